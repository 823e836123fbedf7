"""The axis of an arch, a parabola or a circle, and its outline: underside, top, level seats of what stands on it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from .road_profiles import RoadProfile
from .vectors import length

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
        """Return the height at which a column stands: that of the top at the higher side of its foot."""
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
