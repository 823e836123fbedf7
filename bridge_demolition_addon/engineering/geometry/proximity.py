"""Neighbours among thousands of points or boxes, found by sorting them into the cells of a grid."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, IntArray
from .vectors import distance

_MOST_CELLS = 2**20
"""Cells along an axis, at most: the number of a cell in three axes then fits into 64 bits."""

_SLACK = 1e-6
"""Part of a radius that cells are larger by: rounding, 2**20 × 2**-52, then never hides a neighbour two cells away."""

_CELLS_PER_BOX = 30
"""Cells that a box is in, in the mean, at most: 2 in each direction and room for some large ones."""

_AT_ONCE = 2_000_000
"""Candidates in one array operation: their differences in three axes take 50 MB."""

_SAMPLE = 64
"""Points that show how close points lie."""

_GROWTH = 1.5
"""Growth of a radius in which too few neighbours were found."""


def ranges(starts: IntArray, counts: IntArray) -> tuple[IntArray, IntArray]:
    """For every row k the numbers starts[k] ... starts[k] + counts[k] - 1, one after the other, and each one's row."""
    rows = np.repeat(np.arange(len(counts)), counts)
    firsts = np.cumsum(counts) - counts
    return rows, np.arange(len(rows)) - firsts[rows] + starts[rows]


def blocks(counts: IntArray) -> Iterator[slice]:
    """Slices of rows (k,), in order, each with as many as can be worked on at once by their counts, or one row."""
    sums = np.cumsum(counts)
    start, before = 0, 0
    while start < len(counts):
        end = max(start + 1, int(np.searchsorted(sums, before + _AT_ONCE, side="right")))
        yield slice(start, end)
        start, before = end, int(sums[end - 1])


def boxes_that_meet(lower: FloatArray, upper: FloatArray, distance: float = 0.0) -> IntArray:
    """Pairs (k, 2) of boxes, by corners (n, 3), that are no further apart than a distance in every direction.

    The smaller index comes first, and pairs are in ascending order. Every box is noted in all cells that it is in, and
    boxes noted in the same cell are compared. A pair is taken in the first cell that both are noted in: so it comes
    once.
    """
    meeting: list[IntArray] = [np.zeros((0, 2), np.int64)]
    if len(lower) > 1:
        upper = upper + distance  # to one side is enough: half of the distance on either side is the same
        low, key_of, boxes, keys = _boxes_in_cells(lower, upper)
        positions = np.arange(len(boxes))
        others = np.searchsorted(keys, keys, side="right") - positions - 1
        for part in blocks(others):
            row, position = ranges(positions[part] + 1, others[part])
            one, other = boxes[part][row], boxes[position]
            first_cell = key_of(np.maximum(low[one], low[other])) == keys[position]
            one, other = one[first_cell], other[first_cell]
            meets = ((lower[one] <= upper[other]) & (lower[other] <= upper[one])).all(axis=1)
            meeting.append(np.column_stack((np.minimum(one, other), np.maximum(one, other)))[meets])
    pairs = np.concatenate(meeting)
    return pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]


def points_within(points: FloatArray, radius: float) -> tuple[IntArray, FloatArray]:
    """Pairs (k, 2) of points (n, 3) no further apart than a radius, in ascending order, and their distances (k,)."""
    near: list[tuple[IntArray, FloatArray]] = [(np.zeros((0, 2), np.int64), np.zeros(0))]
    if len(points) > 1:
        for query, other, distances in _Grid.of(points, radius).near(np.arange(len(points))):
            once = (query < other) & (distances <= radius)
            near.append((np.column_stack((query, other))[once], distances[once]))
    pairs, distances = (np.concatenate(parts) for parts in zip(*near, strict=True))
    order = np.lexsort((pairs[:, 1], pairs[:, 0]))
    return pairs[order], distances[order]


def nearest_points(points: FloatArray, count: int) -> tuple[IntArray, FloatArray]:
    """Indices and distances (n, c) of the `count` points nearest to each point (n, 3), at most all others.

    They are nearest first and, at the same distance, the smaller index first.
    """
    count = min(count, max(len(points) - 1, 0))
    indices, distances = np.zeros((len(points), count), np.int64), np.zeros((len(points), count))
    waiting = np.arange(len(points)) if count else np.zeros(0, np.int64)
    radius = _likely_radius(points, count) if count else 0.0
    while len(waiting):
        served: list[IntArray] = [np.zeros(0, np.int64)]
        for query, other, apart in _Grid.of(points, radius).near(waiting):
            near = (query != other) & (apart <= radius)
            served.append(_keep_nearest(query[near], other[near], apart[near], indices, distances))
        waiting = np.setdiff1d(waiting, np.concatenate(served), assume_unique=True)
        radius *= _GROWTH
    return indices, distances


