"""What was done by hand to a scene after it was built, as far as no scenario can say it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import astuple, fields, replace
from typing import Any

import bpy
import numpy as np

from ..model.results.fingerprint import digest
from ..model.scenario.kept import values_from_text, values_text
from .bodies import Kind, bodies_of, kind_of
from .connections.breaking_settings import breaking_of
from .connections.breaking_thresholds import kept_breaking_force
from .connections.constraints import connections_of
from .connections.elasticity import damping_ratio_of, is_elastic
from .connections.soil import soil_of
from .structural_changes import changes_of, loads_of
from .time_scale import curves_of
from .tools.ball import lifts_of
from .tools.ground_motion import ground_motion_of

_AS_BUILT = "bda_as_built"


def keep_as_built(scene: bpy.types.Scene) -> None:
    """Remember a scene as it has just been built."""
    scene[_AS_BUILT] = values_text(_digests(scene))


def made_by_hand(scene: bpy.types.Scene) -> list[str]:
    """Return what is no longer as it was built, in a few words each; nothing where that is not known."""
    before = values_from_text(scene.get(_AS_BUILT, ""), {})
    return [name for name, found in _digests(scene).items() if before.get(name, found) != found]


def _digests(scene: bpy.types.Scene) -> dict[str, str]:
    return {name: digest(parts) for name, parts in _parts(scene)}


def _parts(scene: bpy.types.Scene) -> Iterator[tuple[str, dict[str, Any]]]:
    """Give all that decides what happens and has no key of its own."""
    bodies, connections = bodies_of(scene), connections_of(scene)
    rigid, constraints = ([each.rigid_body for each in bodies], [each.rigid_body_constraint for each in connections])
    yield "gravity", {"m_s2": tuple(scene.gravity), "used": scene.use_gravity}
    yield "which bodies there are", {"names": [body.name for body in bodies]}
    yield (
        "places, shapes or sizes of bodies",
        {
            "places": np.array([body.matrix_basis for body in bodies if not body.animation_data], float),
            "vertices": [len(body.data.vertices) for body in bodies],
            "boxes": np.array([body.bound_box for body in bodies], float),
        },
    )
    # That of the ball has a key.
    yield "masses of bodies", {"kg": [body.rigid_body.mass for body in bodies if kind_of(body) != Kind.BALL]}
    yield (
        "how bodies move and touch",
        {
            "types": [each.type for each in rigid],
            "shapes": [each.collision_shape for each in rigid],
            "enabled": [each.enabled for each in rigid],
            "layers": [tuple(each.collision_collections) for each in rigid],
            **{
                name: _unlike(bodies, name) for name in ("friction", "restitution", "linear_damping", "angular_damping")
            },
        },
    )
    yield "animation of bodies", {"keys": np.concatenate([np.zeros(0), *map(_keys, bodies)])}
    yield (
        "which connections there are, and between which bodies",
        {
            "names": [each.name for each in connections],
            "places": np.array([each.matrix_basis.translation for each in connections], float),
            "first": [each.object1.name if each.object1 else "" for each in constraints],
            "second": [each.object2.name if each.object2 else "" for each in constraints],
        },
    )
    yield (
        "kinds and strengths of connections",
        {
            "types": [each.type for each in constraints],
            "enabled": [each.enabled for each in constraints],
            "breaking": [each.use_breaking for each in constraints],
            "breaking at": [_breaks_at(each) for each in connections],
            "collisions": [each.disable_collisions for each in constraints],
            "iterations": [
                each.solver_iterations if each.use_override_solver_iterations else 0 for each in constraints
            ],
            "elasticity": [str(is_elastic(scene)), str(damping_ratio_of(scene))],
            **_strengths(scene, connections),
        },
    )
    yield "removals, saw cuts and weakenings", {"planned": repr(changes_of(scene))}
    yield "loads", {"planned": repr(loads_of(scene))}
    if motion := ground_motion_of(scene):
        record = motion.record
        yield "the motion of the ground", {"record": np.column_stack((record.times_s, record.accelerations_m_s2))}
    if soil := soil_of(connections):
        yield "soil under footings", {each.name: getattr(soil, each.name) for each in fields(soil)}


def _strengths(scene: bpy.types.Scene, connections: Sequence[bpy.types.Object]) -> dict[str, Any]:
    breaking = breaking_of(scene, connections)
    strength = [] if breaking.strength is None else np.broadcast_arrays(*astuple(breaking.strength))
    return {"strength": strength, "others": repr(replace(breaking, strength=None))}


def _breaks_at(connection: bpy.types.Object) -> float:
    """Return a force, N, or an impulse with a minus sign where no force is kept, N·s."""
    force = kept_breaking_force(connection)
    return -connection.rigid_body_constraint.breaking_threshold if force is None else force


def _unlike(bodies: Sequence[bpy.types.Object], name: str) -> list[float]:
    """Return a value of all shards where it is not the same for all: a scenario can only say the same."""
    values = [getattr(body.rigid_body, name) for body in bodies if kind_of(body) == Kind.SHARD]
    return values if len(set(values)) > 1 else []


def _keys(body: bpy.types.Object) -> np.ndarray:
    """Return the keyframes of a body; not of a ball that is lifted, which a run makes begin where it lies."""
    if not (body.animation_data and body.animation_data.action) or lifts_of(body):
        return np.zeros(0)
    found = [np.zeros(0)]
    for curve in curves_of(body.animation_data):
        points = np.empty(2 * len(curve.keyframe_points), np.float32)
        curve.keyframe_points.foreach_get("co", points)
        found.append(points)
    return np.concatenate(found)
