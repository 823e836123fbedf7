"""Symmetric systems of equations with six unknowns a body, which the compiled core factors: `core/src/equations.h`.

The order of elimination is that of QDLDL (B. Stellato, P. Goulart), by approximate minimum degree.
"""

from __future__ import annotations

import ctypes
import weakref
from collections.abc import Sequence

import numpy as np
import qdldl
from scipy.sparse import csc_matrix

from ..arrays import FloatArray, IntArray
from ..core.library import function

_BLOCK = 6

_POINTER = ctypes.c_void_p


class BlockSystem:
    """Equations of bodies, coupled in pairs by c connections, whose numbers change while their pattern does not.

    `first` and `second` (c,) are the bodies of each connection; -1 for one whose motion is known.

    Attributes
    ----------
    address : int
        Where the core has them.
    """

    def __init__(self, body_count: int, first: IntArray, second: IntArray):
        self._count = body_count
        bodies = np.arange(body_count)
        starts, rows, places = self._positions(((bodies, bodies), (first, first), (second, second), (first, second)))
        order = _order(starts, rows)
        new = function("bda_equations_new", *[ctypes.c_int64] * 3, *[_POINTER] * 7, returns=_POINTER)
        arrays = (starts, rows, *places, order)
        address = new(body_count, len(first), len(rows), *(array.ctypes.data for array in arrays))
        if not address:
            raise MemoryError(f"there is no room for the equations of {body_count} bodies")
        self.address = int(address)
        weakref.finalize(self, function("bda_equations_free", _POINTER, returns=None), self.address)

    def assemble(self, of_bodies: FloatArray, connections: IntArray, *blocks: FloatArray) -> None:
        """Take over the numbers of each body (6, 6, b), and what some connections (k,) add, three (6, 6, k).

        A connection adds to its first body, its second, and between them, with rows for the first body.
        """
        own, added = _matrices(of_bodies), _added(blocks)
        call = function("bda_equations_assemble", _POINTER, _POINTER, ctypes.c_int64, _POINTER, _POINTER)
        answer = call(self.address, own.ctypes.data, len(connections), connections.ctypes.data, added.ctypes.data)
        if answer:
            raise ValueError(f"there are no connections {connections} in the equations")

    def factor(self, connections: IntArray | None = None, *blocks: FloatArray) -> None:
        """Factor what was assembled, with what other connections (k,) add; the next time that is forgotten."""
        rows = np.zeros(0, int) if connections is None else connections
        added = _added(blocks) if blocks else np.zeros(0)
        call = function("bda_equations_factor", _POINTER, ctypes.c_int64, _POINTER, _POINTER)
        if call(self.address, len(rows), rows.ctypes.data, added.ctypes.data):
            raise ValueError(f"there are no connections {rows} in the equations")

    def solve(self, right: FloatArray) -> FloatArray:
        """Return the unknowns (6, b) for a right-hand side (6, b)."""
        right, unknowns = np.ascontiguousarray(right), np.empty((_BLOCK, self._count))
        if right.shape != unknowns.shape:
            raise ValueError(f"the right-hand side has shape {right.shape}: expected {unknowns.shape}")
        solve = function("bda_equations_solve", _POINTER, _POINTER, _POINTER, returns=None)
        solve(self.address, right.ctypes.data, unknowns.ctypes.data)
        return unknowns

    def _positions(self, kinds: Sequence[tuple[IntArray, IntArray]]) -> tuple[IntArray, IntArray, list[IntArray]]:
        """Return starts of columns and rows of the upper triangle, and where blocks of each kind belong, (k, 36) each.

        Blocks have rows and columns (k,). The numbers of one that lies below the diagonal belong where its transpose
        does; those of bodies whose motion is known belong nowhere: their position is the one after the last.
        """
        rows, columns = (np.concatenate(ends) for ends in zip(*kinds, strict=True))
        is_known = (rows < 0) | (columns < 0)
        keys = np.where(is_known, 0, np.maximum(rows, columns) * self._count + np.minimum(rows, columns))
        kept, which = np.unique(keys, return_inverse=True)  # column by column, with the diagonal as the last of each
        block_columns, block_rows = np.divmod(kept, self._count)
        in_column = np.bincount(block_columns, minlength=self._count)
        within = np.arange(_BLOCK)
        lengths = _BLOCK * (in_column[:, None] - 1) + within + 1
        starts = np.concatenate(([0], np.cumsum(lengths))).astype(np.int32)
        size = int(starts[-1])
        above = np.arange(len(kept)) - (np.cumsum(in_column) - in_column)[block_columns]
        positions = starts[:-1].reshape(-1, _BLOCK)[block_columns].T + _BLOCK * above + within[:, None, None]
        positions[np.tri(_BLOCK, k=-1, dtype=bool)[..., None] & (block_rows == block_columns)] = size
        indices = np.empty(size + 1, np.int32)
        indices[positions] = (_BLOCK * block_rows + within[:, None])[:, None]
        places = positions[..., which]
        is_below = rows > columns
        places[..., is_below] = np.swapaxes(places[..., is_below], 0, 1)
        places[..., is_known] = size
        ends = np.cumsum([len(of_kind) for of_kind, _ in kinds])[:-1]
        split = np.split(np.moveaxis(places, 2, 0), ends)
        return starts, indices[:-1].copy(), [np.ascontiguousarray(part, np.uint32) for part in split]


def _order(starts: IntArray, rows: IntArray) -> IntArray:
    """Return the order in which unknowns (n,) are eliminated, by the pattern of an upper triangle alone."""
    numbers = np.zeros(len(rows))
    numbers[starts[1:] - 1] = 1.0
    count = len(starts) - 1
    solver = qdldl.Solver(csc_matrix((numbers, rows, starts), shape=(count, count)), upper=True)
    return np.ascontiguousarray(solver.factors()[2], np.int64)


def _added(blocks: Sequence[FloatArray]) -> FloatArray:
    """Return three blocks (6, 6, k) of each connection as (k, 3, 6, 6)."""
    return np.stack([_matrices(block) for block in blocks], axis=1)


def _matrices(blocks: FloatArray) -> FloatArray:
    """Return blocks (6, 6, k) as (k, 6, 6)."""
    return np.ascontiguousarray(np.moveaxis(blocks, 2, 0))
