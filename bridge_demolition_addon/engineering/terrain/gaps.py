"""Nodes of a grid whose height is not known."""

from __future__ import annotations

import numpy as np

from ..arrays import BoolArray, IntArray
from ..geometry.proximity import ranges


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

    In a row they ascend, so that those of every second node bound those between (A. Aggarwal et al., 1987, Geometric
    applications of a matrix-searching algorithm, Algorithmica 2, 195-208).
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
