"""Bearings: springs at the pads between two bodies, at rest and in a sub-step, in the equations of the structure.

Each pad is a row of springs. A spring presses what lies above upwards, and pulls only where the bearing holds against
uplift. Sideways it holds by its stiffness, up to friction times the pressing force where the bearing slides (C. A. de
Coulomb 1785), and else as long as the bearing presses anywhere. Bending of the body above reaches the one below only by
the arms of the springs: in one line across the road it turns freely about that.

In a sub-step (`elasticity.springs`) friction counts by the pressing force that was solved in the sub-step before, and
at rest by that at rest. Positions do not say it: at the stiffness of a pad their rounding is a good part of the weight,
and where a deck slides on a pier that rotates, both move by more than the pad deforms in a sub-step.

All arrays have their components first, except places.
"""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..core.calls import call
from ..core.structs import Count, Doubles, Flags, Indices, Struct, WrittenDoubles, WrittenFlags
from .joint_rows import turned, turned_back
from .springs import (
    PressedSprings,
    SpringPositions,
    SpringsOfConnections,
    loads_of_springs,
    stiffness_of_springs,
)
from .substep import Places, Term

_LIFTED_M = 0.02
"""Opening from which on pins and guides of a bearing that holds no uplift are out of their holes."""

_LARGEST_TURN = 0.05
"""Angle, rad, between what lies above and below, from which on edges carry and no pads. Bearings are made for up to
0.02 (EN 1337-3, -5); the springs have the positions of small angles."""


_OVERTURNED = 2.0
"""1 + 2 cos of the angle, 60°, from which on a bearing that holds uplift has been wrung off: from 90° on, angles of
Bullet's own constraint are not defined."""


@dataclass(frozen=True, slots=True, eq=False)
class PadSprings:
    """p springs of the pads of bearings, in c connections between two bodies each, of which the first lies above."""

    rows: IntArray  # (c,), the connections, in ascending order
    parts: IntArray  # (p,), which of these each spring is in, in ascending order
    places_m: FloatArray  # (p, 3), positions as the bridge was built
    vertical_n_m: FloatArray  # (p,), stiffness
    sideways_n_m: FloatArray  # (p, 2), stiffness along x and y
    friction: FloatArray  # (c,), largest force sideways by the pressing force; infinite where it does not slide
    pulls: BoolArray  # (c,), whether it holds what is lifted
    travel_m: FloatArray  # (c,), displacement at which the two bodies have left each other
    bearings: IntArray  # (c,), bearing of each connection
    breaking_n: FloatArray  # (c,), force sideways, or of uplift, that breaks the whole bearing

    def among(self, kept: BoolArray) -> PadSprings:
        """Return the springs of the connections that are kept of all (m,), by their numbers among these."""
        stays = kept[self.rows]
        of_springs = stays[self.parts]
        return PadSprings(
            rows=(np.cumsum(kept) - 1)[self.rows[stays]],
            parts=(np.cumsum(stays) - 1)[self.parts[of_springs]],
            places_m=self.places_m[of_springs],
            vertical_n_m=self.vertical_n_m[of_springs],
            sideways_n_m=self.sideways_n_m[of_springs],
            friction=self.friction[stays],
            pulls=self.pulls[stays],
            travel_m=self.travel_m[stays],
            bearings=self.bearings[stays],
            breaking_n=self.breaking_n[stays],
        )

    def utilisations(self, forces_n: FloatArray, left: FloatArray) -> FloatArray:
        """Return the part (c,) of its breaking force that the bearing of each connection carries.

        Forces (3, c) are on what lies above, `left` (c,) is the part of its strength that each connection has.
        """
        count = int(self.bearings.max(initial=-1)) + 1
        x, y, z = (np.bincount(self.bearings, force, count)[self.bearings] for force in forces_n)
        can_break = np.isfinite(self.breaking_n)
        limit = np.multiply(self.breaking_n, left, out=np.full_like(self.breaking_n, np.inf), where=can_break)
        used: FloatArray = np.maximum(np.sqrt(x * x + y * y), -z)
        return np.divide(used, limit, out=np.full_like(used, np.inf), where=limit > 0.0)

    def sideways_of_connections(self) -> FloatArray:
        """Return the stiffness (c, 2) of each connection along x and y, N/m."""
        return np.stack([np.bincount(self.parts, k, len(self.rows)) for k in self.sideways_n_m.T], axis=1)

    def middles_m(self) -> FloatArray:
        """Return the middles (c, 3) of the springs of each connection."""
        counts = np.bincount(self.parts, minlength=len(self.rows))
        sums = [np.bincount(self.parts, values, len(self.rows)) for values in self.places_m.T]
        return np.stack([values / counts for values in sums], axis=1)

    def followed_by(self, other: PadSprings) -> PadSprings:
        """Return these springs with others, in connections that come after theirs."""
        columns = {item.name: [getattr(self, item.name), getattr(other, item.name)] for item in fields(self)}
        columns["parts"][1] = columns["parts"][1] + len(self.rows)
        return PadSprings(**{name: np.concatenate(pair) for name, pair in columns.items()})


