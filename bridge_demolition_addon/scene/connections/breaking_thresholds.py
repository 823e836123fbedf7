"""Breaking thresholds: forces as people give them, and impulses in a sub-step as Blender takes them."""

from __future__ import annotations

import bpy
import numpy as np

from ...core.timing.time_step import TimeStep
from ..time_scale import time_step_at
from .constraints import connections_of

_FORCE = "bda_breaking_force_n"


def set_breaking_force(connection: bpy.types.Object, force_n: float, step: TimeStep) -> None:
    """Have a connection break at a force, whatever the step: it is kept with the connection."""
    connection[_FORCE] = force_n
    constraint = connection.rigid_body_constraint
    constraint.use_breaking = True
    constraint.breaking_threshold = step.impulse(force_n)


def rewrite_thresholds(scene: bpy.types.Scene) -> bool:
    """Write the breaking thresholds that the kept forces have in the scene's present step.

    It is the step that the start frame has, where the time scale is animated. Blender takes a new threshold for a
    reason to simulate anew: this is for before a simulation starts, and not for while it runs. A connection that no
    force is kept with has the threshold that somebody gave it, and keeps that.

    Returns
    -------
    bool
        Whether any threshold was another one before.
    """
    step = time_step_at(scene, scene.rigidbody_world.point_cache.frame_start)
    changed = False
    for connection in connections_of(scene):
        force = connection.get(_FORCE)
        if force is None:
            continue
        constraint, impulse = connection.rigid_body_constraint, float(np.float32(step.impulse(force)))
        if constraint.breaking_threshold != impulse:
            constraint.breaking_threshold = impulse
            changed = True
    return changed
