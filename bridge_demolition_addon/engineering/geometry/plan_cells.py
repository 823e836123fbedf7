"""Square cells over a plan: which of them an area touches."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from manifold3d import CrossSection

from ..arrays import BoolArray, FloatArray, IntArray
from .plan_areas import united

_SIZES_M = tuple(step * decade for decade in (0.1, 1.0, 10.0, 100.0, 1000.0) for step in (1.0, 2.0, 5.0))
_ON_A_LINE = 1e-9
"""Distance from a line between cells, in sides of a cell, up to which a point lies on it."""


@dataclass(frozen=True, slots=True)
class PlanCells:
    """Rows and columns of square cells, whose lines lie at multiples of their side."""

    side_m: float
    first_column: int  # lowest x by the side
    first_row: int  # lowest y by the side
    columns: int
    rows: int

    @classmethod
    def over(cls, low_m: FloatArray, high_m: FloatArray, most: int) -> PlanCells:
        """Return cells that cover a rectangle (2,) to (2,), as small as `most` along its longer side allow."""
        longest_m = float((high_m - low_m).max())
        fitting = [side for side in _SIZES_M if longest_m <= side * (most - 2)]
        if not fitting:
            raise ValueError(f"an area of {longest_m:g} m is too large for a plan")
        side_m = fitting[0]
        first = np.floor(low_m / side_m).astype(int)
        counts = np.maximum(np.ceil(high_m / side_m).astype(int) - first, 1)
        return cls(side_m, int(first[0]), int(first[1]), int(counts[0]), int(counts[1]))

    @property
    def xs_m(self) -> FloatArray:
        """Lines between columns, (columns + 1,), m."""
        return self.side_m * np.arange(self.first_column, self.first_column + self.columns + 1, dtype=float)

    @property
    def ys_m(self) -> FloatArray:
        """Lines between rows, (rows + 1,), m."""
        return self.side_m * np.arange(self.first_row, self.first_row + self.rows + 1, dtype=float)

    def touched(self, rings: Sequence[FloatArray]) -> BoolArray:
        """Return the cells (rows, columns) that an area covers wholly or in part, even the smallest.

        Its outlines (k, 2), as `outlines` gives them, lie within the cells; those of holes run the other way round.
        """
        grid = np.zeros((self.rows, self.columns), bool)
        if not len(rings):
            return grid
        origin = np.array([self.first_column, self.first_row])
        in_cells = [np.asarray(ring, float) / self.side_m - origin for ring in rings]
        in_cells = [np.where(np.abs(ring - np.rint(ring)) < _ON_A_LINE, np.rint(ring), ring) for ring in in_cells]
        starts = np.concatenate(in_cells)
        ends = np.concatenate([np.roll(ring, -1, axis=0) for ring in in_cells])
        return self._crossed(starts, ends) | self._centres_within(starts, ends)

    def area_of(self, chosen: BoolArray) -> CrossSection:
        """Return the area of chosen cells (rows, columns)."""
        steps = np.diff(np.pad(chosen.astype(int), ((0, 0), (1, 1))), axis=1)
        rows, firsts = np.nonzero(steps == 1)
        _, lasts = np.nonzero(steps == -1)
        xs, ys = self.xs_m, self.ys_m
        bars = zip(xs[firsts], xs[lasts], ys[rows], ys[rows + 1], strict=True)
        return united(
            CrossSection([[(left, low), (right, low), (right, high), (left, high)]]) for left, right, low, high in bars
        )

    def _crossed(self, starts: FloatArray, ends: FloatArray) -> BoolArray:
        """Which cells sides of an area run through, not only along."""
        lowest, highest = np.minimum(starts[:, 1], ends[:, 1]), np.maximum(starts[:, 1], ends[:, 1])
        sides, rows = _spread(np.floor(lowest), np.ceil(highest))
        start, end = starts[sides], ends[sides]
        at_bottom = np.clip(rows, lowest[sides], highest[sides])
        at_top = np.clip(rows + 1.0, lowest[sides], highest[sides])
        rises = end[:, 1] - start[:, 1]
        slopes = np.divide(end[:, 0] - start[:, 0], rises, out=np.zeros(len(rises)), where=rises != 0.0)
        xs = np.column_stack([start[:, 0] + slopes * (height - start[:, 1]) for height in (at_bottom, at_top)])
        level = rises == 0.0
        xs[level] = np.column_stack([start[level, 0], end[level, 0]])
        firsts, lasts = np.floor(xs.min(axis=1)), np.ceil(xs.max(axis=1))
        return self._filled(rows, firsts, 1) + self._filled(rows, lasts, -1) > 0

    def _centres_within(self, starts: FloatArray, ends: FloatArray) -> BoolArray:
        """Which middles of cells an area covers: outlines wind around them."""
        lowest, highest = np.minimum(starts[:, 1], ends[:, 1]), np.maximum(starts[:, 1], ends[:, 1])
        sides, rows = _spread(np.ceil(lowest - 0.5), np.ceil(highest - 0.5))
        start, end = starts[sides], ends[sides]
        slopes = (end[:, 0] - start[:, 0]) / (end[:, 1] - start[:, 1])
        xs = start[:, 0] + slopes * (rows + 0.5 - start[:, 1])
        upwards = np.where(end[:, 1] > start[:, 1], -1, 1)
        covered: BoolArray = self._filled(rows, np.ceil(xs - 0.5), upwards) != 0
        return covered

    def _filled(self, rows: IntArray, columns: IntArray, values: IntArray | int) -> IntArray:
        """Sums (rows, columns) of values that count from their column on to the right."""
        sums = np.zeros((self.rows, self.columns + 1), int)
        inside = np.clip(columns, 0, self.columns).astype(int)
        np.add.at(sums, (rows.astype(int), inside), values)
        return np.cumsum(sums, axis=1)[:, :-1]


def _spread(firsts: IntArray, ends: IntArray) -> tuple[IntArray, IntArray]:
    """Numbers of ranges, each as often as it has members, and the members; ranges begin before their ends."""
    counts = np.maximum(ends - firsts, 0.0).astype(int)
    of = np.repeat(np.arange(len(counts)), counts)
    within = np.arange(len(of)) - np.repeat(np.cumsum(counts) - counts, counts)
    return of, firsts[of] + within
