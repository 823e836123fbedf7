"""Footings on springs: their resistance in a sub-step, in the equations of the elastic structure.

Each part of a footing's area is a spring. It presses by stiffness, area and settlement, and never pulls: E. Winkler
(1867), Die Lehre von der Elastizität und Festigkeit. At the largest pressure that the soil resists, it settles for
good. Along the ground it holds up to its friction, by the pressure at the beginning of the sub-step, and slides beyond
it.

A sub-step is implicit, and solved as `elasticity.cracks` is: forces are linear about a guess, which is followed by
another until both agree.

All arrays have their components first.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..elasticity.gaps import Gaps, SolvedTangents, motion_of_points
from ..elasticity.joint_rows import cross_products, matrix_products, transposed, turned, turned_back

_AGREES = 1e-4
"""Largest error of the force of a spring, by the mean force of the footing's springs."""

_EVEN_M = 1e-10
"""Settlement up to this counts as none."""

_ANY = 1e300
"""Pressure by which friction holds any slip."""


@dataclass(frozen=True, slots=True, eq=False)
class SoilSprings:
    """Springs under f footings, at p positions."""

    rows: IntArray  # (f,), connection of each footing with the ground, in ascending order
    footings: IntArray  # (p,), footing of each spring, in ascending order
    places_m: FloatArray  # (p, 3), position as the bridge was built
    areas_m2: FloatArray  # (p,), parts of the area
    stiffness_n_m3: FloatArray  # (f,), pressure by settlement
    horizontal_n_m3: FloatArray  # (f,), shear by slip
    capacity_pa: FloatArray  # (f,), largest pressure, which may be infinite
    friction: FloatArray  # (f,), largest shear by pressure


