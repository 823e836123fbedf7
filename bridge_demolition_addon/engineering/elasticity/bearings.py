"""Bearings: springs at the pads between two bodies, at rest and in a sub-step, in the equations of the structure.

Each pad is a row of springs. A spring presses what lies above upwards, and pulls only where the bearing holds against
uplift. Sideways it holds by its stiffness, up to friction times the pressing force where the bearing slides (C. A. de
Coulomb 1785), and else as long as the bearing presses anywhere. Bending of the body above reaches the one below only by
the arms of the springs: in one line across the road it turns freely about that.

A sub-step is implicit, and solved as `elasticity.cracks` is: forces are linear about a guess, which is followed by
another until both agree. Friction then counts by the pressing force that was solved in the sub-step before, and at rest
by that at rest. Positions do not say it: at the stiffness of a pad their rounding is a good part of the weight, and
where a deck slides on a pier that rotates, both move by more than the pad deforms in a sub-step.

All arrays have their components first, except places.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from .equations import summed_on_bodies
from .gaps import Gaps, SolvedTangents, motion_of_points
from .joint_rows import cross_products, matrix_products, transposed, turned, turned_back

_AGREES = 1e-4
"""Largest error of the force of a spring, by the mean force of the springs of its connection."""

_EVEN_M = 1e-10
"""Deformation up to this counts as none."""


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


@dataclass(frozen=True, slots=True, eq=False)
class PadLaw:
    """Resistance of q springs."""

    vertical_n_m: FloatArray  # (q,)
    sideways_n_m: FloatArray  # (2, q)
    friction: FloatArray  # (q,)
    pulls: BoolArray  # (q,)
    pressed_n: FloatArray  # (q,), pressing force by which they hold sideways

    def only(self, which: IntArray) -> PadLaw:
        """Return the law of some springs."""
        return PadLaw(*(getattr(self, item.name)[..., which] for item in fields(self)))

    @property
    def whole(self) -> FloatArray:
        """Stiffness (3, 3, q) of springs that neither lift off nor slide."""
        tangents = np.zeros((3, 3, len(self.vertical_n_m)))
        tangents[0, 0], tangents[1, 1], tangents[2, 2] = *self.sideways_n_m, self.vertical_n_m
        return tangents

    def resisted(self, gaps_m: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return forces (3, q) on what lies above gaps (3, q), and by how much these fall with them, (3, 3, q)."""
        wanted = -self.vertical_n_m * gaps_m[2]
        acts = self.pulls | (wanted > 0.0)
        upwards = np.where(acts, wanted, 0.0)
        held = -self.sideways_n_m * gaps_m[:2]
        size = np.sqrt(held[0] * held[0] + held[1] * held[1])
        limit = self._limits()
        slides = size > limit
        share = np.divide(limit, size, out=np.ones_like(size), where=slides)
        forces = np.stack((share * held[0], share * held[1], upwards))
        tangents = self.whole
        tangents[2, 2] *= acts
        tangents[:2, :2] *= share
        across = np.divide(share, size * size, out=np.zeros_like(size), where=slides)
        tangents[:2, :2] -= across * held[:, None] * held * self.sideways_n_m
        return forces, tangents

    def _limits(self) -> FloatArray:
        """Largest forces sideways (q,)."""
        holds = np.isinf(self.friction)
        by_friction = np.where(holds, 0.0, self.friction) * self.pressed_n
        return np.where(holds & (self.pulls | (self.pressed_n > 0.0)), np.inf, by_friction)


@dataclass(frozen=True, slots=True, eq=False)
class PadsAtRest:
    """Forces of c connections by pads, and their stiffness, at certain positions of the bodies."""

    rows: IntArray  # (c,)
    blocks: tuple[FloatArray, FloatArray, FloatArray]  # (6, 6, c), for the first and second bodies, and between
    loads: tuple[FloatArray, FloatArray]  # (6, c), on the first and on the second bodies


