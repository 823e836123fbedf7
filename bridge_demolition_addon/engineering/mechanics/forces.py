"""Effects of connections on bodies: resultants, and sums of magnitudes."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray, IntArray
from ..geometry.vectors import by_component


class PairSums:
    """Sums over the pairs of n bodies in each of s sub-steps, all at once. `shape` is (s, n).

    The sum of the magnitudes of all forces on a body measures how hard it is held from all sides, where the resultant
    of a body at rest is only its weight.

    `pairs` (k, 2) are bodies, `substeps` (k,) the sub-step of each pair; None where all pairs are in all sub-steps, and
    values are (s, k). `first` and `second` are rows of the pairs' bodies among those (s n,) of all sub-steps.
    """

    def __init__(self, pairs: IntArray, substeps: IntArray | None, shape: tuple[int, int]):
        self.shape = shape
        rows = np.arange(shape[0])[:, None] if substeps is None else substeps
        self.first, self.second = ((shape[1] * rows + bodies).ravel() for bodies in pairs.T)

    def sums(self, values: FloatArray) -> FloatArray:
        """Sums (s, n) of values over the pairs of every body."""
        return self._of(self.first, values) + self._of(self.second, values)

    def differences(self, values: FloatArray) -> FloatArray:
        """Sums (s, n) of values over pairs with a body as the first, less those with it as the second."""
        return self._of(self.first, values) - self._of(self.second, values)

    def resultants(self, forces: FloatArray) -> FloatArray:
        """Vector sums (s, n, 3) of forces (..., 3) on the first body of each pair; the second gets the opposite.

        That is Newton's third law.
        """
        return by_component(*(self.differences(forces[..., axis]) for axis in range(3)))

    def _of(self, rows: IntArray, values: FloatArray) -> FloatArray:
        if not len(rows):
            return np.zeros(self.shape)
        substeps, bodies = self.shape
        return np.bincount(rows, values.ravel(), substeps * bodies).reshape(self.shape)
