"""The way of a wrecking ball that is lifted for its next hit."""

from __future__ import annotations

import numpy as np


def lift_path(start_m: np.ndarray, end_m: np.ndarray, shares: np.ndarray) -> np.ndarray:
    """Places (k, 3) of a lifted ball after shares (k,) of the time: straight up, then level to its next drop, m.

    It goes up by the way that it came down. Its speed rises from 0 and falls to 0 again, with 3 s² - 2 s³ of the way
    after the share s of the time, and is at most 1.5 times the mean: what lies on the ball is pushed off, not flung.
    """
    start, end = np.asarray(start_m, float), np.asarray(end_m, float)
    corner = np.array([*start[:2], end[2]])
    rise, level = np.linalg.norm(corner - start), np.linalg.norm(end - corner)
    time = np.asarray(shares, float)
    gone = (3.0 * time**2 - 2.0 * time**3) * (rise + level)
    way = np.array([0.0, rise, rise + level])
    points = np.array([start, corner, end])
    return np.column_stack([np.interp(gone, way, points[:, axis]) for axis in range(3)])
