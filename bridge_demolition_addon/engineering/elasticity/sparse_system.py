"""Symmetric systems of equations with six unknowns a body, solved the same on every processor.

QDLDL (B. Stellato, P. Goulart) factors as LDLᵀ in plain C: one multiplication and one addition after another. LAPACK
and the solvers of scipy go through BLAS, which rounds by processor.
"""

from __future__ import annotations

import numpy as np
import qdldl
from scipy.sparse import csc_matrix

from ..arrays import FloatArray, IntArray

_BLOCK = 6


class BlockSystem:
    """Equations of bodies, coupled in pairs by c connections, whose numbers change while their pattern does not.

    `first` and `second` (c,) are the bodies of each connection; -1 for one whose motion is known.
    """

    def __init__(self, body_count: int, first: IntArray, second: IntArray):
        self._count = body_count
        self._has_first, self._has_second = first >= 0, second >= 0
        self._has_both = self._has_first & self._has_second
        self._is_turned = (first > second)[self._has_both]
        blocks = np.concatenate(
            (
                np.repeat(np.arange(body_count)[:, None], 2, axis=1),
                np.repeat(first[self._has_first, None], 2, axis=1),
                np.repeat(second[self._has_second, None], 2, axis=1),
                np.sort(np.stack((first, second), axis=1)[self._has_both], axis=1),
            )
        )
        self._matrix: csc_matrix | None = None
        self._solver: qdldl.Solver | None = None
        self._find_positions(blocks)

    def factor(self, of_bodies: FloatArray, first: FloatArray, second: FloatArray, between: FloatArray) -> None:
        """Take over and factor the numbers of each body (6, 6, b), and what each connection adds (6, 6, c).

        A connection adds to its `first` and `second` body, and `between` them, with rows for the first body.
        """
        both = between[..., self._has_both]
        both = np.where(self._is_turned, np.swapaxes(both, 0, 1), both)
        parts = (of_bodies, first[..., self._has_first], second[..., self._has_second], both)
        values = np.concatenate(parts, axis=2).reshape(-1)
        data = np.bincount(self._places, values, self._size + 1)[: self._size]
        if self._matrix is None or self._solver is None:
            self._matrix = csc_matrix((data, self._indices, self._starts), shape=(_BLOCK * self._count,) * 2)
            self._solver = qdldl.Solver(self._matrix, upper=True)
        else:
            self._matrix.data = data  # scipy takes longer to make a matrix than QDLDL to factor a small one
            self._solver.update(self._matrix, upper=True)

    def solve(self, right: FloatArray) -> FloatArray:
        """Return the unknowns (6, b) for a right-hand side (6, b)."""
        assert self._solver is not None, "numbers come first, by `factor`"
        unknowns: FloatArray = self._solver.solve(np.ascontiguousarray(right.T).reshape(-1))
        return unknowns.reshape(-1, _BLOCK).T

    def _find_positions(self, blocks: FloatArray) -> None:
        """Find where each number of blocks (k, 2) belongs in the upper triangle, column by column."""
        keys = blocks[:, 1] * self._count + blocks[:, 0]
        kept, which = np.unique(keys, return_inverse=True)
        columns, rows = np.divmod(kept, self._count)
        row, column = np.meshgrid(np.arange(_BLOCK), np.arange(_BLOCK), indexing="ij")
        all_rows = _BLOCK * rows[:, None, None] + row
        all_columns = _BLOCK * columns[:, None, None] + column
        upper = all_rows <= all_columns
        order = np.lexsort((all_rows[upper], all_columns[upper]))
        self._size = len(order)
        positions = np.full(upper.shape, self._size)
        sorted_positions = np.empty(self._size, int)
        sorted_positions[order] = np.arange(self._size)
        positions[upper] = sorted_positions
        self._places = np.moveaxis(positions[which], 0, 2).reshape(-1)
        self._indices = all_rows[upper][order].astype(np.int32)
        per_column = np.bincount(all_columns[upper], minlength=_BLOCK * self._count)
        self._starts = np.concatenate(([0], np.cumsum(per_column))).astype(np.int32)
