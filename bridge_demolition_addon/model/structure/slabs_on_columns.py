"""Slabs on several columns under one axis: cut by a lattice that has a point above each column.

What such a slab lays on each column depends on how it bends from one to the next, also because bending along the road
curves it across that, by Poisson's effect. Shards around points of chance bend there anyhow: single columns had 0.5 to
1.7 times their share in 100 shards, and in 400 still four fifths. Around a lattice of points, each row half a step off
the last, shards are hexagons, and springs of `member_shapes` follow an evenly bent plate, without what chance takes
off. Columns below are cut across.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ...engineering.arrays import FloatArray, IntArray
from ..bridge.member import Member
from ..scenario import Scenario
from ..schema import SHORTEST_LENGTH_M

_SAME_AXIS_M = 0.05
"""Distance along the road up to which columns are under one axis."""

_SLENDER = 3.0
"""Height by width of a support from which on it is a column."""

_ROWS = (1.08, 0.97, 0.87, 0.76)
"""Distances of rows by that of points in them, of which √3 / 2 makes regular hexagons: with less or more than these,
triangles of points have no springs that make an even plate (`member_shapes.ratios_in_lattices`)."""

_LEAST_PARTS = 2
"""Steps from one column to the next: with one, single columns are off by 10 to 15 %."""

_THINNEST = 0.5
"""Distance of rows by the slab's thickness down to which it is cut by a lattice."""

_MOST_TIMES = 8.0
"""Points of a lattice by shards asked for, up to which a slab is cut around it: columns very close would need more."""

_CLEAR = 0.25
"""Part of a step that a point is away from the end of a slab at least."""

_JITTER = 0.02
"""Part of a step by which chance moves a point: as each seed cuts a bridge otherwise."""


@dataclass(frozen=True, slots=True, eq=False)
class SlabOnColumns:
    """A slab, and the k members that it lies on, by their indices: along and across the road without skew.

    Attributes
    ----------
    axes_m : (a,) float
        Where it is supported along the road.
    columns_m : (c,) float
        Where columns are across the road, two or more under one axis.
    corners_m : (2, 3) float
        Its lowest and its highest corner.
    """

    member: int
    below: IntArray
    axes_m: FloatArray
    columns_m: FloatArray
    corners_m: FloatArray

    def points_m(self, shards: int, draw: np.random.Generator) -> FloatArray:
        """Return points (p, 3) of a lattice: as many as shards, or fewer, but from one column to the next two at least.

        None where this number makes shards much thinner than the slab, or it would take many more.
        """
        parts = _LEAST_PARTS
        while len(self._lattice_m(parts + 1, _ROWS[0])) <= shards:
            parts += 1
        apart_m = self._spacing_m / parts
        is_thinner = apart_m < _THINNEST * float(np.ptp(self.corners_m[:, 2]))
        if is_thinner or len(self._lattice_m(parts, _ROWS[0])) > _MOST_TIMES * shards:
            return np.zeros((0, 3))
        fitting = [lattice for ratio in _ROWS if len(lattice := self._lattice_m(parts, ratio)) <= shards]
        places = np.array(fitting[-1] if fitting else self._lattice_m(parts, _ROWS[0]))
        places += (2.0 * draw.random(places.shape) - 1.0) * _JITTER * apart_m
        return np.column_stack((places, np.full(len(places), 0.5 * float(self.corners_m[:, 2].sum()))))

    def columns_in_a_row(self, members: Sequence[Member], counts: IntArray) -> Iterator[int]:
        """Yield the columns below whose shards (k,) are one above the other, none shorter than half of its width."""
        for row in self.below.tolist():
            *sides, high_m = np.ptp(members[row].solid.vertices, axis=0).tolist()
            if high_m > _SLENDER * max(sides) and 0.5 * counts[row] * max(sides) <= high_m:
                yield row

    @property
    def _spacing_m(self) -> float:
        return float(self.columns_m[-1] - self.columns_m[0]) / (len(self.columns_m) - 1)

    def _lattice_m(self, parts: int, ratio: float) -> list[tuple[float, float]]:
        """Points with a number of steps from one column to the next, in rows across the road by that ratio apart."""
        (begin, right), (end, left) = self.corners_m[:, :2].tolist()
        axes, step_m = self.axes_m.tolist(), self._spacing_m / parts
        # Axes are in even rows, whose points are above columns.
        counts = [2 * max(math.ceil((high - low) / (2.0 * ratio * step_m)), 1) for low, high in pairwise(axes)]
        rows = [(axes[0], 0)]
        for (low, high), count in zip(pairwise(axes), counts, strict=True):
            rows += [(low + (high - low) * (row + 1) / count, row + 1) for row in range(count)]
        for axis, way, end_m in ((axes[0], -1.0, begin), (axes[-1], 1.0, end)):
            more = math.floor(way * (end_m - axis) / (ratio * step_m) - _CLEAR)
            rows += [(axis + way * ratio * step_m * (row + 1), row + 1) for row in range(more)]
        return [(row_m, y) for row_m, row in rows for y in self._across_m(step_m, 0.5 * (row % 2), (right, left))]

    def _across_m(self, step_m: float, shift: float, edges_m: tuple[float, float]) -> list[float]:
        """Where points of a row are across the road, that part of a step off columns."""
        first_m = float(self.columns_m[0]) + shift * step_m
        least, most = (edges_m[0] - first_m) / step_m + _CLEAR, (edges_m[1] - first_m) / step_m - _CLEAR
        return [first_m + step_m * number for number in range(math.ceil(least), math.floor(most) + 1)]


def slabs_on_columns(scenario: Scenario, members: Sequence[Member]) -> Iterator[SlabOnColumns]:
    """Yield the slabs of a bridge that lie on two columns or more under one axis, where connections are elastic."""
    bridge = scenario.bridge
    if bridge is None or bridge.girders or bridge.box_girder or not scenario.connections.is_elastic:
        return
    for index, member in enumerate(members):
        if member.kind != "deck" or member.parts or member.steel is not None:
            continue
        corners = member.without_skew(member.solid.vertices)
        below, places = supports_below(members, index, (index,))
        beside = abs(places[:, None, 0] - places[None, :, 0]) < _SAME_AXIS_M
        columns, axes = np.unique(places[beside.sum(axis=1) > 1, 1].round(6)), np.unique(places[:, 0].round(6))
        if len(columns) > 1 and len(axes) > 1:
            ends = np.array([corners.min(axis=0), corners.max(axis=0)])
            yield SlabOnColumns(index, below, axes, columns, ends)


def supports_below(members: Sequence[Member], carried: int, cast: Sequence[int]) -> tuple[IntArray, FloatArray]:
    """Return on which members (k,) one lies that is not cast with it, and the middles (k, 2) of where it does.

    Along the road and across it, without skew; `cast` are the members cast with it, itself among them.
    """
    corners = [members[carried].without_skew(member.solid.vertices) for member in members]
    lowest, highest = corners[carried].min(axis=0), corners[carried].max(axis=0)
    rows, places = [], []
    for row, other in enumerate(corners):
        low, high = np.maximum(lowest, other.min(axis=0))[:2], np.minimum(highest, other.max(axis=0))[:2]
        lies = abs(float(other[:, 2].max() - lowest[2])) < SHORTEST_LENGTH_M
        if row not in cast and lies and (low < high).all():
            rows.append(row)
            places.append(0.5 * (low + high))
    return np.array(rows, int), np.array(places).reshape(-1, 2)
