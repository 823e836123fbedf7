"""The blast wave of Kinney and Graham: closed formulas for a spherical burst of TNT, the report's equations 3 and 4.

Kinney and Graham, *Explosive Shocks in Air* (2nd ed., 1985), chapter 6. Far away their pressure and impulse fall as
1/Z, like a sound wave's, so that their range has no end.
"""

from functools import cache

import numpy as np

from ..arithmetic import cube_root, power
from ..arrays import FloatArray
from .wave import (
    AMBIENT_PRESSURE_PA,
    SMALLEST_SCALED_DISTANCE,
    SOUND_SPEED_M_S,
    Burst,
    Wave,
    reflected_overpressure,
    shock_speed,
)

GROUND_REFLECTION = 1.8
"""Number of charges in the air that act like one on the ground: 2 on unyielding ground, less the work of the crater
(Smith and Hetherington 1994, section 3.4). Kinney and Graham have no surface burst of their own."""

SHORTEST_DURATION_DISTANCE = 0.5095
"""Scaled distance, m/kg^(1/3), of the least duration. Nearer than it equation 4 rises again, up to a second for 1 kg,
which contradicts peak and impulse by the other formulas; a wave keeps its least duration there."""

_TABLE_DECADES = (-3.0, 4.0)
"""Powers of ten of the scaled distances between which arrival times are integrated, up to where it is a sound wave."""


def peak_overpressure(scaled_distance: FloatArray) -> FloatArray:
    """Return the peak incident overpressure, Pa (equation 3)."""
    z = np.asarray(scaled_distance, float)
    ratio = (
        808.0
        * (1.0 + _raised(z / 4.5, 2))
        / (
            np.sqrt(1.0 + _raised(z / 0.048, 2))
            * np.sqrt(1.0 + _raised(z / 0.32, 2))
            * np.sqrt(1.0 + _raised(z / 1.35, 2))
        )
    )
    overpressure: FloatArray = AMBIENT_PRESSURE_PA * ratio
    return overpressure


def scaled_duration(scaled_distance: FloatArray) -> FloatArray:
    """Return the positive-phase duration of 1 kg of TNT, s (equation 4)."""
    z = np.asarray(scaled_distance, float)
    milliseconds = (
        980.0
        * (1.0 + _raised(z / 0.54, 10))
        / ((1.0 + _raised(z / 0.02, 3)) * (1.0 + _raised(z / 0.74, 6)) * np.sqrt(1.0 + _raised(z / 6.9, 2)))
    )
    return 1e-3 * milliseconds


def scaled_incident_impulse(scaled_distance: FloatArray) -> FloatArray:
    """Return the incident impulse per area of 1 kg of TNT, Pa·s: 6.7 √(1 + (Z/0.23)⁴) / (Z² ∛(1 + (Z/1.55)³)).

    Not in the report; Kinney and Graham give it in bar·ms, with 0.067.
    """
    z = np.asarray(scaled_distance, float)
    impulse: FloatArray = 6.7 * np.sqrt(1.0 + _raised(z / 0.23, 4)) / (z * z * cube_root(1.0 + _raised(z / 1.55, 3)))
    return impulse


def scaled_arrival_time(scaled_distance: FloatArray) -> FloatArray:
    """Return the arrival time for 1 kg of TNT, s: of a front with the speed that its overpressure gives it.

    Kinney and Graham have no formula for it. Its path begins in the middle of the charge.
    """
    distances, times = _arrival_table()
    z = np.asarray(scaled_distance, float)
    beyond = np.maximum(z - distances[-1], 0.0) / SOUND_SPEED_M_S
    arrival: FloatArray = np.interp(z, distances, times) + beyond
    return arrival


def unit_wave(scaled_distance: FloatArray, burst: Burst = Burst.AIR) -> Wave:
    """Return the wave of 1 kg of TNT at scaled distances of any shape, m/kg^(1/3)."""
    if burst is Burst.SURFACE:
        size = cube_root(GROUND_REFLECTION)
        return unit_wave(np.asarray(scaled_distance) / size).scaled(size)
    z = np.maximum(scaled_distance, SMALLEST_SCALED_DISTANCE)
    peak, impulse = peak_overpressure(z), scaled_incident_impulse(z)
    reflected = reflected_overpressure(peak)
    return Wave(
        peak,
        reflected,
        impulse,
        impulse * reflected / peak,  # the reflected pulse has the shape of the incident one
        scaled_arrival_time(z),
        scaled_duration(np.maximum(z, SHORTEST_DURATION_DISTANCE)),
    )


def _raised(base: FloatArray, exponent: int) -> FloatArray:
    """Return base to the power of a whole exponent, by products alone."""
    result = base
    for _ in range(exponent - 1):
        result = result * base
    return result


@cache
def _arrival_table() -> tuple[FloatArray, FloatArray]:
    distances = np.concatenate(([0.0], power(10.0, np.linspace(*_TABLE_DECADES, 4001))))
    slowness = 1.0 / shock_speed(peak_overpressure(distances))
    steps = np.diff(distances) * (slowness[1:] + slowness[:-1]) / 2.0
    return distances, np.concatenate(([0.0], np.cumsum(steps)))
