"""Reinforcement across the cracks of connections that broke by their strength, put into Bullet as forces."""

from __future__ import annotations

import numpy as np

from ...bullet.bodies import BodyTable
from ...engineering.geometry.vectors import transformed, transformed_back
from ...engineering.mechanics.reinforcement import bar_forces, effective_masses, parting
from ...model.results.inventory import Inventory
from ...model.schema import given
from ...scene.connections.breaking_settings import Breaking
from .drivers import Driver


class Reinforcement(Driver):
    """Pulls across the cracks of rigid connections with reinforcement, by one force for each that broke.

    Events keep up to date which part of its strength each connection (m,) has left. `forces_n` (m, 3) are the forces on
    the first bodies in the coming sub-step.
    """

    def __init__(self, bodies: BodyTable, inventory: Inventory, breaking: Breaking, remaining_strength: np.ndarray):
        self._bodies, self._inventory, self._ductility = bodies, inventory, given(breaking.ductility)
        self._remaining_strength = remaining_strength
        self._yield_n = self._ductility.strength_share * given(breaking.strength).tension_pa * inventory.areas_m2
        self._rows = np.zeros(0, int)
        self._anchors = np.zeros((0, 2, 3))
        self._holding_n = np.zeros(0)
        self.forces_n = np.zeros((len(inventory.pairs), 3))

    def tear(self, rows: np.ndarray, points_m: np.ndarray, axes: np.ndarray) -> None:
        """Let the reinforcement hold of connections (r,) that broke at points (r, 3), with section axes (r, 3, 3)."""
        positions_m, rotations = self._bodies.positions()
        pairs = self._inventory.pairs[rows]
        anchors = transformed_back(rotations[pairs], points_m[:, None] - positions_m[pairs])
        self._rows = np.concatenate((self._rows, rows))
        self._anchors = np.concatenate((self._anchors, anchors))
        self._holding_n = np.concatenate((self._holding_n, np.zeros(len(rows))))

    def before_substep(self, elapsed_s: float, substep_s: float) -> None:
        """Release bars that have stretched too far, and pull with the others in the coming sub-step."""
        self.forces_n[:] = 0.0
        if not len(self._rows):
            return
        pairs = self._inventory.pairs[self._rows]
        positions_m, rotations = self._bodies.positions()
        levers = transformed(rotations[pairs], self._anchors)
        points = positions_m[pairs] + levers
        speeds = self._bodies.velocities()[pairs] + np.cross(self._bodies.angular_velocities()[pairs], levers)
        distances, rates, directions = parting(points[:, 0], points[:, 1], speeds[:, 0], speeds[:, 1])
        masses = effective_masses(self._inventory.masses_kg, pairs)
        yield_n = (self._remaining_strength * self._yield_n)[self._rows]
        tensions, self._holding_n = bar_forces(self._holding_n, rates, masses, yield_n, substep_s)
        holds = distances <= self._ductility.elongation_m
        pulls = np.where(holds, tensions, 0.0)[:, None] * directions
        self.forces_n[self._rows] = pulls
        both = np.stack((pulls, -pulls), axis=1).reshape(-1, 3)
        self._bodies.add_forces(pairs.ravel(), both, np.cross(levers.reshape(-1, 3), both))
        self._rows, self._anchors, self._holding_n = self._rows[holds], self._anchors[holds], self._holding_n[holds]
