# SPDX-License-Identifier: GPL-3.0-or-later
"""Print how much more memory Python holds after many frames of a recording than after a few, and a frame's own size.

Usage: memory_of_a_recording.py FOLDER FRAMES. The scene has blocks that stand on each other, and a ball that hits them.
"""

import gc
import sys
import tracemalloc
from pathlib import Path

from support.blocks import Blocks

from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.simulation.blender_events import start_recording, stop_recording
from bridge_demolition_addon.simulation.recording.recorder import Recording

WARM = 40
"""Frames after which caches and buffers are there."""

folder, frames = Path(sys.argv[1]), int(sys.argv[2])
blocks = Blocks()
blocks.block((0, 0, -0.5), size_m=(40, 40, 1))
tower = [blocks.block((2.0 * (number % 6), 0, 0.5 + number // 6), 100.0) for number in range(30)]
for first, second in zip(tower, tower[6:], strict=False):
    blocks.connect("FIXED", tuple((first.location + second.location) / 2.0), first, second)
recording = Recording(blocks.scene, folder)
start_recording(recording)


def play(first, last):
    for frame in range(first, last + 1):
        blocks.scene.frame_set(frame)
    gc.collect()


play(1, WARM)
tracemalloc.start()
play(WARM + 1, WARM + 10)  # what is replaced in every frame is counted from here on
before = tracemalloc.get_traced_memory()[0]
play(WARM + 11, WARM + frames)
grown = tracemalloc.get_traced_memory()[0] - before
tracemalloc.stop()
stop_recording()
assert recording.error is None and recording.recorded_frames == WARM + frames - 1
double = sum(values.nbytes for values in load_results(folder).arrays().values() if getattr(values, "ndim", 0) > 1)
print(grown, 2 * double // recording.recorded_frames)
sys.stdout.flush()
