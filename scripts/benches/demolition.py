# SPDX-License-Identifier: GPL-3.0-or-later
"""What recording costs in a frame of the demolitions that users run, next to Blender's bare step of the same bodies.

A bridge with cracks, bars and bearings, brought down by drilled charges or by a ball: before anything happens to it,
and while it comes down. The bare step is of the same bodies and connections, all awake and played in turn, in the same
frames, with nothing recorded and as many passes of the solver as Blender makes by default: they stand, as Blender alone
breaks none of them.
"""

import tempfile
import time
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path

import numpy as np
from benches.deck import FIRST_FRAMES, SMALLEST, build_scene, frame_seconds, make_world, ratios_to_bare_step, recorded

from bridge_demolition_addon.model.scenario import Scenario, ShardSettings
from bridge_demolition_addon.model.scenario.file import read_scenario

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
DRILLED, BALL = EXAMPLES / "drilled" / "two_spans.toml", EXAMPLES / "two_spans_13m_ball.toml"
CASES = ((DRILLED, 100), (DRILLED, 200), (BALL, 200), (DRILLED, 400), (DRILLED, 1000))
ROUNDS = 3
PASSES_OF_BLENDER = 10
BEGINS_S, COMES_DOWN_S = 0.5, 0.7
"""When something happens to it, and for how long it is timed from then on."""

WAYS = {"every sub-step": {"every_substep": True}, "as in a study": {"every_substep": True, "loads": False}}


def main(smallest: bool) -> dict[str, float]:
    """Build each bridge, play it every way in turn, print and return ratios."""
    ratios = {}
    for file, shards in ((DRILLED, SMALLEST),) if smallest else CASES:
        scenario = demolition(file, shards)
        scene = build_scene(scenario)
        began = round(BEGINS_S / scene.render.fps_base * scene.render.fps) - FIRST_FRAMES
        frames = began + round(COMES_DOWN_S * scene.render.fps)
        before: dict[str, list[float]] = {}
        after: dict[str, list[float]] = {}
        with tempfile.TemporaryDirectory() as folder:
            for _ in range(1 if smallest else ROUNDS):
                for way, settings in ({"bare step": None} | WAYS).items():
                    passes = PASSES_OF_BLENDER if settings is None else scenario.time.solver_iterations
                    scene.rigidbody_world.solver_iterations = passes
                    with nullcontext() if settings is None else recorded(scene, Path(folder), **settings):
                        make_world(scene)
                        seconds = frame_seconds(scene, frames, time.process_time)
                    before.setdefault(way, []).append(float(np.median(seconds[:began])))
                    after.setdefault(way, []).append(float(np.mean(seconds[began:])))
        name = f"{file.parent.name} {file.stem}" if file.parent != EXAMPLES else file.stem
        for when, of_ways in (("standing", before), ("coming down", after)):
            print(f"{name}, {shards} shards, {len(scene.rigidbody_world.constraints.objects)} connections, {when}")
            for way, ratio in ratios_to_bare_step(of_ways).items():
                ratios[f"{name}, {shards} shards, {when}, {way} over bare step"] = ratio
    return ratios


def demolition(file: Path, shards: int) -> Scenario:
    """Return an example in so many shards, all awake, to which something happens at once."""
    scenario = read_scenario(file)
    awake = ShardSettings(use_deactivation=False, start_deactivated=False)
    scenario = replace(scenario, fracture=replace(scenario.fracture, shards=shards), shards=awake)
    if scenario.blast:
        return replace(scenario, blast=replace(scenario.blast, start_s=BEGINS_S))
    fall_m = 0.5 * 9.81 * BEGINS_S**2
    return replace(scenario, ball=replace(scenario.ball, release_time_s=0.0, drop_height_m=fall_m))
