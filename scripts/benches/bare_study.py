# SPDX-License-Identifier: GPL-3.0-or-later
"""Play all runs of a study with nothing recorded, and print the seconds of their steps, of clock and processor.

Usage: bare_study.py alone | turns STUDY.toml

Alone, steps are as Blender plays them by itself. In turns they change what ours change, and each run is made once more
as a study makes it, whose seconds are printed too: the rest of the computer slows both alike.
"""

import json
import os
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path

import bpy
import numpy as np

from bridge_demolition_addon.bullet.world import BulletWorld, WorldState
from bridge_demolition_addon.model.scenario import Scenario
from bridge_demolition_addon.model.scenario.file import scenario_text
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.structure.kept_models import KeptModels
from bridge_demolition_addon.model.study.file import Study, read_study
from bridge_demolition_addon.model.study.sampled_runs import sampled_run
from bridge_demolition_addon.scene.bodies import bodies_of
from bridge_demolition_addon.scene.connections.constraints import connections_of
from bridge_demolition_addon.scene.demolition import build_demolition
from bridge_demolition_addon.scene.world import START_FRAME
from bridge_demolition_addon.studies.run_program import play


def main(way: str, path: str) -> None:
    """Play the runs alone, or in turns with those of a study, of which the first in the process does not count."""
    study, seconds, of_runs = read_study(path), np.zeros(2), np.zeros(2)
    scenarios = [sampled_run(study, number).scenario for number in range(1, study.settings.runs + 1)]
    if way == "turns":
        _seconds_of_run(scenarios[0], study)
    for scenario in scenarios:
        seconds += _seconds_of_steps(scenario, as_ours=way == "turns")
        if way == "turns":
            of_runs += _seconds_of_run(scenario, study)
    print(json.dumps([*seconds, *(of_runs if way == "turns" else ())]), flush=True)
    os._exit(0)  # Blender's own end may hang


def _seconds_of_steps(scenario: Scenario, *, as_ours: bool) -> np.ndarray:
    """Return the seconds of a run's steps, of clock and processor, maybe with the same changes as ours."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    scene = bpy.context.scene
    build_demolition(scene, scenario, checked_model(scenario))
    with _broken_ones_collide(scene) if as_ours else nullcontext():
        began = _clocks()
        for frame in range(START_FRAME, scene.frame_end + 1):
            scene.frame_set(frame)
        return _clocks() - began


def _seconds_of_run(scenario: Scenario, study: Study) -> np.ndarray:
    """Return the seconds of a whole run of a study, of clock and processor."""
    request, began = {"scenario": scenario_text(scenario), "study": study.settings.shared_text}, _clocks()
    with tempfile.TemporaryDirectory() as folder:
        play(KeptModels(), request, Path(folder))
    return _clocks() - began


def _clocks() -> np.ndarray:
    return np.array((time.perf_counter(), time.process_time()))


@contextmanager
def _broken_ones_collide(scene: bpy.types.Scene) -> Iterator[None]:
    """Let bodies collide again once nothing connects them, which alone changes what happens."""
    world = BulletWorld(scene, bodies_of(scene), connections_of(scene))

    def bind(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
        if scene.frame_current == START_FRAME + 1 and world.bind(depsgraph) is WorldState.NEW:
            table = world.constraints
            world.call_around_substeps(lambda _: None, lambda _: table.let_broken_collide(table.intact()))

    bpy.app.handlers.frame_change_post.append(bind)
    yield
    bpy.app.handlers.frame_change_post.remove(bind)
    world.release()


if __name__ == "__main__":
    main(*sys.argv[1:])
