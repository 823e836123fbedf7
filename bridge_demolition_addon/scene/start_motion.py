"""Velocity and angular velocity with which bodies begin, kept with them: Blender has none for rigid bodies."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np

from .custom_properties import kept_numbers

_MOTION = "bda_start_motion"
_RESTS = (0.0,) * 6


def keep_start_motion(
    bodies: Sequence[bpy.types.Object], velocities_m_s: np.ndarray, angular_velocities_rad_s: np.ndarray
) -> None:
    """Have those of bodies (n,) begin with velocities (n, 3) and angular velocities (n, 3) that have any."""
    for body, motion in zip(bodies, np.column_stack((velocities_m_s, angular_velocities_rad_s)).tolist(), strict=True):
        if any(motion):
            body[_MOTION] = motion


def start_motion_of(bodies: Sequence[bpy.types.Object]) -> tuple[np.ndarray, np.ndarray]:
    """Return velocities (n, 3), m/s, and angular velocities (n, 3), rad/s, with which bodies (n,) begin."""
    motion = np.array([kept_numbers(body, _MOTION, _RESTS) for body in bodies], float).reshape(-1, 6)
    return motion[:, :3], motion[:, 3:]
