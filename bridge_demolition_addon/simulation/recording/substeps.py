"""What happens around every sub-step: drivers act before it, a meter reads after it, and what is overloaded breaks.

While Bullet waits, no more is done than that. Where loads are not wanted, nothing is copied that does not decide what
breaks.
"""

from __future__ import annotations

import time
from collections.abc import Iterable

from ...bullet.constraints import ConstraintTable
from .blast import Blast
from .breaking import Breaker, ElasticPrediction
from .drivers import Driver, LastSubstepLoads, ThresholdScale, WarmUp
from .events import Events
from .frame_sums import FrameSums, MeasuredSubstep
from .ground_drive import GroundDrive
from .loads import Loads
from .meter import Meter
from .reinforcement import Reinforcement

ORDER = (
    LastSubstepLoads,
    WarmUp,
    GroundDrive,
    Events,
    ThresholdScale,
    Reinforcement,
    Blast,
    Loads,
    ElasticPrediction,
)
"""Order in which drivers act, which decides the last bits of a run. The ground moves before anything is connected to
it or not; events decide what connections and reinforcement are left; elastic connections come last, as they take over
all forces on the bodies."""


def in_order(drivers: Iterable[Driver | None]) -> list[Driver]:
    """Return the drivers that there are in the order in which they act."""
    return sorted((driver for driver in drivers if driver is not None), key=lambda driver: ORDER.index(type(driver)))


class SubstepRecorder:
    """Drives and measures a world sub-step by sub-step. Bullet calls it: it keeps an error instead of raising it.

    Parameters
    ----------
    constraints : ConstraintTable
        Of the world, bound before any time passes.
    drivers : list of Driver
        In order.
    meter : Meter
    breaker : Breaker
    warm_up : WarmUp
    sums : FrameSums or None
        Adds up loads and work; None where these are not recorded. What happens is the same without them.

    Attributes
    ----------
    elapsed_s : float
        Simulated time so far.
    seconds : float
        Wall time that measuring has cost so far.
    error : Exception or None
        What went wrong in a sub-step; nothing is recorded after it. Whoever follows the frames raises it there.
    """

    def __init__(
        self,
        constraints: ConstraintTable,
        drivers: list[Driver],
        meter: Meter,
        breaker: Breaker,
        warm_up: WarmUp,
        sums: FrameSums | None,
    ):
        self.elapsed_s = 0.0
        self.seconds = 0.0
        self.error: Exception | None = None
        self._constraints, self._drivers, self._meter = constraints, drivers, meter
        self._breaker, self._warm_up, self._sums = breaker, warm_up, sums

    def before_substep(self, substep_s: float) -> None:
        """Prepare a sub-step of a length in s."""
        if self.error:
            return
        try:
            for driver in self._drivers:
                driver.before_substep(self.elapsed_s, substep_s)
        except Exception as error:
            self.error = error

    def after_substep(self, substep_s: float) -> None:
        """Measure a sub-step of a length in s, and break what was overloaded in it."""
        if self.error:
            return
        began = time.perf_counter()
        try:
            for driver in self._drivers:
                driver.after_substep()
            self.elapsed_s += substep_s
            if self._sums:
                self._record(self._sums, substep_s)
            else:
                self._follow(substep_s)
        except Exception as error:
            self.error = error
        self.seconds += time.perf_counter() - began

    def skip(self, duration_s: float) -> None:
        """Let time pass of which nothing is known."""
        self.elapsed_s += duration_s

    def _record(self, sums: FrameSums, substep_s: float) -> None:
        sums.let_work_count(self._warm_up.is_over)
        reading = self._meter.read(substep_s, self.elapsed_s)
        self._warm_up.end_when_due(self.elapsed_s)
        intact = reading.snapshot.intact.copy()
        intact[self._breaker.break_overloaded(reading)] = False
        broken = self._breaker.follow(intact)
        stored_j = self._meter.stored_j(intact)
        sums.add(MeasuredSubstep(reading, broken, self._breaker.take_broken_before(), stored_j))

    def _follow(self, substep_s: float) -> None:
        """Break what is overloaded in a sub-step of which no loads are kept, and let go of what is broken."""
        self._warm_up.end_when_due(self.elapsed_s)
        if self._breaker.uses_strength:
            self._breaker.break_overloaded(self._meter.read(substep_s, self.elapsed_s))
        self._breaker.take_broken_before()
        self._breaker.follow(self._constraints.intact())
