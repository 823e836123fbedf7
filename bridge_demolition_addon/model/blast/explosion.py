"""Loads of several charges on several bodies in every step of a simulation, while the bodies move and rotate."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...engineering.blast.exposure import lines_of_blast, projected_areas, visible_shares
from ...engineering.blast.pulses import Pulses, blast_pulses, charges_as_fired, impulse_between
from ...engineering.blast.wave import scaled_distance
from ...engineering.geometry.hulls import ConvexHulls
from .charges import Charge
from .settings import BlastSettings


@dataclass(frozen=True, eq=False, slots=True)
class StepLoads:
    """Loads of one step of time: k pairs of a body and a charge that loads it, structure of arrays."""

    bodies: np.ndarray  # (k,), rows of bodies
    charges: np.ndarray  # (k,), rows of charges
    stand_offs_m: np.ndarray  # (k,), from the charge to the body's centre at the detonation
    scaled_distances: np.ndarray  # (k,), m/kg^(1/3)
    areas_m2: np.ndarray  # (k,), area of the body towards the charge, times the share that the charge sees
    directions: np.ndarray  # (k, 3), unit vectors from the charge to the body at the detonation
    peaks_pa: np.ndarray  # (k,), peak overpressures
    pressure_impulses_pa_s: np.ndarray  # (k,), integrals of the overpressure over this step
    impulses_ns: np.ndarray  # (k,), impulses on the bodies along the directions in this step

    def __len__(self) -> int:
        return len(self.bodies)

    def vectors(self, count: int) -> np.ndarray:
        """Return the impulse (count, 3) on each of `count` bodies by the charges together, N·s."""
        columns = (self.impulses_ns[:, None] * self.directions).T
        return np.column_stack([np.bincount(self.bodies, column, count) for column in columns])


class Explosion:
    """Charges and the bodies around them, through time.

    Stand-offs and directions are those at the detonation: the front is faster than the bodies by far. The projected
    areas follow the rotation of the bodies.
    """

    def __init__(self, charges: Sequence[Charge], hulls: ConvexHulls, settings: BlastSettings):
        self._hulls, self._settings = hulls, settings
        self._sources_m = np.array([charge.position_m for charge in charges], float).reshape(-1, 3)
        self._detonations_s = settings.start_s + np.array([charge.delay_s for charge in charges], float)
        self._bursts = [charge.burst for charge in charges]
        self._tnt_kg, self._parts = charges_as_fired(
            self._sources_m, [charge.tnt_kg for charge in charges], self._detonations_s, self._bursts
        )
        shape = (len(hulls), len(charges))
        self._detonated = np.zeros(shape[1], bool)
        self._pulses = Pulses(np.full(shape, np.inf), np.zeros(shape), np.zeros(shape), np.zeros(shape))
        self._stand_offs, self._scaled_distances = np.zeros(shape), np.zeros(shape)
        self._directions = np.zeros((*shape, 3))
        self._shares = np.ones(shape)

    def loads(self, start_s: float, end_s: float, centres: np.ndarray, rotations: np.ndarray) -> StepLoads:
        """Return the exact loads of a step of simulated time.

        Centres of mass (n, 3), m, and rotations (n, 3, 3) from body axes to world axes are taken at its beginning.
        """
        self._detonate(np.flatnonzero(~self._detonated & (self._detonations_s < end_s)), centres, rotations)
        pulses = self._pulses
        during = pulses.load_between(start_s, end_s)
        pairs = np.flatnonzero(during)
        if not len(pairs):
            return no_loads()
        bodies, charges = np.divmod(pairs, during.shape[1])
        active = np.flatnonzero(during.any(axis=0))
        shown = projected_areas(self._hulls, rotations, self._directions[:, active])
        areas = shown[bodies, np.searchsorted(active, charges)] * self._shares.take(pairs)
        taken = pulses.take(pairs)
        pressure_impulses = impulse_between(taken, start_s, end_s)
        return StepLoads(
            bodies=bodies,
            charges=charges,
            stand_offs_m=self._stand_offs.take(pairs),
            scaled_distances=self._scaled_distances.take(pairs),
            areas_m2=areas,
            directions=self._directions.reshape(-1, 3).take(pairs, axis=0),
            peaks_pa=taken.peaks_pa,
            pressure_impulses_pa_s=pressure_impulses,
            impulses_ns=pressure_impulses * areas,
        )

    def is_quiet(self, start_s: float, end_s: float) -> bool:
        """Return whether nothing is loaded between two times, wherever the bodies are."""
        if (~self._detonated & (self._detonations_s < end_s)).any():
            return False
        return not self._pulses.load_between(start_s, end_s).any()

    def _detonate(self, columns: np.ndarray, centres: np.ndarray, rotations: np.ndarray) -> None:
        """Fix lines, pulses and shares of some charges (k,) as the bodies are now."""
        if not len(columns):
            return
        sources, settings = self._sources_m[columns], self._settings
        stand_offs, directions = lines_of_blast(sources, centres)
        pulses = blast_pulses(
            stand_offs,
            self._tnt_kg[columns],
            self._detonations_s[columns],
            [self._bursts[column] for column in columns],
            model=settings.model,
            loading=settings.loading,
            constant_decay=settings.constant_decay,
            pressure_factor=settings.pressure_factor * self._parts[columns],
        )
        self._pulses.put(columns, pulses)
        self._stand_offs[:, columns], self._directions[:, columns] = stand_offs, directions
        self._scaled_distances[:, columns] = scaled_distance(stand_offs, self._tnt_kg[columns])
        if settings.shielding:
            self._shares[:, columns] = visible_shares(self._hulls, centres, rotations, sources)
        self._detonated[columns] = True


def no_loads() -> StepLoads:
    """Return the loads of a step in which there are none."""
    nothing, none = np.zeros(0), np.zeros(0, int)
    return StepLoads(none, none, nothing, nothing, nothing, np.zeros((0, 3)), nothing, nothing, nothing)


def sum_of_loads(steps: Sequence[StepLoads]) -> StepLoads:
    """Sum the loads of consecutive steps of time into one step.

    The area, which changes from step to step, is the mean weighted by pressure impulse.
    """
    if not steps:
        return no_loads()
    if len(steps) > 1 and all(_load_the_same(steps[0], step) for step in steps[1:]):
        once = steps[0]
        impulses, pressures = once.impulses_ns.copy(), once.pressure_impulses_pa_s.copy()
        for step in steps[1:]:  # one after another, as they are added below
            impulses += step.impulses_ns
            pressures += step.pressure_impulses_pa_s
        return _with_sums(once, impulses, pressures)
    every = StepLoads(*(np.concatenate([getattr(step, name) for step in steps]) for name in _COLUMNS))
    pairs = every.bodies * (1 + every.charges.max(initial=0)) + every.charges
    pairs, rows, groups = np.unique(pairs, return_index=True, return_inverse=True)
    impulses = np.bincount(groups.ravel(), every.impulses_ns, len(pairs))
    pressures = np.bincount(groups.ravel(), every.pressure_impulses_pa_s, len(pairs))
    return _with_sums(StepLoads(*(getattr(every, name)[rows] for name in _COLUMNS)), impulses, pressures)


def _load_the_same(one: StepLoads, other: StepLoads) -> bool:
    """Return whether two steps have the same pairs of bodies and charges."""
    return np.array_equal(one.bodies, other.bodies) and np.array_equal(one.charges, other.charges)


def _with_sums(first: StepLoads, impulses: np.ndarray, pressures: np.ndarray) -> StepLoads:
    """Return the loads of k pairs in the first step of each, with sums (k,) of impulses and of pressure impulses."""
    areas = np.divide(impulses, pressures, where=pressures > 0.0, out=first.areas_m2.copy())
    return replace(first, impulses_ns=impulses, pressure_impulses_pa_s=pressures, areas_m2=areas)


_COLUMNS = tuple(StepLoads.__dataclass_fields__)
