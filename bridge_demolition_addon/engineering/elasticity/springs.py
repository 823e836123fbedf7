"""Springs between two bodies: footings on soil, and pads of bearings; where they are, and what they do in a sub-step.

A sub-step is implicit, and its forces are guessed (`core/src/guesses.h`).

All arrays have their components first, except places.

All arrays have their components first.
"""

from __future__ import annotations

import ctypes
import math
from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..core.calls import call
from ..core.structs import Count, Doubles, Flags, Indices, Struct, WrittenDoubles
from .joint_rows import cross_products, stiffness_of_points, turned_back
from .substep import SPRINGS, Places, Term


class _Law(Struct):
    _fields_ = (
        ("count", Count),
        *((name, Doubles) for name in ("vertical", "sideways", "capacity", "friction", "pressed")),
        ("pulls", Flags),
    )


@dataclass(frozen=True, eq=False)
class PressedSprings:
    """Resistance of q springs: they press upwards, and hold sideways by their stiffness up to friction."""

    vertical_n_m: FloatArray  # (q,), stiffness
    sideways_n_m: FloatArray  # (2, q), stiffness along x and y
    capacity_n: FloatArray  # (q,), largest pressing force; may be infinite
    friction: FloatArray  # (q,), largest force sideways by the pressing force; infinite where they do not slide
    pulls: BoolArray  # (q,), whether they hold what is lifted
    pressed_n: FloatArray  # (q,), pressing force by which they hold sideways

    def only(self, which: IntArray) -> PressedSprings:
        """Return some of the springs."""
        return PressedSprings(*(getattr(self, item.name)[..., which] for item in fields(self)))

    @property
    def whole(self) -> FloatArray:
        """Stiffness (3, 3, q) of springs that neither lift off, nor slide, nor yield."""
        tangents = np.zeros((3, 3, len(self.vertical_n_m)))
        tangents[0, 0], tangents[1, 1], tangents[2, 2] = *self.sideways_n_m, self.vertical_n_m
        return tangents

    @cached_property
    def core(self) -> _Law:
        """The law, as the core takes it."""
        count = len(self.vertical_n_m)
        law = _Law(count=count)
        for name, array in (
            ("vertical", self.vertical_n_m),
            ("sideways", self.sideways_n_m),
            ("capacity", self.capacity_n),
            ("friction", self.friction),
            ("pressed", self.pressed_n),
            ("pulls", self.pulls),
        ):
            law.point(name, np.ascontiguousarray(array), 2 * count if name == "sideways" else count)
        return law


class _Places(Struct):
    _fields_ = (
        ("count", Count),
        ("above", Indices),
        ("below", Indices),
        ("anchors_above", Doubles),
        ("anchors_below", Doubles),
    )


