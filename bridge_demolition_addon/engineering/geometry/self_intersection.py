"""Whether a surface crosses itself: triangles that an edge of another one goes through."""

from __future__ import annotations

import numpy as np

from ..arrays import BoolArray, FloatArray
from .proximity import ranges
from .vectors import dot, length

_STRICTLY_INSIDE = 1e-7
"""Part of a triangle or edge that a crossing has to keep from its ends: what only touches does not cross."""

_CANDIDATES_PER_BLOCK = 2_000_000
"""Pairs of triangles whose boxes are compared in one go; bounds the memory."""


def first_crossing(corners: FloatArray) -> FloatArray | None:
    """Position (3,) where an edge goes through the inside of a triangle of a surface (t, 3, 3), or None.

    Triangles that lie in one plane and overlap there do not count as crossing.

    T. Möller, B. Trumbore (1997), Fast, minimum storage ray-triangle intersection, Journal of Graphics Tools 2, 21-28;
    here for the edges of one triangle in place of rays.
    """
    lower, upper = corners.min(axis=1), corners.max(axis=1)
    order = np.argsort(lower[:, 0], kind="stable")
    last = np.searchsorted(lower[order, 0], upper[order, 0], side="right")
    begin = 0
    while begin < len(order):
        # As many rows as keep the block small: each is compared with all that begin before it ends.
        counts = np.cumsum(last[begin:] - np.arange(begin, len(order)))
        end = begin + max(1, int(np.searchsorted(counts, _CANDIDATES_PER_BLOCK)))
        rows = np.arange(begin, end)
        row, second = ranges(rows + 1, last[rows] - rows - 1)
        one, other = order[begin + row], order[second]
        meet = ((lower[one] <= upper[other]) & (lower[other] <= upper[one])).all(axis=1)
        position = _crossing(corners[one[meet]], corners[other[meet]])
        if position is not None:
            return position
        begin = end
    return None


def _crossing(one: FloatArray, other: FloatArray) -> FloatArray | None:
    """Position where an edge of one of the triangles (m, 3, 3) goes through the other of its pair."""
    for through, edged in ((one, other), (other, one)):
        for corner in range(3):
            start, end = edged[:, corner], edged[:, (corner + 1) % 3]
            crosses, along = _pierced(through, start, end - start)
            if crosses.any():
                row = int(np.argmax(crosses))
                crossing: FloatArray = start[row] + along[row] * (end - start)[row]
                return crossing
    return None


def _pierced(triangles: FloatArray, starts: FloatArray, edges: FloatArray) -> tuple[BoolArray, FloatArray]:
    """Whether each edge goes through the inside of its triangle (m,), and where along the edge (m,)."""
    first, second = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    across = np.cross(edges, second)
    volume = dot(first, across)
    size = length(np.cross(first, second)) * length(edges)
    leaning = np.abs(volume) > _STRICTLY_INSIDE * size
    scale = np.divide(1.0, volume, out=np.zeros_like(volume), where=leaning)
    offset = starts - triangles[:, 0]
    turned = np.cross(offset, first)
    u = dot(offset, across) * scale
    v = dot(edges, turned) * scale
    along = dot(second, turned) * scale
    least = np.minimum.reduce([u, v, 1.0 - u - v, along, 1.0 - along])
    return leaning & (least > _STRICTLY_INSIDE), along
