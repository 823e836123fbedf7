"""How a bed of loose material stops what falls on it: as a cushion on a gallery stops a block.

ASTRA 12006 (*Einwirkungen infolge Steinschlags auf Schutzgalerien*, 2008, V2.03), after drop tests by Labiouse,
Descoeudres and Montani (*Structural Engineering International* 6(3), 1996, 171-176) with blocks of 100 to 1000 kg,
which fell up to 10 m on 0.35 to 1 m of gravel and soil:

    F = 2.8 t^-0.5 r^0.7 M_E^0.4 tan φ (m v² / 2)^0.6,    d = m v² / F

with F in kN, t and r in m, M_E in kPa, m in t and v in m/s. F is the largest force. Its mean over d is half of it,
which is what stops the block there. Shards are heavier than those blocks, so that it is extrapolated.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from ..arithmetic import cosine, cube_root, power, sine

_KILO = 1e3

TESTED_KG = (100.0, 1000.0)
"""Masses of the blocks of these tests."""


def radius_m(volumes_m3: ArrayLike) -> np.ndarray:
    """Return the radii of balls of such volumes, m."""
    return cube_root(np.asarray(volumes_m3, float) * (0.75 / math.pi))


def largest_force_n(
    energy_j: ArrayLike, radii_m: ArrayLike, *, thickness_m: float, modulus_kpa: float, friction: float
) -> np.ndarray:
    """Return the largest force on a block of a radius that falls on a bed with an energy, N.

    `friction` is the tangent of the angle of friction of the bed.
    """
    of_bed = 2.8 / math.sqrt(thickness_m) * float(power(modulus_kpa, 0.4)) * friction
    force: np.ndarray = _KILO * of_bed * power(radii_m, 0.7) * power(np.asarray(energy_j, float) / _KILO, 0.6)
    return force


def depth_m(energy_j: ArrayLike, force_n: ArrayLike) -> np.ndarray:
    """Return how deep a block sinks into a bed whose force on it is that large at most."""
    depth: np.ndarray = 2.0 * np.asarray(energy_j, float) / np.asarray(force_n, float)
    return depth


def friction_of(angle_deg: float) -> float:
    """Return the tangent of an angle of friction."""
    angle = math.radians(angle_deg)
    return float(sine(angle) / cosine(angle))
