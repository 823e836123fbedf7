# SPDX-License-Identifier: GPL-3.0-or-later
"""What elastic connections cost in a frame, next to Blender's bare step and to recording rigid ones, in the same run.

The deck of the other benches stands on its piers, all awake, in more and more shards. Standing, rows and equations are
made once; while a bridge breaks they are made anew in every sub-step. A second column has that, forced: its equations
are thrown away before each sub-step.
"""

import statistics
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from dataclasses import replace
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from bench_deck import DECK

from bridge_demolition_addon.engineering.elasticity import structure
from bridge_demolition_addon.model.scenario import ConnectionSettings
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.scene.connections.elasticity import damping_ratio_of, forget_elasticity, keep_elasticity
from bridge_demolition_addon.scene.demolition import build_demolition
from bridge_demolition_addon.scene.world import START_FRAME
from bridge_demolition_addon.simulation.blender_events import start_recording, stop_recording
from bridge_demolition_addon.simulation.recording.recorder import Recording

FRAMES, ROUNDS = 4, 3
SHARDS = (200, 1000, 3000)
SETTINGS = ConnectionSettings(
    type="FIXED",
    method="face",
    material="steel",  # so that nothing breaks
    stiffness="elastic",
    elastic_modulus_n_mm2=34e3,
    poisson_ratio=0.2,
)


def main() -> None:
    """Build the deck in each number of shards, play it every way in turn, and print the least times and ratios."""
    for count in map(int, sys.argv[1:] or SHARDS):
        scenario = replace(DECK, connections=SETTINGS, fracture=replace(DECK.fracture, shards=count))
        model = build_model(scenario)
        bpy.ops.wm.read_factory_settings(use_empty=True)
        scene = bpy.context.scene
        build_demolition(scene, scenario, model)
        made = [each for each in bpy.data.objects if each.rigid_body_constraint]
        ratio, seconds = damping_ratio_of(scene), {}
        with tempfile.TemporaryDirectory() as folder:
            for _ in range(ROUNDS):
                for way in ("bare step", "rigid", "elastic", "elastic, anew in every sub-step"):
                    forget_elasticity(scene)
                    if way.startswith("elastic"):
                        keep_elasticity(scene, made, model.stiffness, ratio, model.thicknesses_m())
                    recorded = nullcontext() if way == "bare step" else _recording(scene, Path(folder))
                    turned = 0.0 if "anew" in way else structure.TURNED_RAD
                    with recorded, _refreshed_from(turned):
                        seconds.setdefault(way, []).append(_frame_seconds(scene))
        print(f"{count} shards, {len(made)} connections")
        bare = min(seconds["bare step"])
        for way, times in seconds.items():
            spread = statistics.median(times) / min(times) - 1.0
            print(f"  {way:35} {1e3 * min(times):8.1f} ms a frame  {min(times) / bare:5.2f}  (spread {spread:.0%})")


@contextmanager
def _recording(scene: bpy.types.Scene, folder: Path) -> Iterator[None]:
    start_recording(recording := Recording(scene, folder))
    try:
        yield
    finally:
        stop_recording()
        recording.forget()
    if recording.error:
        raise recording.error


@contextmanager
def _refreshed_from(turned_rad: float) -> Iterator[None]:
    before, structure.TURNED_RAD = structure.TURNED_RAD, turned_rad
    try:
        yield
    finally:
        structure.TURNED_RAD = before


def _frame_seconds(scene: bpy.types.Scene) -> float:
    """Processor time of a frame, after those in which Blender makes a new world."""
    scene.rigidbody_world.time_scale = scene.rigidbody_world.time_scale  # makes Blender forget the frames it played
    for frame in range(START_FRAME, START_FRAME + 3):
        scene.frame_set(frame)
    began = time.process_time()
    for frame in range(START_FRAME + 3, START_FRAME + 3 + FRAMES):
        scene.frame_set(frame)
    return (time.process_time() - began) / FRAMES


if __name__ == "__main__":
    main()
