"""Loads that change with time, put into Bullet's world as forces before each sub-step."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ...bullet.bodies import BodyTable
from ...engineering.geometry.vectors import cross, dot, length, transformed, transformed_back
from ...model.loads.part import PlacedLoad, SizedLoad
from .drivers import Driver


class ActedLoad:
    """What a load did so far: its largest force, its impulse, and its work.

    Force is the resultant on all bodies, and work that on their motion where it acts.
    """

    def __init__(self, name: str):
        self.name = name
        self.force_n, self.largest_n, self.largest_s, self.work_j = 0.0, 0.0, 0.0, 0.0
        self.impulse_ns = np.zeros(3)
        self.course: list[tuple[float, float]] = []

    def push(self, time_s: float, step_s: float, force_n: np.ndarray) -> None:
        """Take note of the resultant (3,) in a sub-step that begins at a time."""
        self.force_n = float(length(force_n))
        self.impulse_ns += force_n * step_s
        if self.force_n > self.largest_n:
            self.largest_n, self.largest_s = self.force_n, time_s

    def to_json(self) -> dict[str, Any]:
        """Return it ready for JSON."""
        return {
            "name": self.name,
            "largest_force_N": self.largest_n,
            "largest_force_s": self.largest_s,
            "impulse_Ns": self.impulse_ns.tolist(),
            "work_J": self.work_j,
            "course": {
                "time_s": [time_s for time_s, _ in self.course],
                "force_N": [force_n for _, force_n in self.course],
            },
        }


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
        self.acted = [ActedLoad(load.called(number)) for number, load in enumerate(self._loads, start=1)]
        self._pushed = np.zeros(0, int)
        self._impulses = self._angular_impulses = np.zeros((0, 3))

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
        self._note_work()
        self._pushed = pushed
        self._impulses, self._angular_impulses = substep_s * forces[pushed], substep_s * torques[pushed]
        owners = self._load_of[pushed]
        for row, acted in enumerate(self.acted):
            acted.push(begins_s, substep_s, forces[pushed[owners == row]].sum(axis=0))
        if len(pushed):
            self._table.wake(self._bodies[pushed])
            self._table.add_forces(self._bodies[pushed], forces[pushed], torques[pushed])
            self._note_work()

    def _note_work(self) -> None:
        """Add half of the work of the last sub-step: by velocities before it, or after it.

        A constant force does its work by the mean of both.
        """
        if not len(self._pushed):
            return
        bodies, owners = self._bodies[self._pushed], self._load_of[self._pushed]
        work_j = dot(self._impulses, self._table.velocities()[bodies])
        work_j += dot(self._angular_impulses, self._table.angular_velocities()[bodies])
        for row, acted in enumerate(self.acted):
            acted.work_j += 0.5 * float(work_j[owners == row].sum())

    def note(self, time_s: float) -> None:
        """Take note of the work of the last sub-step, and of forces, at the end of a frame."""
        self._note_work()
        self._pushed = np.zeros(0, int)
        for acted in self.acted:
            acted.course.append((time_s, acted.force_n))

    def summary(self) -> list[dict[str, Any]]:
        """Return what each load did so far, ready for JSON."""
        return [acted.to_json() for acted in self.acted]
