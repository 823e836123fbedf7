"""Rasters of heights: gaps in them, and contour lines."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..geometry.proximity import ranges


@dataclass(frozen=True, eq=False, slots=True)
class Raster:
    """Heights in rows from south to north."""

    first: FloatArray  # (2,), easting and northing of the first height of the first row
    steps: FloatArray  # (2,), distances of columns and of rows, both positive
    heights: FloatArray  # (r, c), nan where there are no data

    @property
    def bounds(self) -> FloatArray:
        """Lowest and highest easting and northing of the heights, (2, 2)."""
        rows, columns = self.heights.shape
        return np.array([self.first, self.first + self.steps * (columns - 1, rows - 1)])

    @property
    def points(self) -> FloatArray:
        """Positions (n, 3) of the known heights."""
        rows, columns = np.nonzero(np.isfinite(self.heights))
        x, y = self.first[0] + self.steps[0] * columns, self.first[1] + self.steps[1] * rows
        return np.column_stack((x, y, self.heights[rows, columns]))

    @property
    def spacing(self) -> float | None:
        """Distance of neighbouring heights."""
        return float(self.steps.min())

    def heights_at(self, positions: FloatArray) -> FloatArray:
        """Heights (n,) at positions (n, 2), even between the four around each; nan where one of these is not known."""
        rows, columns = self.heights.shape
        x, y = ((np.asarray(positions, float) - self.first) / self.steps).T
        inside = (x >= 0.0) & (y >= 0.0) & (x <= columns - 1) & (y <= rows - 1)
        x, y = np.where(inside, x, 0.0), np.where(inside, y, 0.0)
        column = np.minimum(x.astype(np.int64), max(columns - 2, 0))
        row = np.minimum(y.astype(np.int64), max(rows - 2, 0))
        heights = np.zeros(len(x))
        for across in (0, 1):
            for along in (0, 1):
                weight = (y - row if across else 1.0 - (y - row)) * (x - column if along else 1.0 - (x - column))
                corner = self.heights[np.minimum(row + across, rows - 1), np.minimum(column + along, columns - 1)]
                heights += np.where(weight > 0.0, weight * corner, 0.0)
        return np.where(inside, heights, np.nan)


def nearest_known(known: BoolArray) -> tuple[IntArray, IntArray]:
    """Return the row and the column, both (r, c), of the known node nearest to each node (r, c) of a grid.

    Where several are as near it is the first column's of them, and its lower row. At least one has to be known.
    """
    rows, columns = known.shape
    index, far = np.arange(rows)[:, None], 2 * (rows + columns)
    before = np.maximum.accumulate(np.where(known, index, -far), axis=0)
    after = np.minimum.accumulate(np.where(known, index, rows + far)[::-1], axis=0)[::-1]
    in_column = np.where(index - before <= after - index, before, after)
    column = _nearest_columns(np.square(in_column - index))
    return in_column[index, column], column


def _nearest_columns(squares: IntArray) -> IntArray:
    """Return the column (r, c) of the node nearest to each, by squared distances (r, c) within their own columns.

    In a row they ascend, so that the columns of every second node bound the columns between (A. Aggarwal et al., 1987,
    Geometric applications of a matrix-searching algorithm, Algorithmica 2, 195-208).
    """
    rows, columns = squares.shape
    step = 1 << columns.bit_length()
    nearest = np.zeros((rows, step + 1), np.int64)  # of column -1 and on, to a column that is not there
    nearest[:, columns + 1 :] = columns - 1
    while step := step // 2:
        places = np.arange(step, columns + 1, 2 * step)
        lowest, highest = nearest[:, places - step].ravel(), nearest[:, places + step].ravel()
        asked, tried = ranges(lowest, highest - lowest + 1)
        row, place = np.divmod(asked, len(places))
        distances = squares[row, tried] + np.square(tried - (places[place] - 1))
        least = np.minimum.reduceat(distances, np.searchsorted(asked, np.arange(rows * len(places))))
        _, first = np.unique(asked[best := np.flatnonzero(distances == least[asked])], return_index=True)
        nearest[:, places] = tried[best[first]].reshape(rows, -1)
    return nearest[:, 1 : columns + 1]


_MOST_LINES = 15
_DISTANCES_M = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0)


def contour_lines(corners: FloatArray) -> FloatArray:
    """Return the lines (s, 2, 3) at round heights in triangles (t, 3, 3), m; none in ground that is level."""
    heights = corners[:, :, 2]
    if not len(corners):
        return np.zeros((0, 2, 3))
    low, high = float(heights.min()), float(heights.max())
    distance = next(
        (distance_m for distance_m in _DISTANCES_M if high - low <= _MOST_LINES * distance_m), _DISTANCES_M[-1]
    )
    numbers = np.arange(np.ceil(low / distance), np.floor(high / distance) + 1.0)
    return np.concatenate([np.zeros((0, 2, 3)), *(_lines_at(corners, number * distance) for number in numbers)])


def _lines_at(corners: FloatArray, level_m: float) -> FloatArray:
    """Lines (s, 2, 3) at a height in triangles (t, 3, 3), from one of their sides to another."""
    above = corners[:, :, 2] > level_m
    cut = above.any(axis=1) & ~above.all(axis=1)
    corners, above = corners[cut], above[cut]
    # The corner that is alone on its side of the level comes first.
    alone = np.where(above.sum(axis=1) == 1, above.argmax(axis=1), (~above).argmax(axis=1))
    rows = np.arange(len(corners))
    apex = corners[rows, alone]
    ends = [corners[rows, (alone + step) % 3] for step in (1, 2)]
    shares = [((level_m - apex[:, 2]) / (end[:, 2] - apex[:, 2]))[:, None] for end in ends]
    return np.stack([apex + share * (end - apex) for share, end in zip(shares, ends, strict=True)], axis=1)
