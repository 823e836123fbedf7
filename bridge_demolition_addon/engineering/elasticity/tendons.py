"""Tendons: the forces by which they press bodies together, and what is left of these where they are cut or rupture.

Where a tendon passes from one body into the next it pulls the two together, along its line. So a body in which it has a
kink gets the deviation force of that, one with its anchorage the force of the anchorage, and the concrete between two
bodies the axial force and the moment of the prestress. All of it is in equilibrium with itself.

All arrays have their components first.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from .joint_rows import cross_products, dot_products, turned, turned_back

MODULUS_PA = 195e9
"""Modulus of elasticity of strands: EN 1992-1-1:2004, 3.3.6 (3)."""

RUPTURE_STRAIN = 0.035
"""Least strain of prestressing steel under the largest force: EN 10138, and EN 1992-1-1:2004, 3.3.4 (5)."""

LEAST_RELEASED_J = 1.0
"""Energy that a tendon lets go, from which on it is said: less is rounding."""

_SUDDEN, _STRANDS = 1.25, 0.19
"""α1 of a sudden release and α2 of strands of 3 and 7 wires: EN 1992-1-1:2004, 8.10.2.2 (2), equation 8.16."""

_BOND, _GOOD_CONDITIONS = 3.2, 1.0
"""η_p1 of these strands and η_1 of good bond conditions: ibid., (1), equation 8.15."""


def transmission_length_m(diameter_m: float, prestress_pa: float, tensile_pa: float) -> float:
    """Return the length over which bond takes up the prestress of a strand: EN 1992-1-1:2004, 8.10.2.2.

    With the mean strength of the concrete in tension instead of its design value, as everywhere here.
    """
    bond_pa = _BOND * _GOOD_CONDITIONS * tensile_pa
    return _SUDDEN * _STRANDS * diameter_m * prestress_pa / bond_pa


@dataclass(frozen=True, slots=True, eq=False)
class TendonSteel:
    """t tendons. `transmission_m` counts for those that are bonded, and at the ends of those without anchorages."""

    forces_n: FloatArray  # (t,), of their prestress
    areas_m2: FloatArray  # (t,)
    lengths_m: FloatArray  # (t,)
    transmission_m: FloatArray  # (t,)
    bonded: BoolArray  # (t,)
    anchored: BoolArray  # (t,)

    def shares(self, tendon: int, cuts_m: FloatArray, distances_m: FloatArray) -> FloatArray:
        """Return the parts (k,) of its force that a tendon has at distances (k,), after cuts at distances (c,)."""
        if not self.bonded[tendon]:
            return np.full(len(distances_m), 0.0 if len(cuts_m) else 1.0)
        free = self._free_ends_m(tendon, cuts_m)
        if not len(free):
            return np.ones(len(distances_m))
        away = np.abs(distances_m[:, None] - free).min(axis=1)
        shares: FloatArray = np.minimum(away / self.transmission_m[tendon], 1.0)
        return shares

    def shares_at(self, passages: TendonPassages, cuts: Sequence[CutTendon] = ()) -> FloatArray:
        """Return the parts (k,) of their forces that tendons have at passages, after cuts."""
        shares = np.ones(len(passages.tendons))
        for tendon in np.unique(passages.tendons).tolist():
            mine = np.flatnonzero(passages.tendons == tendon)
            at = np.array([cut.distance_m for cut in cuts if cut.tendon == tendon])
            shares[mine] = self.shares(tendon, at, passages.distances_m[mine])
        return shares

    def stored_j(self, tendon: int, cuts_m: FloatArray) -> float:
        """Return the energy in a tendon after cuts at distances (c,), ∫ F² / 2 E A: of its prestress alone."""
        free, length_m = self._free_ends_m(tendon, cuts_m), float(self.lengths_m[tendon])
        reach_m = float(self.transmission_m[tendon])
        between = 0.5 * (free[1:] + free[:-1])
        kinks = np.concatenate((np.array((0.0, length_m)), free, free - reach_m, free + reach_m, between))
        kinks = np.unique(np.clip(kinks, 0.0, length_m))
        shares = self.shares(tendon, cuts_m, kinks)
        one, other = shares[:-1], shares[1:]
        squares = float((np.diff(kinks) * (one * one + one * other + other * other) / 3.0).sum())
        force_n = float(self.forces_n[tendon])
        return force_n * force_n * squares / (2.0 * MODULUS_PA * float(self.areas_m2[tendon]))

    def _free_ends_m(self, tendon: int, cuts_m: FloatArray) -> FloatArray:
        """Distances (e,), ascending, at which a bonded tendon has no force."""
        own = np.zeros(0) if self.anchored[tendon] else np.array((0.0, self.lengths_m[tendon]))
        return np.unique(np.concatenate((own, cuts_m)))


@dataclass(frozen=True, slots=True)
class CutTendon:
    """A tendon that is cut, at a distance along it."""

    tendon: int
    distance_m: float


@dataclass(frozen=True, slots=True, eq=False)
class TendonPassages:
    """Where tendons pass from body to body, k times, in the bridge as it was built."""

    tendons: IntArray  # (k,), which of them
    first: IntArray  # (k,), bodies that they leave
    second: IntArray  # (k,), bodies that they enter
    distances_m: FloatArray  # (k,), along the tendon
    points_m: FloatArray  # (3, k)
    directions: FloatArray  # (3, k), from the first to the second
    connections: IntArray  # (k,), between these bodies; -1 for none
    openings_m: FloatArray  # (k,), of a crack at which the tendon ruptures; infinite without bond
    of_bars: FloatArray  # (k,), part of the bars across the connection that is the tendon's, by force at yield

    def only(self, which: IntArray | BoolArray) -> TendonPassages:
        """Return some of them."""
        return TendonPassages(*(getattr(self, item.name)[..., which] for item in fields(self)))

    def cuts_at(self, rows: IntArray) -> list[CutTendon]:
        """Return cuts at some of them (c,)."""
        pairs = zip(self.tendons[rows].tolist(), self.distances_m[rows].tolist(), strict=True)
        return [CutTendon(*pair) for pair in pairs]

    def crossing(self, connections: IntArray, bodies: IntArray) -> list[CutTendon]:
        """Return cuts where tendons pass through connections (c,), or in or out of bodies (b,)."""
        hit = np.isin(self.connections, connections) & (self.connections >= 0)
        hit |= np.isin(self.first, bodies) | np.isin(self.second, bodies)
        return self.cuts_at(np.flatnonzero(hit))


class TendonForces:
    """Forces of tendons on n bodies, of positions (3, n) and rotations (3, 3, n) as they were built.

    A tendon goes with the bodies that it crosses: it does not buckle what it presses. `shares` (k,) is the part of its
    force that a tendon has at each passage.
    """

    def __init__(self, steel: TendonSteel, passages: TendonPassages, positions_m: FloatArray, rotations: FloatArray):
        self._steel, self.passages = steel, passages
        self._count, self._tendons = positions_m.shape[1], len(steel.forces_n)
        ends = (passages.first, passages.second)
        self._lines = [turned_back(rotations[..., end], passages.directions) for end in ends]
        self._anchors = [turned_back(rotations[..., end], passages.points_m - positions_m[:, end]) for end in ends]
        self.cuts: list[CutTendon] = []
        self.shares = steel.shares_at(passages)

    def cut(self, cuts: Sequence[CutTendon]) -> FloatArray:
        """Cut tendons; return the energy (t,) in J that each lets go."""
        before = self.stored_j()
        known = {(cut.tendon, cut.distance_m) for cut in self.cuts}
        self.cuts = [*self.cuts, *(cut for cut in cuts if (cut.tendon, cut.distance_m) not in known)]
        self.shares = self._steel.shares_at(self.passages, self.cuts)
        return before - self.stored_j()

    def stored_j(self) -> FloatArray:
        """Return the energy (t,) in each tendon."""
        return np.array([self._steel.stored_j(tendon, self._cuts_of(tendon)) for tendon in range(self._tendons)])

    def update_plastic_state(self, positions_m: FloatArray, rotations: FloatArray) -> FloatArray:
        """Cut tendons where cracks have opened so far that they rupture; return the energy (t,) that they let go."""
        holds = np.flatnonzero((self.shares > 0.0) & np.isfinite(self.passages.openings_m))
        if not len(holds):
            return np.zeros(self._tendons)
        gaps = self._gaps(positions_m, rotations)[2][:, holds]
        wide = holds[np.sqrt(dot_products(gaps, gaps)) > self.passages.openings_m[holds]]
        if not len(wide):
            return np.zeros(self._tendons)
        return self.cut(self.passages.cuts_at(wide))

    def loads(self, positions_m: FloatArray, rotations: FloatArray) -> FloatArray:
        """Return the forces and moments about their centres (6, n) on bodies at positions and in rotations."""
        passages = self.passages
        first_arms, second_arms, gaps = self._gaps(positions_m, rotations)
        first_arms, second_arms = first_arms + 0.5 * gaps, second_arms - 0.5 * gaps
        along = turned(rotations[..., passages.first], self._lines[0])
        along = along + turned(rotations[..., passages.second], self._lines[1])
        size = np.sqrt(dot_products(along, along))
        along = np.divide(along, size, out=np.zeros_like(along), where=size > 0.0)
        forces = self.forces_n * along
        on_first = np.concatenate((forces, cross_products(first_arms, forces)))
        on_second = np.concatenate((-forces, -cross_products(second_arms, forces)))
        bodies = np.concatenate((passages.first, passages.second))
        both = np.concatenate((on_first, on_second), axis=1)
        return np.stack([np.bincount(bodies, component, self._count) for component in both])

    @property
    def forces_n(self) -> FloatArray:
        """Forces (k,) of the tendons at the passages."""
        forces: FloatArray = self.shares * self._steel.forces_n[self.passages.tendons]
        return forces

    def bars_left(self, count: int) -> FloatArray:
        """Return the part (m,) of the bars across each of m connections that is left after the cuts."""
        left, passages = np.ones(count), self.passages
        rows = np.flatnonzero(passages.connections >= 0)
        lost = passages.of_bars[rows] * (1.0 - self._whole_shares(rows))
        np.subtract.at(left, passages.connections[rows], lost)
        return np.maximum(left, 0.0)

    def copy(self) -> TendonForces:
        """Return tendons in the same state, which go on by themselves."""
        other = object.__new__(TendonForces)
        other.__dict__.update(self.__dict__)
        return other

    def _whole_shares(self, rows: IntArray) -> FloatArray:
        """Shares of passages by those without cuts: bars near ends without anchorages are held as they were."""
        before = self._steel.shares_at(self.passages)[rows]
        return np.divide(self.shares[rows], before, out=np.ones(len(rows)), where=before > 0.0)

    def _cuts_of(self, tendon: int) -> FloatArray:
        return np.array([cut.distance_m for cut in self.cuts if cut.tendon == tendon])

    def _gaps(self, positions_m: FloatArray, rotations: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return arms (3, k) from the centres of both bodies to their points, and gaps from the first to the second."""
        passages = self.passages
        arms = [
            turned(rotations[..., end], anchors)
            for end, anchors in zip((passages.first, passages.second), self._anchors, strict=True)
        ]
        gaps = positions_m[:, passages.second] + arms[1] - positions_m[:, passages.first] - arms[0]
        return arms[0], arms[1], gaps