@dataclass(frozen=True, eq=False, slots=True)
class _Grid:
    """Points (n, 3) with the numbers of their cells (n,), also in ascending order; an empty layer of cells is around.

    The steps (9,) lead from the number of a cell to the rows of cells around it.
    """

    points: FloatArray
    keys: IntArray
    steps: FloatArray
    order: IntArray
    sorted_keys: IntArray

    @classmethod
    def of(cls, points: FloatArray, radius: float) -> _Grid:
        """Grid whose cells are as large as a radius."""
        low = points.min(axis=0)
        extent = float((points.max(axis=0) - low).max())
        size = max(radius * (1.0 + _SLACK), extent / _MOST_CELLS) or 1.0
        cells = np.floor((points - low) / size).astype(np.int64) + 1
        _, across, along = cells.max(axis=0) + 2
        keys = (cells[:, 0] * across + cells[:, 1]) * along + cells[:, 2]
        beside = np.arange(-1, 2)
        order = np.argsort(keys, kind="stable")
        return cls(points, keys, ((beside[:, None] * across + beside) * along).ravel(), order, keys[order])

    def near(self, queries: IntArray) -> Iterator[tuple[IntArray, IntArray, FloatArray]]:
        """Points (k,) among some queries, others (k,) in the cells around them, and distances (k,), block by block.

        All others of a query are in the same block. The query itself is among them.
        """
        rows_of_cells = self.keys[queries][:, None] + self.steps
        starts = np.searchsorted(self.sorted_keys, rows_of_cells - 1, side="left")
        counts = np.searchsorted(self.sorted_keys, rows_of_cells + 1, side="right") - starts
        for part in blocks(counts.sum(axis=1)):
            row, position = ranges(starts[part].ravel(), counts[part].ravel())
            query, other = queries[part][row // len(self.steps)], self.order[position]
            yield query, other, distance(self.points[query], self.points[other])


def _boxes_in_cells(
    lower: FloatArray, upper: FloatArray
) -> tuple[IntArray, Callable[[IntArray], IntArray], IntArray, IntArray]:
    """Lowest cells (n, 3) of boxes, how to number a cell, and boxes (e,) with the numbers (e,) of cells, by number."""
    origin, extent = lower.min(axis=0), float((upper.max(axis=0) - lower.min(axis=0)).max())
    size = max(float(np.median((upper - lower).max(axis=1))), extent / _MOST_CELLS) or 1.0
    while ((upper - lower) / size + 1.0).prod(axis=1).sum() > _CELLS_PER_BOX * len(lower):
        size *= 2.0
    low = np.floor((lower - origin) / size).astype(np.int64)
    high = np.floor((upper - origin) / size).astype(np.int64)
    _, across, along = high.max(axis=0) + 1

    def key_of(cells: IntArray) -> IntArray:
        numbers: IntArray = (cells[:, 0] * across + cells[:, 1]) * along + cells[:, 2]
        return numbers

    counts = high - low + 1
    boxes, position = ranges(np.zeros(len(lower), np.int64), counts.prod(axis=1))
    position, upwards = np.divmod(position, counts[boxes, 2])
    keys = key_of(low[boxes] + np.column_stack((*np.divmod(position, counts[boxes, 1]), upwards)))
    order = np.argsort(keys, kind="stable")
    return low, key_of, boxes[order], keys[order]


def _likely_radius(points: FloatArray, count: int) -> float:
    """Radius within which some points have that many others; above 0 unless all points are in one position."""
    sample = points[:: max(1, len(points) // _SAMPLE)]
    distances = distance(sample[:, None], points)
    radius = float(np.partition(distances, count, axis=1)[:, count].min())
    return max(radius, float(np.ptp(points, axis=0).max()) / _MOST_CELLS)


def _keep_nearest(
    query: IntArray, other: IntArray, apart: FloatArray, indices: IntArray, distances: FloatArray
) -> IntArray:
    """Enter the nearest others of each query that has enough of them, and return these queries."""
    order = np.lexsort((other, apart, query))
    query, other, apart = query[order], other[order], apart[order]
    unique, starts, counts = np.unique(query, return_index=True, return_counts=True)
    enough = counts >= indices.shape[1]
    served: IntArray = unique[enough]
    rows = starts[enough, None] + np.arange(indices.shape[1])
    indices[served], distances[served] = other[rows], apart[rows]
    return served
