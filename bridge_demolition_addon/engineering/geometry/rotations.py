"""Rotations of bodies, changes between them, and points and axes that turn with bodies."""

from __future__ import annotations

import math

import numpy as np

from ..arithmetic import arctangent, cosine, sine
from ..arrays import FloatArray, IntArray
from .vectors import length, product, transformed

_QUARTERS = (
    ((1.0, 0.0), (0.0, 1.0)),
    ((0.0, -1.0), (1.0, 0.0)),
    ((-1.0, 0.0), (0.0, -1.0)),
    ((0.0, 1.0), (-1.0, 0.0)),
)
"""Rotations by none, one, two and three right angles."""

_SMALLEST_SINE = 1e-9
"""Below it an angle and its sine are one."""


def turn_in_plane(angle_rad: float) -> FloatArray:
    """Matrix (2, 2) that turns plane vectors by an angle, anticlockwise."""
    return np.array([[cosine(angle_rad), -sine(angle_rad)], [sine(angle_rad), cosine(angle_rad)]])


def turn_by_degrees(angle_deg: float) -> FloatArray:
    """Matrix (2, 2) that turns plane vectors by an angle in degrees, anticlockwise, exact for right angles."""
    quarters = angle_deg / 90.0
    if quarters.is_integer():
        return np.array(_QUARTERS[int(quarters % 4.0)])
    return turn_in_plane(math.radians(angle_deg))


def rotation_vectors(before: FloatArray, after: FloatArray) -> FloatArray:
    """Rotation vectors (..., 3) in rad that turn rotations (..., 3, 3) into others, in the world's axes.

    The shorter way round: a body that turns by more than half a turn between the two seems to turn backwards. Of a turn
    by exactly half, the axis is not defined, and 0 is given.
    """
    change = product(after, np.swapaxes(before, -1, -2))
    # The skew part of a rotation by θ about a is sin θ a, and its trace 1 + 2 cos θ.
    doubled = np.stack([change[..., 2, 1], change[..., 0, 2], change[..., 1, 0]], axis=-1)
    doubled -= np.stack([change[..., 1, 2], change[..., 2, 0], change[..., 0, 1]], axis=-1)
    sines = length(doubled) / 2.0
    angles = arctangent(sines, (np.trace(change, axis1=-2, axis2=-1) - 1.0) / 2.0)
    factors = np.divide(angles, 2.0 * sines, out=np.full_like(sines, 0.5), where=sines > _SMALLEST_SINE)
    return factors[..., None] * doubled


def rotated(rotations: FloatArray, vectors: FloatArray) -> FloatArray:
    """Rotations (..., 3, 3) turned further by rotation vectors (..., 3) in rad, by Rodrigues' formula."""
    angles = length(vectors)[..., None, None]
    cross = np.zeros(rotations.shape)
    cross[..., 2, 1], cross[..., 0, 2], cross[..., 1, 0] = np.moveaxis(vectors, -1, 0)
    cross -= np.swapaxes(cross, -1, -2)
    by_sine, by_cosine = _sine_by_angle(angles), np.square(_sine_by_angle(angles / 2.0)) / 2.0
    return rotations + product(by_sine * cross + by_cosine * product(cross, cross), rotations)


def carried_points(local_points: FloatArray, centres: FloatArray, rotations: FloatArray) -> FloatArray:
    """Positions (..., m, 3) of points fixed to moving bodies, m, with centre and rotation of the body of each.

    `local_points` (m, 3) are in the axes of their bodies, from the bodies' centres, m.
    """
    return centres + transformed(rotations, local_points)


def axes_in_bodies(axes: FloatArray, bodies: IntArray, rotations: FloatArray) -> FloatArray:
    """Axes (m, 3, 3), as columns, as seen from the bodies (m,) that they turn with, for `carried_axes`."""
    return product(np.swapaxes(rotations[bodies], 1, 2), axes)


def carried_axes(local_axes: FloatArray, bodies: IntArray, rotations: FloatArray) -> FloatArray:
    """Axes (m, 3, 3) in the world that turn with bodies (m,), from `axes_in_bodies`."""
    return product(rotations[bodies], local_axes)


def _sine_by_angle(angles: FloatArray) -> FloatArray:
    return np.divide(sine(angles), angles, out=np.ones(angles.shape), where=angles != 0.0)
