"""Guesses of forces that are not proportional to motion, followed in a sub-step until they agree (Newton).

The equations hold forces that are linear about a guess of how far gaps open. The motion that solves them is the next
guess. On the way from one to the other, the forces that are in balance with all else change evenly, so that the slope
of the energy is the work of what the gaps resist beyond these. Each part of the structure goes as far as its slope is
below 0. The energy is convex: so each guess takes energy off, and guesses end (J. Nocedal and S. J. Wright, 2006,
Numerical optimization, chapter 3).

All arrays have their components first.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray

_MOST_SECANTS = 12
_FLAT = 0.01
"""Slope of the energy on the way from one guess to the next, by that at its beginning, which is taken for none."""


class GuessedForces(ABC):
    """Forces across q gaps of c connections, linear about a guess of how far the gaps open in a sub-step.

    `rows` (c,) are the numbers of the connections, `of_gaps` (q,) which of these each gap belongs to.
    """

    def __init__(self, rows: IntArray, of_gaps: IntArray):
        self.rows, self._of_gaps = rows, of_gaps
        self._guess: tuple[FloatArray, FloatArray] | None = None
        self._next: tuple[FloatArray, FloatArray] | None = None

    @property
    def is_first(self) -> bool:
        """Whether there was no guess before the next one: then there is no way to it."""
        return self._guess is None

    def take(self, velocities: FloatArray) -> BoolArray:
        """Take over the motion that solves the equations, (6, n); return which connections (c,) it does not agree with.

        It agrees where the gaps resist the forces that were guessed.
        """
        moved = self._moved(velocities)
        guessed = self._linear(moved)
        self._next = moved, guessed
        off = np.zeros(len(self.rows), bool)
        off[self._of_gaps[(abs(self._resisted(moved) - guessed) > self._slack()).any(axis=0)]] = True
        return off

    def slopes(self, shares: FloatArray) -> FloatArray:
        """Return the slopes (c,) of the energy at shares (c,) of the way to the next guess."""
        assert self._guess is not None and self._next is not None, "there is a way from the second guess on"
        moved, guessed = self._on_the_way(shares)
        work = (self._resisted(moved) - guessed) * (self._next[0] - self._guess[0])
        return np.bincount(self._of_gaps, work.sum(axis=0), len(self.rows))

    def go(self, shares: FloatArray) -> None:
        """Take forces for linear about the guess at shares (c,) of the way; 0 keeps those that agreed."""
        if self._guess is None:
            assert self._next is not None
            self._guess = self._next
        else:
            self._guess = self._on_the_way(shares)
        self._begin_at(self._guess[0])

    def _on_the_way(self, shares: FloatArray) -> tuple[FloatArray, FloatArray]:
        """How far gaps have opened (d, q), and forces that are in balance with all else."""
        assert self._guess is not None and self._next is not None
        share = shares[self._of_gaps]
        (moved, guessed), (next_moved, next_guessed) = self._guess, self._next
        return moved + share * (next_moved - moved), guessed + share * (next_guessed - guessed)

    @abstractmethod
    def changed(self) -> BoolArray:
        """Return whether each of the connections (c,) has other tangents than its equations."""

    @abstractmethod
    def blocks(self, chosen: IntArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return what some (k,) add to the equations of their first and second bodies, and between, (6, 6, k)."""

    @abstractmethod
    def loads(self, velocities: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the impulses (6, c) on the first and second bodies, with velocities (6, n) then."""

    @abstractmethod
    def of_bodies(self, loads: tuple[FloatArray, FloatArray], count: int) -> FloatArray:
        """Return the sums (6, n) of loads (6, c) on the first and on the second bodies, for n bodies."""

    @abstractmethod
    def _moved(self, velocities: FloatArray) -> FloatArray:
        """How far gaps open in the sub-step (d, q), by velocities (6, n)."""

    @abstractmethod
    def _resisted(self, moved: FloatArray) -> FloatArray:
        """Forces (d, q) that pull the sides of gaps together which have opened further (d, q)."""

    @abstractmethod
    def _linear(self, moved: FloatArray) -> FloatArray:
        """The same, linear about the guess."""

    @abstractmethod
    def _begin_at(self, moved: FloatArray) -> None:
        """Take forces for linear about gaps that have opened further (d, q)."""

    @abstractmethod
    def _slack(self) -> FloatArray:
        """Errors of forces (q,) that count as none."""


def next_shares(terms: Sequence[GuessedForces], parts: Sequence[IntArray], are_off: BoolArray) -> FloatArray:
    """Return how far each of p parts goes on its way to the next guess: 0 where it is not off, (p,).

    `parts` are the numbers of the parts of each term's connections.
    """
    count = len(are_off)

    def slope(shares: FloatArray) -> FloatArray:
        total = np.zeros(count)
        for term, part in zip(terms, parts, strict=True):
            total += np.bincount(part, term.slopes(shares[part]), count)
        return total

    if any(term.is_first for term in terms):
        return are_off.astype(float)
    return np.where(are_off, _zeros_of(slope, are_off), 0.0)


def _zeros_of(slope: Callable[[FloatArray], FloatArray], are_sought: BoolArray) -> FloatArray:
    """Return where each of p slopes that grow becomes 0, from below 0 at 0 on; at most 1.

    M. Dowell and P. Jarratt (1971), A modified regula falsi method for computing the root of an equation, BIT 11, for
    the Illinois method.
    """
    low, high = np.zeros(len(are_sought)), np.ones(len(are_sought))
    at_low, at_high = slope(low), slope(high)
    flat = _FLAT * abs(at_low)
    seek = are_sought & (at_low < 0.0) & (at_high > flat)
    for _ in range(_MOST_SECANTS):
        if not seek.any():
            break
        share = high.copy()
        share[seek] = ((low * at_high - high * at_low)[seek]) / (at_high - at_low)[seek]
        at_share = slope(share)
        is_flat, is_low = seek & (abs(at_share) <= flat), seek & (at_share < -flat)
        high[is_flat] = share[is_flat]
        low[is_low], at_low[is_low], at_high[is_low] = share[is_low], at_share[is_low], 0.5 * at_high[is_low]
        is_high = seek & (at_share > flat)
        high[is_high], at_high[is_high], at_low[is_high] = share[is_high], at_share[is_high], 0.5 * at_low[is_high]
        seek &= ~is_flat
    return high
