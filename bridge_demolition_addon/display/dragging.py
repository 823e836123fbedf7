"""Where in space a mouse drags something to: level, straight up and down, or along another axis."""

from __future__ import annotations

import numpy as np

_GRAZING = 0.02
"""Sine of the angle between a ray and what it meets: below it, a position would jump by metres between pixels."""


def dragged_level(eye: np.ndarray, ray: np.ndarray, height_m: float) -> np.ndarray | None:
    """Return where a ray (3,) from an eye (3,) meets a level plane, (3,) float, m; None where it hardly does."""
    ray = ray / np.linalg.norm(ray)
    if abs(ray[2]) < _GRAZING:
        return None
    distance = (height_m - eye[2]) / ray[2]
    return None if distance <= 0.0 else np.array((*(eye[:2] + distance * ray[:2]), height_m))


def dragged_along(eye: np.ndarray, ray: np.ndarray, foot: np.ndarray, axis: int) -> np.ndarray | None:
    """Return the position (3,) float, m, on the line through a foot (3,) along an axis that is nearest to a ray (3,).

    The ray is from an eye (3,). None where it is all but along that axis itself.
    """
    ray = ray / np.linalg.norm(ray)
    along = float(ray[axis])
    across = 1.0 - along * along
    if across < _GRAZING * _GRAZING:
        return None
    # The nearest points of two lines: what lies between them is at right angles to both.
    apart = foot - eye
    moved = (along * float((apart * ray).sum()) - float(apart[axis])) / across
    position = np.array(foot, float)
    position[axis] += moved
    return position
