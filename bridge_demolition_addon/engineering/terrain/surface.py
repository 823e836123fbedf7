"""Surfaces of triangles over a plan, their heights, and the ground that a run was on, with the surfaces on it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from manifold3d import CrossSection, FillRule

from ..arrays import FloatArray, IntArray
from ..geometry.mesh import TriangleMesh
from ..geometry.plan_areas import signed_area
from ..geometry.proximity import blocks, ranges
from ..geometry.vectors import cross_2d

_ON_EDGE = 1e-9
"""Distance outside a triangle, as a part of it, up to which a position is on it."""

_MOST_CELLS_ALONG = 1024


@dataclass(frozen=True, eq=False)
class Surface:
    """Triangles over a plan, sorted into square cells so that those at a position are known at once.

    Upright triangles have no height at any position.
    """

    mesh: TriangleMesh

    @cached_property
    def bounds(self) -> FloatArray:
        """Lowest and highest x and y, (2, 2)."""
        return self.mesh.bounds[:, :2]

    @cached_property
    def _cells(self) -> _Cells:
        return _Cells.of(self.mesh)

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
        positions, sorted_in = np.asarray(positions, float).reshape(-1, 2), self._cells
        highest = np.full(len(positions), np.nan)
        if not len(sorted_in.corners):
            return highest
        column, row = np.floor((positions - sorted_in.low) / sorted_in.side_m).astype(np.int64).T
        on_edge = positions == self.bounds[1]
        columns, rows = sorted_in.counts
        column = np.where(on_edge[:, 0], np.minimum(column, columns - 1), column)
        row = np.where(on_edge[:, 1], np.minimum(row, rows - 1), row)
        inside = np.flatnonzero((column >= 0) & (row >= 0) & (column < columns) & (row < rows))
        cells = row[inside] * columns + column[inside]
        counts = sorted_in.firsts[cells + 1] - sorted_in.firsts[cells]
        for part in blocks(counts):
            of, candidate = ranges(sorted_in.firsts[cells[part]], counts[part])
            at = inside[part][of]
            heights = _heights_in(sorted_in.corners[sorted_in.triangles[candidate]], positions[at])
            np.fmax.at(highest, at, heights)
        return highest


@dataclass(frozen=True, eq=False, slots=True)
class _Cells:
    """Square cells over a plan, and the triangles in each."""

    corners: FloatArray  # (t, 3, 3), of triangles that are not upright
    low: FloatArray  # lowest x and y, (2,)
    side_m: float
    counts: IntArray  # along x and y, (2,)
    triangles: IntArray  # in cells, one cell after the other
    firsts: IntArray  # of each cell among these, and their number

    @classmethod
    def of(cls, mesh: TriangleMesh) -> _Cells:
        corners = mesh.corners
        doubled = cross_2d(corners[:, 1, :2] - corners[:, 0, :2], corners[:, 2, :2] - corners[:, 0, :2])
        corners = corners[doubled != 0.0]
        lower, upper = corners[:, :, :2].min(axis=1), corners[:, :, :2].max(axis=1)
        low = lower.min(axis=0, initial=np.inf) if len(corners) else np.zeros(2)
        size = (upper.max(axis=0) - low).max() if len(corners) else 1.0
        along = min(_MOST_CELLS_ALONG, int(np.sqrt(max(len(corners), 1))) + 1)
        side = max(float(size) / along, np.finfo(float).tiny)
        first, last = (np.floor((corner - low) / side).astype(np.int64) for corner in (lower, upper))
        counts = last.max(axis=0, initial=0) + 1
        wide, high = (last - first + 1).T
        rows, number = ranges(np.zeros(len(corners), np.int64), wide * high)
        cells = (first[rows, 1] + number // wide[rows]) * counts[0] + first[rows, 0] + number % wide[rows]
        order = np.argsort(cells, kind="stable")
        firsts = np.searchsorted(cells[order], np.arange(int(counts[0] * counts[1]) + 1))
        return cls(corners, low, side, counts, rows[order], firsts)


def _heights_in(corners: FloatArray, positions: FloatArray) -> FloatArray:
    """Height (n,) of each triangle (n, 3, 3) at its position (n, 2); nan outside it."""
    origin = corners[:, 0]
    first, second = corners[:, 1] - origin, corners[:, 2] - origin
    offset = positions - origin[:, :2]
    area = cross_2d(first, second)
    u, v = cross_2d(offset, second) / area, cross_2d(first, offset) / area
    inside = (u >= -_ON_EDGE) & (v >= -_ON_EDGE) & (u + v <= 1.0 + _ON_EDGE)
    return np.where(inside, origin[:, 2] + u * first[:, 2] + v * second[:, 2], np.nan)


_LEVEL_M = 1e-4
"""Heights that differ by less are one: those of a kilometre in single precision do."""


@dataclass(frozen=True, slots=True)
class NamedSurface:
    """A surface on the ground; its kind is a word such as water."""

    name: str
    kind: str
    surface: Surface

    @property
    def level_m(self) -> float | None:
        """Height of its upper side, m; None where that is not level."""
        corners = self.surface.mesh.corners
        up = signed_area(corners[:, :, :2]) > 0.0
        heights = corners[up, :, 2]
        return float(heights.max()) if len(heights) and np.ptp(heights) <= _LEVEL_M else None

    def plan(self) -> CrossSection:
        """Return the area that it covers in plan, above the ground or below it."""
        return _covered(self.surface.mesh.corners[:, :, :2])


@dataclass(frozen=True, slots=True)
class RecordedGround:
    """The ground of a run, and the surfaces on it; without `terrain` it is flat, at height 0."""

    terrain: Surface | None = None
    surfaces: tuple[NamedSurface, ...] = ()

    @property
    def is_flat(self) -> bool:
        """Whether it is at height 0 everywhere."""
        return self.terrain is None and not self.surfaces

    def shown(self, surface: NamedSurface) -> CrossSection:
        """Return the area of a surface in plan where it lies above the terrain: of water, up to its shores.

        Of a surface that is not level it is all of its plan.
        """
        plan, level = surface.plan(), surface.level_m
        if self.terrain is None or level is None:
            return plan
        return plan - _covered_above(self.terrain.mesh.corners, level, np.array(plan.bounds()).reshape(2, 2))

    def heights_at(self, positions_m: FloatArray) -> FloatArray:
        """Heights (...) of ground and surfaces at positions (..., 2), m; beyond its edge, the lowest of the terrain."""
        positions = np.asarray(positions_m, float)
        flat = positions.reshape(-1, 2)
        heights = np.zeros(len(flat))
        if self.terrain is not None:
            heights = self.terrain.heights_at(flat)
            heights = np.where(np.isnan(heights), self.terrain.mesh.vertices[:, 2].min(), heights)
        for surface in self.surfaces:
            heights = np.fmax(heights, surface.surface.heights_at(flat))
        return heights.reshape(positions.shape[:-1])


def _covered(corners: FloatArray) -> CrossSection:
    """Area of triangles (t, 3, 2) in plan, whichever side of them is up."""
    areas = signed_area(corners)
    corners = np.where((areas < 0.0)[:, None, None], corners[:, ::-1], corners)
    return CrossSection(list(corners[areas != 0.0]), FillRule.NonZero)


def _covered_above(corners: FloatArray, level_m: float, bounds_m: FloatArray) -> CrossSection:
    """Area in plan of the parts of triangles (t, 3, 3) above a level, of those that meet a box (2, 2)."""
    plan = corners[:, :, :2]
    meets = (plan.max(axis=1) >= bounds_m[0]).all(axis=1) & (plan.min(axis=1) <= bounds_m[1]).all(axis=1)
    parts = []
    for triangle in corners[meets & (corners[:, :, 2].max(axis=1) > level_m)]:
        above = triangle[:, 2] > level_m
        outline = []
        for row in range(3):
            here, there = triangle[row], triangle[(row + 1) % 3]
            if above[row]:
                outline.append(here[:2])
            if above[row] != above[(row + 1) % 3]:
                share = (level_m - here[2]) / (there[2] - here[2])
                outline.append(here[:2] + share * (there[:2] - here[:2]))
        parts.append(np.array(outline))
    return CrossSection(parts, FillRule.NonZero)
