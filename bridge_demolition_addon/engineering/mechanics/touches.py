"""What bodies that touch have taken from each other's motion, and may give back while they do.

Bodies that are pressed together deform a little and spring back, and so do Bullet's: what lies on each other trembles,
and its contacts take energy in one sub-step and return it in the next. A contact makes energy only where it gives more
than it has taken since the bodies touched.
"""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray, IntArray
from ..core.calls import call
from ..core.structs import Count, Doubles, Indices, Struct, WrittenDoubles, WrittenIndices

APART = 3
"""Sub-steps without any work after which bodies have parted; what trembles touches again before."""

_NO_PAIR = np.iinfo(np.int64).max
"""Number after those of all pairs, so that one is found for each."""


class CoreTouches(Struct):
    """Accounts of pairs that touch, and their work in sub-steps: `bda_touches`."""

    _fields_ = (
        *((name, Count) for name in ("count", "substeps", "substep", "apart")),
        ("pairs", Indices),
        ("work", Doubles),
        ("order", Indices),
        ("ends", Indices),
        ("returned", WrittenDoubles),
        *((name, Count) for name in ("room", "known", "side")),
        ("all_pairs", WrittenIndices),
        ("taken", WrittenDoubles),
        ("last", WrittenIndices),
    )


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

    def returned_energies(self, pairs: IntArray, work_j: FloatArray, ends: IntArray) -> FloatArray:
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
        count, substeps, known = len(work_j), len(ends) - 1, len(self._pairs)
        room = count + known + 1
        all_pairs, taken_j, last = np.empty((2, room), int), np.empty((2, room)), np.empty((2, room), int)
        all_pairs[0, :known], taken_j[0, :known], last[0, :known] = self._pairs, self._taken_j, self._last
        returned_j: FloatArray = np.zeros_like(work_j)
        touches = CoreTouches(count=count, substeps=substeps, substep=self._substep, apart=APART)
        touches.room, touches.known = room, known
        touches.take(
            pairs=(pairs, count),
            work=(work_j, count),
            order=(np.lexsort((pairs, np.repeat(np.arange(substeps), np.diff(ends)))), count),
            ends=(ends, substeps + 1),
            returned=(returned_j, count),
            all_pairs=(all_pairs, 2 * room),
            taken=(taken_j, 2 * room),
            last=(last, 2 * room),
        )
        call("bda_book_touches", touches)
        kept = touches.side, slice(touches.known)
        self._pairs, self._taken_j, self._last = all_pairs[kept].copy(), taken_j[kept].copy(), last[kept].copy()
        self._substep += substeps
        return returned_j
