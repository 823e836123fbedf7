"""Work around every sub-step: drivers act before it, a meter reads after it, and overloaded connections break.

While Bullet waits, no more is done than that. Without loads, only values that decide breaking are copied.
"""

from __future__ import annotations

import time
from collections.abc import Iterable

from ...bullet.constraints import ConstraintTable
from .blast import Blast
from .breaking import Breaker, CoreStep
from .drivers import Driver, LastSubstepLoads, ThresholdScale, WarmUp
from .events import Events
from .fall_beds import FallBeds
from .frame_sums import FrameSums, MeasuredSubstep
from .ground_drive import GroundDrive
from .loads import Loads
from .pulls import Pulls
from .tendons import Tendons

ORDER = (
    LastSubstepLoads,
    WarmUp,
    GroundDrive,
    Events,
    ThresholdScale,
    Blast,
    Loads,
    Pulls,
    FallBeds,
    Tendons,
    CoreStep,
)
"""Order in which drivers act, which decides the last bits of a run. The ground moves before events decide which
connections and reinforcement are left; elastic connections come after all forces on the bodies, which they take over,
and torques turn the bodies when all of them are there."""


def in_order(drivers: Iterable[Driver | None]) -> list[Driver]:
    """Return the drivers that are not None in the order in which they act."""
    return sorted((driver for driver in drivers if driver is not None), key=lambda driver: ORDER.index(type(driver)))


class SubstepRecorder:
    """Drives and measures a world sub-step by sub-step, with drivers in order.

    Without sums loads and work are not recorded; the run is the same without them.

    Attributes
    ----------
    elapsed_s : float
        Simulated time so far.
    seconds : float
        Wall time that measuring has taken so far.
    error : Exception or None
        Error in a sub-step, after which nothing is recorded. Bullet calls this class, so that the reader of the frame
        raises it.
    """

    def __init__(
        self,
        constraints: ConstraintTable,
        drivers: list[Driver],
        core: CoreStep,
        breaker: Breaker,
        warm_up: WarmUp,
        sums: FrameSums | None,
    ):
        self.elapsed_s = 0.0
        self.seconds = 0.0
        self.error: Exception | None = None
        self._constraints, self._drivers, self._core = constraints, drivers, core
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
        """Measure a sub-step of a length in s, and break connections that were overloaded in it."""
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
        """Let time pass without measuring it."""
        self.elapsed_s += duration_s

    def _record(self, sums: FrameSums, substep_s: float) -> None:
        sums.count_work(self._warm_up.is_over)
        self._warm_up.end_when_due(self.elapsed_s)
        reading, energy = self._core.read(substep_s, self.elapsed_s, loads=True)
        broken = self._breaker.follow(reading.snapshot.intact)
        sums.add(MeasuredSubstep(reading, broken, self._breaker.take_broken_before(), energy))

    def _follow(self, substep_s: float) -> None:
        """Break connections that are overloaded in a sub-step whose loads are not kept."""
        self._warm_up.end_when_due(self.elapsed_s)
        if self._breaker.uses_strength:
            intact = self._core.read(substep_s, self.elapsed_s, loads=False)[0].snapshot.intact
        else:
            intact = self._constraints.intact()
        self._breaker.take_broken_before()
        self._breaker.follow(intact)
