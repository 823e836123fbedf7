"""Areas on the ground: the plan of the bridge, its debris and its exclusion zone, as far as they are known by now."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import bpy
import numpy as np
from manifold3d import CrossSection

from ...display.ground_lines import distance_rings, planned_zone
from ...engineering.geometry.plan_areas import united
from ...engineering.geometry.vectors import transformed
from ...engineering.terrain.recorded import RecordedGround
from ...errors import GeometryError, ScenarioError
from ...model.bridge.preparation import prepared_members
from ...model.debris.exclusion import ExclusionZone, exclusion_zone
from ...model.debris.footprint import footprint
from ...model.results.arrays import Results
from ...model.scenario import BlastZone, Exclusion
from ...model.scenario.file import scenario_from_text
from ...model.structure.blast_zones import PlacedZone, placed_zones
from ...scene.bodies import Kind, bodies_of, is_uneven_ground, kind_of, triangle_mesh
from ...scene.rendering.ground import ground_of as ground_in
from ...simulation.blender_events import shown_results
from ..preview.zone_handles import zones_shown

_kept: dict[str, tuple[tuple, Any]] = {}
"""Results that were worked out last, with the keys that they depend on."""


def forget() -> None:
    """Forget these results."""
    _kept.clear()


def results_of(scene: bpy.types.Scene) -> Results | None:
    """Return the results that are shown in a scene; None where there are none, and while a run goes on."""
    return shown_results(scene).results


def plan_of(scene: bpy.types.Scene) -> CrossSection | None:
    """Return the area that the bridge covers in plan at first; None where there is no bridge."""
    results = results_of(scene)
    if results is not None and len(results.inventory.of_kind("shard")):
        return _cached("plan", _key(scene), lambda: footprint(results, results.inventory.of_kind("shard"), 0))
    world = scene.rigidbody_world
    if not world or not world.collection:
        return None
    shards = [body for body in bodies_of(scene) if kind_of(body) == Kind.SHARD]
    key = (scene.session_uid, len(shards), scene.bda.built_scenario)
    return _cached("plan", key, lambda: _plan_as_built(shards)) if shards else None


def rings_of(scene: bpy.types.Scene, spacing_m: float, number: int) -> list[tuple[float, np.ndarray]]:
    """Return rings of distance around the plan, as `distance_rings` does; none without a bridge."""
    plan = plan_of(scene)
    if plan is None:
        return []
    return _cached("rings", (_kept["plan"][0], spacing_m, number), lambda: distance_rings(plan, spacing_m, number))


def debris_of(scene: bpy.types.Scene) -> CrossSection | None:
    """Return the area that shards cover in plan when the last run ends; None without a run."""
    results = results_of(scene)
    if results is None or not len(shards := results.inventory.of_kind("shard")):
        return None
    return _cached("debris", _key(scene), lambda: footprint(results, shards, len(results.frames) - 1))


def zone_of(scene: bpy.types.Scene, settings: Exclusion) -> ExclusionZone | None:
    """Return the exclusion zone of the last run, or the planned one before a run; None without a bridge."""
    results, plan = results_of(scene), plan_of(scene)
    if plan is None:
        return None
    if results is None or not len(results.inventory.of_kind("shard")):
        return planned_zone(plan, settings)
    return _cached("zone", (*_key(scene), settings), lambda: exclusion_zone(results, settings))


def blast_zones_of(scene: bpy.types.Scene) -> tuple[PlacedZone, ...]:
    """Return the blast zones that a scene was built with; none where their members are not known any more."""
    text = scene.bda.built_scenario
    if f"[[{BlastZone.table}]]" not in text:
        return ()

    def placed() -> tuple[PlacedZone, ...]:
        try:
            scenario = scenario_from_text(text)
            return placed_zones(scenario, prepared_members(scenario).members)
        except (GeometryError, ScenarioError):
            return ()

    return _cached("blast zones", (text,), placed)


def planned_blast_zones_of(scene: bpy.types.Scene) -> tuple[PlacedZone, ...]:
    """Return the blast zones that the panels show, where they lie in their members; none where that is not known."""
    try:
        return tuple(placed for placed in zones_shown(scene.bda) if placed is not None)
    except (GeometryError, ScenarioError):
        return ()


def ground_of(scene: bpy.types.Scene) -> RecordedGround:
    """Return the ground of a scene, as it was built."""
    world = scene.rigidbody_world
    bodies = bodies_of(scene) if world and world.collection else []
    built = [(body.name, len(body.data.vertices)) for body in bodies if is_uneven_ground(body)]
    key = (scene.session_uid, tuple(built), scene.bda.built_scenario)
    return _cached("ground", key, lambda: ground_in(scene))


def path_of_ball(scene: bpy.types.Scene) -> list[np.ndarray]:
    """Return the positions (k, 3) float, m, of each ball of the last run."""
    results = results_of(scene)
    if results is None:
        return []
    return [np.asarray(results.frames.positions_m[:, ball], float) for ball in results.inventory.of_kind("ball")]


def _key(scene: bpy.types.Scene) -> tuple[int, int]:
    return scene.session_uid, shown_results(scene).number


def _plan_as_built(shards: list[bpy.types.Object]) -> CrossSection:
    plans = []
    for shard in shards:
        matrix = np.array(shard.matrix_basis, float)
        corners = transformed(matrix[:3, :3], triangle_mesh(shard.data).vertices) + matrix[:3, 3]
        plans.append(CrossSection.hull_points(corners[:, :2]))
    return united(plans)


def _cached(name: str, key: tuple, work_out: Callable[[], Any]) -> Any:
    if name not in _kept or _kept[name][0] != key:
        _kept[name] = (key, work_out())
    return _kept[name][1]
