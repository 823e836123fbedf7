"""Breaking by strength: after a sub-step by measured loads, before it by those that elastic connections will carry."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ...bullet.constraints import ConstraintTable
from ...bullet.tick import Found, SubstepStage, Tick
from ...bullet.world import BulletWorld
from ...engineering.mechanics.frame_loads import Moment
from ...engineering.mechanics.overloads import MOST_REDISTRIBUTED, Overloads
from ...engineering.mechanics.section_cuts import SectionForces
from ...model.schema import given
from .drivers import Driver, WarmUp
from .elastic_connections import ElasticConnections, ElasticEnergy
from .meter import Meter, Reading
from .ruptured_bars import RupturedBars
from .torques import Torques

_MOST_ROUNDS = 20
"""How often connections break one after another in one sub-step, before the rest waits for the next."""

_NONE = np.zeros(0, int)


@dataclass(frozen=True, slots=True)
class Breaks:
    """Connections (b,) that broke in one sub-step under loads in their own axes.

    `time_s` is the simulated time at its end, or at its beginning for those that broke before it.
    """

    time_s: float
    connections: np.ndarray
    loads: SectionForces


@dataclass(frozen=True, slots=True)
class Resistance:
    """Resistance of m connections.

    Attributes
    ----------
    overloads : Overloads or None
        Judges them by their strength; None where Bullet's own thresholds alone break them.
    remaining_strength : (m,) float
        Part of its strength that each has left, kept up to date by the events.
    elastic : ElasticConnections or None
        The connections, where they are elastic.
    reinforcement : ElasticConnections or None
        The same, where bars hold on as connections break.
    ruptured : RupturedBars or None
        Those of them whose bars have ruptured.
    """

    overloads: Overloads | None
    remaining_strength: np.ndarray
    elastic: ElasticConnections | None = None
    reinforcement: ElasticConnections | None = None
    ruptured: RupturedBars | None = None


class Breaker:
    """Breaks overloaded connections once the warm-up is over, and lets bodies collide that none holds together."""

    def __init__(self, constraints: ConstraintTable, meter: Meter, resistance: Resistance, warm_up: WarmUp):
        self._constraints, self._meter, self._resistance, self._warm_up = constraints, meter, resistance, warm_up
        self.uses_strength = resistance.overloads is not None
        self._intact, self._held = constraints.intact(), (_NONE, (-1, -1))
        self._broken_before: list[Breaks] = []

    def connect(self, tick: Tick) -> None:
        """Let sub-steps judge by the loads that are predicted."""
        elastic, count = self._resistance.elastic, len(self._intact)
        tick.redistributed = MOST_REDISTRIBUTED
        tick.point("whole", self._intact, count)
        tick.point("strength", self._resistance.remaining_strength, count)
        if elastic:
            places = elastic.motion.position_components_m, elastic.motion.rotation_components
            tick.refer(coming=self._meter.sections.carrying(elastic.loads, *places))

    def begin(self, tick: Tick) -> None:
        """Let a sub-step judge by what is left, once the warm-up is over."""
        overloads, left, parts = self._resistance.overloads, self._resistance.remaining_strength, self._parts
        tick.is_judged = self._warm_up.is_over
        if overloads:
            tick.in_members = overloads.judges_in_members(parts)
            tick.refer(judging=overloads.hand_over(self._intact, self._meter.sections, left, parts))

    def find_sections(self) -> None:
        """Find the sections of members that the core asks for."""
        given(self._resistance.overloads).find_sections(self._parts)

    def break_overloaded(self, reading: Reading) -> None:
        """Break connections that a sub-step has overloaded, as the core has found, and note it in the reading."""
        rows = given(self._resistance.overloads).worst()
        self._break(rows, partial(self._meter.moment, reading))
        reading.snapshot.intact[rows] = False

    def break_predicted(self, begin_s: float, substep_s: float) -> None:
        """Break the connections that predicted loads overload, as the core has found."""
        resistance, elastic = self._resistance, given(self._resistance.elastic)
        rows, failed = resistance.overloads.worst() if resistance.overloads else _NONE, elastic.failed_bearings
        if len(failed):
            rows = np.union1d(rows, failed)
        moment = self._meter.moment(self._meter.predicted(elastic.loads, substep_s, begin_s))
        self._broken_before.append(Breaks(begin_s, rows, self._meter.section_forces(moment, rows)))
        self._break(rows, lambda: moment)
        self._intact[rows] = False
        self._let_collide()

    def take_broken_before(self) -> list[Breaks]:
        """Return the breaks before the sub-step, and forget them."""
        broken, self._broken_before = self._broken_before, []
        return broken

    def follow(self, intact: np.ndarray) -> np.ndarray:
        """Take over which connections (m,) are intact after a sub-step; return those that broke in it (b,)."""
        broken = (self._intact & ~intact).nonzero()[0]
        resistance, held, held_before = self._resistance, (_NONE, (0, 0)), self._held
        self._intact[:] = intact
        if resistance.reinforcement:
            held = resistance.reinforcement.held_corners
        waits = resistance.ruptured and resistance.ruptured.waits
        self._held = held
        if len(broken) or waits or held[0] is not held_before[0] or held[1] != held_before[1]:
            self._let_collide()
        return broken

    @property
    def _parts(self) -> np.ndarray | None:
        return self._resistance.elastic.parts if self._resistance.elastic else None

    def _break(self, rows: np.ndarray, moment: Callable[[], Moment]) -> None:
        """Break connections (b,) under the loads of a moment; their reinforcement holds on."""
        self._constraints.break_rows(rows)
        if self._resistance.reinforcement:
            loads = moment()
            axes = self._meter.section_axes(loads.rotations, rows)
            carried = loads.connection_forces_n[rows], loads.connection_moments_nm[rows]
            self._resistance.reinforcement.tear(rows, loads.connection_points_m[rows], axes, *carried)

    def _let_collide(self) -> None:
        """Let bodies collide that no connection holds together, nor reinforcement in place of one."""
        elastic, ruptured = self._resistance.elastic, self._resistance.ruptured
        holding = elastic.holding(self._intact) if elastic else self._intact
        apart = elastic.keeping_apart(holding) if elastic else holding
        if ruptured:
            apart = apart | ruptured.lie_in_each_other(self._constraints.cracked, holding)
        self._constraints.let_broken_collide(apart)


class CoreStep(Driver):
    """What the core does in each sub-step, in one call before it and one after it: connections, breaking, torques.

    Elastic connections are put in without those that would break in it: one that carries more than its strength would
    push its bodies more than a real one.
    """

    def __init__(
        self, world: BulletWorld, elastic: ElasticConnections | None, breaker: Breaker, meter: Meter, torques: Torques
    ):
        self._elastic, self._breaker, self._meter, self._torques = elastic, breaker, meter, torques
        self._tick = tick = Tick()
        tick.refer(bodies=world.bodies.core, connections=world.constraints.core)
        breaker.connect(tick)
        if elastic:
            elastic.connect(tick)

    def before_substep(self, elapsed_s: float, substep_s: float) -> None:
        """Predict loads, break the connections that they overload, until no more break, and put all of it in."""
        tick, elastic, breaker, rounds = self._tick, self._elastic, self._breaker, 0
        times_s = self._torques.times_s(substep_s)
        tick.substep_s, tick.next = substep_s, SubstepStage.READ if elastic else SubstepStage.TURN
        tick.point("times", times_s, len(times_s))
        if not elastic:
            tick.go_on()
            return
        elastic.begin_substep(tick, substep_s)
        breaker.begin(tick)
        while found := tick.go_on():
            if Found.RUPTURED in found:
                elastic.forget_ruptured()
            if Found.OTHERS_ACT in found:
                elastic.choose(tick)
            if Found.NO_SECTIONS in found:
                breaker.find_sections()
            if Found.OVERLOADED in found:
                breaker.break_predicted(elapsed_s, substep_s)
                rounds += 1
                tick.is_judged = rounds < _MOST_ROUNDS
            elastic.hand_over(tick)
        elastic.end_substep()

    def read(self, substep_s: float, end_s: float, *, loads: bool) -> tuple[Reading, ElasticEnergy | None]:
        """Return Bullet's state after a sub-step, and the energy in elastic connections, once what it overloads broke.

        Without loads contacts and energy are not known.
        """
        tick, elastic, breaker, meter = self._tick, self._elastic, self._breaker, self._meter
        reading, energy = Reading(meter.begin(tick, contacts=loads), substep_s, end_s), None
        tick.next = SubstepStage.TAKE
        breaker.begin(tick)
        if elastic and loads:
            energy = elastic.begin_energy(tick)
        while found := tick.go_on():
            if Found.NO_ROOM in found:
                meter.make_room()
            if Found.NO_SECTIONS in found:
                breaker.find_sections()
            if Found.OVERLOADED in found:
                reading = self._with_contacts(reading, loads)
                breaker.break_overloaded(reading)
                if energy:
                    energy = given(elastic).begin_energy(tick)
        return self._with_contacts(reading, loads), energy

    def _with_contacts(self, reading: Reading, are_read: bool) -> Reading:
        return replace(reading, snapshot=self._meter.with_contacts(reading.snapshot)) if are_read else reading
