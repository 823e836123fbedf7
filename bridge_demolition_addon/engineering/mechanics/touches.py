"""What bodies that touch have taken from each other's motion, and may give back while they do.

Bodies that are pressed together deform a little and spring back, and so do Bullet's: what lies on each other trembles,
and its contacts take energy in one sub-step and return it in the next. A contact makes energy only where it gives more
than it has taken since the bodies touched.
"""

from __future__ import annotations

import itertools

import numpy as np

from ..arrays import FloatArray, IntArray
from .compiled_mechanics import touch_loops

_APART = 3
"""Sub-steps without any work after which bodies have parted; what trembles touches again before."""

_NO_PAIR = np.iinfo(np.int64).max
"""Number after those of all pairs, so that one is found for each."""


class Touches:
    """Accounts of the energy that pairs of bodies have taken since they touched."""

    def __init__(self) -> None:
        self._pairs: IntArray = np.array([_NO_PAIR])  # in ascending order
        self._taken_j = np.zeros(1)
        self._last: IntArray = np.zeros(1, int)  # sub-steps in which they last did work
        self._substep = 0

    def pass_over(self, substeps: int) -> None:
        """Let sub-steps go by in which no pair does work."""
        self._substep += substeps

    def returned(self, pairs: IntArray, work_j: FloatArray, ends: IntArray) -> FloatArray:
        """Return how much of the work (k,) is given back of what was taken before.

        Parameters
        ----------
        pairs : (k,) int
            Numbers of the pairs that touch, each once in a sub-step.
        work_j : (k,) float
            Work on both bodies of a pair, negative where it is taken from them, J.
        ends : (s + 1,) int
            Where the rows of each of s sub-steps begin and end.
        """
        loops = touch_loops()
        returned_j: FloatArray = np.zeros_like(work_j)
        if loops is not None:
            accounts = self._pairs, self._taken_j, self._last
            order = np.lexsort((pairs, np.repeat(np.arange(len(ends) - 1), np.diff(ends))))
            found = loops.returned(pairs, work_j, order, ends, *accounts, self._substep, _APART)
            returned_j, self._pairs, self._taken_j, self._last = found
            self._substep += len(ends) - 1
            return returned_j
        for start, end in itertools.pairwise(ends.tolist()):
            working = start + np.flatnonzero(work_j[start:end])
            if len(working):
                order = working[np.argsort(pairs[working], kind="stable")]
                returned_j[order] = self._book(pairs[order], work_j[order])
            self._substep += 1
        return returned_j

    def _book(self, pairs: IntArray, work_j: FloatArray) -> FloatArray:
        """Book the work of pairs (k,), in ascending order, in one sub-step; return what they give back."""
        touch = self._last >= self._substep - _APART
        rows = np.searchsorted(self._pairs, pairs)
        had_j = np.where((self._pairs[rows] == pairs) & touch[rows], self._taken_j[rows], 0.0)
        touch[rows[self._pairs[rows] == pairs]] = False
        touch[-1] = True
        all_pairs = np.concatenate((pairs, self._pairs[touch]))
        order = np.argsort(all_pairs, kind="stable")
        self._pairs = all_pairs[order]
        self._taken_j = np.concatenate((np.maximum(had_j - work_j, 0.0), self._taken_j[touch]))[order]
        self._last = np.concatenate((np.full(len(pairs), self._substep), self._last[touch]))[order]
        return np.clip(work_j, 0.0, had_j)
