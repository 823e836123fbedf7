# SPDX-License-Identifier: GPL-3.0-or-later
"""What a truss of steel costs in a frame, next to Blender's bare step with the same bodies, in the same run.

It is the span of the example on supports, three times in a row and in more pieces, all awake: at rest, and with its
equations made again in every sub-step, as while it breaks.
"""

import tempfile
import time
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path
from unittest.mock import patch

import bpy
from benches.deck import frame_s, make_world, ratios_to_bare_step, recorded

from bridge_demolition_addon.engineering.elasticity import substep
from bridge_demolition_addon.model.scenario import Scenario, ShardSettings
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.scene.demolition import build_demolition

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "steel" / "truss_severed.toml"
FRAMES, ROUNDS = 4, 7
SPANS, PIECES, GAP_M = 3, 5, 2.0
WAYS = ("bare step", "truss at rest", "truss, again in every sub-step")


def main(smallest: bool) -> dict[str, float]:
    """Build the truss, play it every way in turn, print and return ratios."""
    scenario = truss(1, 2) if smallest else truss(SPANS, PIECES)
    model = build_model(scenario)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    build_demolition(scene, scenario, model)
    seconds: dict[str, list[float]] = {}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(1 if smallest else ROUNDS):
            for way in WAYS:
                with (
                    nullcontext() if way == "bare step" else recorded(scene, Path(folder)),
                    patch.object(substep, "TURNED_RAD", 0.0 if "again" in way else substep.TURNED_RAD),
                ):
                    make_world(scene)
                    seconds.setdefault(way, []).append(frame_s(scene, FRAMES, time.process_time))
    print(
        f"{len(scenario.steelwork.all_members)} bars, {len(model.shards)} bodies, {len(model.connections)} connections"
    )
    return {f"{way} over bare step": ratio for way, ratio in ratios_to_bare_step(seconds).items()}


def truss(spans: int, pieces: int) -> Scenario:
    """Return so many spans of the example with so many pieces of each bar, on supports, which nothing severs."""
    scenario = read_scenario(EXAMPLE)
    [one] = scenario.steelwork.trusses
    x_m, *beside_m = one.position_m
    places_m = [(x_m + number * (one.length_m + GAP_M), *beside_m) for number in range(spans)]
    in_a_row = [
        replace(one, name=f"span {number}", position_m=position_m, is_supported=True)
        for number, position_m in enumerate(places_m, start=1)
    ]
    steelwork = replace(scenario.steelwork, nodes=(), members=(), trusses=tuple(in_a_row), pieces=pieces)
    awake = ShardSettings(use_deactivation=False, start_deactivated=False)
    return replace(scenario, steelwork=steelwork, removals=(), shards=awake)
