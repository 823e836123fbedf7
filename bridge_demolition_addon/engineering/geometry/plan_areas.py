"""Areas in plan: united, outlined, and how far points are outside them, and where paths in plan are straight."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from manifold3d import CrossSection, JoinType, OpType

from ..arrays import BoolArray, FloatArray, IntArray
from .vectors import cross_2d, transformed

FEWEST_CORNERS = 3

_UNITED_AT_ONCE = 8
_CIRCLE_SEGMENTS = 32

PAIRS_PER_BLOCK = 32_768
"""Pairs of point and side that `distances_outside` looks at in one go: their numbers stay in the processor's cache."""


def signed_area(corners: FloatArray) -> FloatArray:
    """Areas (...) within polygons (..., k, 2), negative where the corners run clockwise (Gauss's shoelace formula)."""
    # From the first corner, because a small polygon far from the origin would lose its area in rounding.
    arms = corners - corners[..., :1, :]
    return cross_2d(arms, np.roll(arms, -1, axis=-2)).sum(axis=-1) / 2.0


def united(areas: Iterable[CrossSection]) -> CrossSection:
    """Area that at least one of the areas covers."""
    # Neighbours first: hundreds of areas that all overlap take fifteen times as long at once.
    areas = sorted(areas, key=lambda area: area.bounds())
    while len(areas) > 1:
        groups = range(0, len(areas), _UNITED_AT_ONCE)
        areas = [CrossSection.batch_boolean(areas[first : first + _UNITED_AT_ONCE], OpType.Add) for first in groups]
    return areas[0] if areas else CrossSection()


def without_gaps(area: CrossSection, gap_m: float) -> CrossSection:
    """Area with all gaps and holes in it that are narrower than `gap_m`: one outline around parts that lie close."""
    if area.is_empty():
        return area
    wide = area.offset(gap_m / 2.0, JoinType.Round, circular_segments=_CIRCLE_SEGMENTS)
    closed = wide.offset(-gap_m / 2.0, JoinType.Round, circular_segments=_CIRCLE_SEGMENTS)
    return united([area, closed])  # rounded corners would cut off some millimetres of it


def outlines(area: CrossSection) -> list[FloatArray]:
    """Closed outlines of an area, each (k, 2) in m: outer ones run anticlockwise, holes clockwise."""
    return [np.asarray(polygon, float) for polygon in area.to_polygons()]


