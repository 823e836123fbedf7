"""Surfaces of triangles over a plan, and their heights."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..geometry.mesh import TriangleMesh
from ..geometry.proximity import blocks, ranges
from ..geometry.vectors import cross_2d

_ON_EDGE = 1e-9
"""Distance outside a triangle, as a part of it, up to which a position is on it."""

_MOST_CELLS_ALONG = 1024


@dataclass(frozen=True, eq=False, slots=True)
class Surface:
    """Triangles over a plan, sorted into square cells so that those at a position are known at once.

    Upright triangles have no height at any position.
    """

    mesh: TriangleMesh
    bounds: FloatArray = field(init=False)  # lowest and highest x and y, (2, 2)
    _corners: FloatArray = field(init=False)
    _low: BoolArray = field(init=False)
    _cell_m: float = field(init=False)
    _counts: IntArray = field(init=False)
    _triangles: IntArray = field(init=False)
    _firsts: IntArray = field(init=False)

    def __post_init__(self) -> None:
        corners = self.mesh.corners
        doubled = cross_2d(corners[:, 1, :2] - corners[:, 0, :2], corners[:, 2, :2] - corners[:, 0, :2])
        corners = corners[doubled != 0.0]
        lower, upper = corners[:, :, :2].min(axis=1), corners[:, :, :2].max(axis=1)
        low = lower.min(axis=0, initial=np.inf) if len(corners) else np.zeros(2)
        size = (upper.max(axis=0) - low).max() if len(corners) else 1.0
        along = min(_MOST_CELLS_ALONG, int(np.sqrt(max(len(corners), 1))) + 1)
        cell = max(float(size) / along, np.finfo(float).tiny)
        first, last = (np.floor((corner - low) / cell).astype(np.int64) for corner in (lower, upper))
        counts = last.max(axis=0, initial=0) + 1
        wide, high = (last - first + 1).T
        rows, number = ranges(np.zeros(len(corners), np.int64), wide * high)
        cells = (first[rows, 1] + number // wide[rows]) * counts[0] + first[rows, 0] + number % wide[rows]
        order = np.argsort(cells, kind="stable")
        values = (self.mesh.bounds[:, :2], corners, low, cell, counts, rows[order])
        names = ("bounds", "_corners", "_low", "_cell_m", "_counts", "_triangles")
        for name, value in zip(names, values, strict=True):
            object.__setattr__(self, name, value)
        firsts = np.searchsorted(cells[order], np.arange(int(counts[0] * counts[1]) + 1))
        object.__setattr__(self, "_firsts", firsts)

    @property
    def points(self) -> FloatArray:
        """Positions (n, 3) at which heights were given."""
        return self.mesh.vertices

    @property
    def spacing(self) -> float | None:
        """Distance of neighbouring heights; None, as they lie anywhere."""
        return None

    def heights_at(self, positions: FloatArray) -> FloatArray:
        """Heights (n,) of the highest triangle at positions (n, 2); nan where there is none."""
        positions = np.asarray(positions, float).reshape(-1, 2)
        highest = np.full(len(positions), np.nan)
        if not len(self._corners):
            return highest
        column, row = np.floor((positions - self._low) / self._cell_m).astype(np.int64).T
        on_edge = positions == self.bounds[1]
        column = np.where(on_edge[:, 0], np.minimum(column, self._counts[0] - 1), column)
        row = np.where(on_edge[:, 1], np.minimum(row, self._counts[1] - 1), row)
        inside = (column >= 0) & (row >= 0) & (column < self._counts[0]) & (row < self._counts[1])
        rows = np.flatnonzero(inside)
        cells = row[rows] * self._counts[0] + column[rows]
        counts = self._firsts[cells + 1] - self._firsts[cells]
        for part in blocks(counts):
            of, candidate = ranges(self._firsts[cells[part]], counts[part])
            heights = _heights_in(self._corners[self._triangles[candidate]], positions[rows[part][of]])
            np.fmax.at(highest, rows[part][of], heights)
        return highest


def _heights_in(corners: FloatArray, positions: FloatArray) -> FloatArray:
    """Height (n,) of each triangle (n, 3, 3) at its position (n, 2); nan where that is beside it."""
    origin = corners[:, 0]
    first, second = corners[:, 1] - origin, corners[:, 2] - origin
    offset = positions - origin[:, :2]
    area = cross_2d(first, second)
    u, v = cross_2d(offset, second) / area, cross_2d(first, offset) / area
    inside = (u >= -_ON_EDGE) & (v >= -_ON_EDGE) & (u + v <= 1.0 + _ON_EDGE)
    return np.where(inside, origin[:, 2] + u * first[:, 2] + v * second[:, 2], np.nan)
