"""Largest distances of flyrock by published rules, as if nothing covered the holes. They are no safety distances."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arithmetic import cube_root, power
from ..arrays import FloatArray
from ..units import STANDARD_GRAVITY_M_S2

RISKY_BURIAL = 0.8
"""Scaled depth of burial, m/kg^(1/3), below which flyrock is "violent": B. McKenzie (2009)."""

_INCH_M = 0.0254
_SHORT_HOLE_M = 0.1
_MM_PER_M = 1000.0


def lundborg_range_m(diameter_m: ArrayLike) -> FloatArray:
    """Return L = 260 d^(2/3), d in inches.

    N. Lundborg, A. Persson, A. Ladegaard-Pedersen and R. Holmberg (1975), Keeping the lid on flyrock in open-pit
    blasting, Engineering and Mining Journal 176, 95-100.
    """
    return 260.0 * power(np.asarray(diameter_m, float) / _INCH_M, 2.0 / 3.0)


def scaled_depth_of_burial(
    charge_length_m: ArrayLike, stemming_m: ArrayLike, diameter_m: ArrayLike, density_kg_m3: ArrayLike
) -> FloatArray:
    """Return D / M^(1/3), m/kg^(1/3), of the upper part of a charge: its mass M, and the depth D of its middle.

    That part is 10 diameters long at most, 8 in holes below 100 mm: C. McKenzie (2009), Flyrock range and fragment size
    prediction, 35th Conference on Explosives and Blasting Technique, ISEE, after R. F. Chiappetta.
    """
    diameter = np.asarray(diameter_m, float)
    diameters = np.where(diameter < _SHORT_HOLE_M, 8.0, 10.0)
    length = np.minimum(np.asarray(charge_length_m, float), diameters * diameter)
    mass = np.pi / 4.0 * np.square(diameter) * length * np.asarray(density_kg_m3, float)
    buried: FloatArray = (stemming_m + length / 2.0) / cube_root(mass)
    return buried


def mckenzie_range_m(diameter_m: ArrayLike, scaled_depth: ArrayLike) -> FloatArray:
    """Return R = 9.74 (d / SDoB^2.167)^(2/3), d in mm; C. McKenzie (2009), as above."""
    buried = power(np.asarray(scaled_depth, float), 2.167)
    return 9.74 * power(_MM_PER_M * np.asarray(diameter_m, float) / buried, 2.0 / 3.0)


def speed_for_range_m_s(range_m: ArrayLike) -> FloatArray:
    """Return the least speed with which something flies so far over level ground without drag: √(g R)."""
    speed: FloatArray = np.sqrt(STANDARD_GRAVITY_M_S2 * np.asarray(range_m, float))
    return speed
