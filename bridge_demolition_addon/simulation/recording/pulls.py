"""Cables that pull bodies of a world: put into Bullet as forces before each sub-step, until they break."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from ...bullet.bodies import BodyTable
from ...engineering.geometry.vectors import cross, dot, length, transformed, transformed_back
from ...engineering.mechanics.slings import cable_force_n, force_of_step_n, free_length_m, stored_j
from ...model.loads.part import PlacedLoad
from ...model.pulls import Pull
from .drivers import Driver
from .hooks import Hooks

_LEFT = 0.01
"""Part of the distance of its ends that a cable keeps as free length at least."""

_AT_THE_ANCHOR_M = 1e-6
"""Distance of its ends below which a cable has no direction."""

BROKE, LET_GO = "broke", "its body was removed"

_LEAST_SHARE = 0.25
"""Part of the mass of a body that a force finds at its least: that of a slender bar at its end, across it."""


class ReeledCable:
    """One cable, from the start of its winch on.

    Attributes
    ----------
    force_n, length_m : float
        In the sub-step that was last, and the distance of its ends before it.
    free_m : float
        Its length without force.
    ended, ended_s, let_go_j
        How and when it let go, and the energy that was in it then; None as long as it holds.
    held_s : float or None
        When the winch first paid out.
    work_j : float
        Work that it did on its body.
    """

    def __init__(self, pull: Pull, mass_kg: float):
        self.pull, self._mass_kg, self.elastic_n = pull, mass_kg, pull.elastic_n
        self._keeps_its_length = False
        self.force_n, self.largest_n, self.largest_s, self.work_j = 0.0, 0.0, pull.start_s, 0.0
        self.length_m: float | None = None
        self.free_m: float | None = None
        self.held_s: float | None = None
        self.ended: str | None = None
        self.ended_s: float | None = None
        self.let_go_j: float | None = None
        self.course: list[tuple[float, float, float]] = []

    def step(self, time_s: float, step_s: float, length_m: float, lengthens_m_s: float) -> float:
        """Return the force in a sub-step that begins at a time, with its ends so far apart, and parting so fast."""
        pull = self.pull
        self.length_m = length_m
        if self.ended or time_s + step_s <= pull.start_s:
            return 0.0
        if self.free_m is None:
            self.free_m = length_m if pull.free_length_m is None else pull.free_length_m
        before_n = self.force_n
        if pull.speed_m_s is not None:
            reeled_m = pull.speed_m_s * min(step_s, time_s + step_s - pull.start_s)
            self.free_m = max(self.free_m - reeled_m, _LEFT * length_m)
            most_n = pull.largest_force_n
        elif self._keeps_its_length:
            most_n = math.inf
        else:
            grown_n = (time_s + step_s - pull.start_s) * (pull.growth_n_s or 0.0)
            most_n = min(grown_n, pull.largest_force_n)
            self.free_m = min(self.free_m, free_length_m(self.elastic_n, most_n, length_m + lengthens_m_s * step_s))
            self._keeps_its_length = pull.keeps_its_length and grown_n >= pull.largest_force_n
        force_n = force_of_step_n(self.elastic_n, self.free_m, length_m, lengthens_m_s, before_n, step_s, self._mass_kg)
        if force_n > most_n:
            if most_n == pull.largest_force_n and self.held_s is None:
                self.held_s = time_s
            force_n = most_n
            self.free_m = max(self.free_m, free_length_m(self.elastic_n, force_n, length_m))
        self.force_n = force_n
        if force_n > self.largest_n:
            self.largest_n, self.largest_s = force_n, time_s
        if max(force_n, cable_force_n(self.elastic_n, self.free_m, length_m)) >= pull.breaking_force_n:
            self.end(BROKE, time_s)
            return 0.0
        self.work_j -= force_n * lengthens_m_s * step_s
        return force_n

    def end(self, how: str, time_s: float) -> None:
        """Let go."""
        if self.ended is None:
            free_m = self.free_m or self.pull.built_length_m
            self.ended, self.ended_s = how, time_s
            self.let_go_j = stored_j(self.elastic_n, min(self.force_n, self.pull.breaking_force_n), free_m)
            self.force_n = 0.0


class Pulls(Driver):
    """Pulls bodies by all cables."""

    def __init__(self, bodies: BodyTable, pulls: Sequence[PlacedLoad[Pull]], masses_kg: np.ndarray):
        self._table = bodies
        self._bodies = np.array([int(placed.bodies[0]) for placed in pulls], int)
        masses = (_LEAST_SHARE * masses_kg[self._bodies]).tolist()
        self.cables = [ReeledCable(placed.load, mass_kg) for placed, mass_kg in zip(pulls, masses, strict=True)]
        arms = np.concatenate([placed.arms_m for placed in pulls])
        self._anchors = np.array([placed.load.anchor_m for placed in pulls]).reshape(-1, 3)
        self._arms_in_bodies = transformed_back(bodies.positions()[1][self._bodies], arms)
        self._begins_s = 0.0
        self.hooks = Hooks([placed.load for placed in pulls])

    def before_substep(self, elapsed_s: float, substep_s: float) -> None:
        """Pull with the forces of this sub-step; simulated time is known once a frame at least."""
        self._begins_s = max(self._begins_s, elapsed_s)
        time_s, self._begins_s = self._begins_s, self._begins_s + substep_s
        positions_m, rotations = self._table.positions()
        arms = transformed(rotations[self._bodies], self._arms_in_bodies)
        towards = self._anchors - positions_m[self._bodies] - arms
        lengths_m = length(towards)
        units = towards / np.maximum(lengths_m, _AT_THE_ANCHOR_M)[:, None]
        moving = self._table.velocities()[self._bodies] + cross(self._table.angular_velocities()[self._bodies], arms)
        parting_m_s = -dot(moving, units)
        forces_n = np.zeros(len(self.cables))
        for row, cable in enumerate(self.cables):
            if self._table.removed[self._bodies[row]]:
                cable.end(LET_GO, time_s)
            forces_n[row] = cable.step(time_s, substep_s, float(lengths_m[row]), float(parting_m_s[row]))
        self.hooks.measure(time_s, forces_n * units[:, 2])
        pulled = np.flatnonzero(forces_n > 0.0)
        if len(pulled):
            forces = forces_n[pulled, None] * units[pulled]
            self._table.wake(self._bodies[pulled])
            self._table.add_forces(self._bodies[pulled], forces, cross(arms[pulled], forces))

    def note(self, time_s: float) -> None:
        """Keep forces and lengths at the end of a frame."""
        for cable in self.cables:
            if cable.length_m is not None:
                cable.course.append((time_s, cable.force_n, cable.length_m))

    def summary(self) -> list[dict[str, Any]]:
        """Return what each cable did so far, ready for JSON."""
        return [
            {
                "name": cable.pull.name,
                "largest_force_N": cable.largest_n,
                "largest_force_s": cable.largest_s,
                "paid_out_s": cable.held_s,
                "ended": cable.ended,
                "ended_s": cable.ended_s,
                "let_go_J": cable.let_go_j,
                "work_J": cable.work_j,
                "course": {
                    name: [values[column] for values in cable.course]
                    for column, name in enumerate(("time_s", "force_N", "length_m"))
                },
            }
            for cable in self.cables
        ]
