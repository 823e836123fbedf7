# SPDX-License-Identifier: GPL-3.0-or-later
"""What recording costs in a frame, next to Blender's bare step and to the way of 2019, in the same run.

The deck in 200 shards, and in 1000 with some 4300 connections, is played in each way from the start. Three ways do a
part of recording each, in the order in which they add up: Bullet writes the loads of connections, calls back around
sub-steps, and what it holds is copied after each.
"""

import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path

import bpy
import numpy as np
from benches.deck import (
    SMALLEST,
    build_scene,
    deck,
    frame_s,
    frames_and_rounds,
    make_world,
    ratios_to_bare_step,
    recorded,
)
from benches.way_of_2019 import forces_and_colours

from bridge_demolition_addon.bullet.snapshots import SnapshotTaker
from bridge_demolition_addon.bullet.world import BulletWorld, WorldState
from bridge_demolition_addon.scene.bodies import bodies_of
from bridge_demolition_addon.scene.connections.constraints import connections_of
from bridge_demolition_addon.scene.world import START_FRAME
from bridge_demolition_addon.simulation.recording.recorder import Recording

SIZES = (200, 1000)


def main(smallest: bool) -> dict[str, float]:
    """Build the deck in each number of shards, play it every way in turn, print and return ratios."""
    ratios = {}
    for shards in (SMALLEST,) if smallest else SIZES:
        ratios |= {f"{name}, {shards} shards": ratio for name, ratio in measured(shards).items()}
    return ratios


def measured(shards: int) -> dict[str, float]:
    """Build the deck in so many shards, play it every way in turn, print and return ratios."""
    scene = build_scene(deck(shards))
    frames, rounds = frames_and_rounds(shards)
    world = scene.rigidbody_world
    print(f"{len(world.collection.objects)} bodies, {len(world.constraints.objects)} connections")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        ways = {
            "bare step": nullcontext,
            "loads written": lambda: _part(scene, None),
            "callbacks": lambda: _part(scene, lambda _taker: None),
            "copies alone": lambda: _part(scene, SnapshotTaker.take),
            "every sub-step": lambda: recorded(scene, folder, every_substep=True),
            "last sub-step": lambda: recorded(scene, folder, every_substep=False),
            "every, in a window": lambda: recorded(scene, folder, every_substep=True, in_window=True),
            "way of 2019": lambda: forces_and_colours(folder / "forces.log"),
        }
        seconds: dict[str, list[float]] = {name: [] for name in ways}
        own: dict[str, list[np.ndarray]] = {
            name: [] for name in ("every sub-step", "last sub-step", "every, in a window")
        }
        for _ in range(rounds):
            for name, way in ways.items():
                with way() as recording:
                    make_world(scene)
                    before = _own_seconds(recording) if recording else None
                    seconds[name].append(frame_s(scene, frames))
                    if recording:
                        own[name].append((_own_seconds(recording) - before) / frames)
    ratios = ratios_to_bare_step(seconds)
    _print_own(seconds, own)
    return {f"{name} over bare step": ratios[name] for name in (*own, "way of 2019")}


@contextmanager
def _part(scene: bpy.types.Scene, after: Callable[[SnapshotTaker], object] | None) -> Iterator[None]:
    """Have Bullet write loads and, with a function of what takes snapshots, call it after every sub-step."""
    world = BulletWorld(scene, bodies_of(scene), connections_of(scene))

    def bind(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
        if scene.frame_current == START_FRAME + 1 and world.bind(depsgraph) is WorldState.NEW and after:
            taker = world.snapshots(2 * np.arange(len(world.connection_objects)))
            world.call_around_substeps(lambda _substep_s: None, lambda _substep_s: after(taker))

    bpy.app.handlers.frame_change_post.append(bind)
    yield
    bpy.app.handlers.frame_change_post.remove(bind)
    world.release()


def _own_seconds(recording: Recording) -> np.ndarray:
    """What our own code has taken, all of it and the part within sub-steps."""
    return np.array([recording.seconds, recording.reading_seconds])


def _print_own(seconds: dict[str, list[float]], own: dict[str, list[np.ndarray]]) -> None:
    """What our own code takes of the bare step in the same rounds, and the part of it in sub-steps: medians."""
    for name, times in own.items():
        ours, reading = np.median(np.array(times) / np.array(seconds["bare step"])[:, None], axis=0)
        print(f"  our own code, {name}: {ours:.1%} of the bare step, in sub-steps {reading:.1%}")
