"""Velocities of the ground that foundations of buildings resist in a short shaking, by its frequency.

DIN 4150-3 (2016), table 1, lines 1 to 3. BS 7385-2 (1993), table 1, which BS 5228-2 (2009) has as table B.2; below 4 Hz
it has 0.6 mm of displacement, which is 15 mm/s there. SN 640 312 (2013), sensitivity classes 3 and 4, shaken now and
then; of class 4 the lower end, half of class 3.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...texts import Text

FALL_HZ, CHARGES_HZ = 4.0, 50.0
"""Frequencies whose limits count: what falls shakes the ground with less than 10 Hz, charges with more than 50 Hz
(Huang et al., *Sensors* 23, 2023, 6240). 50.8 mm/s, quoted for blasting, is more than any of these allows dwellings."""

FREQUENCIES_HZ = (4.0, 10.0, 30.0, 50.0, 100.0)
"""Those of the table in reports."""

_MM_PER_M = 1e3


@dataclass(frozen=True, slots=True)
class VibrationLimit:
    """A limit of the peak particle velocity for a kind of building, by `corners` of frequency (Hz) and velocity (mm/s).

    Between corners it is a straight line, or, where it `has_steps`, the value of the corner below; beyond them level.
    """

    building: str
    source: str
    corners: tuple[tuple[float, float], ...]
    has_steps: bool = False

    def at_m_s(self, frequency_hz: float) -> float:
        """Return the limit at a frequency, m/s."""
        frequencies, velocities = zip(*self.corners, strict=True)
        if self.has_steps:
            return max(velocity for corner_hz, velocity in self.corners if corner_hz <= frequency_hz) / _MM_PER_M
        return float(np.interp(frequency_hz, frequencies, velocities)) / _MM_PER_M


LIMITS = (
    VibrationLimit(
        Text("sensitive or listed buildings"),
        Text("DIN 4150-3, table 1, line {}", "3"),
        ((10.0, 3.0), (50.0, 8.0), (100.0, 10.0)),
    ),
    VibrationLimit(
        Text("dwellings"), Text("DIN 4150-3, table 1, line {}", "2"), ((10.0, 5.0), (50.0, 15.0), (100.0, 20.0))
    ),
    VibrationLimit(
        Text("buildings of raised sensitivity"),
        Text("SN 640 312, class {}", "4"),
        ((0.0, 7.5), (30.0, 10.0), (60.0, 15.0)),
        has_steps=True,
    ),
    VibrationLimit(
        Text("buildings of normal sensitivity"),
        Text("SN 640 312, class {}", "3"),
        ((0.0, 15.0), (30.0, 20.0), (60.0, 30.0)),
        has_steps=True,
    ),
    VibrationLimit(
        Text("unreinforced or light framed buildings, cosmetic damage"),
        Text("BS 7385-2, BS 5228-2"),
        ((4.0, 15.0), (15.0, 20.0), (40.0, 50.0)),
    ),
    VibrationLimit(
        Text("industrial buildings"),
        Text("DIN 4150-3, table 1, line {}", "1"),
        ((10.0, 20.0), (50.0, 40.0), (100.0, 50.0)),
    ),
    VibrationLimit(
        Text("reinforced or framed buildings, cosmetic damage"), Text("BS 7385-2, BS 5228-2"), ((4.0, 50.0),)
    ),
)
"""The lowest at low frequencies first."""


def reached(velocity_m_s: float, frequency_hz: float) -> tuple[VibrationLimit, ...]:
    """Return the limits that a velocity reaches or exceeds at a frequency."""
    return tuple(limit for limit in LIMITS if velocity_m_s >= limit.at_m_s(frequency_hz))
