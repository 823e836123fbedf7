"""Fall beds, which push what has sunk into them before each sub-step."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...bullet.bodies import BodyTable
from ...engineering.geometry.vectors import length, transformed
from ...engineering.mechanics.fall_beds import friction_of, radius_m
from ...model.results.frames import Inventory
from ...model.scenario.fall_beds import FallBed
from .drivers import Driver

_LEAST_M_S = 1e-9


class FallBeds(Driver):
    """Stops shards in beds, which push upwards, and against what moves sideways in them by their friction.

    A bed resists by its weight and half of the largest force of its law, which stops it at the depth of the law; never
    by more than stops it in the sub-step. What stands in a bed at the begin is left alone.
    """

    def __init__(self, bodies: BodyTable, beds: Sequence[FallBed], inventory: Inventory, gravity_m_s2: float):
        self._table, self._beds, self._gravity = bodies, beds, gravity_m_s2
        moving = (inventory.body_kinds == "shard") & inventory.moves
        self._rows = np.flatnonzero(moving)
        self._masses, self._radii = inventory.masses_kg[self._rows], radius_m(inventory.volumes_m3[self._rows])
        corners = np.split(inventory.vertices_m, np.cumsum(inventory.vertex_counts)[:-1])
        self._corners = [corners[row] for row in self._rows.tolist()]
        self._reach = np.array([float(length(own).max()) for own in self._corners])
        self._largest_n = np.zeros((len(beds), len(self._rows)))
        standing = np.array([self._sunken(bed) for bed in beds])
        self._free = ~standing.reshape(len(beds), -1)

    def before_substep(self, elapsed_s: float, substep_s: float) -> None:
        """Push all that is in a bed."""
        velocities = self._table.velocities()[self._rows]
        for number, bed in enumerate(self._beds):
            inside = np.flatnonzero(self._sunken(bed) & self._free[number] & ~self._table.removed[self._rows])
            if not len(inside):
                continue
            forces = self._forces(number, inside, velocities[inside], substep_s)
            self._table.add_forces(self._rows[inside], forces)

    def _sunken(self, bed: FallBed) -> np.ndarray:
        """Return whether each shard (s,) reaches into a bed, with its middle over it."""
        positions, rotations = (values[self._rows] for values in self._table.positions())
        near = np.flatnonzero(positions[:, 2] - self._reach < bed.top_m)
        found = np.zeros(len(self._rows), bool)
        for row in near[bed.covers(positions[near, :2])].tolist():
            lowest = positions[row, 2] + transformed(rotations[row, 2:], self._corners[row])[:, 0].min()
            found[row] = lowest < bed.top_m and positions[row, 2] > bed.base_m
        return found

    def _forces(self, number: int, inside: np.ndarray, velocities_m_s: np.ndarray, substep_s: float) -> np.ndarray:
        bed, masses = self._beds[number], self._masses[inside]
        down = -velocities_m_s[:, 2]
        energies = 0.5 * masses * np.square(np.maximum(down, 0.0))
        largest = np.maximum(self._largest_n[number, inside], bed.forces_n(energies, self._radii[inside]))
        self._largest_n[number, inside] = largest
        weights = masses * self._gravity
        up = np.clip(weights + masses * down / substep_s, 0.0, weights + 0.5 * largest)
        speeds = length(velocities_m_s[:, :2])
        sideways = np.minimum(friction_of(bed.friction_deg) * up, masses * speeds / substep_s)
        against = -velocities_m_s[:, :2] / np.maximum(speeds, _LEAST_M_S)[:, None]
        return np.column_stack((sideways[:, None] * against, up))
