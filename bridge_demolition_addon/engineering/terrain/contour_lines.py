"""Contour lines of ground, a round distance apart."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray

_MOST_LINES = 15
_DISTANCES_M = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0)


def contour_lines(corners: FloatArray) -> FloatArray:
    """Return the lines (s, 2, 3) at round heights in triangles (t, 3, 3), m; none in ground that is level."""
    heights = corners[:, :, 2]
    if not len(corners):
        return np.zeros((0, 2, 3))
    low, high = float(heights.min()), float(heights.max())
    distance = next(
        (distance_m for distance_m in _DISTANCES_M if high - low <= _MOST_LINES * distance_m), _DISTANCES_M[-1]
    )
    numbers = np.arange(np.ceil(low / distance), np.floor(high / distance) + 1.0)
    return np.concatenate([np.zeros((0, 2, 3)), *(_lines_at(corners, number * distance) for number in numbers)])


def _lines_at(corners: FloatArray, level_m: float) -> FloatArray:
    """Lines (s, 2, 3) at a height in triangles (t, 3, 3), from one of their sides to another."""
    above = corners[:, :, 2] > level_m
    cut = above.any(axis=1) & ~above.all(axis=1)
    corners, above = corners[cut], above[cut]
    # The corner that is alone on its side of the level comes first.
    alone = np.where(above.sum(axis=1) == 1, above.argmax(axis=1), (~above).argmax(axis=1))
    rows = np.arange(len(corners))
    apex = corners[rows, alone]
    ends = [corners[rows, (alone + step) % 3] for step in (1, 2)]
    shares = [((level_m - apex[:, 2]) / (end[:, 2] - apex[:, 2]))[:, None] for end in ends]
    return np.stack([apex + share * (end - apex) for share, end in zip(shares, ends, strict=True)], axis=1)
