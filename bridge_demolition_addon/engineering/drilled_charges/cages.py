"""Bars that stand bare between two bodies, where a blast has taken the concrete of a zone away.

Groups of bars, each between a point on the body below and one on the body above, pull and press along the line between
these. They yield in tension, and rupture. In compression they yield or buckle, and then fold: they resist less the
closer their ends have come for good, and as little while they are straightened again. Sideways they resist nothing.

A sub-step is implicit, as of cracks. What groups have yielded or folded by follows after it, so that the largest forces
in a sub-step are those of its beginning.

At rest, the ends of bars are taken for held sideways, as their buckling load takes them: a bridge that is not quite
upright would tip over on bars without any stiffness sideways. There bars resist what they may be counted on for, and in
a run as much as straight ones.

All arrays have their components first.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..elasticity.joint_rows import dot_products, turned, turned_back
from ..elasticity.steel_bars import MODULUS_PA, USUAL_STEEL
from ..elasticity.substep import BARE_BARS, Term
from .bare_bars import bar_area_m2, folding_force_n, yield_force_n

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


@dataclass(frozen=True, slots=True, eq=False)
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

    def joined(self, others: _Groups) -> _Groups:
        """Return these and others."""
        pairs = {name: (getattr(self, name), getattr(others, name)) for name in _ARRAYS}
        return self._with({name: np.concatenate(pair, axis=-1) for name, pair in pairs.items()})

    def only(self, which: IntArray) -> _Groups:
        """Return some of them."""
        return self._with({name: getattr(self, name)[..., which] for name in _ARRAYS})

    def _with(self, arrays: dict[str, Any]) -> _Groups:
        return replace(self, **arrays)

    @property
    def stiffness_n_m(self) -> FloatArray:
        """Force (g,) by elongation, E A / l."""
        return self.counts * MODULUS_PA * bar_area_m2(self.diameters_m) / self.bared_m

    @property
    def limits_n(self) -> tuple[FloatArray, FloatArray]:
        """Largest forces (g,) in tension and in compression."""
        yields = self.counts * yield_force_n(self.diameters_m, self.yields_pa)
        folded_m = np.maximum(-self.stays_m, 0.0)
        folding = self.counts * folding_force_n(
            self.diameters_m, self.bared_m, folded_m, self.yields_pa, straight=self.straight
        )
        return self.shares * np.where(folded_m > 0.0, folding, yields), self.shares * folding

    def forces_n(self, elongations_m: FloatArray) -> FloatArray:
        """Return the forces (g,), above 0 in tension, at elongations (g,) since they were bared."""
        return self.forces_within(elongations_m, *self.limits_n)

    def forces_within(self, elongations_m: FloatArray, pulled_n: FloatArray, pressed_n: FloatArray) -> FloatArray:
        """Return the same with largest forces (g,) in tension and in compression that are known already."""
        return self.holds * np.clip(self.stiffness_n_m * (elongations_m - self.stays_m), -pressed_n, pulled_n)

    def lines(self, positions_m: FloatArray, rotations: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the lines (3, g) from their first to their second points, and arms (3, g) of these on the bodies."""
        first = turned(rotations[..., self.first], self.first_anchors_m)
        second = turned(rotations[..., self.second], self.second_anchors_m)
        return positions_m[:, self.second] + second - positions_m[:, self.first] - first, first, second


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
        self._remembered = np.zeros((12, 0))

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
        self._remembered = np.concatenate((self._remembered, np.full((12, count), np.nan)), axis=1)
        return len(self) - count + np.arange(count)

    @property
    def holds(self) -> BoolArray:
        """Which of them (g,) hold."""
        return self._groups.holds

    def let_go(self, bodies: IntArray) -> None:
        """Let go of all bars that end in some bodies (b,)."""
        gone = np.isin(self._groups.first, bodies) | np.isin(self._groups.second, bodies)
        self._groups.holds[gone] = False

    def update_plastic_state(self, positions_m: FloatArray, rotations: FloatArray) -> None:
        """Take over, before a sub-step, what has yielded, folded or ruptured by now."""
        groups = self._groups
        line, *_ = groups.lines(positions_m, rotations)
        size = np.sqrt(dot_products(line, line))
        elongations = size - groups.bared_m
        forces = groups.forces_n(elongations)
        np.maximum(groups.pressed_n, -forces, out=groups.pressed_n)
        elastic = np.divide(forces, groups.stiffness_n_m)
        groups.stays_m[groups.holds] = (elongations - elastic)[groups.holds]
        ruptured = groups.stays_m > RUPTURE_STRAIN * groups.bared_m
        groups.holds[ruptured | (size < _FOLDED_UP * groups.bared_m)] = False

    def stored_j(self, positions_m: FloatArray, rotations: FloatArray) -> FloatArray:
        """Return the energy (g,) that the bars would give back."""
        groups = self._groups
        line, *_ = groups.lines(positions_m, rotations)
        forces = groups.forces_n(np.sqrt(dot_products(line, line)) - groups.bared_m)
        stored: FloatArray = 0.5 * forces * forces / groups.stiffness_n_m
        return stored

    def forces_n(self, positions_m: FloatArray, rotations: FloatArray) -> FloatArray:
        """Return the forces (g,) along their lines, above 0 in tension."""
        line, *_ = self._groups.lines(positions_m, rotations)
        return self._groups.forces_n(np.sqrt(dot_products(line, line)) - self._groups.bared_m)

    def pressed_n(self, chosen: IntArray) -> FloatArray:
        """Return the largest forces (k,) in compression that some groups have had so far."""
        return self._groups.pressed_n[chosen]

    def folded_m(self, chosen: IntArray) -> FloatArray:
        """Return by how much the ends of some groups (k,) have come closer for good."""
        return np.maximum(-self._groups.stays_m[chosen], 0.0)

    def in_substep(self, chosen: IntArray, positions_m: FloatArray, rotations: FloatArray, substep_s: float) -> Term:
        """Return what some groups (k,) do in a sub-step of a length in s."""
        groups = self._groups.only(chosen)
        line, first_arms, second_arms = groups.lines(positions_m, rotations)
        length = np.sqrt(dot_products(line, line))
        pulled_n, pressed_n = groups.limits_n
        law = {
            "yields": groups.counts * yield_force_n(groups.diameters_m, groups.yields_pa),
            "stiffness": groups.stiffness_n_m,
            "directions": line / np.where(length > 0.0, length, 1.0),
            "lengths": length,
            "bared": groups.bared_m,
            "stays": groups.stays_m,
            "pulled_limits": pulled_n,
            "pressed_limits": pressed_n,
            "bared_lines": groups.lines_m,
            "holds": groups.holds,
        }
        return Term.of(
            BARE_BARS,
            self.rows[chosen],
            np.arange(len(chosen)),
            chosen,
            self._remembered,
            (groups.first, groups.second),
            (first_arms, second_arms),
            line,
            law,
            held_sideways=int(self._held_sideways),
        )
