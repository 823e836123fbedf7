"""What confined charges do at a distance: pressure in air and vibration of the ground."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arithmetic import cube_root, logarithm, power
from ..arrays import BoolArray, FloatArray

BARE_KPA = 516.0
STEMMED_KPA = 20.0
"""K_a of AS 2187.2, appendix J: of charges in the open, and of well stemmed holes, which have 5 to 20."""

_AIR_EXPONENT = 1.45
_REFERENCE_PA = 20e-6
_PA_PER_KPA = 1000.0

DELAY_WINDOW_S = 0.008
"""What detonates less than this apart shakes the ground together; more, one after the other. USBM Bulletin 656 (1971)
has 8 ms, and most rules since."""


def air_pressure_pa(distance_m: ArrayLike, charge_kg: ArrayLike, site_kpa: float = STEMMED_KPA) -> FloatArray:
    """Return the peak pressure in air, P = K_a (R / Q^(1/3))^-1.45, AS 2187.2 (2006), appendix J."""
    scaled = np.asarray(distance_m, float) / cube_root(charge_kg)
    return _PA_PER_KPA * site_kpa * power(scaled, -_AIR_EXPONENT)


def decibels(pressure_pa: ArrayLike) -> FloatArray:
    """Return the peak level of a pressure in air over 20 µPa, dB."""
    level: FloatArray = 20.0 * logarithm(np.asarray(pressure_pa, float) / _REFERENCE_PA) / np.log(10.0)
    return level


def largest_mass_together_kg(
    times_s: ArrayLike, masses_kg: ArrayLike, spreads_s: ArrayLike = 0.0, window_s: float = DELAY_WINDOW_S
) -> float:
    """Return the largest mass that can detonate within a window, 0 without any charge.

    A spread (k,) is how much earlier or later than its time (k,) a charge may fire.
    """
    within = fires_together(times_s, spreads_s, window_s)
    return float((within * np.asarray(masses_kg, float)).sum(axis=1).max(initial=0.0))


def fires_together(times_s: ArrayLike, spreads_s: ArrayLike = 0.0, window_s: float = DELAY_WINDOW_S) -> BoolArray:
    """Return which charges (k, k) can fire within a window that begins as late as each of them can fire.

    The fullest window is among these. Times and spreads (k,) as in `largest_mass_together_kg`.
    """
    times, spreads = np.broadcast_arrays(np.asarray(times_s, float), np.asarray(spreads_s, float))
    first, last = times - spreads, times + spreads
    within: BoolArray = (first < last[:, None] + window_s) & (last >= last[:, None])
    return within
