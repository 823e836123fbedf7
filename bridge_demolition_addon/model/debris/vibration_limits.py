"""Velocities of the ground at a foundation that buildings bear in a short shaking of low frequency, as touchdown is.

What falls shakes the ground with less than 10 Hz, charges with more than 50 Hz (Huang et al., *Sensors* 23, 2023,
6240). So the limits at the lowest frequencies hold, and not the 50.8 mm/s that are quoted for blasting.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class VibrationLimit:
    """A limit of the peak particle velocity.

    Attributes
    ----------
    building : str
        What it is for.
    velocity_m_s : float
    source : str
        Where it is from.
    """

    building: str
    velocity_m_s: float
    source: str


LIMITS = (
    VibrationLimit("sensitive or listed buildings", 0.003, "DIN 4150-3, table 1, 1 to 10 Hz"),
    VibrationLimit("dwellings", 0.005, "DIN 4150-3, table 1, 1 to 10 Hz"),
    VibrationLimit("unreinforced or light framed buildings, cosmetic damage", 0.015, "BS 7385-2, at 4 Hz"),
    VibrationLimit("industrial buildings", 0.020, "DIN 4150-3, table 1, 1 to 10 Hz"),
    VibrationLimit("reinforced or framed buildings, cosmetic damage", 0.050, "BS 7385-2, from 4 Hz on"),
)
"""The lowest first."""


def reached(velocity_m_s: float) -> tuple[VibrationLimit, ...]:
    """Return the limits that a velocity reaches or exceeds."""
    return tuple(each for each in LIMITS if velocity_m_s >= each.velocity_m_s)
