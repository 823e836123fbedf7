"""Removals, saw cuts and weakenings, put into Bullet's world when their time has come."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...bullet.world import BulletWorld
from ...model.sequence.events import Event
from .drivers import Driver

_ROUNDING = 1e-3
"""Part of a sub-step by which adding up sub-steps may be off."""


@dataclass(frozen=True, slots=True)
class AppliedEvent:
    """An event that was applied: when, and which bodies (b,) and connections (c,) were still there then."""

    time_s: float
    kind: str
    bodies: np.ndarray
    connections: np.ndarray


class Events(Driver):
    """All events of a world in order of time, each before the first sub-step that begins at its time or later.

    The connections are between pairs (m, 2) of bodies; `remaining_strength` (m,) is the part of its strength that each
    has left.
    """

    def __init__(self, world: BulletWorld, pairs: np.ndarray, events: Sequence[Event]):
        self.remaining_strength = np.ones(len(pairs))
        self.applied: list[AppliedEvent] = []
        self._world, self._pairs = world, pairs
        self._coming = list(events)
        self._begins_s = 0.0

    def before_substep(self, elapsed_s: float, substep_s: float) -> None:
        """Apply due events before a sub-step of a length in s; simulated time is known once a frame at least."""
        self._begins_s = max(self._begins_s, elapsed_s)
        while self._coming and self._coming[0].time_s <= self._begins_s + _ROUNDING * substep_s:
            self._apply(self._coming.pop(0))
        self._begins_s += substep_s

    def _apply(self, event: Event) -> None:
        connections = event.connections[self._world.constraints.intact()[event.connections]]
        # Connections that broke before may still hold by reinforcement, which is weakened or cut with the others.
        self.remaining_strength[event.connections] *= event.factor
        if event.factor > 0.0:
            self._world.constraints.weaken(connections, event.factor)
        else:
            self._world.constraints.break_rows(connections)
        bodies = event.bodies[~self._world.bodies.removed[event.bodies]]
        self._world.bodies.wake(self._concerned(bodies, connections))
        self._world.bodies.remove(bodies)
        self.applied.append(AppliedEvent(self._begins_s, event.kind, bodies, connections))

    def _concerned(self, bodies: np.ndarray, connections: np.ndarray) -> np.ndarray:
        """Bodies whose support may be gone: all, if bodies are removed on which others may lie unconnected."""
        if len(bodies):
            return np.arange(len(self._world.bodies))
        return np.unique(self._pairs[connections])
