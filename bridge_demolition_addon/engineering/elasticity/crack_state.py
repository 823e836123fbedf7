"""How bars across cracks fare: opening, force, part of their rupture strain, and work that they and the sides take.

All arrays have their components first. What is at corners comes as (4, t), of t cracks.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from .joint_rows import dot_products
from .steel_bars import BarResponse, Bars

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
class CornerState:
    """Bars and sides at the 4 t corners of cracks, in the axes of their first bodies."""

    gaps_m: FloatArray  # (3, 4 t), between the sides
    normals: FloatArray  # (3, 4 t)
    bars: Bars  # all of them, also those that have ruptured
    holds: FloatArray  # (4 t,), 1 where bars hold on, 0 where they have ruptured
    pulls: BarResponse  # of the bars
    forces_n: FloatArray  # (3, 4 t), of bars that hold, across the crack: less along it than along the bars
    slips_m: FloatArray  # (3, 4 t), of the bars, as the sub-step began
    rubbing: Bars
    rubs: BarResponse  # of sides that rub
    rests_m: FloatArray  # (3, 4 t), their slips as the sub-step began
    pressed_n_m: FloatArray  # (4 t,), stiffness of the sides
    elongations_m: FloatArray  # (4 t,), openings at which bars rupture

    def of_cracks(self, rows: IntArray) -> CrackState:
        """Return the state of the cracks (t,) at these corners."""
        bars, pulls = self.bars, self.holds * self.pulls.forces_n
        has_bars = bars.yield_n > 0.0
        closing = np.minimum(dot_products(self.normals, self.gaps_m), 0.0)
        stored = 0.5 * (
            _stored(pulls, bars) + _stored(self.rubs.forces_n, self.rubbing) + self.pressed_n_m * closing * closing
        )
        openings = np.where(has_bars * self.holds > 0.0, np.sqrt(dot_products(self.gaps_m, self.gaps_m)), 0.0)
        used = openings / self.elongations_m
        ruptured = bars.yield_n * ((self.holds == 0.0) | (used > 1.0))
        whole, resultants = _of_corners(bars.yield_n).sum(axis=0), _of_corners(self.forces_n).sum(axis=1)
        return CrackState(
            rows=rows,
            stored_j=_of_corners(stored).sum(axis=0),
            yielding_j=_of_corners(dot_products(pulls, self.pulls.slips_m - self.slips_m)).sum(axis=0),
            rubbing_j=_of_corners(dot_products(self.rubs.forces_n, self.rubs.slips_m - self.rests_m)).sum(axis=0),
            openings_m=_of_corners(openings).max(axis=0),
            forces_n=np.sqrt(dot_products(resultants, resultants)),
            yield_shares=_of_corners(_shares(np.sqrt(dot_products(pulls, pulls)), bars.yield_n)).max(axis=0),
            rupture_shares=np.minimum(_of_corners(used).max(axis=0), 1.0),
            ruptured_shares=_shares(_of_corners(ruptured).sum(axis=0), whole),
        )


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


def _stored(forces_n: FloatArray, bars: Bars) -> FloatArray:
    """Twice the energy (b,) that bars give back under forces (3, b)."""
    resists = bars.stiffness_n_m > 0.0
    doubled: FloatArray = np.divide(
        dot_products(forces_n, forces_n), bars.stiffness_n_m, out=np.zeros(len(bars.yield_n)), where=resists
    )
    return doubled


def _shares(values: FloatArray, whole: FloatArray) -> FloatArray:
    shares: FloatArray = np.divide(values, whole, out=np.zeros_like(values), where=whole > 0.0)
    return shares


def _of_corners(values: FloatArray) -> FloatArray:
    """Values (…, 4 t) as (…, 4, t)."""
    return values.reshape(*values.shape[:-1], 4, -1)
