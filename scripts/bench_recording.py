# SPDX-License-Identifier: GPL-3.0-or-later
"""What recording costs in a frame, next to Blender's bare step and to the way of 2019, in the same run.

A deck of 1000 shards and some 4400 connections hangs between its piers, all awake, so that Bullet has all of it to
solve in every sub-step. Each way plays the same frames from the start. Three ways do a part of recording each, in the
order in which they add up: Bullet writes the loads of connections, calls back around sub-steps, and what it holds is
copied after each. The way of 2019 goes through all objects of the
file in Python, adds one number per connection to two entries of a dictionary, opens its log for every frame, writes a
line per body and gives each body one of 200 materials. The number itself, which only a patched Blender of its time
gave, is replaced here by one that any Blender has; it costs the same to read. Takes some 80 s where the
bare step takes 0.2 s.
"""

import statistics
import sys
import tempfile
import time
from collections.abc import Callable
from contextlib import contextmanager
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from bench_deck import DECK

from bridge_demolition_addon.bullet.snapshots import SnapshotTaker
from bridge_demolition_addon.bullet.world import BulletWorld, WorldState
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.scene.bodies import bodies_of
from bridge_demolition_addon.scene.connections.constraints import connections_of
from bridge_demolition_addon.scene.demolition import build_demolition
from bridge_demolition_addon.scene.world import START_FRAME
from bridge_demolition_addon.simulation.blender_events import start_recording, stop_recording
from bridge_demolition_addon.simulation.recording.recorder import Recording

FRAMES = 5
ROUNDS = 4
"""Of all ways in turn: what else the machine does only ever adds, so that the least of several is the way's own."""
LEVELS = 200


def main() -> None:
    """Build the deck, play it every way in turn, and print the least times, their spread and ratios."""
    scene = _deck_scene()
    world = scene.rigidbody_world
    print(f"{len(world.collection.objects)} bodies, {len(world.constraints.objects)} connections")
    with tempfile.TemporaryDirectory() as folder:
        ways = {
            "bare step": _bare,
            "loads written": lambda: _part(scene, None),
            "callbacks": lambda: _part(scene, lambda _taker: None),
            "copies alone": lambda: _part(scene, SnapshotTaker.take),
            "every sub-step": lambda: _recording(scene, Path(folder), every_substep=True),
            "last sub-step": lambda: _recording(scene, Path(folder), every_substep=False),
            "way of 2019": lambda: _way_of_2019(Path(folder) / "forces.log"),
        }
        seconds: dict[str, list[float]] = {name: [] for name in ways}
        own: dict[str, list[np.ndarray]] = {"every sub-step": [], "last sub-step": []}
        for _ in range(ROUNDS):
            for name, way in ways.items():
                with way() as recording:
                    _make_world(scene)
                    before = _own_seconds(recording) if recording else None
                    seconds[name].append(_frame_seconds(scene))
                    if recording:
                        own[name].append((_own_seconds(recording) - before) / FRAMES)
    _print_table(seconds, own)


def _deck_scene() -> bpy.types.Scene:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    build_demolition(bpy.context.scene, DECK, build_model(DECK))
    return bpy.context.scene


def _make_world(scene: bpy.types.Scene) -> None:
    """Play the two frames in which Blender makes a new world."""
    scene.rigidbody_world.time_scale = scene.rigidbody_world.time_scale  # makes Blender forget the frames it played
    for frame in (START_FRAME, START_FRAME + 1):
        scene.frame_set(frame)


def _frame_seconds(scene: bpy.types.Scene) -> float:
    """Mean wall time of the frames after those, which is what a user waits for: a part is done beside Bullet."""
    began = time.perf_counter()
    for frame in range(START_FRAME + 2, START_FRAME + 2 + FRAMES):
        scene.frame_set(frame)
    return (time.perf_counter() - began) / FRAMES


@contextmanager
def _bare():
    yield None


@contextmanager
def _part(scene: bpy.types.Scene, after: Callable[[SnapshotTaker], object] | None):
    """Have Bullet write loads and, with a function of what takes snapshots, call it after every sub-step."""
    world = BulletWorld(scene, bodies_of(scene), connections_of(scene))

    def bind(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
        if scene.frame_current == START_FRAME + 1 and world.bind(depsgraph) is WorldState.NEW and after:
            taker = world.snapshots(2 * np.arange(len(world.connections)))
            world.call_around_substeps(lambda _substep_s: None, lambda _substep_s: after(taker))

    bpy.app.handlers.frame_change_post.append(bind)
    yield None
    bpy.app.handlers.frame_change_post.remove(bind)
    world.release()


@contextmanager
def _recording(scene: bpy.types.Scene, folder: Path, *, every_substep: bool):
    recording = Recording(scene, folder, every_substep=every_substep)
    start_recording(recording)
    yield recording
    stop_recording()
    if recording.error:
        raise recording.error


@contextmanager
def _way_of_2019(log: Path):
    after = _handler_of_2019(log)
    bpy.app.handlers.frame_change_post.append(after)
    yield None
    bpy.app.handlers.frame_change_post.remove(after)


def _handler_of_2019(log: Path) -> Callable:
    materials = [bpy.data.materials.new(f"Level {level}") for level in range(LEVELS)]

    def after(scene: bpy.types.Scene, _depsgraph: bpy.types.Depsgraph) -> None:
        forces: dict[str, float] = {}
        for each in bpy.data.objects:
            constraint = each.rigid_body_constraint
            if constraint:
                first, second, force = constraint.object1.name, constraint.object2.name, constraint.breaking_threshold
                forces[first] = forces.get(first, 0.0) + force
                forces[second] = forces.get(second, 0.0) - force
        with log.open("a", encoding="utf-8") as file:
            for name, force in forces.items():
                file.write(f"{name}:{force}\n")
        for number, name in enumerate(forces):
            slots = bpy.data.objects[name].data.materials
            material = materials[(number + scene.frame_current) % LEVELS]
            if slots:
                slots[0] = material
            else:
                slots.append(material)

    return after


def _own_seconds(recording: Recording) -> np.ndarray:
    """What our own code has taken, all of it and the part within sub-steps."""
    return np.array([recording.seconds, recording.reading_seconds])


def _print_table(seconds: dict[str, list[float]], own: dict[str, list[np.ndarray]]) -> None:
    """The whole frame, what our own code takes in it and in sub-steps, all against the bare step: least of all rounds.

    The spread is by how much the median and the most of them are longer.
    """
    bare = min(seconds["bare step"])
    print(
        f"{'least of ' + str(ROUNDS) + ' rounds':>18}{'ms a frame':>12}{'median, most':>16}{'over bare step':>16}",
        end="",
    )
    print(f"{'ours, ms':>10}{'of bare step':>14}{'in sub-steps':>14}")
    for name, each in seconds.items():
        frame = min(each)
        spread = f"{statistics.median(each) / frame - 1.0:+.0%}, {max(each) / frame - 1.0:+.0%}"
        line = f"{name:>18}{1e3 * frame:>12.1f}{spread:>16}{frame / bare - 1.0:>16.1%}"
        if name in own:
            ours, reading = np.min(own[name], axis=0)
            line += f"{1e3 * ours:>10.1f}{ours / bare:>14.1%}{reading / bare:>14.1%}"
        print(line)


if __name__ == "__main__":
    main()
