# SPDX-License-Identifier: GPL-3.0-or-later
"""Play all draws of a study with nothing recorded, and print the seconds of their steps, of clock and processor.

Usage: bare_study.py alone | same STUDY.toml
"""

import json
import os
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext

import bpy
import numpy as np

from bridge_demolition_addon.bullet.world import BulletWorld, WorldState
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.study.file import read_study
from bridge_demolition_addon.model.study.sampled_runs import sampled_run
from bridge_demolition_addon.scene.bodies import bodies_of
from bridge_demolition_addon.scene.connections.constraints import connections_of
from bridge_demolition_addon.scene.demolition import build_demolition
from bridge_demolition_addon.scene.world import START_FRAME


def main(way: str, path: str) -> None:
    """Play the draws alone, as Blender does, or with the same changes as ours."""
    study, seconds = read_study(path), np.zeros(2)
    for number in range(1, study.settings.runs + 1):
        scenario = sampled_run(study, number).scenario
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        scene = bpy.context.scene
        build_demolition(scene, scenario, checked_model(scenario))
        with _broken_ones_collide(scene) if way == "same" else nullcontext():
            began = np.array((time.perf_counter(), time.process_time()))
            for frame in range(START_FRAME, scene.frame_end + 1):
                scene.frame_set(frame)
            seconds += np.array((time.perf_counter(), time.process_time())) - began
    print(json.dumps(seconds.tolist()), flush=True)
    os._exit(0)  # Blender's own end may hang


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