class Bearings:
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
        self.rows, self._springs = springs.rows, springs
        one, other, of = first[self.rows], second[self.rows], springs.parts
        self._above_first = one == above
        below = np.where(self._above_first, other, one)
        self._of, self._above, self._below = of, above[of], below[of]
        self._anchors, self._anchors_below, self._middles = (
            turned_back(rotations[..., bodies], places - positions_m[:, bodies])
            for bodies, places in (
                (self._above, springs.places_m.T),
                (self._below, springs.places_m.T),
                (above, springs.middles_m().T),
            )
        )
        self._of_above = above
        sideways, unpressed = springs.sideways_n_m.T.copy(), np.zeros(len(of))
        self._law = PadLaw(springs.vertical_n_m, sideways, springs.friction[of], springs.pulls[of], unpressed)
        self._free = np.zeros((3, len(of)))  # gaps at which springs resist nothing
        self._forces_n = np.zeros((3, len(of)))
        self._pressed_n = np.full(len(of), np.nan)  # pressing forces as they were solved last
        self._gone = np.zeros(len(self.rows), bool)
        self._solved_for = np.full((3, 3, len(of)), np.nan)

    def settle(self, positions_m: FloatArray, rotations: FloatArray) -> None:
        """Take over, before a sub-step, how far springs have slid, and which bodies have left each other."""
        gaps = self._gaps(positions_m, rotations)[0]
        unknown = np.isnan(self._pressed_n)
        self._pressed_n[unknown] = self._pressing(gaps)[unknown]
        self._law = replace(self._law, pressed_n=self._holding_by(self._pressed_n))
        self._forces_n = self._law.resisted(gaps - self._free)[0]
        sideways = self._law.sideways_n_m
        slid = gaps[:2] + np.divide(self._forces_n[:2], sideways, out=np.zeros_like(sideways), where=sideways > 0.0)
        slides = ~np.isinf(self._law.friction) | (~self._law.pulls & (self._law.pressed_n <= 0.0))
        self._free[:2, slides] = slid[:, slides]
        counts = np.bincount(self._of, minlength=len(self.rows))
        apart = np.stack([self._summed(gap) / counts for gap in gaps])
        self._gone = np.sqrt((apart * apart).sum(axis=0)) > self._springs.travel_m

    def failed(self, intact: BoolArray, left: FloatArray) -> IntArray:
        """Return which connections (k,) of those (m,) that are intact break, as it settled last.

        A connection breaks alone where its bodies have left each other, all of a bearing by its force; `left` (m,) is
        the part of its strength that each has.
        """
        holds = intact[self.rows]
        of_parts = np.stack([self._summed(force) for force in self._forces_n]) * holds
        return self.rows[holds & (self._gone | (self._springs.utilisations(of_parts, left[self.rows]) > 1.0))]

    @property
    def touching(self) -> FloatArray:
        """Part (c,) of the stiffness of each connection that acts, from 0 to 1, as it settled last."""
        stiffness = self._law.vertical_n_m
        acts = self._law.pulls | (self._pressed_n > 0.0)
        return self._summed(np.where(acts, stiffness, 0.0)) / self._summed(stiffness)

    def diagonal(self) -> FloatArray:
        """Return the stiffness (6, c) along x, y and z, and about these, of connections that are pressed all over."""
        law, springs = self._law, self._springs
        x, y, _ = (springs.places_m - springs.middles_m()[self._of]).T
        along_x, along_y, up = *law.sideways_n_m, law.vertical_n_m
        about_z = x * x * along_y + y * y * along_x
        return np.stack([self._summed(k) for k in (along_x, along_y, up, y * y * up, x * x * up, about_z)])

    def stored_j(self, positions_m: FloatArray, rotations: FloatArray) -> FloatArray:
        """Return the energy (c,) that the springs would give back."""
        forces = self._law.resisted(self._gaps(positions_m, rotations)[0] - self._free)[0]
        stiffness = np.stack((*self._law.sideways_n_m, self._law.vertical_n_m))
        doubled = np.divide(forces * forces, stiffness, out=np.zeros_like(forces), where=stiffness > 0.0)
        return self._summed(0.5 * doubled.sum(axis=0))

    def pressed_at(self, positions_m: FloatArray, rotations: FloatArray) -> FloatArray:
        """Return the pressing forces (p,) by which springs hold sideways, with bodies at these positions."""
        return self._holding_by(self._pressing(self._gaps(positions_m, rotations)[0]))

    def at_rest(self, positions_m: FloatArray, rotations: FloatArray, pressed_n: FloatArray | None) -> PadsAtRest:
        """Return forces and stiffness with bodies at these positions.

        Springs slide by friction times `pressed_n` (p,); without it they neither slide nor lift off.
        """
        gaps, arms, arms_below = self._gaps(positions_m, rotations)
        if pressed_n is None:
            forces, tangents = -turned(self._law.whole, gaps), self._law.whole
        else:
            forces, tangents = replace(self._law, pressed_n=pressed_n).resisted(gaps)
        above, below = motion_of_points(arms), motion_of_points(arms_below)
        stiff_above, stiff_below = matrix_products(tangents, above), matrix_products(tangents, below)
        blocks = self._ordered(
            self._summed_matrices(matrix_products(transposed(above), stiff_above)),
            self._summed_matrices(matrix_products(transposed(below), stiff_below)),
        )
        between = -self._summed_matrices(matrix_products(transposed(above), stiff_below))
        between = np.where(self._above_first, between, np.swapaxes(between, 0, 1))
        loads = self._ordered(*(self._moved_to_centres(arm, f) for arm, f in ((arms, forces), (arms_below, -forces))))
        return PadsAtRest(self.rows, (*blocks, between), loads)

    def add_stiffness(
        self,
        blocks: Sequence[FloatArray],
        connections: IntArray,
        positions_m: FloatArray,
        rotations: FloatArray,
        pressed_n: FloatArray | None,
    ) -> None:
        """Add the stiffness `at_rest` to the blocks (6, 6, r) of connections (r,), which are in ascending order."""
        mine = np.flatnonzero(np.isin(self.rows, connections))
        at = np.searchsorted(connections, self.rows[mine])
        for block, more in zip(blocks, self.at_rest(positions_m, rotations, pressed_n).blocks, strict=True):
            block[..., at] += more[..., mine]

    def loads_at_rest(self, positions_m: FloatArray, rotations: FloatArray) -> FloatArray:
        """Return forces and moments (6, c) on the first bodies, about the middle of each connection's springs."""
        gaps, arms, _ = self._gaps(positions_m, rotations)
        forces = replace(self._law, pressed_n=self._holding_by(self._pressing(gaps))).resisted(gaps)[0]
        middles = turned(rotations[..., self._of_above], self._middles)
        on_above = self._moved_to_centres(arms - middles[:, self._of], forces)
        return np.where(self._above_first, on_above, -on_above)

    def in_substep(
        self, chosen: IntArray, positions_m: FloatArray, rotations: FloatArray, substep_s: float
    ) -> BearingStep:
        """Return what some connections (c,) do in a sub-step of a length in s."""
        number = np.full(len(self.rows), -1)
        number[chosen] = np.arange(len(chosen))
        which = np.flatnonzero(number[self._of] >= 0)
        gaps, arms, arms_below = (gap[:, which] for gap in self._gaps(positions_m, rotations))
        between = Gaps(self._below[which], self._above[which], arms_below, arms, gaps - self._free[:, which])
        return BearingStep(
            self.rows[chosen],
            self._above_first[chosen],
            number[self._of[which]],
            between,
            self._law.only(which),
            SolvedPads(SolvedTangents(self._solved_for, which), self._pressed_n, which),
            substep_s,
        )

    def _pressing(self, gaps_m: FloatArray) -> FloatArray:
        """Pressing forces (p,) of springs with these gaps."""
        own: FloatArray = np.maximum(-self._law.vertical_n_m * gaps_m[2], 0.0)
        return own

    def _holding_by(self, own: FloatArray) -> FloatArray:
        """Pressing forces (p,) by which springs hold sideways: their own, or all of a bearing that does not slide."""
        bearing = self._springs.bearings[self._of]
        whole = np.bincount(bearing, own, int(bearing.max(initial=-1)) + 1)[bearing]
        return np.where(np.isinf(self._law.friction), whole, own)

    def _gaps(self, positions_m: FloatArray, rotations: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Gaps (3, p) below the bodies above, and arms (3, p) of the force there, from the centres of both bodies."""
        arms = turned(rotations[..., self._above], self._anchors)
        below = turned(rotations[..., self._below], self._anchors_below)
        gaps = positions_m[:, self._above] - positions_m[:, self._below] + arms - below
        return gaps, arms, below + gaps

    def _ordered(self, above: FloatArray, below: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return what is of the bodies above and below (…, c) as of the first and second bodies."""
        return np.where(self._above_first, above, below), np.where(self._above_first, below, above)

    def _moved_to_centres(self, arms_m: FloatArray, forces_n: FloatArray) -> FloatArray:
        both = np.concatenate((forces_n, cross_products(arms_m, forces_n)))
        return np.stack([self._summed(values) for values in both])

    def _summed(self, values: FloatArray) -> FloatArray:
        return np.bincount(self._of, values, len(self.rows))

    def _summed_matrices(self, values: FloatArray) -> FloatArray:
        sums = [self._summed(entry) for entry in values.reshape(36, values.shape[2])]
        return np.stack(sums).reshape(6, 6, len(self.rows))


@dataclass(frozen=True, slots=True, eq=False)
class SolvedPads:
    """What some of all springs were solved with: tangents, and where pressing forces (p,) of all are kept."""

    tangents: SolvedTangents
    pressed_n: FloatArray
    which: IntArray

    def take_over(self, forces_n: FloatArray) -> None:
        """Keep the upward forces (q,) of these springs."""
        self.pressed_n[self.which] = np.maximum(forces_n, 0.0)


class BearingStep:
    """Forces of c connections with q springs in a sub-step.

    `rows` and `above_first` (c,): connections, and whether the first body of each lies above. `parts` (q,): connection
    of each spring. `gaps` are from the body below to the one above, and from where a spring resists nothing.
    """

    def __init__(
        self,
        rows: IntArray,
        above_first: BoolArray,
        parts: IntArray,
        gaps: Gaps,
        law: PadLaw,
        solved: SolvedPads,
        substep_s: float,
    ):
        self.rows = rows
        self._above_first, self._of, self._gaps = above_first, parts, gaps
        self._law, self._solved, self._substep_s, self._kept = law, solved.tangents, substep_s, solved
        self._begin_at(np.zeros_like(gaps.widths_m))
        size = abs(self._forces).max(axis=0)
        counts = np.bincount(parts, minlength=len(rows))
        self._slack = (_AGREES * np.bincount(parts, size, len(rows)) / counts)[parts] + _EVEN_M * law.vertical_n_m

    def changed(self) -> BoolArray:
        """Return whether each connection (c,) has other tangents than its equations."""
        return np.bincount(self._of, self._solved.differ(self._tangents), len(self.rows)) > 0

    def blocks(self, chosen: IntArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return what some (k,) add to the equations of their first and second bodies, and between, (6, 6, k)."""
        is_chosen = np.zeros(len(self.rows), bool)
        is_chosen[chosen] = True
        mine = np.flatnonzero(is_chosen[self._of])
        tangents = self._tangents[..., mine]
        self._solved.take_over(mine, tangents)
        implicit = self._substep_s * self._substep_s * tangents
        above, below = (motion_of_points(arms[:, mine]) for arms in (self._gaps.second_arms_m, self._gaps.first_arms_m))
        stiff_above, stiff_below = matrix_products(implicit, above), matrix_products(implicit, below)
        of_above, of_below, between = (
            self._summed_blocks(mine, values, chosen)
            for values in (
                matrix_products(transposed(above), stiff_above),
                matrix_products(transposed(below), stiff_below),
                -matrix_products(transposed(above), stiff_below),
            )
        )
        first = self._above_first[chosen]
        return (
            np.where(first, of_above, of_below),
            np.where(first, of_below, of_above),
            np.where(first, between, np.swapaxes(between, 0, 1)),
        )

    def loads(self, velocities: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the impulses (6, c) on the first and second bodies, which have velocities (6, n) then."""
        forces = self._linear(self._substep_s * self._gaps.rates(velocities))
        self._kept.take_over(forces[2])
        push = self._substep_s * forces
        above, below = (
            np.stack([self._summed(value) for value in np.concatenate((force, cross_products(arms, force)))])
            for force, arms in ((push, self._gaps.second_arms_m), (-push, self._gaps.first_arms_m))
        )
        return np.where(self._above_first, above, below), np.where(self._above_first, below, above)

    def agrees(self, velocities: FloatArray) -> bool:
        """Whether the forces are those that follow from velocities (6, n); if not, guess again."""
        moved = self._substep_s * self._gaps.rates(velocities)
        off = abs(self._law.resisted(self._gaps.widths_m + moved)[0] - self._linear(moved)).max(axis=0)
        if (off <= self._slack).all():
            return True
        self._begin_at(moved)
        return False

    def of_bodies(self, loads: tuple[FloatArray, FloatArray], count: int) -> FloatArray:
        """Return the sums (6, n) of loads (6, c) on the first and on the second bodies, for n bodies."""
        above, below = np.zeros((2, len(self.rows)), int)
        above[self._of], below[self._of] = self._gaps.second, self._gaps.first
        first, second = np.where(self._above_first, above, below), np.where(self._above_first, below, above)
        return summed_on_bodies(first, second, loads, count)

    def _begin_at(self, moved: FloatArray) -> None:
        """Take forces for linear about springs that have moved further (3, q)."""
        forces, self._tangents = self._law.resisted(self._gaps.widths_m + moved)
        self._forces = forces + turned(self._tangents, moved)

    def _linear(self, moved: FloatArray) -> FloatArray:
        return self._forces - turned(self._tangents, moved)

    def _summed(self, values: FloatArray) -> FloatArray:
        return np.bincount(self._of, values, len(self.rows))

    def _summed_blocks(self, mine: IntArray, values: FloatArray, chosen: IntArray) -> FloatArray:
        count = len(self.rows)
        sums = [np.bincount(self._of[mine], entry, count) for entry in values.reshape(36, len(mine))]
        return np.stack(sums)[:, chosen].reshape(6, 6, len(chosen))
