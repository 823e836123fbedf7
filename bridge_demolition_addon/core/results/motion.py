"""What can be read off the motion of bodies: travel, throw, and when a falling body is hit."""

from __future__ import annotations

import numpy as np

_SMALLEST_SINE = 1e-9
"""Below it an angle and its sine are one."""

_HIT_SHARE = 0.5
"""A frame counts as a hit when velocity departs from free fall by more than this share of the frame's g·t."""


def travel(first: np.ndarray, last: np.ndarray) -> np.ndarray:
    """Straight-line distance (n,) between first and last places (n, 3), m."""
    return np.linalg.norm(last - first, axis=1)


def throw(first: np.ndarray, last: np.ndarray) -> np.ndarray:
    """Horizontal distance (n,) between first and last places (n, 3), m."""
    return np.linalg.norm((last - first)[:, :2], axis=1)


def turn(before: np.ndarray, after: np.ndarray) -> np.ndarray:
    """Rotation vectors (n, 3) in rad that turn rotation matrices (n, 3, 3) into others, in the world's axes.

    The shorter way round: a body that turns by more than half a turn between the two seems to turn backwards. Of a turn
    by exactly half, the axis is not defined, and 0 is given.
    """
    change = after @ np.swapaxes(before, -1, -2)
    # The skew part of a rotation by θ about a is sin θ a, and its trace 1 + 2 cos θ.
    doubled = np.stack([change[..., 2, 1], change[..., 0, 2], change[..., 1, 0]], axis=-1)
    doubled -= np.stack([change[..., 1, 2], change[..., 2, 0], change[..., 0, 1]], axis=-1)
    sines = np.linalg.norm(doubled, axis=-1) / 2.0
    angles = np.arctan2(sines, (np.trace(change, axis1=-2, axis2=-1) - 1.0) / 2.0)
    factors = np.divide(angles, 2.0 * sines, out=np.full_like(sines, 0.5), where=sines > _SMALLEST_SINE)
    return factors[..., None] * doubled


def turned(rotations: np.ndarray, turns: np.ndarray) -> np.ndarray:
    """Rotation matrices (n, 3, 3) turned further by rotation vectors (n, 3) in rad, by Rodrigues' formula."""
    angles = np.linalg.norm(turns, axis=-1)[..., None, None]
    cross = np.zeros(rotations.shape)
    cross[..., 2, 1], cross[..., 0, 2], cross[..., 1, 0] = np.moveaxis(turns, -1, 0)
    cross -= np.swapaxes(cross, -1, -2)
    by_sine, by_cosine = np.sinc(angles / np.pi), np.sinc(angles / (2.0 * np.pi)) ** 2 / 2.0
    return rotations + (by_sine * cross + by_cosine * cross @ cross) @ rotations


def first_hit(velocities: np.ndarray, times: np.ndarray, gravity: np.ndarray) -> int | None:
    """First step in which something other than gravity acted on a falling body.

    Parameters
    ----------
    velocities
        (k, 3) velocity of the body at its release and after each step since then, m/s.
    times
        (k,) simulated time of each, s.
    gravity
        (3,) acceleration of gravity, m/s².

    Returns
    -------
    int or None
        Index of that step, None where the body fell freely throughout.
    """
    steps = np.diff(times)
    departures = np.linalg.norm(np.diff(velocities, axis=0) - steps[:, None] * gravity, axis=1)
    hits = np.flatnonzero(departures > _HIT_SHARE * steps * np.linalg.norm(gravity))
    return int(hits[0]) + 1 if len(hits) else None
