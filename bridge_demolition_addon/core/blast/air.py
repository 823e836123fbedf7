"""Shock fronts in air: the Rankine-Hugoniot relations for a perfect gas with a ratio of specific heats of 1.4.

Sources: Kinney and Graham, *Explosive Shocks in Air* (2nd ed., 1985), chapters 4 and 5; Smith and Hetherington, *Blast
and Ballistic Loading of Structures* (1994), chapter 3.
"""

import numpy as np

AMBIENT_PRESSURE_PA = 101_325.0
"""Standard atmosphere at sea level."""

SOUND_SPEED_M_S = 340.29
"""Speed of sound in the standard atmosphere at sea level, 15 °C."""


def shock_speed(overpressure_pa: np.ndarray) -> np.ndarray:
    """Return the speed of a shock front, m/s: c₀ √(1 + 6 p₀ / 7 Pₐ)."""
    return SOUND_SPEED_M_S * np.sqrt(1.0 + 6.0 * np.asarray(overpressure_pa) / (7.0 * AMBIENT_PRESSURE_PA))


def reflected_overpressure(overpressure_pa: np.ndarray) -> np.ndarray:
    """Return the overpressure on a wall that a front meets head-on, Pa: 2 p₀ (7 Pₐ + 4 p₀) / (7 Pₐ + p₀).

    Between 2 p₀ for a weak front and 8 p₀ for a strong one. Air in front of a charge is hot enough to be no perfect
    gas any more, and reflects up to 13 p₀.
    """
    peak = np.asarray(overpressure_pa, float)
    return 2.0 * peak * (7.0 * AMBIENT_PRESSURE_PA + 4.0 * peak) / (7.0 * AMBIENT_PRESSURE_PA + peak)
