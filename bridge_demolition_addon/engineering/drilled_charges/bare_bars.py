"""Bars that stay in a zone when its concrete is gone: they yield in tension, and yield or buckle in compression.

A bar is fixed in the concrete at both ends of the bared height and cannot move sideways there, so that Euler's length
is half of that: P = π² E I / (0.5 l)². Ends that move sideways with the whole member would buckle at a quarter of it.

Two forces in compression bound what bars resist. Curve c of EN 1993-1-1, for solid round bars, is what they may be
counted on for: it has them bowed by 1/200 to 1/150 of their length (table 5.1), and explosive does not leave them
straighter. Bars without any bow resist the less of yield and Euler's load: 1.3 to 1.85 times as much over 20 to 50
diameters. A run has these, so that what comes down in it comes down on the strongest of bars.

A bar that has buckled folds in three plastic hinges, at its ends and in its middle, and resists less the more it folds.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import FloatArray
from ..elasticity.buckling_curves import reduction_factor
from ..elasticity.steel_bars import MODULUS_PA, YIELD_PA

_EFFECTIVE_LENGTH = 0.5

_CURVE = "c"
"""Of solid sections: EN 1993-1-1:2005, table 6.2."""


def bar_area_m2(diameter_m: ArrayLike) -> FloatArray:
    """Return the cross-section of a bar."""
    area: FloatArray = np.pi / 4.0 * np.square(np.asarray(diameter_m, float))
    return area


def yield_force_n(diameter_m: ArrayLike, yield_pa: ArrayLike = YIELD_PA) -> FloatArray:
    """Return the force at which a bar yields."""
    force: FloatArray = bar_area_m2(diameter_m) * np.asarray(yield_pa, float)
    return force


def buckling_force_n(diameter_m: ArrayLike, bared_m: ArrayLike) -> FloatArray:
    """Return the force at which an elastic bar buckles over a bared height (L. Euler, 1744), whatever its yield."""
    diameter = np.asarray(diameter_m, float)
    inertia_m4 = np.pi / 64.0 * np.square(np.square(diameter))
    force: FloatArray = np.pi * np.pi * MODULUS_PA * inertia_m4 / np.square(_EFFECTIVE_LENGTH * np.asarray(bared_m))
    return force


def compression_n(diameter_m: ArrayLike, bared_m: ArrayLike, yield_pa: ArrayLike = YIELD_PA) -> FloatArray:
    """Return what a bar may be counted on for in compression: χ A f_y of curve c."""
    yields = yield_force_n(diameter_m, yield_pa)
    return reduction_factor(np.sqrt(yields / buckling_force_n(diameter_m, bared_m)), _CURVE) * yields


def straight_compression_n(diameter_m: ArrayLike, bared_m: ArrayLike, yield_pa: ArrayLike = YIELD_PA) -> FloatArray:
    """Return what a bar without any bow resists in compression: the less of its forces at yield and at buckling."""
    return np.minimum(yield_force_n(diameter_m, yield_pa), buckling_force_n(diameter_m, bared_m))


def slender_from_m(diameter_m: ArrayLike, yield_pa: ArrayLike = YIELD_PA) -> FloatArray:
    """Return the bared height from which on a straight bar buckles before it yields: (π/2) d √(E/f_y).

    That is 31.4 d at 500 N/mm², where it may be counted on for 54 % of its yield force.
    """
    height: FloatArray = np.pi / 2.0 * np.asarray(diameter_m, float) * np.sqrt(MODULUS_PA / np.asarray(yield_pa))
    return height


def largest_compression_n(
    diameter_m: ArrayLike, bared_m: ArrayLike, yield_pa: ArrayLike = YIELD_PA, *, straight: bool = True
) -> FloatArray:
    """Return what a bar resists until it folds: its buckling load if `straight`, or else what it may be counted on for.

    As it folds it resists the less of this and of its hinges (`core/src/cages.c`).
    """
    return buckling_force_n(diameter_m, bared_m) if straight else compression_n(diameter_m, bared_m, yield_pa)


def hinge_arm_m(diameter_m: ArrayLike) -> FloatArray:
    """Return the moment of two plastic hinges by the yield force, 2 M_p / N_p: M_p of a round bar is f_y d³ / 6."""
    arm: FloatArray = 4.0 / (3.0 * np.pi) * np.asarray(diameter_m, float)
    return arm
