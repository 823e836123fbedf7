"""Springs between two bodies: footings on soil, and pads of bearings; where they are, and what they do in a sub-step.

A sub-step is implicit, and its forces are guessed (`guesses`).

All arrays have their components first, except places.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from .compiled_springs import rates, resisted, spring_loops
from .equations import summed_on_bodies
from .gaps import Gaps, SolvedTangents, stiffness_of_points
from .guesses import GuessedForces
from .joint_rows import cross_products, turned, turned_back
from .spring_law import PressedSprings

_AGREES = 1e-4
"""Largest error of the force of a spring, by the mean force of the springs of its connection."""

_EVEN_M = 1e-10
"""Deformation up to this counts as none."""


@dataclass(frozen=True, slots=True, eq=False)
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
        arms = turned(rotations[..., self.above], self.anchors_above_m)
        below = turned(rotations[..., self.below], self.anchors_below_m)
        gaps = positions_m[:, self.above] - positions_m[:, self.below] + arms - below
        return gaps, arms, below + gaps

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

    def between(self, arms: FloatArray, arms_below: FloatArray, widths_m: FloatArray) -> Gaps:
        """Return gaps (3, p) with these widths, from the bodies below to those above."""
        return Gaps(self.below, self.above, arms_below, arms, widths_m)


class SpringStep(GuessedForces):
    """Forces of c connections, `rows` (c,), with q springs in a sub-step.

    `gaps` are from the bodies below to those above, and from where springs resist nothing. `keep` gets the upward
    forces (q,) that are solved.
    """

    def __init__(
        self,
        rows: IntArray,
        positions: SpringPositions,
        gaps: Gaps,
        law: PressedSprings,
        solved: SolvedTangents,
        substep_s: float,
        keep: Callable[[FloatArray], None] | None = None,
    ):
        super().__init__(rows, positions.of)
        self._positions, self._gaps, self._law = positions, gaps, law
        self._solved, self._substep_s, self._keep = solved, substep_s, keep
        self._begin_at(np.zeros_like(gaps.widths_m))
        of = positions.of
        mean_n = positions.summed(abs(self._forces).max(axis=0)) / np.bincount(of, minlength=len(rows))
        self._slack_n = _AGREES * mean_n[of] + _EVEN_M * law.vertical_n_m

    def changed(self) -> BoolArray:
        """Return whether each connection (c,) has other tangents than its equations."""
        return self._positions.summed(self._solved.differ(self._tangents).astype(float)) > 0.0

    def blocks(self, chosen: IntArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return what some (k,) add to the equations of their first and second bodies, and between, (6, 6, k)."""
        positions, mine = self._positions.only(chosen)
        tangents = self._tangents[..., mine]
        self._solved.take_over(mine, tangents)
        implicit = self._substep_s * self._substep_s * tangents
        return stiffness_of_springs(
            positions, implicit, self._gaps.second_arms_m[:, mine], self._gaps.first_arms_m[:, mine]
        )

    def loads(self, velocities: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the impulses (6, c) on the first and second bodies, which have velocities (6, n) then."""
        forces = -self._linear(self._moved(velocities))
        if self._keep is not None:
            self._keep(forces[2])
        push = self._substep_s * forces
        return loads_of_springs(self._positions, push, self._gaps.second_arms_m, self._gaps.first_arms_m)

    def of_bodies(self, loads: tuple[FloatArray, FloatArray], count: int) -> FloatArray:
        """Return the sums (6, n) of loads (6, c) on the first and on the second bodies, for n bodies."""
        above, below = np.zeros((2, len(self.rows)), int)
        above[self._positions.of], below[self._positions.of] = self._gaps.second, self._gaps.first
        first, second = (np.where(self._positions.above_first, *ends) for ends in ((above, below), (below, above)))
        return summed_on_bodies(first, second, loads, count)

    def _moved(self, velocities: FloatArray) -> FloatArray:
        return self._substep_s * rates(self._gaps, velocities)

    def _resisted(self, moved: FloatArray) -> FloatArray:
        return -resisted(self._law, self._gaps.widths_m + moved)[0]

    def _linear(self, moved: FloatArray) -> FloatArray:
        return self._forces + turned(self._tangents, moved)

    def _begin_at(self, moved: FloatArray) -> None:
        upwards, self._tangents = resisted(self._law, self._gaps.widths_m + moved)
        self._forces = -upwards - turned(self._tangents, moved)

    def _slack(self) -> FloatArray:
        return self._slack_n


def stiffness_of_springs(
    positions: SpringPositions, tangents: FloatArray, arms: FloatArray, arms_below: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the stiffness (6, 6, c) for the first and second bodies of connections, and between them.

    Springs have tangents (3, 3, p), and arms (3, p) from the centres of the bodies above and below.
    """
    loops = spring_loops()
    if loops is not None:
        found: tuple[FloatArray, FloatArray, FloatArray] = loops.summed_stiffness(
            tangents, arms, arms_below, positions.of, positions.above_first
        )
        return found
    of_above, of_below, between = stiffness_of_points(tangents, arms, arms_below, positions.summed)
    first, second = positions.ordered(of_above, of_below)
    return first, second, np.where(positions.above_first, between, np.swapaxes(between, 0, 1))


def loads_of_springs(
    positions: SpringPositions, forces: FloatArray, arms: FloatArray, arms_below: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return what forces (3, p) of springs on the bodies above do to the first and second bodies, (6, c) each."""
    loops = spring_loops()
    if loops is not None:
        found: tuple[FloatArray, FloatArray] = loops.summed_loads(
            forces, arms, arms_below, positions.of, positions.above_first
        )
        return found
    above, below = (
        positions.summed(np.concatenate((force, cross_products(arm, force))))
        for force, arm in ((forces, arms), (-forces, arms_below))
    )
    return positions.ordered(above, below)
