"""Ground vibration from blasting, by square-root scaled distance: v = K (R / √Q)^(-β).

Form: Nicholls, Johnson and Duvall, *Blasting Vibrations and Their Effects on Structures*, USBM Bulletin 656 (1971). K
and β are measured on site; those here are to begin with. They are for charges drilled into rock: charges in the columns
of a bridge shake the ground less. The fall of the bridge, which often shakes it more, is not in them.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...errors import BlastError
from ..arithmetic import power
from ..arrays import FloatArray
from .wave import checked

DAMAGE_LIMIT_M_S = 0.0508
"""Peak particle velocity (2 inches per second) that houses withstand, USBM Bulletin 656; many codes ask for less."""


@dataclass(frozen=True, slots=True)
class VibratingGround:
    """Constants of ground that carries vibration."""

    name: str
    velocity_m_s: float  # K: peak particle velocity at a scaled distance of 1 m/kg^(1/2)
    exponent: float  # β


FREE_FACE_HARD = VibratingGround("free face, hard or highly structured rock", 0.500, 1.6)
FREE_FACE_AVERAGE = VibratingGround("free face, average rock", 1.140, 1.6)
CONFINED = VibratingGround("heavily confined charge", 5.000, 1.6)
"""Constants from Dyno Nobel, *Blasting and Explosives Quick Reference Guide* (2010); the one for average rock is that
of Australian Standard AS 2187.2, and is 160 in/s at 1 ft/lb^(1/2) in the units of American handbooks."""

GROUNDS = {"hard": FREE_FACE_HARD, "average": FREE_FACE_AVERAGE, "confined": CONFINED}


def peak_particle_velocity(
    distance_m: ArrayLike, charge_kg: ArrayLike, ground: VibratingGround = FREE_FACE_AVERAGE
) -> FloatArray:
    """Return the peak particle velocity, m/s, at distances (m) that broadcast with charges (kg).

    A charge is the explosive that detonates within one delay. Its own mass counts: the constants are not for TNT.
    """
    distance, charge = _distances(distance_m), checked(charge_kg, "charge", "kg")
    return ground.velocity_m_s * power(np.sqrt(charge) / distance, ground.exponent)


def charge_per_delay(
    distance_m: ArrayLike, limit_m_s: ArrayLike = DAMAGE_LIMIT_M_S, ground: VibratingGround = FREE_FACE_AVERAGE
) -> FloatArray:
    """Return the explosive that may detonate within one delay so that a velocity is kept at distances, kg."""
    limit = checked(limit_m_s, "limit", "m/s")
    return np.square(_distances(distance_m) * power(limit / ground.velocity_m_s, 1.0 / ground.exponent))


def distance_for_velocity(
    charge_kg: ArrayLike, limit_m_s: ArrayLike = DAMAGE_LIMIT_M_S, ground: VibratingGround = FREE_FACE_AVERAGE
) -> FloatArray:
    """Return the distance from which on a charge keeps a velocity (above 0), m."""
    limit = checked(limit_m_s, "limit", "m/s")
    if (limit == 0.0).any():
        raise BlastError("limit is 0: expected a number above 0 (m/s)")
    return np.sqrt(checked(charge_kg, "charge", "kg")) * power(ground.velocity_m_s / limit, 1.0 / ground.exponent)


def _distances(distance_m: ArrayLike) -> FloatArray:
    distance = checked(distance_m, "distance", "m")
    if (distance == 0.0).any():
        raise BlastError("distance is 0: expected a number above 0 (m)")
    return distance
