# SPDX-License-Identifier: GPL-3.0-or-later
"""What blast loads cost in a frame, next to Blender's bare step and to the way of 2019, in the same run.

A deck in 250 to 2000 shards hangs between its piers, all awake, with two charges below it. Three kinds of frames are
timed: all shards loaded at once, as in a frame of a 24th of a second; a twentieth of them, as in slow motion; and none,
which is what every other frame of the run costs. The way of 2019 keeps three tube fields for each body switched on and
adds up each body's area in Python, face by face.
"""

import sys
import time
from dataclasses import replace
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from bench_deck import DECK

from bridge_demolition_addon.model.blast.charges import Charge
from bridge_demolition_addon.model.blast.explosion import Explosion
from bridge_demolition_addon.model.blast.settings import Apply, BlastSettings
from bridge_demolition_addon.model.scenario import FractureSettings
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.scene.blast.charges import create_charges
from bridge_demolition_addon.scene.blast.force_fields import build_force_objects
from bridge_demolition_addon.scene.blast.settings import keep_blast
from bridge_demolition_addon.scene.bodies import bodies_of
from bridge_demolition_addon.scene.demolition import build_demolition
from bridge_demolition_addon.scene.world import START_FRAME
from bridge_demolition_addon.simulation.blender_events import start_recording, stop_recording
from bridge_demolition_addon.simulation.recording import blast
from bridge_demolition_addon.simulation.recording.recorder import Recording

FRAMES = 5
"""Of each kind."""

COUNTS = (250, 500, 1000, 2000)
WAY_OF_2019_UP_TO = 500
"""Shards; with 1000, its 3000 fields take minutes for a frame."""

FEW = 20
"""One shard in so many is loaded in frames of slow motion."""

CHARGES = (
    Charge(name="west", place_m=(7.0, 0.0, 1.0), mass_kg=1e-6),
    Charge(name="east", place_m=(22.0, 0.0, 1.0), mass_kg=1e-6),
)
"""So small that they load every shard and move none: the frames to compare do the same work otherwise."""


class SteadyLoads(Explosion):
    """Loads some bodies in every frame, as if charges went off in each."""

    every = 1

    def loads(self, start_s, end_s, centres, rotations):
        found = super().loads(0.0, 1.0, centres, rotations)
        chosen = found.bodies % self.every == 0
        return replace(found, **{name: getattr(found, name)[chosen] for name in found.__dataclass_fields__})

    def is_quiet(self, start_s, end_s):
        return not self.every


def main() -> None:
    """Print the seconds of a frame and their ratio to the bare step, for each number of shards."""
    blast.Explosion = SteadyLoads
    print(f"{'shards':>7}{'frame':>24}{'ms':>10}{'of bare step':>14}")
    for count in COUNTS:
        bare = _bare(count)
        _show(count, "bare step", bare, bare)
        for apply in Apply:
            for name, every in (("all loaded", 1), ("one in 20", FEW), ("none", 0)):
                _show(count, f"{apply.value}, {name}", _with_blast(count, apply, every), bare)
        if count <= WAY_OF_2019_UP_TO:
            _show(count, "way of 2019", _way_of_2019(count), bare)


def _show(count: int, name: str, seconds: float, bare: float) -> None:
    print(f"{count:>7}{name:>24}{1e3 * seconds:>10.1f}{seconds / bare:>14.2f}", flush=True)


def _scene(count: int, apply: Apply | None) -> bpy.types.Scene:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scenario = replace(DECK, fracture=FractureSettings(shards=count))
    scene = bpy.context.scene
    build_demolition(scene, scenario, build_model(scenario))
    if apply:
        create_charges(scene, CHARGES)
        keep_blast(scene, BlastSettings(start_s=0.0, apply=apply.value))
        if apply is Apply.FIELDS:
            build_force_objects(scene, bodies_of(scene))
    return scene


def _frames(scene: bpy.types.Scene) -> float:
    """Shortest time of the frames after those in which Blender makes its world."""
    first = START_FRAME + 3
    for frame in range(START_FRAME, first):
        scene.frame_set(frame)
    times = []
    for frame in range(first, first + FRAMES):
        began = time.perf_counter()
        scene.frame_set(frame)
        times.append(time.perf_counter() - began)
    return min(times)  # what else the machine does only ever adds


def _bare(count: int) -> float:
    return _frames(_scene(count, None))


def _with_blast(count: int, apply: Apply, every: int) -> float:
    """What blast adds to a bare step: loads are recorded in neither."""
    SteadyLoads.every = every
    scene = _scene(count, apply)
    start_recording(recording := _Unrecorded(scene, Path()))
    seconds = _frames(scene)
    stop_recording()
    if recording.error:
        raise recording.error
    return seconds


class _Unrecorded(Recording):
    """A recording that applies the blast and keeps next to nothing, so that little more than the blast is timed."""

    def __init__(self, scene: bpy.types.Scene, folder: Path):
        super().__init__(scene, folder, every_substep=False)

    def _keep(self, frame, balls):
        self._last = frame

    def _begin_blast(self, world):
        self._blast = blast.Blast(self.scene, self._bodies, self.inventory, world)
        self._last = None
        self._logs = _NoLogs()


class _NoLogs:
    def write_breaks(self, *_):
        pass

    def close(self, _):
        pass


def _way_of_2019(count: int) -> float:
    """Three tube fields per body, each body's area by a loop over its faces, in every frame."""
    scene = _scene(count, None)
    shards = [body for body in bodies_of(scene) if body.rigid_body.type == "ACTIVE"]
    bpy.ops.object.effector_add(type="FORCE")
    template = bpy.context.object
    template.field.falloff_type, template.field.use_max_distance, template.field.use_radial_max = "TUBE", True, True
    template.field.distance_max, template.field.radial_max, template.field.strength = 5.0, 2.0, 1e-9
    fields = [template.copy() for _ in shards for _ in range(3)]
    collection = bpy.data.collections.new("Fields")
    for field in fields:
        collection.objects.link(field)
    scene.collection.children.link(collection)
    source = np.array(CHARGES[0].place_m)

    def before(scene: bpy.types.Scene, _depsgraph: bpy.types.Depsgraph | None = None) -> None:
        for row, body in enumerate(shards):
            place = body.matrix_world.translation
            direction = (np.array(place) - source) / np.linalg.norm(np.array(place) - source)
            area = 0.0
            for polygon in body.data.polygons:
                area += 0.5 * abs(float(np.array(polygon.normal) @ direction)) * polygon.area
            for field in fields[3 * row : 3 * row + 3]:
                field.location, field.field.strength = place, 1e-9 * area

    bpy.app.handlers.frame_change_pre.append(before)
    seconds = _frames(scene)
    bpy.app.handlers.frame_change_pre.remove(before)
    return seconds


if __name__ == "__main__":
    main()
