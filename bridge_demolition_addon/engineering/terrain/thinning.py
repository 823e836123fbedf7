"""A square grid of heights as few triangles: right-angled ones, halved where the ground is uneven.

W. Evans, D. Kirkpatrick, G. Townsend (2001), *Right-triangulated irregular networks*, Algorithmica 30(2), 264-286. A
triangle is halved at the middle of its longest side. Where a middle is needed, so is the middle of each triangle that
it was part of, so that no two triangles meet at a gap.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..geometry.mesh import TriangleMesh

_STRICTER = 0.7
_MOST_ROUNDS = 30


@dataclass(frozen=True, eq=False, slots=True)
class Grid:
    """Heights at the nodes of a square grid with 2^k cells along each side."""

    low: FloatArray  # (2,), x and y of its first node, m
    step_m: float
    heights: FloatArray  # (s, s), rows along x, one for each y; s = 2^k + 1

    @property
    def size(self) -> int:
        """Number of nodes along a side."""
        return len(self.heights)

    def places(self) -> FloatArray:
        """Positions (s², 2) of the nodes, row by row, m."""
        numbers = np.arange(self.size)
        x, y = np.meshgrid(self.low[0] + self.step_m * numbers, self.low[1] + self.step_m * numbers)
        return np.column_stack((x.ravel(), y.ravel()))


def thinned(grid: Grid, tolerance_m: float, kept: BoolArray, longest_m: float) -> TriangleMesh:
    """Return triangles that are no farther than a tolerance above or below any node of a grid.

    Nodes `kept` (s, s) are corners in any case. Shorter sides are no longer than `longest_m`, or the grid's step.
    """
    limit = tolerance_m
    for _ in range(_MOST_ROUNDS):
        needed = _needed(grid, limit, kept, longest_m)
        # Errors of every size of triangles add up: they are measured, and the limit made stricter.
        if np.abs(_interpolated(grid.heights, needed) - grid.heights).max() <= tolerance_m:
            return _triangles(grid, needed)
        limit *= _STRICTER
    return _triangles(grid, np.ones_like(kept))


def _levels(size: int) -> Iterator[tuple[int, bool]]:
    """Halves of the sides, and whether squares or their sides are halved, from the largest triangles to the least."""
    half = (size - 1) // 2
    while half:
        yield half, True
        yield half, False
        half //= 2


def _middles(size: int, half: int, of_squares: bool) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Middles (m, 2) of the longest sides of one size, as row and column, and the sides' ends, (m, 2) each."""
    odd, even = np.arange(half, size, 2 * half), np.arange(0, size, 2 * half)
    if of_squares:
        row, column = (numbers.ravel() for numbers in np.meshgrid(odd, odd, indexing="ij"))
        # The diagonal runs to the corner whose numbers are both even, in steps of the side.
        same = ((row - half) // (2 * half) + (column - half) // (2 * half)) % 2 == 0
        lean = np.where(same, half, -half)
        first, second = (row - half, column - lean), (row + half, column + lean)
    else:
        flat = [numbers.ravel() for numbers in np.meshgrid(even, odd, indexing="ij")]
        upright = [numbers.ravel() for numbers in np.meshgrid(odd, even, indexing="ij")]
        row, column = (np.concatenate(pair) for pair in zip(flat, upright, strict=True))
        along = np.repeat([half, 0], [len(flat[0]), len(upright[0])])
        first, second = (row - (half - along), column - along), (row + (half - along), column + along)
    return np.column_stack((row, column)), np.column_stack(first), np.column_stack(second)


def _needed(grid: Grid, limit_m: float, kept: BoolArray, longest_m: float) -> BoolArray:
    """Whether each node is a corner of triangles."""
    heights, size = grid.heights, grid.size
    needed = kept.copy()
    needed[:: size - 1, :: size - 1] = True
    for half, of_squares in reversed(list(_levels(size))):
        middles, first, second = _middles(size, half, of_squares)
        row, column = middles.T
        off = np.abs(heights[row, column] - (heights[tuple(first.T)] + heights[tuple(second.T)]) / 2.0)
        wanted = needed[row, column] | (off > limit_m) | (2 * half * grid.step_m > longest_m)
        needed[row, column] = wanted | _halved_further(needed, row, column, half, of_squares)
    return needed


def _halved_further(needed: BoolArray, row: IntArray, column: IntArray, half: int, of_squares: bool) -> BoolArray:
    """Whether a triangle that comes from those with these middles is halved in turn."""
    last = len(needed) - 1
    shifts: tuple[tuple[int, int], ...]
    if of_squares:
        shifts = ((half, 0), (-half, 0), (0, half), (0, -half))
    elif half > 1:
        shifts = tuple((a * half // 2, b * half // 2) for a in (-1, 1) for b in (-1, 1))
    else:
        return np.zeros(len(row), bool)
    halved = np.zeros(len(row), bool)
    for down, right in shifts:
        there = (row + down >= 0) & (row + down <= last) & (column + right >= 0) & (column + right <= last)
        halved |= there & needed[np.clip(row + down, 0, last), np.clip(column + right, 0, last)]
    return halved


def _interpolated(heights: FloatArray, needed: BoolArray) -> FloatArray:
    """Heights (s, s) of the triangles at all nodes: a node that is no corner is the mean of its longest side's ends."""
    interpolated = heights.copy()
    for half, of_squares in _levels(len(heights)):
        middles, first, second = _middles(len(heights), half, of_squares)
        row, column = middles.T
        between = (interpolated[tuple(first.T)] + interpolated[tuple(second.T)]) / 2.0
        interpolated[row, column] = np.where(needed[row, column], heights[row, column], between)
    return interpolated


def _triangles(grid: Grid, needed: BoolArray) -> TriangleMesh:
    last = grid.size - 1
    # Each with the ends of its longest side first, as row and column, so that, as x and y, they run counter-clockwise.
    corners = np.array([[[0, 0], [last, last], [last, 0]], [[last, last], [0, 0], [0, last]]])
    done = []
    while len(corners):
        middle = (corners[:, 0] + corners[:, 1]) // 2
        whole = ((corners[:, 0] + corners[:, 1]) % 2 == 0).all(axis=1)
        halved = whole & needed[middle[:, 0], middle[:, 1]]
        done.append(corners[~halved])
        first, second, apex = np.moveaxis(corners[halved], 1, 0)
        middle = middle[halved]
        corners = np.concatenate([np.stack((apex, first, middle), 1), np.stack((second, apex, middle), 1)])
    corners = np.concatenate(done)
    nodes, triangles = np.unique(corners[..., 0] * grid.size + corners[..., 1], return_inverse=True)
    row, column = np.divmod(nodes, grid.size)
    x, y = grid.low[0] + grid.step_m * column, grid.low[1] + grid.step_m * row
    vertices = np.column_stack((x, y, grid.heights[row, column]))
    return TriangleMesh(vertices, triangles.reshape(-1, 3).astype(np.int64))