def distances_outside(area: CrossSection, points: FloatArray) -> FloatArray:
    """Distances (p,) of points (p, 2) from an area, m; 0 within it."""
    if not area.num_contour():
        raise ValueError("an empty area has no distance to anything")
    rings = outlines(area)
    starts, ends = np.concatenate(rings).T, np.concatenate([np.roll(ring, -1, axis=0) for ring in rings]).T
    distances = np.zeros(len(points))
    rows = max(1, PAIRS_PER_BLOCK // starts.shape[1])
    for first in range(0, len(points), rows):
        block = np.asarray(points[first : first + rows], float)
        outside = _windings(block.T[..., None], starts, ends) <= 0
        distances[first : first + rows][outside] = _distances_to_sides(block[outside].T[..., None], starts, ends)
    return distances


def _distances_to_sides(points: FloatArray, starts: FloatArray, ends: FloatArray) -> FloatArray:
    """Distances (p,) of points (2, p, 1) from the nearest of sides, from (2, s) to (2, s)."""
    sides_x, sides_y = ends - starts
    lengths_squared = np.maximum(sides_x * sides_x + sides_y * sides_y, np.finfo(float).tiny)
    shares = (points[0] - starts[0]) * sides_x
    shares += (points[1] - starts[1]) * sides_y
    shares /= lengths_squared
    np.clip(shares, 0.0, 1.0, out=shares)
    x = points[0] - (starts[0] + shares * sides_x)
    y = points[1] - (starts[1] + shares * sides_y)
    nearest: FloatArray = np.sqrt((x * x + y * y).min(axis=1))
    return nearest


def _windings(points: FloatArray, starts: FloatArray, ends: FloatArray) -> IntArray:
    """Winding numbers (p,) of an outline around points (2, p, 1), from the sides that a ray to the right meets.

    D. Sunday (2021), Practical Geometry Algorithms: the winding number of a point in a polygon, without angles.
    """
    sides_x, sides_y = ends - starts
    is_left = sides_x * (points[1] - starts[1]) - sides_y * (points[0] - starts[0])
    starts_below, ends_below = starts[1] <= points[1], ends[1] <= points[1]
    rises = starts_below & ~ends_below & (is_left > 0.0)
    falls = ends_below & ~starts_below & (is_left < 0.0)
    windings: IntArray = np.count_nonzero(rises, axis=1) - np.count_nonzero(falls, axis=1)
    return windings


def inside_outline(corners: FloatArray, points: FloatArray) -> BoolArray:
    """Return whether points (n, 2) lie within an outline with corners (k, 2) in order around it."""
    found: BoolArray = _windings(points.T[..., None], corners.T, np.roll(corners, -1, axis=0).T) != 0
    return found


def sides_cross(corners: FloatArray) -> bool:
    """Whether two sides of a polygon (k, 2) that are not neighbours meet, or it has no area."""
    ends = np.roll(corners, -1, axis=0)
    if abs(signed_area(corners)) <= 1e-12 * max(1.0, float(np.square(np.ptp(corners, axis=0).max()))):
        return True
    count = len(corners)
    return any(
        _meet(corners[i], ends[i], corners[j], ends[j])
        for i in range(count)
        for j in range(i + 2, count)
        if (i, j) != (0, count - 1)
    )


def _meet(a: FloatArray, b: FloatArray, c: FloatArray, d: FloatArray) -> bool:
    """Return whether the segments from a to b and from c to d have a point in common; all (2,) float."""

    def side(p: FloatArray, q: FloatArray, r: FloatArray) -> float:
        return float(np.sign(cross_2d(q - p, r - p)))

    def within(p: FloatArray, q: FloatArray, r: FloatArray) -> bool:
        return bool(((np.minimum(p, q) <= r) & (r <= np.maximum(p, q))).all())

    first, second, third, fourth = side(a, b, c), side(a, b, d), side(c, d, a), side(c, d, b)
    if first != second and third != fourth:
        return True
    on_line = ((first, a, b, c), (second, a, b, d), (third, c, d, a), (fourth, c, d, b))
    return any(turn == 0.0 and within(p, q, r) for turn, p, q, r in on_line)


def path_of_corners(rotations: FloatArray, positions: FloatArray, corners: FloatArray) -> FloatArray:
    """Corners (v, 3) of a body in plan (k, v, 2) at all steps, by its rotations (k, 3, 3) and positions (k, 3)."""
    return transformed(rotations[:, None, :2], corners) + positions[:, None, :2]


def ends_of_straight_parts(plans: FloatArray, off: float) -> list[int]:
    """Steps at which straight parts of a path of corners (k, v, 2) meet, and the first and last.

    Corners stray from a straight way, or from the position at which they stay, by `off` at most.
    """
    last = len(plans) - 1
    bends, moves = bends_and_moves(plans)
    bent, leaves_at_once = np.cumsum(bends).tolist(), (moves > off).tolist()
    ends = [0]
    while ends[-1] < last:
        start = ends[-1]
        away = 0 if leaves_at_once[start] else _steps_near(plans, start, off)
        ends.append(start + max(1, away, _straight_steps(bent, start, last, off)))
    return ends if last else [0, 0]


def bends_and_moves(plans: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Largest second difference of a coordinate of corners (k, v, 2) at each step, and largest way to the next, (k,).

    Both are 0 at the last step, and bends at the first.
    """
    bends, moves = np.zeros(len(plans)), np.zeros(len(plans))
    bends[1:-1] = np.abs(np.diff(plans, 2, axis=0)).max(axis=(1, 2), initial=0.0)
    moves[:-1] = np.abs(np.diff(plans, axis=0)).max(axis=(1, 2), initial=0.0)
    return bends, moves


def _steps_near(plans: FloatArray, start: int, off: float) -> int:
    """How many steps after one all corners stay where they were."""
    is_away = np.abs(plans[start + 1 :] - plans[start]).max(axis=(1, 2)) > off
    return int(is_away.argmax()) if is_away.any() else len(is_away)


def _straight_steps(bent: list[float], start: int, last: int, off: float) -> int:
    """How many steps after one lie on a straight line, by the sums of second differences up to each step.

    A way of n steps strays from its chord by n / 4 times the sum of its second differences at most.
    """
    steps = range(1, last - start + 1)
    return bisect_right(steps, off, key=lambda step: step / 4.0 * (bent[start + step - 1] - bent[start]))


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

        Its outlines (k, 2), as `outlines` gives them, lie within the cells; holes run the other way round.
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
