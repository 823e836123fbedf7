"""Connections between bodies as Blender's rigid-body constraints."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np

from ...engineering.structure.connections import GROUND, Connections
from ..bodies import bodies_of
from ..custom_properties import kept_number, kept_numbers
from ..naming import make_named, numbered_names

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
    """Return connections that lack a body of the scene's world, such as those of a deleted shard: they do nothing."""
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
    # This name comes after those of the many shards, see `make_named`.
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
