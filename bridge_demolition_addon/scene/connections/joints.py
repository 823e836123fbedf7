"""Kinds of connections, and what breaks them, as properties of Blender's constraints."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np

from ...engineering.mechanics.joint import Joint, JointMotion
from ...engineering.timing.timeline import TimeStep
from .breaking_settings import set_breaking_force, set_strength

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
