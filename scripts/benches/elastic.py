# SPDX-License-Identifier: GPL-3.0-or-later
"""What elastic connections cost in a frame, next to Blender's bare step and to recording rigid ones, in the same run.

The deck stands on its piers in more and more shards. Standing, rows and equations are made once; while a bridge breaks
they are made again in every sub-step. The last way forces that: equations are thrown away before each sub-step.
"""

import tempfile
import time
from contextlib import nullcontext
from pathlib import Path
from unittest.mock import patch

import bpy
from benches.deck import (
    SMALLEST,
    deck,
    frame_s,
    frames_and_rounds,
    make_world,
    ratios_to_bare_step,
    recorded,
)

from bridge_demolition_addon.engineering.elasticity import substep
from bridge_demolition_addon.model.scenario import ConnectionSettings
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.scene.connections.elasticity import elasticity_of, forget_elasticity, keep_elasticity
from bridge_demolition_addon.scene.demolition import build_demolition

SIZES = (200, 1000)
SETTINGS = ConnectionSettings(
    type="FIXED",
    method="face",
    material="steel",  # so that nothing breaks
    stiffness="elastic",
    elastic_modulus_n_mm2=34e3,
    poisson_ratio=0.2,
)
WAYS = ("bare step", "rigid", "elastic", "elastic, again in every sub-step")


def main(smallest: bool) -> dict[str, float]:
    """Build the deck in each number of shards, play it every way in turn, print and return ratios."""
    ratios = {}
    for shards in (SMALLEST,) if smallest else SIZES:
        scenario = deck(shards, connections=SETTINGS)
        model = build_model(scenario)
        bpy.ops.wm.read_factory_settings(use_empty=True)
        scene = bpy.context.scene
        build_demolition(scene, scenario, model)
        made = [obj for obj in bpy.data.objects if obj.rigid_body_constraint]
        damping_ratio, seconds = elasticity_of(scene, made).damping_ratio, {}
        frames, rounds = frames_and_rounds(shards)
        with tempfile.TemporaryDirectory() as folder:
            for _ in range(rounds):
                for way in WAYS:
                    forget_elasticity(scene)
                    if way.startswith("elastic"):
                        keep_elasticity(scene, made, model.stiffness, damping_ratio, model.thicknesses_m())
                    turned_rad = 0.0 if "again" in way else substep.TURNED_RAD
                    with (
                        nullcontext() if way == "bare step" else recorded(scene, Path(folder)),
                        patch.object(substep, "TURNED_RAD", turned_rad),
                    ):
                        make_world(scene)
                        seconds.setdefault(way, []).append(frame_s(scene, frames, time.process_time))
        print(f"{shards} shards, {len(made)} connections")
        for way, ratio in ratios_to_bare_step(seconds).items():
            ratios[f"{way} over bare step, {shards} shards"] = ratio
    return ratios
