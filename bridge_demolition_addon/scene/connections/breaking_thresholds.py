"""Breaking thresholds: given as forces, written to Blender as impulses in a sub-step."""

from __future__ import annotations

import bpy
import numpy as np

from ...engineering.timing.time_step import TimeStep
from ..custom_properties import kept_number
from ..time_scale import time_step_at
from .constraints import connections_of

_FORCE = "bda_breaking_force_n"


def set_breaking_force(connection: bpy.types.Object, force_n: float, step: TimeStep) -> None:
    """Make a connection break at a force, which is kept with it for other steps."""
    connection[_FORCE] = force_n
    constraint = connection.rigid_body_constraint
    constraint.use_breaking = True
    constraint.breaking_threshold = step.impulse(force_n)


def kept_breaking_force(connection: bpy.types.Object) -> float | None:
    """Return the force that a connection breaks at, N; None where Blender's own threshold says that."""
    return kept_number(connection, _FORCE, 0.0) if _FORCE in connection else None


def rewrite_thresholds(scene: bpy.types.Scene) -> bool:
    """Write the breaking thresholds that the kept forces have in the scene's present step.

    Where the time scale is animated, the step is that of the start frame. With a new threshold Blender simulates from
    the start again, so call this before a simulation starts. A connection without a kept force keeps its threshold.

    Returns
    -------
    bool
        Whether any threshold has changed.
    """
    step = time_step_at(scene, scene.rigidbody_world.point_cache.frame_start)
    changed = False
    for connection in connections_of(scene):
        force = kept_breaking_force(connection)
        if force is None:
            continue
        constraint, impulse = connection.rigid_body_constraint, float(np.float32(step.impulse(force)))
        if constraint.breaking_threshold != impulse:
            constraint.breaking_threshold = impulse
            changed = True
    return changed
