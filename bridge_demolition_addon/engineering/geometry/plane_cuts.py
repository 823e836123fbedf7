"""Where a plane across an axis cuts triangles."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray, IntArray


def plane_cuts(corners: FloatArray, across: int, level: float) -> tuple[IntArray, FloatArray]:
    """Return which triangles (t, 3, 3) a plane across an axis parts (c,), and the ends of the cuts (c, 2, 3)."""
    heights = corners[..., across] - level
    parted = np.flatnonzero((heights > 0.0).any(axis=1) & (heights <= 0.0).any(axis=1))
    corners, heights = corners[parted], heights[parted]
    # The corner that is alone on its side comes first: both edges from it are cut.
    above = heights > 0.0
    alone = np.where(above.sum(axis=1) == 1, above.argmax(axis=1), above.argmin(axis=1))
    rows = np.arange(len(corners))
    first, height = corners[rows, alone], heights[rows, alone]
    ends = []
    for step in (1, 2):
        other = (alone + step) % 3
        share = height / (height - heights[rows, other])
        ends.append(first + share[:, None] * (corners[rows, other] - first))
    return parted, np.stack(ends, axis=1) if len(ends[0]) else np.zeros((0, 2, 3))
