"""Springs between two bodies: footings on soil, and pads of bearings; where they are, and what they do in a sub-step.

A sub-step is implicit, and its forces are guessed (`core/src/guesses.h`).

All arrays have their components first, except places.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..core.calls import call
from ..core.structs import Count, Doubles, Indices, Struct
from .gaps import stiffness_of_points
from .joint_rows import cross_products, turned_back
from .spring_law import PressedSprings
from .substep import SPRINGS, Places, Term


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

    def gaps(self, positions_m: FloatArray, rotations: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return gaps (3, p) below the bodies above, and arms (3, p) of the force there, from both bodies' centres."""
        gaps, arms, arms_below = (np.empty((3, len(self.of))) for _ in range(3))
        call("bda_spring_gaps", self._core, Places.of(positions_m, rotations), gaps, arms, arms_below)
        return gaps, arms, arms_below

    @cached_property
    def _core(self) -> _Places:
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


def spring_term(
    rows: IntArray,
    positions: SpringPositions,
    which: IntArray,
    gaps: tuple[FloatArray, FloatArray, FloatArray],
    law: PressedSprings,
    remembered: FloatArray,
    solved: Callable[[FloatArray], None] | None = None,
) -> Term:
    """Return what c connections, `rows` (c,), do in a sub-step by q springs, which are `which` (q,) of all.

    `gaps` are from where springs resist nothing, (3, q), with their arms on the bodies above and below. `solved` gets
    the upward forces (q,).
    """
    widths, arms, arms_below = gaps
    return Term.of(
        SPRINGS,
        rows,
        positions.of,
        which,
        remembered,
        (positions.below, positions.above),
        (arms_below, arms),
        widths,
        {
            "vertical": law.vertical_n_m,
            "sideways": law.sideways_n_m,
            "capacity": law.capacity_n,
            "friction": law.friction,
            "pressed_by": law.pressed_n,
            "pulls": law.pulls,
            "above_first": positions.above_first,
        },
        solved,
    )


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
