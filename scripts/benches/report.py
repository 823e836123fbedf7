# SPDX-License-Identifier: GPL-3.0-or-later
"""How long the report of a run takes, without its film, by numbers of shards and frames.

The run is made up: shards of a deck fly to all sides in a scenario with charges, zones and neighbours, so that every
section of the report is there.
"""

import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(1, str(Path(__file__).resolve().parents[2] / "tests"))

from support.run_folders import TOLD, flying_shards, keep_run

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.report.write import write_report

SIZES = ((50, 40), (200, 150), (1000, 300))
"""Numbers of shards and of frames; the last is the size that the report is to take less than 20 s for."""


def main(smallest: bool) -> None:
    """Make the report of each run once and print its seconds."""
    for shards, frames in ((10, 5),) if smallest else SIZES:
        with tempfile.TemporaryDirectory() as folder:
            run = keep_run(Path(folder) / "run", flying_shards(shards, frames), TOLD)
            began = time.perf_counter()
            write_report([run], None, progress=Silence())
            print(f"{shards:>5} shards, {frames} frames: {time.perf_counter() - began:5.1f} s")
