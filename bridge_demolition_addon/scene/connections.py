"""Connections between bodies as Blender's rigid-body constraints."""

from __future__ import annotations

from collections.abc import Sequence

import bpy

from ..core.connections import GROUND, Connections

_SYMBOL_SIZE_M = 0.1


def connections_of(scene: bpy.types.Scene) -> list[bpy.types.Object]:
    """All objects that hold a constraint of the scene's rigid-body world."""
    constraints = scene.rigidbody_world.constraints
    return [each for each in constraints.all_objects if each.rigid_body_constraint] if constraints else []


def create_connection_template(world: bpy.types.RigidBodyWorld, kind: str, impulse: float) -> bpy.types.Object:
    """Connection that all others are copied from; to be removed afterwards.

    Parameters
    ----------
    kind
        Blender's type of constraint: FIXED, POINT or HINGE.
    impulse
        Breaking threshold, N·s in one sub-step.
    """
    template = bpy.data.objects.new("Connection", None)
    template.empty_display_size = _SYMBOL_SIZE_M
    world.constraints.objects.link(template)
    constraint = template.rigid_body_constraint
    constraint.type = kind
    constraint.use_breaking = True
    constraint.breaking_threshold = impulse
    return template


def create_connections(
    collection: bpy.types.Collection,
    template: bpy.types.Object,
    connections: Connections,
    shards: Sequence[bpy.types.Object],
    ground: bpy.types.Object,
) -> list[bpy.types.Object]:
    """One constraint per connection, at its point, in the world's axes: a hinge turns about the vertical."""
    objects = []
    for (first, second), point in zip(connections.pairs, connections.points, strict=True):
        connection = template.copy()  # keeps the name that Blender gives it: each renaming searches all names
        connection.location = point
        constraint = connection.rigid_body_constraint
        constraint.object1 = shards[first]
        constraint.object2 = ground if second == GROUND else shards[second]
        collection.objects.link(connection)
        objects.append(connection)
    return objects


def set_breaking_impulse(connections: Sequence[bpy.types.Object], impulse: float) -> None:
    """Rewrite the breaking threshold of all connections, N·s in one sub-step."""
    for connection in connections:
        connection.rigid_body_constraint.breaking_threshold = impulse
