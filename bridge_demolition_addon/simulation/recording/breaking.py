"""Breaking by strength: after a sub-step by measured loads, before it by those that elastic connections will carry."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from ...bullet.constraints import ConstraintTable
from ...engineering.mechanics.frame_loads import Moment
from ...engineering.mechanics.overloads import Overloads
from ...engineering.mechanics.section_cuts import SectionForces
from ...model.schema import given
from .drivers import Driver, WarmUp
from .elastic_connections import ElasticConnections
from .meter import Meter, Reading
from .ruptured_bars import RupturedBars

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
        self._intact = constraints.intact()
        self._broken_before: list[Breaks] = []

    def break_overloaded(self, reading: Reading) -> np.ndarray:
        """Break connections that a sub-step has overloaded; return which (m,) are intact then."""
        snapshot = reading.snapshot
        intact, rows = snapshot.intact, self._overloaded(snapshot.load_components, *snapshot.places)
        if len(rows):
            self._break(rows, partial(self._meter.moment, reading))
            intact[rows] = False
        return intact

    def break_predicted(self, loads: np.ndarray, begin_s: float, substep_s: float) -> np.ndarray:
        """Break the connections (b,) that predicted loads (6, m) on the bodies overload, and return them."""
        motion = given(self._resistance.elastic).motion
        rows = self._overloaded(loads, motion.position_components_m, motion.rotation_components)
        failed = self._failed_bearings()
        if len(failed):
            rows = np.union1d(rows, failed)
        if len(rows):
            moment = self._meter.moment(self._meter.predicted(loads, substep_s, begin_s))
            self._broken_before.append(Breaks(begin_s, rows, self._meter.section_forces(moment, rows)))
            self._break(rows, lambda: moment)
            self._intact[rows] = False
            self._let_collide()
        return rows

    def take_broken_before(self) -> list[Breaks]:
        """Return the breaks before the sub-step, and forget them."""
        broken, self._broken_before = self._broken_before, []
        return broken

    def follow(self, intact: np.ndarray) -> np.ndarray:
        """Take over which connections (m,) are intact after a sub-step; return those that broke in it (b,)."""
        broken = (self._intact & ~intact).nonzero()[0]
        self._intact = intact
        self._let_collide()
        return broken

    def _failed_bearings(self) -> np.ndarray:
        """Connections (b,) at pads of bearings that break by their force, or whose bodies have left each other."""
        elastic, left = self._resistance.elastic, self._resistance.remaining_strength
        return elastic.failed_bearings(self._intact, left) if elastic and self._warm_up.is_over else _NONE

    def _overloaded(self, loads: np.ndarray, positions_m: np.ndarray, rotations: np.ndarray) -> np.ndarray:
        """Which connections (k,) break by loads (6, m) about the centres of bodies.

        Bodies are at positions (3, n) in rotations (3, 3, n).
        """
        if not self._warm_up.is_over or not self.uses_strength:
            return _NONE
        resistance = self._resistance
        parts = resistance.elastic.parts if resistance.elastic else None
        judging, left = given(resistance.overloads), resistance.remaining_strength
        return judging.breaking(self._intact, self._meter.sections, loads, positions_m, rotations, left, parts)

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


class ElasticPrediction(Driver):
    """Puts elastic connections into each sub-step, without those that would break in it.

    A connection that carries more than its strength in a sub-step would push its bodies more than a real one.
    """

    def __init__(self, elastic: ElasticConnections, breaker: Breaker):
        self._elastic, self._breaker = elastic, breaker

    def before_substep(self, elapsed_s: float, substep_s: float) -> None:
        """Predict loads, and break the connections that they overload, until no more break."""
        self._elastic.begin_substep(substep_s)
        for _ in range(_MOST_ROUNDS):
            if not len(self._breaker.break_predicted(self._elastic.predict(), elapsed_s, substep_s)):
                break
        else:
            self._elastic.predict()
        self._elastic.apply()
