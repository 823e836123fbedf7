# SPDX-License-Identifier: GPL-3.0-or-later
"""Print a digest of the logs of a scenario that is run in a new folder."""

import hashlib
import os
import sys
import tempfile
from pathlib import Path

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.simulation.run import run_scenario

if "one core" in sys.argv[2:] and hasattr(os, "sched_setaffinity"):
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
digest = hashlib.sha256()
with tempfile.TemporaryDirectory() as folder:
    run = Path(folder) / "run"
    summary = run_scenario(read_scenario(sys.argv[1]), run, overwrite=False, pictures=False, progress=Silence())
    assert summary["connections"]["broken"] and summary["blast"] and len(summary["events"]) == 2
    for log in ("force", "debris", "breaking", "explosion"):
        digest.update((run / f"{log}_log.csv").read_bytes())
print(digest.hexdigest())
sys.stdout.flush()
