"""Connections as Blender's rigid-body constraints: their bodies, their kinds, and what breaks them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import astuple, dataclass, fields
from typing import Any

import bpy
import numpy as np

from ...engineering.elasticity.steel_bars import USUAL_STEEL, Steel
from ...engineering.mechanics.reinforcement import FaceBars
from ...engineering.mechanics.strength import Ductility, Joint, JointMotion, Strength
from ...engineering.structure.connections import GROUND, Connections
from ...engineering.timing.timeline import TimeStep
from ..bodies import bodies_of
from ..collections import make_named, numbered_names
from ..custom_properties import keep, kept_number, kept_numbers
from ..world import time_step_at

_SYMBOL_SIZE_M = 0.1
_AREA = "bda_area_m2"
_NORMAL = "bda_normal"
_IS_CABLE = "bda_is_cable"
_SECOND_MOMENTS = "bda_second_moments_m4"


def connections_of(scene: bpy.types.Scene) -> list[bpy.types.Object]:
    """Return all objects with a constraint of the scene's rigid-body world, but for the cables of balls."""
    return [obj for obj in constraints_of(scene) if not obj.get(_IS_CABLE)]


def constraints_of(scene: bpy.types.Scene) -> list[bpy.types.Object]:
    """Return all objects with a constraint of the scene's rigid-body world, cables of balls too."""
    constraints = scene.rigidbody_world.constraints
    return [obj for obj in constraints.all_objects if obj.rigid_body_constraint] if constraints else []


def ends_of(connection: bpy.types.Object) -> set[bpy.types.Object | None]:
    """Return the two bodies that a connection holds together; None stands for one that it lacks."""
    constraint = connection.rigid_body_constraint
    return {constraint.object1, constraint.object2}


def loose_connections(scene: bpy.types.Scene) -> list[bpy.types.Object]:
    """Return connections that lack a body of the scene's world, such as with a deleted shard: they do nothing."""
    bodies = set(bodies_of(scene))
    return [connection for connection in connections_of(scene) if not ends_of(connection) <= bodies]


def mark_cable(constraint: bpy.types.Object) -> None:
    """Mark a constraint as a cable, not a connection whose loads and breaking are recorded."""
    constraint[_IS_CABLE] = True


