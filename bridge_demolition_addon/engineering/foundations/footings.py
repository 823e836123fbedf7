"""Footings on springs: what they bear in a sub-step, in the equations of the elastic structure.

Under each footing are places, each with its part of the area. A place presses by stiffness, area and settlement, and
never pulls: E. Winkler (1867), Die Lehre von der Elastizität und Festigkeit. Where the pressure reaches what the soil
bears, it stays there and the place settles for good. Along the ground it holds as a spring up to its friction, by the
pressure at the beginning of the sub-step, and slides beyond it.

A sub-step is implicit, and solved as `elasticity.cracks` is: forces are linear about a guess, which is followed by
another until both agree.

All arrays have their components first.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..elasticity.joint_rows import cross_products, matrix_products, transposed, turned, turned_back

_AGREES = 1e-4
"""Part of the mean force of the places under a footing by which that of one may be off."""

_EVEN_M = 1e-10
"""Settlement that is none."""

_ANY = 1e300
"""Pressure by which friction holds any slip."""


@dataclass(frozen=True, slots=True, eq=False)
class SoilSprings:
    """Springs under f footings, at p places.

    Attributes
    ----------
    rows : (f,) int
        Connection of each footing with the ground, in ascending order.
    footings : (p,) int
        Footing of each place, in ascending order.
    places_m : (p, 3) float
        Where they are as the bridge was built.
    areas_m2 : (p,) float
        Their parts of the area.
    stiffness_n_m3, horizontal_n_m3 : (f,) float
        Pressure by settlement, and shear by slip.
    capacity_pa, friction : (f,) float
        Largest pressure, which may be infinite, and largest shear by pressure.
    """

    rows: np.ndarray
    footings: np.ndarray
    places_m: np.ndarray
    areas_m2: np.ndarray
    stiffness_n_m3: np.ndarray
    horizontal_n_m3: np.ndarray
    capacity_pa: np.ndarray
    friction: np.ndarray


class Footings:
    """All footings of a structure of n bodies.

    Parameters
    ----------
    springs : SoilSprings
    first, second : (m,) int
        Bodies of all connections, of which those of footings have the ground as one.
    moves : (n,) bool
        Whether each body can move.
    positions_m, rotations : (3, n) and (3, 3, n) float
        As the bridge was built.

    Attributes
    ----------
    rows : (f,) int
        Connections, in ascending order.
    """

    def __init__(
        self,
        springs: SoilSprings,
        first: np.ndarray,
        second: np.ndarray,
        moves: np.ndarray,
        positions_m: np.ndarray,
        rotations: np.ndarray,
    ):
        self.rows = springs.rows
        one, other, of = first[self.rows], second[self.rows], springs.footings
        self._stands_first = moves[one]
        standing, ground = np.where(self._stands_first, one, other), np.where(self._stands_first, other, one)
        self._of, self._standing, self._ground = of, standing[of], ground[of]
        self._anchors, self._ground_anchors = (
            turned_back(rotations[..., each], springs.places_m.T - positions_m[:, each])
            for each in (self._standing, self._ground)
        )
        areas = springs.areas_m2
        self._soil = _Soil(
            areas * springs.stiffness_n_m3[of],
            areas * springs.horizontal_n_m3[of],
            areas * springs.capacity_pa[of],
            springs.friction[of],
        )
        self._unloaded, self._pressed = np.zeros((3, len(of))), np.zeros(len(of))
        self._solved_for = np.full((3, 3, len(of)), np.nan)

    def settle(self, positions_m: np.ndarray, rotations: np.ndarray) -> None:
        """Take over, before a sub-step, how far places have settled or slid for good.

        Parameters
        ----------
        positions_m, rotations : (3, n) and (3, 3, n) float
            Of all bodies.
        """
        gaps = self._gaps(positions_m, rotations)[0]
        soil = self._soil
        deepest = soil.capacity_n / soil.vertical_n_m
        self._unloaded[2] = np.minimum(self._unloaded[2], gaps[2] + deepest)
        forces = soil.borne(gaps - self._unloaded, _ANY)[0]
        self._pressed = forces[2]
        size = np.sqrt(forces[0] * forces[0] + forces[1] * forces[1])
        limit = soil.friction * self._pressed
        share = np.divide(limit, size, out=np.ones_like(size), where=size > limit)
        for axis in range(2):
            self._unloaded[axis] = gaps[axis] + share * forces[axis] / soil.horizontal_n_m
        lifted = self._pressed <= 0.0
        self._unloaded[:2, lifted] = gaps[:2, lifted]

    @property
    def touching(self) -> np.ndarray:
        """Part (f,) of the stiffness of each footing that is pressed, from 0 to 1, as it settled last."""
        pressed = np.where(self._pressed > 0.0, self._soil.vertical_n_m, 0.0)
        return self._summed(pressed) / self._summed(self._soil.vertical_n_m)

    def stored_j(self, positions_m: np.ndarray, rotations: np.ndarray) -> np.ndarray:
        """Return the energy (f,) that the springs would give back."""
        forces = self._soil.borne(self._gaps(positions_m, rotations)[0] - self._unloaded, self._pressed)[0]
        along = forces[0] * forces[0] + forces[1] * forces[1]
        doubled = forces[2] * forces[2] / self._soil.vertical_n_m + along / self._soil.horizontal_n_m
        return self._summed(0.5 * doubled)

    def in_substep(
        self, chosen: np.ndarray, positions_m: np.ndarray, rotations: np.ndarray, substep_s: float
    ) -> FootingStep:
        """Return what some footings (c,) do in a sub-step of a length in s."""
        number = np.full(len(self.rows), -1)
        number[chosen] = np.arange(len(chosen))
        which = np.flatnonzero(number[self._of] >= 0)
        gaps, arms, ground_arms = (each[:, which] for each in self._gaps(positions_m, rotations))
        return FootingStep(
            self.rows[chosen],
            self._stands_first[chosen],
            number[self._of[which]],
            self._standing[which],
            self._ground[which],
            arms,
            ground_arms,
            gaps - self._unloaded[:, which],
            self._soil.only(which),
            self._pressed[which],
            substep_s,
            self._solved_for,
            which,
        )

    def _gaps(self, positions_m: np.ndarray, rotations: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Where places are: from where they were built on the ground, and from the bodies that stand and the ground."""
        arms = turned(rotations[..., self._standing], self._anchors)
        on_ground = turned(rotations[..., self._ground], self._ground_anchors)
        between = positions_m[:, self._standing] - positions_m[:, self._ground]
        gaps = between + arms - on_ground
        return gaps, arms, on_ground + gaps

    def _summed(self, values: np.ndarray) -> np.ndarray:
        return np.bincount(self._of, values, len(self.rows))


