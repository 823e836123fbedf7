"""The time that work still takes, judged by what of it is done."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ..arithmetic import exponential
from ..arrays import FloatArray

_SECONDS_PER_MINUTE = 60

_AT_REST_M_S = 0.5
"""Speed below which a body is taken to stay where it is."""

_SLOWING_S = 0.4
"""Time in which a landed body gets slower by a factor of e: from 0.3 to 0.6 s the time left of three examples, with a
ball and with explosives, is within a factor of 1.5 in most looks."""

_MOST_TIMES = 60
"""Number of times to come for which speeds are calculated."""


class Pace:
    """Pace of work, judged by the later half of its steps: Blender makes its world in the first one."""

    def __init__(self) -> None:
        self.took_s: list[float] = []  # time on the clock of each step
        self.work: list[float] = []  # done in each step, in any unit

    def note(self, took_s: float, work: float = 1.0) -> None:
        """Note a step that is done."""
        self.took_s.append(took_s)
        self.work.append(work)

    def left_s(self, work: float) -> float | None:
        """Return how long the work that is left takes, s; None before a step is done."""
        earlier = len(self.work) // 2
        done = math.fsum(self.work[earlier:])
        return math.fsum(self.took_s[earlier:]) / done * max(work, 0.0) if done else None


def speeds_to_come(
    heights_m: FloatArray, velocities_m_s: FloatArray, gravity_m_s2: float, after_s: Sequence[float]
) -> FloatArray:
    """Return how fast, m/s, the fastest body probably is at times (k,) from now on, in order.

    A moving body, with height and velocity (n, 3), flies on until it is as low as the lowest body, and slows down
    there. A body at rest is taken to stay at rest: later falls are not known.
    """
    times = np.asarray(after_s, float)
    along_x, along_y, upwards = velocities_m_s.T
    sideways_squared = along_x * along_x + along_y * along_y
    moving = sideways_squared + upwards * upwards > _AT_REST_M_S * _AT_REST_M_S
    if not moving.any():
        return np.zeros(len(times))
    fall_m = (heights_m - heights_m.min())[moving]
    upwards, sideways_squared = upwards[moving], sideways_squared[moving]
    lands_s = (upwards + np.sqrt(upwards * upwards + 2.0 * gravity_m_s2 * fall_m)) / gravity_m_s2
    looked_at = np.unique(np.linspace(0, len(times) - 1, _MOST_TIMES).round().astype(int))
    flown_s = np.minimum(times[looked_at, None], lands_s)
    climbs = upwards - gravity_m_s2 * flown_s
    speeds = np.sqrt(sideways_squared + climbs * climbs)
    slowed = exponential((flown_s - times[looked_at, None]) / _SLOWING_S)
    speeds_left: FloatArray = np.interp(times, times[looked_at], (speeds * slowed).max(axis=1))
    return speeds_left


def clock(seconds: float) -> str:
    """Return a time in minutes and seconds, such as ``1:05``."""
    whole = round(seconds)
    return f"{whole // _SECONDS_PER_MINUTE}:{whole % _SECONDS_PER_MINUTE:02d}"
