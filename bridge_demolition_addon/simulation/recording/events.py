"""Removals, saw cuts, weakenings and blast zones, put into Bullet's world when their time has come."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from ...bullet.world import BulletWorld
from ...engineering.drilled_charges.cages import Cages
from ...model.changes.change import Change, Event
from ...model.changes.departures import Departure
from .drivers import Driver
from .elastic_connections import ElasticConnections
from .tendons import Tendons

_ROUNDING = 1e-3
"""Part of a sub-step by which adding up sub-steps may be off."""

_NONE = np.zeros(0, int)


@dataclass(frozen=True, slots=True)
class AppliedEvent:
    """An event that was applied: when, and which bodies (b,) and connections (c,) were still there then."""

    time_s: float
    change: Change
    bodies: np.ndarray
    connections: np.ndarray
    bars: np.ndarray = field(default_factory=lambda: _NONE)  # numbers (g,) of groups of bars that stand bare since then
    law: Cages | None = None  # of all such bars
    held_by: np.ndarray = field(default_factory=lambda: _NONE)  # bodies (h,) that still held what a crane took away

    def bars_so_far(self) -> dict[str, float]:
        """Return the largest force that pressed its bars, and how far they folded; nothing where none stand bare."""
        if self.law is None or not len(self.bars):
            return {}
        pressed_n, folded_m = self.law.pressed_n(self.bars), self.law.folded_m(self.bars)
        return {"cage_pressed_n": float(pressed_n.sum()), "cage_folded_m": float(folded_m.max())}


@dataclass(frozen=True, slots=True, eq=False)
class _Leaving:
    """Bodies (b,) on their way out of their member, until a time."""

    bodies: np.ndarray
    departure: Departure
    until_s: float


class Events(Driver):
    """All events of a world in order of time, each before the first sub-step that begins at its time or later.

    The connections are between pairs (m, 2) of bodies with masses (n,); `remaining_strength` (m,) is the part of its
    strength that each has left, and `remaining_bars` (m,) that of its bars, which is less where tendons among them are
    cut. Bars of blast zones stand bare where connections are elastic. `compression_factors` (m,) is by how
    much more strength each has left in compression. `lifts_off` (m,) are bearings that hold nothing that is lifted.
    """

    def __init__(
        self,
        world: BulletWorld,
        pairs: np.ndarray,
        masses_kg: np.ndarray,
        events: Sequence[Event],
        elastic: ElasticConnections | None = None,
        tendons: Tendons | None = None,
        lifts_off: np.ndarray | None = None,
    ):
        self.remaining_strength = np.ones(len(pairs))
        self.remaining_bars = self.remaining_strength if tendons is None else np.ones(len(pairs))
        self._tendons = tendons
        self.compression_factors = (
            np.ones(len(pairs)) if any(event.compression_factor != 1.0 for event in events) else None
        )
        self._elastic, self._lifts_off = elastic, np.zeros(len(pairs), bool) if lifts_off is None else lifts_off
        self.applied: list[AppliedEvent] = []
        self._world, self._pairs, self._masses_kg = world, pairs, masses_kg
        self._impulses_ns = np.zeros((len(masses_kg), 3))
        self._coming = list(events)
        self._leaving: list[_Leaving] = []
        self._begins_s = 0.0
        if any(event.departure for event in events):
            world.bodies.check_contact_flags()

    def before_substep(self, elapsed_s: float, substep_s: float) -> None:
        """Apply due events before a sub-step of a length in s; simulated time is known once a frame at least."""
        self._begins_s = max(self._begins_s, elapsed_s)
        while self._coming and self._coming[0].time_s <= self._begins_s + _ROUNDING * substep_s:
            self._apply(self._coming.pop(0))
        self._leaving = [leaving for leaving in self._leaving if self._goes_on(leaving, substep_s)]
        self._begins_s += substep_s

    def take_impulses_ns(self) -> np.ndarray:
        """Return the impulses (n, 3) by which blast zones have moved bodies since the last call."""
        impulses, self._impulses_ns = self._impulses_ns, np.zeros_like(self._impulses_ns)
        return impulses

    def _apply(self, event: Event) -> None:
        held_by = self._bodies_holding(event) if event.change.by_crane else _NONE
        connections = event.connections[self._world.constraints.intact()[event.connections]]
        bars = _NONE
        if self._elastic and event.bars:
            holding = self._elastic.holding(self._world.constraints.intact())
            bars = self._elastic.bare_bars.bare(event.bars, holding)
        # Connections that broke before may still hold by reinforcement, which is weakened or cut with the others.
        self.remaining_strength[event.connections] *= event.factor
        if self.compression_factors is not None:
            self.compression_factors[event.connections] *= event.compression_factor
        if event.factor > 0.0:
            self._world.constraints.weaken(connections, event.factor)
        else:
            self._world.constraints.break_rows(connections)
        if self._elastic and event.departure:
            self._elastic.bare_bars.law.let_go(event.bodies)
        if self._tendons:
            if event.tendons:
                self._tendons.cut(event.tendons, self._begins_s)
            left = self._tendons.forces.bars_left(len(self.remaining_strength))
            self.remaining_bars[:] = self.remaining_strength * left
        bodies = event.bodies[~self._world.bodies.removed[event.bodies]]
        self._world.bodies.wake(self._concerned(bodies, connections))
        if event.departure is None:
            self._world.bodies.remove(bodies)
        else:
            self._world.bodies.let_touch(event.bodies, touch=False)
            until_s = self._begins_s + event.departure.duration_s
            self._leaving.append(_Leaving(event.bodies, event.departure, until_s))
        law = self._elastic.bare_bars.law if self._elastic else None
        self.applied.append(AppliedEvent(self._begins_s, event.change, bodies, connections, bars, law, held_by))

    def _bodies_holding(self, event: Event) -> np.ndarray:
        """Bodies (h,) that hold the part that a lift takes away, by connections or by bars across cracks."""
        holding = self._world.constraints.intact()
        if self._elastic:
            holding = self._elastic.holding(holding) & (self.remaining_strength > 0.0)
        ends = np.isin(self._pairs, event.bodies)
        crossing = holding & ~self._lifts_off & (ends[:, 0] != ends[:, 1])
        return np.unique(self._pairs[crossing][~ends[crossing]])

    def _goes_on(self, leaving: _Leaving, substep_s: float) -> bool:
        """Move bodies that leave their member for one more sub-step, or let them go; return whether they go on."""
        there = ~self._world.bodies.removed[leaving.bodies]
        bodies, resting = leaving.bodies[there], np.zeros((int(there.sum()), 3))
        goes_on = self._begins_s < leaving.until_s - _ROUNDING * substep_s
        velocities = (leaving.departure.leaving_m_s if goes_on else leaving.departure.after_m_s)[there]
        gained_m_s = velocities - self._world.bodies.velocities()[bodies]
        self._impulses_ns[bodies] += self._masses_kg[bodies, None] * gained_m_s
        self._world.bodies.set_velocities(bodies, velocities, resting)
        if not goes_on:
            self._world.bodies.let_touch(bodies, touch=True)
        return goes_on

    def _concerned(self, bodies: np.ndarray, connections: np.ndarray) -> np.ndarray:
        """Bodies whose support may be gone: all, if bodies are removed on which others may lie unconnected."""
        if len(bodies):
            return np.arange(len(self._world.bodies))
        return np.unique(self._pairs[connections])