class FootingStep:
    """What c footings with q places do in a sub-step.

    Parameters
    ----------
    rows, stands_first : (c,) int, (c,) bool
        Connections, and whether the first body of each is the one that stands on the ground.
    footings, standing, ground : (q,) int
        Footing of each place, and the bodies that press there.
    arms_m, ground_arms_m, gaps_m : (3, q) float
        From the centres of these to the places, and how far these are from where they bear nothing.
    soil, pressed_n : _Soil, (q,) float
        The springs, and how they are pressed as it begins.
    substep_s : float
    solved_for : (3, 3, p) float
        Tangents of all places for which equations were made last.
    which : (q,) int
        Which of these the places are.

    Attributes
    ----------
    rows : (c,) int
        As given.
    """

    def __init__(
        self,
        rows: np.ndarray,
        stands_first: np.ndarray,
        footings: np.ndarray,
        standing: np.ndarray,
        ground: np.ndarray,
        arms_m: np.ndarray,
        ground_arms_m: np.ndarray,
        gaps_m: np.ndarray,
        soil: _Soil,
        pressed_n: np.ndarray,
        substep_s: float,
        solved_for: np.ndarray,
        which: np.ndarray,
    ):
        self.rows = rows
        self._stands_first, self._of, self._standing, self._ground = stands_first, footings, standing, ground
        self._arms, self._ground_arms, self._gaps = arms_m, ground_arms_m, gaps_m
        self._soil, self._pressed, self._substep_s = soil, pressed_n, substep_s
        self._solved_for, self._which = solved_for, which
        counts = np.bincount(footings, minlength=len(rows))
        self._slack = (_AGREES * np.bincount(footings, pressed_n, len(rows)) / counts)[footings]
        self._slack += _EVEN_M * soil.vertical_n_m
        self._begin_at(np.zeros_like(gaps_m))

    def changed(self) -> np.ndarray:
        """Which footings (c,) have other tangents than their equations."""
        differs = (self._tangents != self._solved_for[..., self._which]).any(axis=(0, 1))
        return np.bincount(self._of, differs, len(self.rows)) > 0

    def blocks(self, chosen: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return what footings (k,) add to the equations of their first and second bodies, and between, (6, 6, k)."""
        is_chosen = np.zeros(len(self.rows), bool)
        is_chosen[chosen] = True
        mine = np.flatnonzero(is_chosen[self._of])
        tangents = self._tangents[..., mine]
        self._solved_for[..., self._which[mine]] = tangents
        moving = _motion_of_points(self._arms[:, mine])
        implicit = self._substep_s * self._substep_s * tangents
        stiff = matrix_products(transposed(moving), matrix_products(implicit, moving)).reshape(36, -1)
        count = len(self.rows)
        sums = np.stack([np.bincount(self._of[mine], each, count) for each in stiff])[:, chosen].reshape(6, 6, -1)
        first = self._stands_first[chosen]
        return np.where(first, sums, 0.0), np.where(first, 0.0, sums), np.zeros_like(sums)

    def loads(self, velocities: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the impulses (6, c) on the first and second bodies of footings, which have velocities (6, n) then."""
        push = self._substep_s * self._linear(self._substep_s * self._rates(velocities))
        standing, ground = (
            self._summed(np.concatenate((force, cross_products(arms, force))))
            for force, arms in ((push, self._arms), (-push, self._ground_arms))
        )
        return np.where(self._stands_first, standing, ground), np.where(self._stands_first, ground, standing)

    def agrees(self, velocities: np.ndarray) -> bool:
        """Whether the forces are those of the settlement that follows from velocities (6, n); if not, guess anew."""
        moved = self._substep_s * self._rates(velocities)
        off = abs(self._soil.borne(self._gaps + moved, self._pressed)[0] - self._linear(moved)).max(axis=0)
        if (off <= self._slack).all():
            return True
        self._begin_at(moved)
        return False

    def of_bodies(self, loads: tuple[np.ndarray, np.ndarray], count: int) -> np.ndarray:
        """Return the sums (6, n) of loads (6, c) on the bodies that stand, for n bodies; the ground does not move."""
        standing = np.where(self._stands_first, *loads)
        bodies = np.zeros(len(self.rows), int)
        bodies[self._of] = self._standing
        return np.stack([np.bincount(bodies, each, count) for each in standing])

    def _begin_at(self, moved: np.ndarray) -> None:
        """Take forces for linear about places that have moved further (3, q)."""
        forces, self._tangents = self._soil.borne(self._gaps + moved, self._pressed)
        self._forces = forces + turned(self._tangents, moved)

    def _linear(self, moved: np.ndarray) -> np.ndarray:
        return self._forces - turned(self._tangents, moved)

    def _rates(self, velocities: np.ndarray) -> np.ndarray:
        """How fast the places (3, q) move over the ground."""
        standing, ground = velocities[:, self._standing], velocities[:, self._ground]
        moving = standing[:3] + cross_products(standing[3:], self._arms)
        return moving - ground[:3] - cross_products(ground[3:], self._ground_arms)

    def _summed(self, values: np.ndarray) -> np.ndarray:
        return np.stack([np.bincount(self._of, each, len(self.rows)) for each in values])


@dataclass(frozen=True, slots=True, eq=False)
class _Soil:
    """Springs at q places: stiffness (q,), largest pressing force (q,), and largest force along the ground by that."""

    vertical_n_m: np.ndarray
    horizontal_n_m: np.ndarray
    capacity_n: np.ndarray
    friction: np.ndarray

    def only(self, which: np.ndarray) -> _Soil:
        """Return some of the springs."""
        found = self.vertical_n_m, self.horizontal_n_m, self.capacity_n, self.friction
        return _Soil(*(each[which] for each in found))

    def borne(self, gaps_m: np.ndarray, pressed_n: np.ndarray | float) -> tuple[np.ndarray, np.ndarray]:
        """Return forces (3, q) on what stands on gaps (3, q), and by how much these fall with them, (3, 3, q).

        Friction counts by how places were pressed.
        """
        wanted = -self.vertical_n_m * gaps_m[2]
        forces, tangents = np.zeros_like(gaps_m), np.zeros((3, *gaps_m.shape))
        forces[2] = np.clip(wanted, 0.0, self.capacity_n)
        tangents[2, 2] = np.where((wanted > 0.0) & (wanted < self.capacity_n), self.vertical_n_m, 0.0)
        along = gaps_m[:2]
        squares = _squares(along)
        size = np.sqrt(squares) * self.horizontal_n_m
        limit = self.friction * pressed_n
        slides = size > limit
        share = np.divide(limit, size, out=np.ones_like(size), where=slides)
        forces[:2] = -share * self.horizontal_n_m * along
        tangents[0, 0] = tangents[1, 1] = share * self.horizontal_n_m
        across = np.divide(share * self.horizontal_n_m, squares, out=np.zeros_like(size), where=slides)
        tangents[:2, :2] -= across * along[:, None] * along
        return forces, tangents


def _squares(vectors: np.ndarray) -> np.ndarray:
    """Return the squares (q,) of vectors (2, q)."""
    return vectors[0] * vectors[0] + vectors[1] * vectors[1]


def _motion_of_points(arms_m: np.ndarray) -> np.ndarray:
    """Matrices (3, 6, q) that give the velocities of points at arms (3, q) from those of their bodies."""
    x, y, z = arms_m
    matrices = np.zeros((3, 6, len(x)))
    matrices[[0, 1, 2], [0, 1, 2]] = 1.0
    matrices[0, 4], matrices[0, 5] = z, -y
    matrices[1, 3], matrices[1, 5] = -z, x
    matrices[2, 3], matrices[2, 4] = y, -x
    return matrices
