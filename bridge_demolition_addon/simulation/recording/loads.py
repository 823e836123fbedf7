"""Loads that grow with time, put into Bullet's world as forces before each sub-step."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...bullet.bodies import BodyTable
from ...engineering.geometry.vectors import cross, transformed, transformed_back
from ...model.loads import Load
from ...model.sequence.loads import PlacedLoad
from .drivers import Driver


class Loads(Driver):
    """Pushes bodies with all loads."""

    def __init__(self, bodies: BodyTable, loads: Sequence[PlacedLoad[Load]]):
        self._table = bodies
        self._loads = [load.load for load in loads]
        counts = [len(load.bodies) for load in loads]
        self._load_of = np.repeat(np.arange(len(loads)), counts)
        self._bodies = np.concatenate([np.zeros(0, int), *(load.bodies for load in loads)])
        shares = np.concatenate([np.zeros(0), *(load.shares for load in loads)])
        directions = np.array([load.load.unit_direction for load in loads]).reshape(-1, 3)
        self._unit_forces = shares[:, None] * directions[self._load_of]
        at_points = np.array([load.arm_m is not None for load in loads], bool)
        self._turns = np.flatnonzero(at_points[self._load_of])
        arms = np.array([load.arm_m for load in loads if load.arm_m is not None]).reshape(-1, 3)
        self._arms_in_bodies = transformed_back(bodies.positions()[1][self._bodies[self._turns]], arms)
        self._begins_s = 0.0

    def before_substep(self, elapsed_s: float, substep_s: float) -> None:
        """Push with the means of loads in a sub-step of a length in s; simulated time is known once a frame at least.

        A body that was removed carries no load, and its part of the load is gone with it.
        """
        if not self._loads:
            return
        self._begins_s = max(self._begins_s, elapsed_s)
        middle_s = self._begins_s + substep_s / 2.0
        self._begins_s += substep_s
        sizes_n = np.array([load.force_n(middle_s) for load in self._loads])[self._load_of]
        forces = sizes_n[:, None] * self._unit_forces
        torques = np.zeros_like(forces)
        if len(self._turns):
            arms = transformed(self._table.positions()[1][self._bodies[self._turns]], self._arms_in_bodies)
            torques[self._turns] = cross(arms, forces[self._turns])
        pushed = np.flatnonzero((sizes_n > 0.0) & ~self._table.removed[self._bodies])
        if len(pushed):
            self._table.wake(self._bodies[pushed])
            self._table.add_forces(self._bodies[pushed], forces[pushed], torques[pushed])
