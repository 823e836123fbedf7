"""Symmetric systems of equations with six unknowns a body, solved the same on every x86-64 processor.

QDLDL (B. Stellato, P. Goulart) factors as LDLᵀ in plain C: one multiplication and one addition after another, which its
wheels for ARM join. LAPACK and the solvers of scipy go through BLAS, which rounds by processor. Equations of which only
the numbers change are factored again by compiled loops, with the same bits.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import qdldl
from scipy.sparse import csc_matrix

from ..arrays import FloatArray, IntArray
from .compiled_joints import equation_loops
from .panel_factors import PanelFactors, loops_like_qdldl

_BLOCK = 6


class BlockSystem:
    """Equations of bodies, coupled in pairs by c connections, whose numbers change while their pattern does not.

    `first` and `second` (c,) are the bodies of each connection; -1 for one whose motion is known.
    """

    def __init__(self, body_count: int, first: IntArray, second: IntArray):
        self._count = body_count
        self._matrix: csc_matrix | None = None
        self._solver: qdldl.Solver | None = None
        self._panels: PanelFactors | None = None  # once numbers have changed
        bodies = np.arange(body_count)
        self._find_positions(((bodies, bodies), (first, first), (second, second), (first, second)))
        self._assembled = np.zeros(self._size)

    def assemble(
        self, of_bodies: FloatArray, connections: IntArray, *blocks: FloatArray, chosen: IntArray | None = None
    ) -> None:
        """Take over the numbers of each body (6, 6, b), and what some connections (k,) add, three (6, 6, k).

        A connection adds to its first body, its second, and between them, with rows for the first body. Where blocks
        are of more connections (6, 6, m), `chosen` (k,) are those of these.
        """
        bodies = np.arange(self._count)
        which = np.arange(len(connections)) if chosen is None else chosen
        terms = [
            (places, connections, values, which) for places, values in zip(self._of_connections, blocks, strict=True)
        ]
        self._assembled = self._summed([(self._of_bodies, bodies, of_bodies, bodies), *terms])

    def factor(self, connections: IntArray | None = None, *blocks: FloatArray, chosen: IntArray | None = None) -> None:
        """Factor what was assembled, with what other connections (k,) add; the next time that is forgotten."""
        data = self._assembled
        if connections is not None and len(connections):
            which = np.arange(len(connections)) if chosen is None else chosen
            data = data + self._summed(
                [
                    (places, connections, values, which)
                    for places, values in zip(self._of_connections, blocks, strict=True)
                ]
            )
        if self._matrix is None or self._solver is None:
            self._matrix = csc_matrix((data, self._indices, self._starts), shape=(_BLOCK * self._count,) * 2)
            self._solver = qdldl.Solver(self._matrix, upper=True)
        elif (loops := loops_like_qdldl()) is None:
            self._matrix.data = data  # scipy takes longer to make a matrix than QDLDL to factor a small one
            self._solver.update(self._matrix, upper=True)
        else:
            if self._panels is None:
                order = np.asarray(self._solver.factors()[2])
                self._panels = PanelFactors(loops, self._starts, self._indices, order)
            self._panels.factor(data)

    def solve(self, right: FloatArray) -> FloatArray:
        """Return the unknowns (6, b) for a right-hand side (6, b)."""
        if self._panels is not None:
            return self._panels.solve(right)
        assert self._solver is not None, "numbers come first, by `factor`"
        unknowns: FloatArray = self._solver.solve(np.ascontiguousarray(right.T).reshape(-1))
        return unknowns.reshape(-1, _BLOCK).T

    def _summed(self, terms: Sequence[tuple[IntArray, IntArray, FloatArray, IntArray]]) -> FloatArray:
        """Return numbers of the upper triangle: terms have places and which of them (k,), blocks and which of them."""
        loops = equation_loops()
        if loops is not None:
            totals = np.zeros(self._size + 1)
            for places, *term in terms:
                loops.add(totals, places, *term, places is not self._of_connections[-1])
            return totals[: self._size]
        places = np.concatenate([places[..., at].reshape(-1) for places, at, _, _ in terms])
        values = np.concatenate([blocks[..., chosen].reshape(-1) for _, _, blocks, chosen in terms])
        return np.bincount(places, values, self._size + 1)[: self._size]

    def _find_positions(self, kinds: Sequence[tuple[IntArray, IntArray]]) -> None:
        """Find where each number of blocks with rows and columns (k,) belongs in the upper triangle, column by column.

        The numbers of a block that lies below the diagonal belong where its transpose does; those of bodies whose
        motion is known belong nowhere: their position is the one after the last.
        """
        rows, columns = (np.concatenate(ends) for ends in zip(*kinds, strict=True))
        is_known = (rows < 0) | (columns < 0)
        keys = np.where(is_known, 0, np.maximum(rows, columns) * self._count + np.minimum(rows, columns))
        kept, which = np.unique(keys, return_inverse=True)  # column by column, with the diagonal as the last of each
        block_columns, block_rows = np.divmod(kept, self._count)
        in_column = np.bincount(block_columns, minlength=self._count)
        within = np.arange(_BLOCK)
        lengths = _BLOCK * (in_column[:, None] - 1) + within + 1
        self._starts = np.concatenate(([0], np.cumsum(lengths))).astype(np.int32)
        self._size = int(self._starts[-1])
        above = np.arange(len(kept)) - (np.cumsum(in_column) - in_column)[block_columns]
        starts = self._starts[:-1].reshape(-1, _BLOCK)[block_columns].T + _BLOCK * above
        positions = starts + within[:, None, None]
        positions[np.tri(_BLOCK, k=-1, dtype=bool)[..., None] & (block_rows == block_columns)] = self._size
        indices = np.empty(self._size + 1, np.int32)
        indices[positions] = (_BLOCK * block_rows + within[:, None])[:, None]
        self._indices = indices[:-1]
        places = positions[..., which]
        is_below = rows > columns
        places[..., is_below] = np.swapaxes(places[..., is_below], 0, 1)
        places[..., is_known] = self._size
        ends = np.cumsum([len(of_kind) for of_kind, _ in kinds])[:-1]
        split = np.split(places, ends, axis=2)
        # Without a sign, so that loops need not look for places before the first.
        self._of_bodies, *self._of_connections = (np.ascontiguousarray(part, np.uint32) for part in split)
