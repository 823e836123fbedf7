# SPDX-License-Identifier: GPL-3.0-or-later
"""Simulate very many frames in one run, and print memory and time per frame as they go, and the files at the end.

A small bridge stands awake by its own strength all the time, so every frame is as much work as the one before: memory
should stay flat and the time of a frame the same.
"""

import os
import statistics
import sys
import tempfile
import time
from pathlib import Path

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.model.results.arrays import RESULTS_FILE
from bridge_demolition_addon.model.run_folder.files import SUMMARY_FILE
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.system.progress import Counts

FRAMES, PARTS = 10_000, 10
SCENARIO = """
[scenario]
title = "soak"
[time]
duration_s = {duration_s}
frames_per_second = 24
substeps_per_frame = 10
solver_iterations = 20
[bridge]
density_kg_m3 = 2400
span_lengths_m = [10.0]
[bridge.deck]
width_m = 8.0
thickness_m = 0.7
overhang_m = 0.6
[bridge.piers]
kind = "wall"
column_length_m = 0.8
column_width_m = 7.0
height_m = 4.0
[fracture]
shards = 20
[connections]
type = "FIXED"
method = "face"
breaking_force_n = 1e9
[shards]
use_deactivation = false
start_deactivated = false
"""


class Watch(Silence):
    """Notes when each frame ends, and how much memory is in use after each part of them."""

    def __init__(self, frames: int):
        self._part = max(2, frames // PARTS)
        self._last_s = time.perf_counter()
        self._seconds: list[float] = []
        self.parts: list[tuple[int, float, float]] = []
        """Frames so far, memory in MB, and the median time of a frame in the part in ms."""

    def frame(self, done: int, total: int, connections: Counts, left_s: float | None) -> None:
        """Note a frame."""
        now_s = time.perf_counter()
        self._seconds.append(now_s - self._last_s)
        self._last_s = now_s
        if done % self._part == 0:
            self.parts.append((done, memory_mb(), 1e3 * statistics.median(self._seconds)))
            self._seconds.clear()


def memory_mb() -> float:
    """Return the memory that this process has in use, as Linux counts it."""
    resident = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return resident * os.sysconf("SC_PAGE_SIZE") / 1e6


def main(frames: int) -> None:
    """Run so many frames and print what became of memory, time and files."""
    from bridge_demolition_addon.simulation.run import run_scenario

    scenario, watch = scenario_from_text(SCENARIO.format(duration_s=frames / 24)), Watch(frames)
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "run"
        run_scenario(scenario, output, overwrite=False, pictures=False, progress=watch)
        sizes_kb = {name: (output / name).stat().st_size / 1e3 for name in (SUMMARY_FILE, RESULTS_FILE)}
    print(f"{'frames':>8}{'memory, MB':>12}{'a frame, ms':>13}")
    for done, megabytes, milliseconds in watch.parts:
        print(f"{done:8}{megabytes:12.1f}{milliseconds:13.2f}")
    (_, memory_0, time_0), *_, (_, memory_1, time_1) = watch.parts
    print(f"memory of the last part over that of the first: {memory_1 / memory_0:.3f}")
    print(f"time of a frame: {time_1 / time_0:.3f}")
    for name, kilobytes in sizes_kb.items():
        print(f"{name}: {kilobytes:.0f} kB")
    sys.stdout.flush()
    os._exit(0)  # Blender's own end may hang.


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else FRAMES)
