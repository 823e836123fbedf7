# SPDX-License-Identifier: GPL-3.0-or-later
"""The deck that benches simulate, and the time of its frames.

It hangs between its piers, all awake, so that Bullet has all of it to solve.
"""

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import bpy
import numpy as np

from bridge_demolition_addon.model.scenario import (
    Bridge,
    ConnectionSettings,
    Deck,
    FractureSettings,
    Piers,
    Scenario,
    ShardSettings,
    TimeSettings,
)
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.scene.demolition import build_demolition
from bridge_demolition_addon.scene.world import START_FRAME
from bridge_demolition_addon.simulation.blender_events import start_recording, stop_recording
from bridge_demolition_addon.simulation.recording.recorder import Recording

DECK = Scenario(
    title="bench",
    time=TimeSettings(duration_s=10.0),
    bridge=Bridge(
        span_lengths_m=(29.0,),
        density_kg_m3=2400.0,
        deck=Deck(width_m=12.0, thickness_m=1.0, overhang_m=0.5),
        piers=Piers(column_length_m=1.0, column_width_m=12.0, height_m=3.0),
    ),
    fracture=FractureSettings(shards=1000),
    connections=ConnectionSettings(type="FIXED", method="face", limit_per_shard=10, breaking_force_n=1e9),
    shards=ShardSettings(use_deactivation=False, start_deactivated=False),
)

SMALLEST = 40
"""Shards of the smallest deck."""

FIRST_FRAMES = 3
"""In these Blender makes a new world, which is not timed."""

FRAMES, ROUNDS = {200: 15, 1000: 6}, 15
"""Frames of each number of shards: the first of a world take longer, which few short ones would be full of. Rounds of
all ways in turn are short, as the speed of a computer drifts that shares its memory with others."""

FRAMES_OF_OTHERS = 5


def deck(shards: int, **settings: object) -> Scenario:
    """The deck in so many shards, with other settings of the scenario."""
    return replace(DECK, fracture=FractureSettings(shards=shards), **settings)


def build_scene(scenario: Scenario) -> bpy.types.Scene:
    """Build a scenario in an otherwise empty Blender."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    build_demolition(bpy.context.scene, scenario, build_model(scenario))
    return bpy.context.scene


@contextmanager
def recorded(
    scene: bpy.types.Scene, folder: Path, *, in_window: bool = False, **settings: object
) -> Iterator[Recording]:
    """Record the frames that are played meanwhile, as `bda run` and studies do.

    In a window the scene can be edited meanwhile, and is guarded.
    """
    start_recording(recording := Recording(scene, folder, **settings), alone=not in_window)
    try:
        yield recording
    finally:
        stop_recording()
        recording.forget()
    if recording.error:
        raise recording.error


def make_world(scene: bpy.types.Scene) -> None:
    """Play the frames in which Blender makes a new world."""
    scene.rigidbody_world.time_scale = scene.rigidbody_world.time_scale  # makes Blender forget the frames it played
    for frame in range(START_FRAME, START_FRAME + FIRST_FRAMES):
        scene.frame_set(frame)


def frames_and_rounds(shards: int) -> tuple[int, int]:
    """How many frames to time of a deck in so many shards, and how often; once with the smallest."""
    return FRAMES.get(shards, FRAMES_OF_OTHERS), 1 if shards == SMALLEST else ROUNDS


def frame_seconds(scene: bpy.types.Scene, frames: int, clock: Callable[[], float] = time.perf_counter) -> np.ndarray:
    """Seconds (frames,) of each frame after those."""
    first, marks = START_FRAME + FIRST_FRAMES, [clock()]
    for frame in range(first, first + frames):
        scene.frame_set(frame)
        marks.append(clock())
    return np.diff(marks)


def frame_s(scene: bpy.types.Scene, frames: int, clock: Callable[[], float] = time.perf_counter) -> float:
    """Median of the seconds of those frames, which are alike: the rest of the computer makes some of them longer."""
    return float(np.median(frame_seconds(scene, frames, clock)))


def ratios_to_bare_step(seconds: Mapping[str, Sequence[float]]) -> dict[str, float]:
    """Print how much longer a frame takes in each way than the bare step of the same round, and return the medians."""
    bare, found = np.array(seconds["bare step"]), {}
    for way, times in seconds.items():
        low, middle, high = np.quantile(np.array(times) / bare, (0.25, 0.5, 0.75))
        print(
            f"  {way:35} {1e3 * np.median(times):8.1f} ms a frame  {middle:5.2f}  (half of all {low:.2f} to {high:.2f})"
        )
        if way != "bare step":
            found[way] = float(middle)
    return found
