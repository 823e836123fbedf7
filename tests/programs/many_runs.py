# SPDX-License-Identifier: GPL-3.0-or-later
"""Run two studies of draws that do nothing, and print what a draw cost and kept. Usage: … STUDY STUDY FOLDER

Prints, of each study, how many draws it had, the processor time of this process for each in ms, and its memory after
them in MB.
"""

import sys
import time
from pathlib import Path

from bridge_demolition_addon.model.study.file import read_study
from bridge_demolition_addon.studies.engine import LocalProcesses
from bridge_demolition_addon.studies.run_process import RunLimits
from bridge_demolition_addon.studies.session import EnsembleSession

VERSIONS = {"program": "that does nothing"}
DOES_NOTHING = """
import sys
print('bda-draw {"versions": {"program": "that does nothing"}}', flush=True)
for line in sys.stdin:
    print('bda-draw {"status": "done", "outputs": {"reach_m": 1.0}, "fingerprint": {}}', flush=True)
"""


def memory_mb():
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * 4096 / 1e6


*studies, output = map(Path, sys.argv[1:])
for number, path in enumerate(studies):
    study = read_study(path)
    engine = LocalProcesses(1, RunLimits(), [sys.executable, "-S", "-c", DOES_NOTHING], VERSIONS)
    run = EnsembleSession(study, output / str(number), engine)
    began = time.process_time()
    while not run.planner.is_finished:
        run.step(1.0)
    each_ms = 1e3 * (time.process_time() - began) / run.planner.total
    run.stop()
    print(run.planner.total, each_ms, memory_mb(), flush=True)
assert "bpy" not in sys.modules
