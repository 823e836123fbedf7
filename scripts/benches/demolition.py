# SPDX-License-Identifier: GPL-3.0-or-later
"""What recording costs in a frame of the demolitions that users run, next to Blender's bare step of the same bodies.

A bridge with cracks, bars and bearings, brought down by drilled charges or by a ball: before anything happens to it,
and while it comes down. The bare step is of the same bodies and connections, all awake and played in turn, in the same
frames, with nothing recorded and as many passes of the solver as Blender makes by default: they stand, as Blender alone
breaks none of them. Ratios are of sub-steps: frames have more of them where bodies are fast. Beside it stands what is
not our own code in the same run: Bullet with the contacts, and all passes, that the demolition has.
"""

import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext
from dataclasses import replace
from pathlib import Path

import bpy
import numpy as np
from benches.deck import FIRST_FRAMES, SMALLEST, build_scene, make_world, ratios_to_bare_step, recorded

from bridge_demolition_addon.model.scenario import Scenario, ShardSettings
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.simulation.recording.substeps import SubstepRecorder

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
        seconds, of_bullet = rounds(scene, scenario.time.solver_iterations, 1 if smallest else ROUNDS)
        name = f"{file.parent.name} {file.stem}" if file.parent != EXAMPLES else file.stem
        name = f"{name}, {shards} shards"
        for when, of_ways in seconds.items():
            print(f"{name}, {len(scene.rigidbody_world.constraints.objects)} connections, {when}: of ten sub-steps")
            for way, ratio in ratios_to_bare_step(of_ways).items():
                ratios[f"{name}, {when}, {way} over bare step"] = ratio
        for way, (whole, bullets) in of_bullet.items():
            ratios[f"{name}, {way} over Bullet's own in the same run"] = whole / bullets
            print(f"  all of it, {way}: {whole / bullets:.2f} times what is not our own code")
    return ratios


def rounds(
    scene: bpy.types.Scene, passes: int, count: int
) -> tuple[dict[str, dict[str, list[float]]], dict[str, list[float]]]:
    """Play a scene so often every way: seconds of ten sub-steps by when and way, and of all and of Bullet by way."""
    began = round(BEGINS_S / scene.render.fps_base * scene.render.fps) - FIRST_FRAMES
    frames = began + round(COMES_DOWN_S * scene.render.fps)
    found: dict[str, dict[str, list[float]]] = {"standing": {}, "coming down": {}}
    of_bullet = {way: [0.0, 0.0] for way in WAYS}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(count):
            for way, settings in ({"bare step": None} | WAYS).items():
                scene.rigidbody_world.solver_iterations = PASSES_OF_BLENDER if settings is None else passes
                with (
                    nullcontext() if settings is None else recorded(scene, Path(folder), **settings),
                    own_seconds() as own,
                ):
                    make_world(scene)
                    own[0] = 0.0
                    played = [played_frame(scene, own) for _ in range(frames)]
                seconds, substeps = np.array(played).T
                found["standing"].setdefault(way, []).append(10.0 * np.median(seconds[:began] / substeps[:began]))
                found["coming down"].setdefault(way, []).append(10.0 * seconds[began:].sum() / substeps[began:].sum())
                if settings is not None:
                    of_bullet[way][0] += seconds.sum()
                    of_bullet[way][1] += seconds.sum() - own[0]
    return found, of_bullet


def played_frame(scene: bpy.types.Scene, own: list[float]) -> tuple[float, int]:
    """Play the next frame; return its processor time and its sub-steps."""
    own[1], began = 0, time.process_time()
    scene.frame_set(scene.frame_current + 1)
    return time.process_time() - began, own[1] or scene.rigidbody_world.substeps_per_frame


@contextmanager
def own_seconds() -> Iterator[list[float]]:
    """Count the processor time around sub-steps, and how many sub-steps there were."""
    own, ways = [0.0, 0], {name: getattr(SubstepRecorder, name) for name in ("before_substep", "after_substep")}

    def timed(name: str) -> Callable[[SubstepRecorder, float], None]:
        def around(recorder: SubstepRecorder, substep_s: float) -> None:
            began = time.process_time()
            ways[name](recorder, substep_s)
            own[0] += time.process_time() - began
            own[1] += name == "after_substep"

        return around

    for name in ways:
        setattr(SubstepRecorder, name, timed(name))
    try:
        yield own
    finally:
        for name, way in ways.items():
            setattr(SubstepRecorder, name, way)


def demolition(file: Path, shards: int) -> Scenario:
    """Return an example in so many shards, all awake, to which something happens at once."""
    scenario = read_scenario(file)
    awake = ShardSettings(use_deactivation=False, start_deactivated=False)
    scenario = replace(scenario, fracture=replace(scenario.fracture, shards=shards), shards=awake)
    if scenario.blast:
        return replace(scenario, blast=replace(scenario.blast, start_s=BEGINS_S))
    fall_m = 0.5 * 9.81 * BEGINS_S**2
    return replace(scenario, ball=replace(scenario.ball, release_time_s=0.0, drop_height_m=fall_m))
