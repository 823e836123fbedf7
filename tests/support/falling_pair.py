# SPDX-License-Identifier: GPL-3.0-or-later
"""Two blocks that fall while they are recorded, and what has to hold once their recording has ended."""

import csv

import numpy as np
from support.blocks import Blocks

from bridge_demolition_addon.errors import SimulationError
from bridge_demolition_addon.simulation import blender_events
from bridge_demolition_addon.simulation.blender_events import start_recording, stop_recording
from bridge_demolition_addon.simulation.recording.recorder import Recording

FRAMES = 10
"""Recorded before something goes wrong: frames 2 to 11."""


class FallingPair:
    """Two blocks that fall with a connection between them, one of them held by another connection to the ground."""

    def __init__(self):
        self.blocks = Blocks()
        self.scene = self.blocks.scene
        self.ground = self.blocks.block((0, 0, -0.5), size_m=(10, 10, 1))
        self.near = self.blocks.block((0, 0, 1.5), 100.0)
        self.far = self.blocks.block((1, 0, 1.5), 100.0)
        self.held = self.blocks.connect("FIXED", (0, 0, 0.5), self.ground, self.near)
        self.between = self.blocks.connect("FIXED", (0.5, 0, 1.5), self.near, self.far)

    def record(self, folder):
        recording = Recording(self.scene, folder)
        start_recording(recording)
        play(self.scene, 1, FRAMES + 1)
        assert recording.error is None
        return recording


def play(scene, first, last):
    for frame in range(first, last + 1):
        scene.frame_set(frame)


def lists_of_handlers(blender):
    every = (getattr(blender.app.handlers, name) for name in dir(blender.app.handlers))
    return [handlers for handlers in every if isinstance(handlers, list)]


def assert_ended(blender, recording, folder, *words, bodies=3):
    """The recording says why it ended, kept what it had, and left nothing behind."""
    assert isinstance(recording.error, SimulationError)
    for word in words:
        assert word in str(recording.error)
    assert_whole(recording, folder, range(2, FRAMES + 2), bodies)
    stop_recording()
    assert_handlers_gone(blender)


def assert_whole(recording, folder, frames, bodies=3):
    """Results and logs hold all frames, and the logs end with a whole line."""
    results = recording.results()
    assert results.frames.number.tolist() == list(frames)
    assert np.isfinite(results.frames.loads.body_forces_n).all()
    logged = {"force": bodies * len(frames), "debris": 2 * bodies, "breaking": 0}
    for log, count in logged.items():
        text = (folder / f"{log}_log.csv").read_text(encoding="utf-8")
        assert text.endswith("\n")
        rows = list(csv.reader(text.splitlines()))
        assert len(rows) == 1 + count
        assert {len(row) for row in rows} == {len(rows[0])}


def assert_handlers_gone(blender):
    handlers = (handler for every in lists_of_handlers(blender) for handler in every)
    ours = (handler for handler in handlers if handler.__module__ == blender_events.__name__)
    assert not any(ours) or blender_events.recorded_scene(blender.context.scene).stands_still
