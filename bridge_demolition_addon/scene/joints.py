"""What kind of connection holds two bodies together, and what breaks it, as properties of Blender's constraints."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np

from ..core.joint import Joint
from ..core.time_step import TimeStep
from .thresholds import set_breaking_force


def set_joints(
    connections: Sequence[bpy.types.Object], joints: Sequence[Joint], joint_of_connection: np.ndarray, step: TimeStep
) -> None:
    """Give every connection its kind, and its breaking threshold where a force breaks it.

    Parameters
    ----------
    connections
        The m connections.
    joints
        The kinds of connections that there are.
    joint_of_connection
        (m,) which of them each connection is.
    step
        How the scene cuts time.
    """
    for connection, row in zip(connections, joint_of_connection.tolist(), strict=True):
        joint = joints[row]
        connection.rigid_body_constraint.type = joint.type
        if joint.breaking_force_n is not None:
            set_breaking_force(connection, joint.breaking_force_n, step)
