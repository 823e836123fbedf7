"""Where in space a mouse drags something to: level, or straight up and down."""

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


def dragged_upright(eye: np.ndarray, ray: np.ndarray, foot: np.ndarray) -> np.ndarray | None:
    """Return the position (3,) float, m, straight above or below a foot (3,) that is nearest to a ray (3,) from an eye.

    None where the ray is all but upright itself.
    """
    ray = ray / np.linalg.norm(ray)
    level = float((ray[:2] * ray[:2]).sum())
    if level < _GRAZING * _GRAZING:
        return None
    # The nearest points of two lines: what lies between them is at right angles to both.
    distance = float(((foot[:2] - eye[:2]) * ray[:2]).sum()) / level
    return np.array((foot[0], foot[1], eye[2] + distance * ray[2]))
