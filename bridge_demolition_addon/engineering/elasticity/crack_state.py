"""How bars across cracks fare: opening, force, part of their rupture strain, and work that they and the sides take.

All arrays have their components first.

Bars pull along themselves, and less across themselves, as dowels. The sides press on each other where the gap is
closed, and rub on each other as far as they are pressed.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from .joint_rows import dot_products

AT_YIELD = 1.0 - 1e-6
"""Part of the yield force from which on bars yield, but for rounding."""

ALL_RUPTURED = 1.0 - 1e-6
"""Part of the bars of a crack from which on all of them have ruptured, but for rounding."""

BARS_HOLD, BARS_YIELDED = 1.0, 2.0
"""States of the bars of a crack: they hold, and they hold and have yielded."""


@dataclass(frozen=True, slots=True, eq=False)
class CrackState:
    """State of t cracks after a sub-step, and the work in it."""

    rows: IntArray  # (t,), connections that they have replaced
    stored_j: FloatArray  # (t,), what bars and pressed sides would give back
    yielding_j: FloatArray  # (t,), work in the sub-step of bars that yielded
    rubbing_j: FloatArray  # (t,), and of sides that slid on each other
    openings_m: FloatArray  # (t,), largest distance of the sides at a corner where bars hold
    forces_n: FloatArray  # (t,), resultant of all bars
    yield_shares: FloatArray  # (t,), largest force at a corner by that at which its bars yield
    rupture_shares: FloatArray  # (t,), largest opening by that at which bars rupture; 1 where they do
    ruptured_shares: FloatArray  # (t,), part of the bars, by force, that has ruptured


@dataclass(frozen=True, slots=True, eq=False)
class FrameCracks:
    """Bars across t cracks over one frame: what was largest in any of its sub-steps."""

    rows: IntArray  # (t,), connections, ascending
    openings_m: FloatArray  # (t,), as in `CrackState`, also below
    forces_n: FloatArray
    yield_shares: FloatArray
    rupture_shares: FloatArray
    ruptured_shares: FloatArray

    @classmethod
    def none(cls) -> FrameCracks:
        """Return those of a frame without cracks."""
        return cls(np.zeros(0, int), *np.zeros((len(fields(cls)) - 1, 0)))

    def only(self, which: BoolArray) -> FrameCracks:
        """Return some of them (t,)."""
        return FrameCracks(*(getattr(self, item.name)[which] for item in fields(self)))

    def use_of_bodies(self, pairs: IntArray, count: int) -> FloatArray:
        """Return the largest part of their rupture strain (n,) that bars use at n bodies, of pairs (m, 2) of these."""
        use = np.zeros(count)
        for bodies in pairs[self.rows].T:
            np.maximum.at(use, bodies, self.rupture_shares)
        return use


_LARGEST = tuple(item.name for item in fields(FrameCracks))[1:]


class CrackAccumulator:
    """Keeps what is largest over the sub-steps of a frame at each of m connections, of those that `have_bars` (m,).

    Attributes
    ----------
    bars : (m,) float
        As the last frame ended: `BARS_HOLD` where a crack is held by bars, `BARS_YIELDED` where these have yielded by
        then, in part ruptured ones among them, and 0 of all other connections.
    """

    def __init__(self, have_bars: BoolArray):
        count = len(have_bars)
        self._have_bars = have_bars
        self._largest = np.zeros((len(_LARGEST), count))
        self._seen, self._have_yielded = np.zeros((2, count), bool)
        self.bars = np.zeros(count)

    def add(self, state: CrackState) -> None:
        """Take over the state after a sub-step."""
        self._seen[state.rows] = self._have_bars[state.rows]
        for largest, name in zip(self._largest, _LARGEST, strict=True):
            largest[state.rows] = np.maximum(largest[state.rows], getattr(state, name))

    def finish(self) -> FrameCracks:
        """Return what was largest in the frame; the next one begins."""
        rows = np.flatnonzero(self._seen)
        frame = FrameCracks(rows, *self._largest[:, rows])
        self._have_yielded[rows] |= frame.yield_shares >= AT_YIELD
        states = np.where(self._have_yielded[rows], BARS_YIELDED, BARS_HOLD)
        self.bars = np.zeros(len(self._seen))
        self.bars[rows] = np.where(frame.ruptured_shares < ALL_RUPTURED, states, 0.0)
        self._largest[:], self._seen[:] = 0.0, False
        return frame


DOWEL_SHARE = float(0.9 * np.sqrt(35.0 / 500.0))
"""Force across themselves that bars resist as dowels, by that along them: 0.9 √(f_c / f_y) for rough cracks, of C35/45
and B500 (fib Model Code 2010, equation 7.3-51 and table 7.3-2). Both together are on an ellipse, as normal and shear
stress by von Mises' criterion.
"""

FRICTION = 0.7
"""Friction of the rough sides of a crack: EN 1992-1-1:2004, 6.2.5 (2), and fib Model Code 2010, table 7.3-2."""

SHEARED = 0.4
"""Stiffness against sliding of sides that do not slip, by that against pressing: shear over normal stiffness of
concrete, G / E."""


def stretches_of_bars(gaps_m: FloatArray, directions: FloatArray) -> FloatArray:
    """Stretches of bars (3, b) with directions (3, b) by gaps (3, b): less across the bars, as dowels."""
    along = dot_products(gaps_m, directions)
    stretches: FloatArray = DOWEL_SHARE * gaps_m + (1.0 - DOWEL_SHARE) * along * directions
    return stretches