class Footings:
    """All footings of a structure of n bodies, which has connections between bodies `first` and `second` (m,).

    Each footing's connection, of `rows` (f,), has the ground as one body. Positions (3, n) and rotations (3, 3, n) are
    those of the bridge as it was built, `moves` (n,) is False for bodies that never move.
    """

    def __init__(
        self,
        springs: SoilSprings,
        first: IntArray,
        second: IntArray,
        moves: BoolArray,
        positions_m: FloatArray,
        rotations: FloatArray,
    ):
        self.rows = springs.rows
        one, other, of = first[self.rows], second[self.rows], springs.footings
        self._stands_first = moves[one]
        standing, ground = np.where(self._stands_first, one, other), np.where(self._stands_first, other, one)
        self._of, self._standing, self._ground = of, standing[of], ground[of]
        self._anchors, self._ground_anchors = (
            turned_back(rotations[..., bodies], springs.places_m.T - positions_m[:, bodies])
            for bodies in (self._standing, self._ground)
        )
        areas = springs.areas_m2
        self._soil = PressedSprings(
            areas * springs.stiffness_n_m3[of],
            areas * springs.horizontal_n_m3[of],
            areas * springs.capacity_pa[of],
            springs.friction[of],
            np.zeros(len(of)),
        )
        self._unloaded = np.zeros((3, len(of)))
        self._solved_for = np.full((3, 3, len(of)), np.nan)

    def settle(self, positions_m: FloatArray, rotations: FloatArray) -> None:
        """Take over, before a sub-step, how far springs have settled or slid for good."""
        gaps = self._gaps(positions_m, rotations)[0]
        soil = self._soil
        deepest = soil.capacity_n / soil.vertical_n_m
        self._unloaded[2] = np.minimum(self._unloaded[2], gaps[2] + deepest)
        forces = replace(soil, pressed_n=np.full(len(self._of), _ANY)).resisted(gaps - self._unloaded)[0]
        pressed_n = forces[2]
        self._soil = replace(soil, pressed_n=pressed_n)
        size = np.sqrt(forces[0] * forces[0] + forces[1] * forces[1])
        limit = soil.friction * pressed_n
        share = np.divide(limit, size, out=np.ones_like(size), where=size > limit)
        for axis in range(2):
            self._unloaded[axis] = gaps[axis] + share * forces[axis] / soil.horizontal_n_m
        lifted = pressed_n <= 0.0
        self._unloaded[:2, lifted] = gaps[:2, lifted]

    @property
    def touching(self) -> FloatArray:
        """Part (f,) of the stiffness of each footing that is pressed, from 0 to 1, as it settled last."""
        pressed = np.where(self._soil.pressed_n > 0.0, self._soil.vertical_n_m, 0.0)
        return self._summed(pressed) / self._summed(self._soil.vertical_n_m)

    def stored_j(self, positions_m: FloatArray, rotations: FloatArray) -> FloatArray:
        """Return the energy (f,) that the springs would give back."""
        forces = self._soil.resisted(self._gaps(positions_m, rotations)[0] - self._unloaded)[0]
        along = forces[0] * forces[0] + forces[1] * forces[1]
        doubled = forces[2] * forces[2] / self._soil.vertical_n_m + along / self._soil.horizontal_n_m
        return self._summed(0.5 * doubled)

    def in_substep(
        self, chosen: IntArray, positions_m: FloatArray, rotations: FloatArray, substep_s: float
    ) -> FootingStep:
        """Return what some footings (c,) do in a sub-step of a length in s."""
        number = np.full(len(self.rows), -1)
        number[chosen] = np.arange(len(chosen))
        which = np.flatnonzero(number[self._of] >= 0)
        gaps, arms, ground_arms = (gap[:, which] for gap in self._gaps(positions_m, rotations))
        between = Gaps(self._ground[which], self._standing[which], ground_arms, arms, gaps - self._unloaded[:, which])
        return FootingStep(
            self.rows[chosen],
            self._stands_first[chosen],
            number[self._of[which]],
            between,
            self._soil.only(which),
            SolvedTangents(self._solved_for, which),
            substep_s,
        )

    def _gaps(self, positions_m: FloatArray, rotations: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Gaps from where springs were built on the ground, and arms from the standing bodies and the ground."""
        arms = turned(rotations[..., self._standing], self._anchors)
        on_ground = turned(rotations[..., self._ground], self._ground_anchors)
        between = positions_m[:, self._standing] - positions_m[:, self._ground]
        gaps = between + arms - on_ground
        return gaps, arms, on_ground + gaps

    def _summed(self, values: FloatArray) -> FloatArray:
        return np.bincount(self._of, values, len(self.rows))


class FootingStep:
    """Forces of c footings with q springs in a sub-step.

    `rows` and `stands_first` (c,): connections, and whether the first body of each stands on the ground. `footings`
    (q,): footing of each spring. `gaps` are from the ground to the body, and from where a spring resists nothing.
    """

    def __init__(
        self,
        rows: IntArray,
        stands_first: BoolArray,
        footings: IntArray,
        gaps: Gaps,
        soil: PressedSprings,
        solved: SolvedTangents,
        substep_s: float,
    ):
        self.rows = rows
        self._stands_first, self._of, self._gaps = stands_first, footings, gaps
        self._soil, self._solved, self._substep_s = soil, solved, substep_s
        counts = np.bincount(footings, minlength=len(rows))
        self._slack = (_AGREES * np.bincount(footings, soil.pressed_n, len(rows)) / counts)[footings]
        self._slack += _EVEN_M * soil.vertical_n_m
        self._begin_at(np.zeros_like(gaps.widths_m))

    def changed(self) -> BoolArray:
        """Return whether each footing (c,) has other tangents than its equations."""
        return np.bincount(self._of, self._solved.differ(self._tangents), len(self.rows)) > 0

    def blocks(self, chosen: IntArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return what footings (k,) add to the equations of their first and second bodies, and between, (6, 6, k)."""
        is_chosen = np.zeros(len(self.rows), bool)
        is_chosen[chosen] = True
        mine = np.flatnonzero(is_chosen[self._of])
        tangents = self._tangents[..., mine]
        self._solved.take_over(mine, tangents)
        moving = motion_of_points(self._gaps.second_arms_m[:, mine])
        implicit = self._substep_s * self._substep_s * tangents
        stiff = matrix_products(transposed(moving), matrix_products(implicit, moving)).reshape(36, -1)
        count = len(self.rows)
        sums = np.stack([np.bincount(self._of[mine], entry, count) for entry in stiff])[:, chosen].reshape(6, 6, -1)
        first = self._stands_first[chosen]
        return np.where(first, sums, 0.0), np.where(first, 0.0, sums), np.zeros_like(sums)

    def loads(self, velocities: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the impulses (6, c) on the first and second bodies of footings, which have velocities (6, n) then."""
        push = self._substep_s * self._linear(self._substep_s * self._gaps.rates(velocities))
        standing, ground = (
            self._summed(np.concatenate((force, cross_products(arms, force))))
            for force, arms in ((push, self._gaps.second_arms_m), (-push, self._gaps.first_arms_m))
        )
        return np.where(self._stands_first, standing, ground), np.where(self._stands_first, ground, standing)

    def agrees(self, velocities: FloatArray) -> bool:
        """Whether the forces are those of the settlement that follows from velocities (6, n); if not, guess again."""
        moved = self._substep_s * self._gaps.rates(velocities)
        off = abs(self._soil.resisted(self._gaps.widths_m + moved)[0] - self._linear(moved)).max(axis=0)
        if (off <= self._slack).all():
            return True
        self._begin_at(moved)
        return False

    def of_bodies(self, loads: tuple[FloatArray, FloatArray], count: int) -> FloatArray:
        """Return the sums (6, n) of loads (6, c) on the bodies that stand, for n bodies; the ground does not move."""
        standing = np.where(self._stands_first, *loads)
        bodies = np.zeros(len(self.rows), int)
        bodies[self._of] = self._gaps.second
        return np.stack([np.bincount(bodies, component, count) for component in standing])

    def _begin_at(self, moved: FloatArray) -> None:
        """Take forces for linear about springs that have moved further (3, q)."""
        forces, self._tangents = self._soil.resisted(self._gaps.widths_m + moved)
        self._forces = forces + turned(self._tangents, moved)

    def _linear(self, moved: FloatArray) -> FloatArray:
        return self._forces - turned(self._tangents, moved)

    def _summed(self, values: FloatArray) -> FloatArray:
        return np.stack([np.bincount(self._of, value, len(self.rows)) for value in values])


@dataclass(frozen=True, slots=True, eq=False)
class PressedSprings:
    """Springs at q positions."""

    vertical_n_m: FloatArray  # (q,), stiffness
    horizontal_n_m: FloatArray
    capacity_n: FloatArray  # largest pressing force
    friction: FloatArray  # largest force along the ground by the pressing force
    pressed_n: FloatArray  # pressing force by which friction counts

    def only(self, which: IntArray) -> PressedSprings:
        return PressedSprings(*(getattr(self, item.name)[which] for item in fields(self)))

    def resisted(self, gaps_m: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return forces (3, q) on what stands on gaps (3, q), and by how much these fall with them, (3, 3, q)."""
        wanted = -self.vertical_n_m * gaps_m[2]
        forces, tangents = np.zeros_like(gaps_m), np.zeros((3, *gaps_m.shape))
        forces[2] = np.clip(wanted, 0.0, self.capacity_n)
        tangents[2, 2] = np.where((wanted > 0.0) & (wanted < self.capacity_n), self.vertical_n_m, 0.0)
        along = gaps_m[:2]
        squares = along[0] * along[0] + along[1] * along[1]
        size = np.sqrt(squares) * self.horizontal_n_m
        limit = self.friction * self.pressed_n
        slides = size > limit
        share = np.divide(limit, size, out=np.ones_like(size), where=slides)
        forces[:2] = -share * self.horizontal_n_m * along
        tangents[0, 0] = tangents[1, 1] = share * self.horizontal_n_m
        across = np.divide(share * self.horizontal_n_m, squares, out=np.zeros_like(size), where=slides)
        tangents[:2, :2] -= across * along[:, None] * along
        return forces, tangents