def sections_of(connections: Sequence[bpy.types.Object]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return areas (m,), m², normals (m, 3) from first to second bodies, and second moments (m, 2, 2), m⁴.

    A connection that the add-on did not make has the area 0, and the direction between its bodies' origins as normal;
    one with only an area is a square.
    """
    areas = np.array([kept_number(connection, _AREA, 0.0) for connection in connections], float)
    normals = np.array([_normal(connection) for connection in connections], float).reshape(-1, 3)
    square = np.eye(2).ravel() / 12.0
    moments = [
        kept_numbers(connection, _SECOND_MOMENTS, area * area * square)
        for connection, area in zip(connections, areas, strict=True)
    ]
    return areas, normals, np.array(moments, float).reshape(-1, 2, 2)


def _normal(connection: bpy.types.Object) -> tuple[float, float, float]:
    if _NORMAL in connection:
        x, y, z = kept_numbers(connection, _NORMAL, (0.0, 0.0, 1.0))
        return x, y, z
    constraint = connection.rigid_body_constraint
    between = constraint.object2.matrix_world.translation - constraint.object1.matrix_world.translation
    return tuple(between.normalized()) if between.length else (0.0, 0.0, 1.0)


def create_connections(
    collection: bpy.types.Collection,
    connections: Connections,
    shards: Sequence[bpy.types.Object],
    ground: bpy.types.Object | None,
    second_moments_m4: np.ndarray,
) -> list[bpy.types.Object]:
    """Make a constraint for each of m connections, with second moments (m, 2, 2), at its point.

    Its axes are the world's, so that a hinge rotates about the vertical. The constraints go into the collection of a
    rigid-body world, fastest while it is `off_scene`.
    """
    # This name comes after the names of the many shards, see `make_named`.
    names = numbered_names("Shard connection", len(connections), bpy.data.objects)
    objects = make_named(bpy.data.objects, names, lambda name, _: bpy.data.objects.new(name, None))
    sections = (connections.areas.tolist(), connections.normals.tolist(), second_moments_m4.reshape(-1, 4).tolist())
    columns = (connections.pairs.tolist(), connections.points.tolist(), *sections)
    for connection, (first, second), point, area, normal, moments in zip(objects, *columns, strict=True):
        connection.empty_display_size = _SYMBOL_SIZE_M
        connection.location = point
        connection[_AREA], connection[_NORMAL], connection[_SECOND_MOMENTS] = area, normal, moments
        collection.objects.link(connection)
        constraint = connection.rigid_body_constraint
        constraint.object1 = shards[first]
        constraint.object2 = ground if second == GROUND else shards[second]
    return objects


_BLENDER_NAMES = {
    JointMotion.MOVE_X: ("lin_x", "x"),
    JointMotion.MOVE_Y: ("lin_y", "y"),
    JointMotion.MOVE_Z: ("lin_z", "z"),
    JointMotion.TURN_X: ("ang_x", "ang_x"),
    JointMotion.TURN_Y: ("ang_y", "ang_y"),
    JointMotion.TURN_Z: ("ang_z", "ang_z"),
}
"""Ends of the names of Blender's properties for the limits and the spring of each motion."""


def set_joints(
    connections: Sequence[bpy.types.Object], joints: Sequence[Joint], joint_of_connection: np.ndarray, step: TimeStep
) -> None:
    """Give m connections their kind and what breaks them, by rows (m,) of the joints.

    The strength of the first joint is the scene's, see `keep_breaking`.
    """
    for connection, row in zip(connections, joint_of_connection.tolist(), strict=True):
        joint = joints[row]
        _set_type(connection.rigid_body_constraint, joint)
        if joint.breaking_force_n is not None:
            set_breaking_force(connection, joint.breaking_force_n, step)
        if joint.strength is not joints[0].strength:
            set_strength(connection, joint.strength)


def _set_type(constraint: bpy.types.RigidBodyConstraint, joint: Joint) -> None:
    if joint.type not in ("GENERIC", "GENERIC_SPRING"):
        constraint.type = joint.type
        return
    # Blender's GENERIC carries nothing in the first sub-step, and 2.2 times the weight that hangs from it in the
    # second. A spring of the second kind, with no springs in it, has no such start. Springs of the first kind deform
    # twice as far as their stiffness says.
    constraint.type, constraint.spring_type = "GENERIC_SPRING", "SPRING2"
    for motion, (limit, spring) in _BLENDER_NAMES.items():
        is_free = motion in joint.free
        stiffness, damping = joint.springs.of(motion)
        setattr(constraint, f"use_limit_{limit}", not is_free)
        setattr(constraint, f"limit_{limit}_lower", 0.0)
        setattr(constraint, f"limit_{limit}_upper", 0.0)
        setattr(constraint, f"use_spring_{spring}", is_free and stiffness > 0.0)
        setattr(constraint, f"spring_stiffness_{spring}", stiffness)
        setattr(constraint, f"spring_damping_{spring}", damping)


_CONSTRAINT = ("type", "enabled", "use_breaking", "breaking_threshold", "disable_collisions")
"""Blender's properties of a constraint that decide how it holds."""


@dataclass(frozen=True, slots=True, eq=False)
class ConstraintSettings:
    """The m connections of a scene's rigid-body world.

    Attributes
    ----------
    bodies
        Names of the two bodies of each, empty for one that it lacks.
    constraint
        Properties of the constraints by Blender's names.
    iterations
        Iterations of the solver that each has of its own, 0 for none.
    breaking_forces_n
        The force that each breaks at, where one is kept.
    """

    objects: tuple[bpy.types.Object, ...]
    names: tuple[str, ...]
    bodies: Sequence[tuple[str, str]]
    positions_m: np.ndarray
    constraint: Mapping[str, Sequence[Any]]
    iterations: Sequence[int]
    breaking_forces_n: Sequence[float | None]

    def __len__(self) -> int:
        return len(self.objects)

    def breaks_at(self) -> list[float]:
        """Return the breaking force, N, of each, or its threshold, N·s, with a minus sign where no force is kept."""
        thresholds = self.constraint["breaking_threshold"]
        return [-own if kept is None else kept for kept, own in zip(self.breaking_forces_n, thresholds, strict=True)]


def constraint_settings_of(scene: bpy.types.Scene) -> ConstraintSettings:
    """Read the connections of a scene."""
    connections = connections_of(scene)
    constraints = [connection.rigid_body_constraint for connection in connections]
    return ConstraintSettings(
        objects=tuple(connections),
        names=tuple(connection.name for connection in connections),
        bodies=[(_name(constraint.object1), _name(constraint.object2)) for constraint in constraints],
        positions_m=np.array([connection.matrix_basis.translation for connection in connections], float),
        constraint={name: [getattr(constraint, name) for constraint in constraints] for name in _CONSTRAINT},
        iterations=[
            constraint.solver_iterations if constraint.use_override_solver_iterations else 0
            for constraint in constraints
        ],
        breaking_forces_n=[kept_breaking_force(connection) for connection in connections],
    )


def _name(body: bpy.types.Object | None) -> str:
    return body.name if body else ""


_STRENGTH = "bda_strength_pa"
_WARM_UP = "bda_warm_up_s"
_DAMPING = "bda_warm_up_damping"
_DUCTILITY = "bda_ductility"
_STEEL = "bda_steel"
_BARS = "bda_bars"
_HINGE = "bda_hinge"
_YIELD_SHARE = "bda_yield_share"
_FORCE = "bda_breaking_force_n"

_NO_BARS = (0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0)

_UNBREAKABLE = Strength(*[1e300] * len(fields(Strength)))
"""Strength of a connection that no stress breaks."""


@dataclass(frozen=True, slots=True)
class Breaking:
    """How connections break.

    Attributes
    ----------
    strength
        Common strength of connections with an area, or the strength of each; None where Blender's breaking threshold
        alone decides.
    warm_up_s
        Simulated time from the start in which nothing breaks, so that the structure can settle under its own weight.
    ductility
        What is left of a broken connection; None for nothing.
    warm_up_damping
        Share of their velocities that shards lose in one second of the warm-up, from 0 to 1.
    steel
        Steel of the reinforcement of elastic connections.
    bars
        Layers of reinforcement across connections, in addition to what `ductility` leaves.
    """

    strength: Strength | None = None
    warm_up_s: float = 0.0
    ductility: Ductility | None = None
    warm_up_damping: float = 0.0
    steel: Steel = USUAL_STEEL
    bars: FaceBars | None = None

    @property
    def is_reinforced(self) -> bool:
        """Return whether anything holds where connections broke."""
        return self.ductility is not None or self.bars is not None


def keep_breaking(scene: bpy.types.Scene, breaking: Breaking) -> None:
    """Keep how connections break in the scene, and so in its file."""
    scene[_WARM_UP], scene[_DAMPING] = breaking.warm_up_s, breaking.warm_up_damping
    steel = breaking.steel if breaking.is_reinforced else None
    for name, values in ((_STRENGTH, breaking.strength), (_DUCTILITY, breaking.ductility), (_STEEL, steel)):
        keep(scene, name, astuple(values) if values else None)


def set_strength(connection: bpy.types.Object, strength: Strength | None) -> None:
    """Give a connection a strength of its own instead of the scene's; with None no stress breaks it."""
    connection[_STRENGTH] = astuple(strength or _UNBREAKABLE)


def keep_bars(connections: Sequence[bpy.types.Object], bars: FaceBars) -> None:
    """Keep bars with the connections (m,) that they cross."""
    columns = np.column_stack((bars.yield_n, bars.offsets_m, bars.directions, bars.openings_m))
    for connection, numbers in zip(connections, columns.tolist(), strict=True):
        connection[_BARS] = numbers
    if bars.hinges is not None:
        for row in np.flatnonzero(bars.have_own_law).tolist():
            connections[row][_HINGE] = bars.hinges[row].tolist()
    if bars.yield_shares is not None:
        for row in np.flatnonzero(~np.isnan(bars.yield_shares)).tolist():
            connections[row][_YIELD_SHARE] = float(bars.yield_shares[row])


def _bars_of(connections: Sequence[bpy.types.Object]) -> FaceBars | None:
    if not any(_BARS in connection for connection in connections):
        return None
    numbers = np.array([kept_numbers(connection, _BARS, _NO_BARS) for connection in connections])
    hinges = None
    if any(_HINGE in connection for connection in connections):
        none = (np.nan,) * 3
        hinges = np.array(
            [kept_numbers(connection, _HINGE, none) if _HINGE in connection else none for connection in connections]
        )
    shares = None
    if any(_YIELD_SHARE in connection for connection in connections):
        shares = np.array(
            [
                kept_number(connection, _YIELD_SHARE, 0.0) if _YIELD_SHARE in connection else np.nan
                for connection in connections
            ]
        )
    return FaceBars(numbers[:, 0], numbers[:, 1:3], numbers[:, 3:6], numbers[:, 6], hinges, shares)


def breaking_of(scene: bpy.types.Scene, connections: Sequence[bpy.types.Object] = ()) -> Breaking:
    """Return what a scene and connections keep; without that, Blender's threshold decides and there is no warm-up.

    Where any of m connections has a strength of its own, the strength has arrays (m,) float.
    """
    strength = Strength(*kept_numbers(scene, _STRENGTH, astuple(_UNBREAKABLE))) if _STRENGTH in scene else None
    if any(_STRENGTH in connection for connection in connections):
        other = astuple(strength or _UNBREAKABLE)
        strength = Strength(*np.array([kept_numbers(connection, _STRENGTH, other) for connection in connections]).T)
    ductility = Ductility(*kept_numbers(scene, _DUCTILITY, (0.0, 0.0))) if _DUCTILITY in scene else None
    return Breaking(
        strength,
        kept_number(scene, _WARM_UP, 0.0),
        ductility,
        kept_number(scene, _DAMPING, 0.0),
        Steel(*kept_numbers(scene, _STEEL, astuple(USUAL_STEEL))),
        _bars_of(connections),
    )


def set_breaking_force(connection: bpy.types.Object, force_n: float, step: TimeStep) -> None:
    """Make a connection break at a force: Blender has the impulse in a sub-step, the connection keeps the force."""
    connection[_FORCE] = force_n
    constraint = connection.rigid_body_constraint
    constraint.use_breaking = True
    constraint.breaking_threshold = step.impulse(force_n)


def kept_breaking_force(connection: bpy.types.Object) -> float | None:
    """Return the force that a connection breaks at, N; None where only Blender's own threshold decides."""
    return kept_number(connection, _FORCE, 0.0) if _FORCE in connection else None


def rewrite_thresholds(scene: bpy.types.Scene) -> bool:
    """Write the thresholds that the kept forces have in the step of the start frame, and return whether any changed.

    With a new threshold Blender simulates from the start again, so call this before a simulation starts. A connection
    without a kept force keeps its threshold.
    """
    step = time_step_at(scene, scene.rigidbody_world.point_cache.frame_start)
    is_changed = False
    for connection in connections_of(scene):
        if (force_n := kept_breaking_force(connection)) is not None:
            constraint, impulse = connection.rigid_body_constraint, float(np.float32(step.impulse(force_n)))
            if constraint.breaking_threshold != impulse:
                constraint.breaking_threshold = impulse
                is_changed = True
    return is_changed
