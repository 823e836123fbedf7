"""The axis of an arch, a parabola or a circle, and its outline: underside, top, level seats of what stands on it; and
solids of one outline along the road all across it, in pieces between sections, such as a deck with haunches."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ..arrays import FloatArray, IntArray
from .mesh import TriangleMesh
from .vectors import length, unit


@dataclass(frozen=True, slots=True, eq=False)
class RoadProfile:
    """Corners of a solid of n - 1 straight pieces, whose sections between them go from underside to top.

    `undersides_m` and `tops_m` are (n, 2), positions along the road and heights.
    """

    undersides_m: FloatArray
    tops_m: FloatArray

    @property
    def outlines_m(self) -> list[FloatArray]:
        """Return the outline (4, 2) of each piece, counter-clockwise."""
        sides = list(zip(self.undersides_m, self.tops_m, strict=True))
        return [
            np.array((under, next_under, next_top, top)) for (under, top), (next_under, next_top) in pairwise(sides)
        ]

    @property
    def directions(self) -> FloatArray:
        """Return the directions (n - 1, 2), of length 1, of the middle lines of the pieces."""
        return unit(np.diff(0.5 * (self.undersides_m + self.tops_m), axis=0))

    def pieces(self, width_m: float, across_m: float = 0.0) -> tuple[TriangleMesh, ...]:
        """Return the pieces, convex where their outlines are."""
        return tuple(across_road(outline, width_m, across_m) for outline in self.outlines_m)

    def solid(self, width_m: float, across_m: float = 0.0) -> TriangleMesh:
        """Return the whole, as wide to either side of a position across the road."""
        count = len(self.undersides_m)
        under = np.arange(count - 1)
        top = 2 * count - 1 - under
        halves = np.column_stack((under, under + 1, top - 1, under, top - 1, top))
        outline = np.concatenate((self.undersides_m, self.tops_m[::-1]))
        return across_road(outline, width_m, across_m, halves.reshape(-1, 3))


def across_road(
    outline_m: FloatArray, width_m: float, across_m: float = 0.0, triangles: IntArray | None = None
) -> TriangleMesh:
    """Return the solid of an outline upright along the road, as wide to either side of a position across it.

    Parameters
    ----------
    outline_m : (n, 2) float
        Corners by position along x and height, counter-clockwise.
    width_m
        Width along y.
    across_m
        Position of its middle along y.
    triangles : (t, 3) int, optional
        Corners of triangles that fill it, counter-clockwise; by default of a convex one.
    """
    count = len(outline_m)
    corner = np.arange(count)
    if triangles is None:
        triangles = np.column_stack((np.zeros(count - 2, np.int64), corner[1:-1], corner[2:]))
    right, left = (np.insert(outline_m, 1, across_m + side * width_m, axis=1) for side in (-0.5, 0.5))
    after = np.roll(corner, -1)
    around = np.column_stack((corner, corner + count, after + count, corner, after + count, after)).reshape(-1, 3)
    return TriangleMesh(np.concatenate((right, left)), np.concatenate((triangles, triangles[:, ::-1] + count, around)))


_PIECES = 12
"""Span of an arch by that of its longest straight piece: a parabola is off its chord by 1/144 of the rise."""

_SIDES = 1000

_STEPS = 40
"""Steps to where a section ends at a position on top; each leaves less than half of what is missing, of arches whose
radius is more than their thickness."""


@dataclass(frozen=True, slots=True)
class ArchAxis:
    """The axis of an arch from one springing to the other, which are at the same height: a parabola or a circle.

    Its thickness, and its sections, are square to it.
    """

    begin_m: float
    end_m: float
    springing_m: float
    rise_m: float
    thickness_m: float
    is_circle: bool = False

    @property
    def span_m(self) -> float:
        """Distance of the springings."""
        return self.end_m - self.begin_m

    @property
    def radius_m(self) -> float:
        """Radius of the circle through springings and crown."""
        return 0.5 * (self.rise_m + 0.25 * self.span_m * self.span_m / self.rise_m)

    @property
    def length_m(self) -> float:
        """Length of the axis, as of a polygon of many sides."""
        points = self.points_m(np.linspace(self.begin_m, self.end_m, _SIDES + 1), 0.0)
        return math.fsum(length(np.diff(points, axis=0)).tolist())

    def points_m(self, x_m: FloatArray, side: float) -> FloatArray:
        """Return points (n, 2) of the sections at positions (n,) of the axis: 0 on it, 1 on top, -1 underneath."""
        heights, slopes = self._on_circle(x_m) if self.is_circle else self._on_parabola(x_m)
        half = 0.5 * side * self.thickness_m / np.sqrt(1.0 + slopes * slopes)
        return np.column_stack((x_m - half * slopes, heights + half))

    def seat_m(self, column_m: float, length_m: float) -> float:
        """Return the height at which a column stands: the top at the higher side of its foot."""
        return float(self.points_m(self._below(_foot(column_m, length_m)), 1.0)[:, 1].max())

    def profile(self, columns_m: Sequence[float], length_m: float) -> RoadProfile:
        """Return the arch as it is built, of straight pieces and level below each column of a length along it."""
        feet = [_foot(column, length_m) for column in columns_m]
        below = [self._below(foot) for foot in feet]
        ends = [self.begin_m, *(float(x) for sides in below for x in sides), self.end_m]
        between = [self._pieces(*ends[number : number + 2]) for number in range(0, len(ends), 2)]
        x = np.unique(np.concatenate((*below, *between)))
        tops = self.points_m(x, 1.0)
        for column, foot, sides in zip(columns_m, feet, below, strict=True):
            seat = self.seat_m(column, length_m)
            for position, side in zip(foot, sides, strict=True):
                tops[x == side] = position, seat
        return RoadProfile(self.points_m(x, -1.0), tops)

    def _on_parabola(self, x_m: FloatArray) -> tuple[FloatArray, FloatArray]:
        part = (x_m - self.begin_m) / self.span_m
        heights = self.springing_m + 4.0 * self.rise_m * part * (1.0 - part)
        return heights, 4.0 * self.rise_m / self.span_m * (1.0 - 2.0 * part)

    def _on_circle(self, x_m: FloatArray) -> tuple[FloatArray, FloatArray]:
        beside = x_m - 0.5 * (self.begin_m + self.end_m)
        above = np.sqrt(self.radius_m * self.radius_m - beside * beside)
        return self.springing_m + self.rise_m - self.radius_m + above, -beside / above

    def _below(self, tops_m: FloatArray) -> FloatArray:
        """Return the positions (n,) of the axis at whose sections the top is at positions (n,)."""
        x = np.clip(tops_m, self.begin_m, self.end_m)
        for _ in range(_STEPS):
            x = np.clip(x + tops_m - self.points_m(x, 1.0)[:, 0], self.begin_m, self.end_m)
        return x

    def _pieces(self, begin_m: float, end_m: float) -> FloatArray:
        """Return the corners between two columns, both ends included."""
        count = max(int(np.ceil(_PIECES * (end_m - begin_m) / self.span_m)), 1)
        return np.concatenate((np.linspace(begin_m, end_m, count, endpoint=False), [end_m]))


def _foot(column_m: float, length_m: float) -> FloatArray:
    return np.array([column_m - 0.5 * length_m, column_m + 0.5 * length_m])
