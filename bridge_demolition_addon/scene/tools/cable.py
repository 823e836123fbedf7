"""The cable of a wrecking ball: a point of the ball's own solid, fixed to the tip of a crane."""

from __future__ import annotations

import bpy

from ...engineering.geometry.solids import box
from ...model.scenario import BallCable
from ..bodies import Kind, create_body, mesh_of
from ..connections.constraints import mark_cable

_CRANE_SIZE_M = 0.3
_APART_FROM_ALL = 19
"""Collision collection of the crane's tip alone, so that nothing hits it."""


def create_cable(world: bpy.types.RigidBodyWorld, ball: bpy.types.Object, settings: BallCable) -> bpy.types.Object:
    """Hang a ball on the tip of a crane; it swings about it without stretch.

    Returns
    -------
    bpy.types.Object
        The cable: a rigid-body constraint that is no connection of the bridge, has no strength and never breaks.
    """
    crane = create_body(world, mesh_of("Crane", box((_CRANE_SIZE_M,) * 3, (0.0, 0.0, 0.0))), Kind.CRANE, "BOX")
    crane.location = settings.crane_point_m
    crane.rigid_body.type = "PASSIVE"
    crane.rigid_body.collision_collections = [number == _APART_FROM_ALL for number in range(20)]
    cable = bpy.data.objects.new("Cable", None)
    cable.location = settings.crane_point_m
    world.constraints.objects.link(cable)
    constraint = cable.rigid_body_constraint
    constraint.type = "POINT"
    constraint.object1, constraint.object2 = crane, ball
    constraint.disable_collisions = False
    mark_cable(cable)
    return cable