@dataclass(frozen=True, eq=False)
class SpringPositions:
    """Where p springs of c connections are, each between a body above and one below."""

    of: IntArray  # (p,), connection of each spring, in ascending order
    above: IntArray  # (p,), bodies
    below: IntArray
    anchors_above_m: FloatArray  # (3, p), in the axes of the bodies, from their centres
    anchors_below_m: FloatArray
    above_first: BoolArray  # (c,), whether the first body of each connection is the one above

    @classmethod
    def built(
        cls,
        of: IntArray,
        places_m: FloatArray,
        ends: tuple[IntArray, IntArray],
        above: IntArray,
        positions_m: FloatArray,
        rotations: FloatArray,
    ) -> SpringPositions:
        """Return the positions of springs at places (p, 3), in connections with bodies at two `ends` (c,).

        `above` (c,) are those of them that lie above. Positions (3, n) and rotations (3, 3, n) of bodies are those of
        the bridge as it was built.
        """
        first, second = ends
        below = np.where(first == above, second, first)
        above_of, below_of = above[of], below[of]
        anchors = [
            turned_back(rotations[..., bodies], places_m.T - positions_m[:, bodies]) for bodies in (above_of, below_of)
        ]
        return cls(of, above_of, below_of, anchors[0], anchors[1], first == above)

    @cached_property
    def core(self) -> _Places:
        """The positions, as the core takes them."""
        count = len(self.of)
        places = _Places(count=count)
        places.point("above", np.ascontiguousarray(self.above), count)
        places.point("below", np.ascontiguousarray(self.below), count)
        places.point("anchors_above", np.ascontiguousarray(self.anchors_above_m), 3 * count)
        places.point("anchors_below", np.ascontiguousarray(self.anchors_below_m), 3 * count)
        return places

    def ordered(self, above: FloatArray, below: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return what is of the bodies above and below (…, c) as of the first and second bodies."""
        return np.where(self.above_first, above, below), np.where(self.above_first, below, above)

    def summed(self, values: FloatArray) -> FloatArray:
        """Return the sums (…, c) of values (…, p) of springs over each connection."""
        count = len(self.above_first)
        rows = values.reshape(math.prod(values.shape[:-1]), len(self.of))
        return np.stack([np.bincount(self.of, row, count) for row in rows]).reshape(*values.shape[:-1], count)

    def only(self, chosen: IntArray) -> tuple[SpringPositions, IntArray]:
        """Return the positions of the springs of some connections (k,), and which springs these are."""
        number = np.full(len(self.above_first), -1)
        number[chosen] = np.arange(len(chosen))
        which = np.flatnonzero(number[self.of] >= 0)
        return (
            SpringPositions(
                number[self.of[which]],
                self.above[which],
                self.below[which],
                self.anchors_above_m[:, which],
                self.anchors_below_m[:, which],
                self.above_first[chosen],
            ),
            which,
        )


class CoreSprings(Struct):
    """Springs with what has become of them by now: `bda_springs`."""

    _fields_ = (
        ("at", ctypes.c_void_p),
        ("law", ctypes.c_void_p),
        ("connections", Count),
        ("of", Indices),
        *((name, WrittenDoubles) for name in ("free", "holding", "touching")),
    )


class SpringsOfConnections:
    """Springs (p,) in place of connections `rows` (c,), from one sub-step to the next.

    Attributes
    ----------
    touching : (c,) float
        Part of the stiffness of each connection that acts, from 0 to 1, as it settled last.
    remembered : (12, p) float
        What the core knows of the last sub-step.
    """

    def __init__(self, rows: IntArray, positions: SpringPositions, law: PressedSprings):
        self.rows, self._positions, self._law = rows, positions, law
        count = len(positions.of)
        if law.sideways_n_m.shape != (2, count):
            raise ValueError(f"stiffness sideways has shape {law.sideways_n_m.shape}: expected (2, {count})")
        self._free = np.zeros((3, count))  # gaps at which springs resist nothing
        self.touching, self.remembered = np.ones(len(rows)), np.full((12, count), np.nan)
        self._pressed_n: FloatArray | None = None  # (p,) pressing forces as they were solved last, where they count
        self._springs_in_core: CoreSprings | None = None

    def __getstate__(self) -> dict[str, object]:
        """Return what a copy has: where its arrays are in memory is its own."""
        return self.__dict__ | {"_springs_in_core": None}

    def term(self, chosen: IntArray) -> Term:
        """Return what some connections (k,) do, as long as these are the same."""
        positions, which = self._positions.only(chosen)
        law, count = self._law.only(which), len(which)
        term = Term.of(
            SPRINGS,
            self.rows[chosen],
            chosen,
            positions.of,
            which,
            self.remembered,
            (positions.below, positions.above),
            (np.zeros((3, count)), np.zeros((3, count))),
            np.zeros((3, count)),
            {
                "vertical": law.vertical_n_m,
                "sideways": law.sideways_n_m,
                "capacity": law.capacity_n,
                "friction": law.friction,
                "pressed_by": np.zeros(count),
                "pulls": law.pulls,
                "above_first": positions.above_first,
            },
            self.core,
        )
        if self._pressed_n is not None:
            term.point("solved_pressed", self._pressed_n, len(self._positions.of))
        return term

    def standing(self, positions_m: FloatArray, rotations: FloatArray) -> Term:
        """Return all springs as they are with bodies at these positions, by themselves and not in a sub-step.

        `widths` (3, p) are gaps beyond where springs resist nothing, `second_arms` and `first_arms` (3, p) lead from
        the centres of the bodies above and below to where the forces act.
        """
        term = self.term(np.arange(len(self.rows)))
        term.begin(positions_m, rotations)
        return term

    def stored_j(self, positions_m: FloatArray, rotations: FloatArray) -> FloatArray:
        """Return the energy (c,) that the springs would give back."""
        stored = np.empty(len(self.rows))
        call("bda_springs_energy", self.core, Places.of(positions_m, rotations), stored)
        return stored

    @property
    def core(self) -> CoreSprings:
        """What the core works on, which changes what is here."""
        if self._springs_in_core is None:
            count = len(self._positions.of)
            self._springs_in_core = CoreSprings(connections=len(self.rows)).take(
                of=(self._positions.of, count),
                free=(self._free, 3 * count),
                holding=(self._law.pressed_n, count),
                touching=(self.touching, len(self.rows)),
            )
            self._springs_in_core.refer(at=self._positions.core, law=self._law.core)
        return self._springs_in_core


def stiffness_of_springs(
    positions: SpringPositions, tangents: FloatArray, arms: FloatArray, arms_below: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the stiffness (6, 6, c) for the first and second bodies of connections, and between them.

    Springs have tangents (3, 3, p), and arms (3, p) from the centres of the bodies above and below.
    """
    of_above, of_below, between = stiffness_of_points(tangents, arms, arms_below, positions.summed)
    first, second = positions.ordered(of_above, of_below)
    return first, second, np.where(positions.above_first, between, np.swapaxes(between, 0, 1))


def loads_of_springs(
    positions: SpringPositions, forces: FloatArray, arms: FloatArray, arms_below: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return what forces (3, p) of springs on the bodies above do to the first and second bodies, (6, c) each."""
    above, below = (
        positions.summed(np.concatenate((force, cross_products(arm, force))))
        for force, arm in ((forces, arms), (-forces, arms_below))
    )
    return positions.ordered(above, below)
