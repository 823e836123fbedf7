"""Loads that change with time, put into Bullet's world as forces before each sub-step."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...bullet.bodies import BodyTable
from ...engineering.geometry.vectors import cross, transformed, transformed_back
from ...model.loads import PlacedLoad, SizedLoad
from .drivers import Driver


class Loads(Driver):
    """Pushes bodies with all loads."""

    def __init__(self, bodies: BodyTable, loads: Sequence[PlacedLoad[SizedLoad]]):
        self._table = bodies
        self._loads = [placed.load for placed in loads]
        self._load_of = np.repeat(np.arange(len(loads)), [len(placed.bodies) for placed in loads])
        self._bodies = np.concatenate([np.zeros(0, int), *(placed.bodies for placed in loads)])
        none = np.zeros((0, 3))
        self._unit_forces = np.concatenate([none, *(placed.shares[:, None] * placed.directions for placed in loads)])
        arms = np.concatenate([none, *(placed.arms_m for placed in loads)])
        turns = np.array([placed.turns for placed in loads], bool)[self._load_of]
        rotations = bodies.positions()[1][self._bodies]
        self._turning = np.flatnonzero(turns)
        self._turning_forces = transformed_back(rotations[self._turning], self._unit_forces[self._turning])
        self._off_centre = np.flatnonzero(arms.any(axis=1))
        self._arms_in_bodies = transformed_back(rotations[self._off_centre], arms[self._off_centre])
        self._begins_s = 0.0

    def before_substep(self, elapsed_s: float, substep_s: float) -> None:
        """Push with the means of loads in a sub-step of a length in s; simulated time is known once a frame at least.

        A body that was removed carries no load, and its part of the load is gone with it.
        """
        if not self._loads:
            return
        begins_s = max(self._begins_s, elapsed_s)
        self._begins_s = begins_s + substep_s
        sizes = np.array([load.mean_size(begins_s, substep_s) for load in self._loads])[self._load_of]
        rotations = self._table.positions()[1] if len(self._turning) + len(self._off_centre) else None
        if rotations is not None:
            turned = transformed(rotations[self._bodies[self._turning]], self._turning_forces)
            self._unit_forces[self._turning] = turned
        forces = sizes[:, None] * self._unit_forces
        torques = np.zeros_like(forces)
        if rotations is not None:
            arms = transformed(rotations[self._bodies[self._off_centre]], self._arms_in_bodies)
            torques[self._off_centre] = cross(arms, forces[self._off_centre])
        pushed = np.flatnonzero((sizes != 0.0) & ~self._table.removed[self._bodies])
        if len(pushed):
            self._table.wake(self._bodies[pushed])
            self._table.add_forces(self._bodies[pushed], forces[pushed], torques[pushed])
