"""Bars that stand bare between two bodies, where a blast has taken the concrete of a zone away.

Groups of bars, each between a point on the body below and one on the body above, pull and press along the line between
these. They yield in tension, and rupture. In compression they yield or buckle, and then fold: they resist less the
closer their ends have come for good, and as little while they are straightened again. Sideways they resist nothing.

A sub-step is implicit, as of cracks. What groups have yielded or folded by follows after it, so that forces in a
sub-step are largest at its beginning.

At rest, the ends of bars are taken for held sideways, as their buckling load takes them: a bridge that is not quite
upright would tip over on bars without any stiffness sideways. There bars resist what they may be counted on for, and in
a run as much as straight ones.

All arrays have their components first.
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..core.calls import call
from ..core.structs import Count, Doubles, Indices, Struct, WrittenDoubles, WrittenFlags
from ..elasticity.joint_rows import dot_products, turned_back
from ..elasticity.steel_bars import MODULUS_PA, USUAL_STEEL
from ..elasticity.substep import BARE_BARS, Places, Term
from .bare_bars import bar_area_m2, hinge_arm_m, largest_compression_n, yield_force_n

RUPTURE_STRAIN = USUAL_STEEL.rupture_strain

_FOLDED_UP = 0.02
"""Length of a group by its bared height from which on it is folded up, and counts no more."""


@dataclass(frozen=True, slots=True, eq=False)
class BareBars:
    """g groups of bars, each of bars that are alike."""

    first: IntArray  # (g,), bodies
    second: IntArray
    first_points_m: FloatArray  # (3, g), where they leave the concrete, in the axes of the world
    second_points_m: FloatArray
    counts: FloatArray  # (g,), bars; a part of one counts as such
    diameters_m: FloatArray  # (g,)
    yields_pa: FloatArray  # (g,)

    @property
    def yield_n(self) -> FloatArray:
        """Forces (g,) at which they yield."""
        return self.counts * yield_force_n(self.diameters_m, self.yields_pa)


class GroupsInCore(Struct):
    """Groups as the core takes them: `bda_cages` in `core/src/cages.h`."""

    _fields_ = (
        ("count", Count),
        *((name, Indices) for name in ("first", "second")),
        *((name, Doubles) for name in ("first_anchors", "second_anchors", "bared", "counts", "shares")),
        *((name, Doubles) for name in ("squash", "most", "arms", "stiffness")),
        *((name, WrittenDoubles) for name in ("stays", "pressed")),
        ("holds", WrittenFlags),
        *((name, ctypes.c_double) for name in ("rupture_strain", "folded_up")),
    )


@dataclass(frozen=True, eq=False)
class _Groups:
    """State of g groups of bars: anchors in the axes of their bodies, and what they have yielded by."""

    first: IntArray
    second: IntArray
    first_anchors_m: FloatArray
    second_anchors_m: FloatArray
    bared_m: FloatArray  # (g,), length as they were bared
    counts: FloatArray
    diameters_m: FloatArray
    yields_pa: FloatArray
    stays_m: FloatArray  # (g,), elongation that stays; below 0 where they have folded
    pressed_n: FloatArray  # (g,), largest force in compression so far
    holds: BoolArray  # (g,)
    lines_m: FloatArray  # (3, g), from their first to their second points as they were bared, in the axes of the world
    shares: FloatArray  # (g,), part of what they resist that is counted on
    straight: bool  # whether they are without any bow

    def __getstate__(self) -> dict[str, object]:
        """Return what a copy has: where its arrays are in memory is its own."""
        return {name: value for name, value in self.__dict__.items() if name != "core"}

    def joined(self, others: _Groups) -> _Groups:
        """Return these and others."""
        pairs = {name: (getattr(self, name), getattr(others, name)) for name in _ARRAYS}
        arrays: dict[str, Any] = {name: np.concatenate(pair, axis=-1) for name, pair in pairs.items()}
        return replace(self, **arrays)

    @property
    def stiffness_n_m(self) -> FloatArray:
        """Force (g,) by elongation, E A / l."""
        return self.counts * MODULUS_PA * bar_area_m2(self.diameters_m) / self.bared_m

    @cached_property
    def core(self) -> GroupsInCore:
        """What the core works on, which changes what is here."""
        count, squash_n = len(self.first), yield_force_n(self.diameters_m, self.yields_pa)
        most_n = largest_compression_n(self.diameters_m, self.bared_m, self.yields_pa, straight=self.straight)
        return GroupsInCore(count=count, rupture_strain=RUPTURE_STRAIN, folded_up=_FOLDED_UP).take(
            first=(self.first, count),
            second=(self.second, count),
            first_anchors=(self.first_anchors_m, 3 * count),
            second_anchors=(self.second_anchors_m, 3 * count),
            bared=(self.bared_m, count),
            counts=(self.counts, count),
            shares=(self.shares, count),
            squash=(squash_n, count),
            most=(most_n, count),
            arms=(hinge_arm_m(self.diameters_m), count),
            stiffness=(self.stiffness_n_m, count),
            stays=(self.stays_m, count),
            pressed=(self.pressed_n, count),
            holds=(self.holds, count),
        )


_ARRAYS = tuple(item.name for item in fields(_Groups) if item.name != "straight")


class Cages:
    """All bare bars of a structure; `rows` (g,) are their numbers among what connects bodies, from a number on.

    Ends that are `held_sideways` are so as stiffly as the bars are along their lines. `share` is the part of what bars
    resist that is counted on: a half where their load comes upon them at once. Bars are `straight`, or have the bow of
    curve c.
    """

    def __init__(self, from_row: int, *, held_sideways: bool = False, share: float = 1.0, straight: bool = True):
        self._from_row, self._held_sideways, self._share = from_row, held_sideways, share
        none, numbers = np.zeros(0), np.zeros(0, int)
        points = np.zeros((3, 0))
        self._groups = _Groups(
            numbers, numbers, points, points, none, none, none, none, none, none, none > 0.0, points, none, straight
        )
        self.remembered = np.zeros((12, 0))  # what the core knows of the last sub-step

    def __len__(self) -> int:
        return len(self._groups.first)

    @property
    def rows(self) -> IntArray:
        """Their numbers (g,)."""
        return self._from_row + np.arange(len(self))

    @property
    def ends(self) -> tuple[IntArray, IntArray]:
        """First and second bodies (g,)."""
        return self._groups.first, self._groups.second

    def add(self, bars: BareBars, positions_m: FloatArray, rotations: FloatArray) -> IntArray:
        """Let groups of bars stand bare, from how they are now; return their numbers (g,) among all groups."""
        ends = ((bars.first, bars.first_points_m), (bars.second, bars.second_points_m))
        anchors = [turned_back(rotations[..., body], points - positions_m[:, body]) for body, points in ends]
        line = bars.second_points_m - bars.first_points_m
        count, zeros = len(bars.first), np.zeros(len(bars.first))
        added = _Groups(
            bars.first,
            bars.second,
            anchors[0],
            anchors[1],
            np.sqrt(dot_products(line, line)),
            bars.counts,
            bars.diameters_m,
            bars.yields_pa,
            zeros,
            zeros,
            np.ones(count, bool),
            line,
            np.full(count, self._share),
            self._groups.straight,
        )
        self._groups = self._groups.joined(added)
        self.remembered = np.concatenate((self.remembered, np.full((12, count), np.nan)), axis=1)
        return len(self) - count + np.arange(count)

    @property
    def holds(self) -> BoolArray:
        """Which of them (g,) hold."""
        return self._groups.holds

    @property
    def core(self) -> GroupsInCore:
        """What the core works on, which changes what is here."""
        return self._groups.core

    def let_go(self, bodies: IntArray) -> None:
        """Let go of the bars that end in some bodies (b,)."""
        gone = np.isin(self._groups.first, bodies) | np.isin(self._groups.second, bodies)
        self._groups.holds[gone] = False

    def update_plastic_state(self, positions_m: FloatArray, rotations: FloatArray) -> None:
        """Take over, before a sub-step, what has yielded, folded or ruptured by now."""
        call("bda_cages_settle", self._groups.core, Places.of(positions_m, rotations))

    def forces_n(self, positions_m: FloatArray, rotations: FloatArray) -> FloatArray:
        """Return the forces (g,) along their lines, above 0 in tension."""
        term = self.term(np.arange(len(self)))
        term.begin(positions_m, rotations)
        (forces,) = term.resisted()
        return np.asarray(forces)

    def pressed_n(self, chosen: IntArray) -> FloatArray:
        """Return the largest forces (k,) in compression that some groups have had so far."""
        return self._groups.pressed_n[chosen]

    def folded_m(self, chosen: IntArray) -> FloatArray:
        """Return by how much the ends of some groups (k,) have come closer for good."""
        return np.maximum(-self._groups.stays_m[chosen], 0.0)

    def term(self, chosen: IntArray) -> Term:
        """Return what some groups (k,) do, as long as there are the same."""
        groups, count = self._groups, len(chosen)
        law: dict[str, FloatArray | BoolArray] = {
            "yields": (groups.counts * yield_force_n(groups.diameters_m, groups.yields_pa))[chosen],
            "stiffness": groups.stiffness_n_m[chosen],
            "directions": np.zeros((3, count)),
            "bared": groups.bared_m[chosen],
            "bared_lines": groups.lines_m[:, chosen],
            "holds": groups.holds[chosen],
        }
        law |= {name: np.zeros(count) for name in ("lengths", "stays", "pulled_limits", "pressed_limits")}
        return Term.of(
            BARE_BARS,
            self.rows[chosen],
            chosen,
            np.arange(count),
            chosen,
            self.remembered,
            (groups.first[chosen], groups.second[chosen]),
            (np.zeros((3, count)), np.zeros((3, count))),
            np.zeros((3, count)),
            law,
            groups.core,
            held_sideways=int(self._held_sideways),
        )
