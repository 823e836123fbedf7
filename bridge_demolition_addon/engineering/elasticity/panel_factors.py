"""Factors LDLᵀ of equations by compiled loops, in panels of six unknowns; in the order of QDLDL, with its bits."""

from __future__ import annotations

from functools import cache
from types import ModuleType
from typing import Any

import numpy as np
import qdldl
from scipy.sparse import csc_matrix, triu

from ..arrays import FloatArray, IntArray
from ..compilation import where_compiled


class PanelFactors:
    """Equations with numbers in a pattern, an upper triangle by columns, in the order (n,) that QDLDL has found.

    What follows from the pattern is found once, which takes as long as it takes to factor.
    """

    def __init__(self, loops: Any, starts: IntArray, rows: IntArray, order: IntArray):
        self._loops, self._order = loops, order
        entry_starts, entry_rows, sources = loops.permuted(starts, rows, order)
        tree = loops.elimination_tree(entry_starts, entry_rows)
        columns = loops.columns_of_rows(entry_starts, entry_rows, *tree)
        panel_starts = loops.panels(*tree, *columns)
        stretches = loops.stretches(panel_starts, *columns)
        below = loops.rows_below(panel_starts, *stretches)
        self._entries, self._stretches = (entry_starts, entry_rows, sources), stretches
        self._panels = panel_starts, *below
        panel_count, row_count = len(panel_starts) - 1, len(below[1])
        self._numbers = np.zeros((panel_count, 6, 6)), np.zeros((row_count, 6)), np.zeros(len(order))

    def factor(self, data: FloatArray) -> None:
        """Factor equations with the numbers of the pattern."""
        panel_starts, *below = self._panels
        self._loops.factor(data, *self._entries, panel_starts, *self._stretches, *below, *self._numbers)

    def solve(self, right: FloatArray) -> FloatArray:
        """Return the unknowns (6, b) for a right-hand side (6, b)."""
        unknowns: FloatArray = self._loops.solved(right, self._order, *self._panels, *self._numbers)
        return unknowns


@where_compiled
def factor_loops() -> ModuleType:
    """Loops that factor equations and solve them."""
    from . import factor_loops

    return factor_loops


@cache
def loops_like_qdldl() -> Any | None:
    """Return the loops where they give the bits of QDLDL, which some compilers let multiply and add without rounding.

    Those for ARM do. There all is left to QDLDL, so that results are the same without Numba.
    """
    loops = factor_loops()
    if loops is None:
        return None
    shapes, right = np.random.default_rng(0).normal(size=(12, 24)), np.linspace(0.1, 1.2, 12)
    matrix = triu(csc_matrix(shapes[:, :12] * shapes[:, :12].T + 40.0 * np.eye(12)), format="csc")
    solver = qdldl.Solver(matrix, upper=True)
    factors = PanelFactors(loops, matrix.indptr, matrix.indices, np.asarray(solver.factors()[2]))
    factors.factor(matrix.data)
    found = factors.solve(right.reshape(2, 6).T).T.ravel()
    return loops if np.array_equal(found, solver.solve(right)) else None