class CorePads(Struct):
    """Bearings as the core takes them: `bda_pads` in `core/src/springs.h`."""

    _fields_ = (
        ("bearings", Count),
        *((name, Indices) for name in ("numbers", "first", "second")),
        ("pulls", Flags),
        *((name, Doubles) for name in ("travel", "breaking", "built_turns")),
        *((name, ctypes.c_double) for name in ("lifted", "least_cosines", "overturned")),
        *((name, WrittenDoubles) for name in ("pressed", "forces", "whole")),
        ("gone", WrittenFlags),
    )


class Bearings(SpringsOfConnections):
    """All bearings of a structure of n bodies, which has connections between bodies `first` and `second` (m,).

    `above` (c,) are the bodies that lie above in the connections of the springs. Positions (3, n) and rotations
    (3, 3, n) are those of the bridge as it was built.
    """

    def __init__(
        self,
        springs: PadSprings,
        first: IntArray,
        second: IntArray,
        above: IntArray,
        positions_m: FloatArray,
        rotations: FloatArray,
    ):
        self._springs = springs
        of, ends = springs.parts, (first[springs.rows], second[springs.rows])
        positions = SpringPositions.built(of, springs.places_m, ends, above, positions_m, rotations)
        self._above, self._ends = above, ends
        self._built_turns = self._turns(rotations)
        self._middles = turned_back(rotations[..., above], springs.middles_m().T - positions_m[:, above])
        law = PressedSprings(
            springs.vertical_n_m,
            springs.sideways_n_m.T.copy(),
            np.full(len(of), np.inf),
            springs.friction[of],
            springs.pulls[of],
            np.zeros(len(of)),
        )
        super().__init__(springs.rows, positions, law)
        self._pressed_n = np.full(len(of), np.nan)
        self._pads: CorePads | None = None

    def __getstate__(self) -> dict[str, object]:
        """Return what a copy has."""
        return super().__getstate__() | {"_pads": None}

    def update_plastic_state(self, positions_m: FloatArray, rotations: FloatArray) -> None:
        """Take over, before a sub-step, how far springs have slid, and which bodies have left each other."""
        call("bda_pads_settle", self.core, self.core_pads, Places.of(positions_m, rotations))

    def failed(self, intact: BoolArray, left: FloatArray) -> IntArray:
        """Return which connections (k,) of those (m,) that are intact break, as it settled last.

        A connection breaks alone where its bodies have left each other, all of a bearing by its force; `left` (m,) is
        the part of its strength that each has.
        """
        failed, all_of_them = np.empty(len(self.rows), bool), Flags.checked("intact", intact, len(left))
        if len(self.rows) and not self.rows.max() < len(left):
            raise ValueError(f"bearings are in place of connection {self.rows.max()} of {len(left)}")
        left = Doubles.checked("left", left, len(left))
        call("bda_pads_failed", self.core, self.core_pads, self.rows, all_of_them, left, failed)
        return self.rows[failed]

    def diagonal(self) -> FloatArray:
        """Return the stiffness (6, c) along x, y and z, and about these, of connections that are pressed all over."""
        law, springs = self._law, self._springs
        x, y, _ = (springs.places_m - springs.middles_m()[self._positions.of]).T
        along_x, along_y, up = *law.sideways_n_m, law.vertical_n_m
        about_z = x * x * along_y + y * y * along_x
        return self._positions.summed(np.stack((along_x, along_y, up, y * y * up, x * x * up, about_z)))

    def pressed_at(self, positions_m: FloatArray, rotations: FloatArray) -> FloatArray:
        """Return the pressing forces (p,) by which springs hold sideways, with bodies at these positions."""
        return self._holding_by(self._pressing(self.standing(positions_m, rotations).arrays["widths"]))

    def add_loads(
        self,
        loads: Sequence[FloatArray],
        connections: IntArray,
        positions_m: FloatArray,
        rotations: FloatArray,
        pressed_n: FloatArray | None,
    ) -> None:
        """Add forces with bodies at these positions to those (6, r) on first and second bodies of connections (r,).

        These are in ascending order. Springs slide by friction times `pressed_n` (p,); without it they neither slide
        nor lift off.
        """
        term = self.standing(positions_m, rotations)
        forces = self._resisted(term, pressed_n)[0]
        mine, at = self._among(connections)
        for load, more in zip(loads, loads_of_springs(self._positions, forces, *_arms(term)), strict=True):
            load[:, at] += more[:, mine]

    def add_stiffness(
        self,
        blocks: Sequence[FloatArray],
        connections: IntArray,
        positions_m: FloatArray,
        rotations: FloatArray,
        pressed_n: FloatArray | None,
    ) -> None:
        """Add their stiffness to the blocks (6, 6, r) of connections (r,), as `add_loads` does forces."""
        term = self.standing(positions_m, rotations)
        tangents = self._resisted(term, pressed_n)[1]
        mine, at = self._among(connections)
        for block, more in zip(blocks, stiffness_of_springs(self._positions, tangents, *_arms(term)), strict=True):
            block[..., at] += more[..., mine]

    def _resisted(self, term: Term, pressed_n: FloatArray | None) -> tuple[FloatArray, FloatArray]:
        """Forces (3, p) on what lies above, and tangents (3, 3, p)."""
        if pressed_n is None:
            return -turned(self._law.whole, term.arrays["widths"]), self._law.whole
        term.arrays["pressed_by"][:] = pressed_n
        return -term.resisted(), term.arrays["tangents"]

    def _among(self, connections: IntArray) -> tuple[IntArray, IntArray]:
        """Return which of the bearings are among some connections, and where there."""
        mine = np.flatnonzero(np.isin(self.rows, connections))
        return mine, np.searchsorted(connections, self.rows[mine])

    def loads_at_rest(self, positions_m: FloatArray, rotations: FloatArray) -> FloatArray:
        """Return forces and moments (6, c) on the first bodies, about the middle of each connection's springs."""
        term = self.standing(positions_m, rotations)
        forces = self._resisted(term, self._holding_by(self._pressing(term.arrays["widths"])))[0]
        middles = turned(rotations[..., self._above], self._middles)[:, self._positions.of]
        arms = term.arrays["second_arms"] - middles
        return loads_of_springs(self._positions, forces, arms, arms)[0]

    @property
    def core_pads(self) -> CorePads:
        """The bearings, as the core takes them."""
        if self._pads is None:
            pressed_n = self._pressed_n
            assert pressed_n is not None
            springs, count, bearings = self._springs, len(self.rows), int(self._springs.bearings.max(initial=-1)) + 1
            self._pads = CorePads(
                bearings=bearings,
                lifted=_LIFTED_M,
                least_cosines=3.0 - _LARGEST_TURN * _LARGEST_TURN,
                overturned=_OVERTURNED,
            ).take(
                numbers=(springs.bearings, count),
                first=(self._ends[0], count),
                second=(self._ends[1], count),
                pulls=(springs.pulls, count),
                travel=(springs.travel_m, count),
                breaking=(springs.breaking_n, count),
                built_turns=(self._built_turns, 9 * count),
                pressed=(pressed_n, len(pressed_n)),
                forces=(np.zeros((3, count)), 3 * count),
                whole=(np.zeros((3, bearings)), 3 * bearings),
                gone=(np.zeros(count, bool), count),
            )
        return self._pads

    def _turns(self, rotations: FloatArray) -> FloatArray:
        """Return how the first body of each connection is turned in the axes of the second, (3, 3, c)."""
        first, second = (rotations[..., bodies] for bodies in self._ends)
        turns: FloatArray = (second[:, :, None] * first[:, None, :]).sum(axis=0)
        return turns

    def _pressing(self, gaps_m: FloatArray) -> FloatArray:
        """Pressing forces (p,) of springs with these gaps."""
        own: FloatArray = np.maximum(-self._law.vertical_n_m * gaps_m[2], 0.0)
        return own

    def _holding_by(self, own: FloatArray) -> FloatArray:
        """Pressing forces (p,) by which springs hold sideways: their own, or all of a bearing that does not slide."""
        bearing = self._springs.bearings[self._positions.of]
        whole = np.bincount(bearing, own, int(bearing.max(initial=-1)) + 1)[bearing]
        return np.where(np.isinf(self._law.friction), whole, own)


def _arms(term: Term) -> tuple[FloatArray, FloatArray]:
    """Arms (3, p) from the centres of the bodies above and below to where the forces of springs act."""
    return term.arrays["second_arms"], term.arrays["first_arms"]
