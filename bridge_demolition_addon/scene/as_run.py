"""What a scene that was built from a scenario runs: all that was changed in Blender since, in the scenario's own words.

What a scenario has no key for is told by `made_by_hand`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import bpy
import numpy as np

from ..engineering.single_precision import as_given
from ..engineering.timing.time_step import TimeStep
from ..errors import ScenarioError
from ..model.scenario import Ground, Scenario
from ..model.schema import Table
from .bodies import Kind, bodies_of, is_marked, kind_of, member_of
from .demolition import FIRST_STEP_FRAME
from .time_scale import time_is_animated, time_step_at
from .world import START_FRAME, farthest_per_substep_of

_DEFAULT_MARGIN_M = 0.04
"""Collision margin of a body for which none is set (Bullet's CONVEX_DISTANCE_MARGIN)."""

_GROUND = {"friction": "friction", "restitution": "restitution"}
_BALL = {**_GROUND, "mass_kg": "mass", "angular_damping": "angular_damping"}
_SHARDS = {
    **_GROUND,
    "linear_damping": "linear_damping",
    "angular_damping": "angular_damping",
    "use_deactivation": "use_deactivation",
    "start_deactivated": "use_start_deactivated",
    "deactivation_linear_velocity_m_s": "deactivate_linear_velocity",
    "deactivation_angular_velocity_rad_s": "deactivate_angular_velocity",
}
"""Keys of a scenario, and Blender's properties of rigid bodies that they set."""


def time_settings(scene: bpy.types.Scene) -> dict[str, Any]:
    """Return how a scene cuts time, by the keys of a scenario; not its speed where that is animated."""
    world = scene.rigidbody_world
    found = {
        "frames_per_second": scene.render.fps,
        "frames_per_second_base": scene.render.fps_base,
        "substeps_per_frame": world.substeps_per_frame,
        "farthest_per_substep_m": farthest_per_substep_of(scene),
        "solver_iterations": world.solver_iterations,
        "split_impulse": world.use_split_impulse,
        "time_scale": world.time_scale,
    }
    if time_is_animated(scene):
        del found["time_scale"]
    return found


def scenario_as_run(scene: bpy.types.Scene, built: Scenario) -> tuple[Scenario, list[str]]:
    """Return what a scene runs, and in sentences what of it no scenario can say.

    Parameters
    ----------
    scene
        With a rigid-body world that was built from a scenario.
    built
        That scenario. It is returned as it is where nothing was changed.
    """
    scenario, unsaid = built, []
    changes: tuple[tuple[Callable[[Scenario], Scenario], str], ...] = (
        (partial(_with_bodies, scene), "settings of bodies that no scenario can have"),
        (partial(_with_time_step, scene), "frames of another length than what is planned and animated allows"),
        (partial(_with_duration, scene), f"the last frame, {_last_frame(scene)}, which is before all that is planned"),
    )
    for change, text in changes:
        try:
            scenario = change(scenario)
        except ScenarioError as error:
            unsaid.append(f"{text} ({error})")
    if _differs(_frame_lengths(scene), scenario.timeline.frame_lengths_s):
        unsaid.append("the speed of the simulation, which is animated")
    if scene.rigidbody_world.point_cache.frame_start != START_FRAME:
        unsaid.append(f"the first frame, {scene.rigidbody_world.point_cache.frame_start}")
    return scenario, unsaid


def _with_bodies(scene: bpy.types.Scene, scenario: Scenario) -> Scenario:
    """Take over mass and surface of ground, ball and shards; of shards what all of them have."""
    bodies = [body for body in bodies_of(scene) if is_marked(body)]
    of_kind = {kind: [body.rigid_body for body in bodies if kind_of(body) == kind] for kind in Kind}
    shards = _common(of_kind[Kind.SHARD], _SHARDS.items(), scenario.shards)
    margins = {each.collision_margin if each.use_margin else _DEFAULT_MARGIN_M for each in of_kind[Kind.SHARD]}
    if len(margins) == 1:
        shards |= _read({"collision_margin_m": margins.pop()}, scenario.shards)
    if not shards.get("use_deactivation", True):
        shards["start_deactivated"] = False  # which Blender ignores there
    scenario = replace(scenario, shards=_replaced(scenario.shards, shards))
    scenario = replace(scenario, ground=_ground_as_run(bodies, scenario.ground))
    if scenario.ball is None:
        return scenario
    ball = _common(of_kind[Kind.BALL], _BALL.items(), scenario.ball)
    return replace(scenario, ball=_replaced(scenario.ball, ball))


def _ground_as_run(bodies: Sequence[bpy.types.Object], ground: Ground) -> Ground:
    """Take over the surface of the ground, and of each surface on it."""
    named: dict[str, list[bpy.types.RigidBodyObject]] = {}
    for body in bodies:
        if kind_of(body) == Kind.GROUND:
            named.setdefault(member_of(body)[0], []).append(body.rigid_body)
    surfaces = tuple(
        _replaced(each, _common(named.get(each.name, ()), _GROUND.items(), each)) for each in ground.surfaces
    )
    ground = _replaced(ground, _common(named.get("", ()), _GROUND.items(), ground))
    return ground if surfaces == ground.surfaces else replace(ground, surfaces=surfaces)


def _with_time_step(scene: bpy.types.Scene, scenario: Scenario) -> Scenario:
    """Take over frame rate, sub-steps, solver and speed. What is animated keeps its frames, and its times change."""
    time = _replaced(scenario.time, _read(time_settings(scene), scenario.time))
    factor = time.step.frame_s / scenario.time.step.frame_s
    if time == scenario.time:
        return scenario
    if factor == 1.0:
        return replace(scenario, time=time)
    if time_is_animated(scene):
        raise ScenarioError("slow motion was animated for frames of another length")
    time = replace(time, duration_s=scenario.time.duration_s * factor)
    return replace(scenario, time=time, **scenario.actions_scaled_in_time(factor))


def _with_duration(scene: bpy.types.Scene, scenario: Scenario) -> Scenario:
    """Take over the last frame."""
    lengths = _frame_lengths(scene)
    if len(lengths) == len(scenario.timeline):
        return scenario
    return replace(scenario, time=replace(scenario.time, duration_s=float(lengths.sum())))


def _frame_lengths(scene: bpy.types.Scene) -> np.ndarray:
    """Return the simulated time, s, of each frame that the scene plays, from the first that time leads to."""
    frames = range(FIRST_STEP_FRAME, _last_frame(scene) + 1)
    if time_is_animated(scene):
        return np.array([time_step_at(scene, frame).frame_s for frame in frames], float)
    settings = time_settings(scene)
    step = TimeStep(
        *(settings[name] for name in ("frames_per_second", "frames_per_second_base")),
        settings["substeps_per_frame"],
        settings["time_scale"],
    )
    return np.full(len(frames), step.frame_s)


def _last_frame(scene: bpy.types.Scene) -> int:
    return min(scene.frame_end, scene.rigidbody_world.point_cache.frame_end)


def _differs(lengths: np.ndarray, planned: np.ndarray) -> bool:
    """Return whether frames are not as long as planned, as far as they are played; Blender has single precision."""
    count = min(len(lengths), len(planned))
    return not np.allclose(lengths[:count], planned[:count], rtol=1e-6, atol=0.0)


def _common(
    bodies: Sequence[bpy.types.RigidBodyObject], names: Iterable[tuple[str, str]], given: Table
) -> dict[str, Any]:
    """Return the values that all of some bodies have in common, by the keys of their table."""
    found = {}
    for key, name in names:
        values = {getattr(each, name) for each in bodies}
        if len(values) == 1:
            found[key] = values.pop()
    return _read(found, given)


def _read(values: Mapping[str, Any], given: Table) -> dict[str, Any]:
    """Return values as Blender holds them in the decimals that the table was given, where it holds just those."""
    return {name: as_given(value, getattr(given, name)) for name, value in values.items()}


def _replaced(table: Table, values: Mapping[str, Any]) -> Table:
    return replace(table, **values) if any(getattr(table, name) != value for name, value in values.items()) else table
