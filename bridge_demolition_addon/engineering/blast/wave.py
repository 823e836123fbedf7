"""The quantities of a blast wave where it arrives, how they scale with the charge, and its front in air.

The front follows the Rankine-Hugoniot relations for a perfect gas with a ratio of specific heats of 1.4: Kinney and
Graham, *Explosive Shocks in Air* (2nd ed., 1985), chapters 4 and 5; Smith and Hetherington, *Blast and Ballistic
Loading of Structures* (1994), chapter 3.
"""

from dataclasses import dataclass
from enum import StrEnum
from typing import NoReturn

import numpy as np
from numpy.typing import ArrayLike

from ...errors import BlastError
from ..arithmetic import cube_root
from ..arrays import FloatArray

AMBIENT_PRESSURE_PA = 101_325.0
"""Standard atmosphere at sea level."""

SOUND_SPEED_M_S = 340.29
"""Speed of sound in the standard atmosphere at sea level, 15 °C."""

SMALLEST_SCALED_DISTANCE = 0.0531
"""Scaled distance, m/kg^(1/3), below which everything counts as this near.

It is where the table of Kingery and Bulmash begins, and the surface of the charge itself: a ball of 1 kg TNT with a
density of 1630 kg/m³ has a radius of 0.0527 m.
"""


class NamedChoice(StrEnum):
    """Base of the few things to choose between; each is equal to the text that names it."""

    @classmethod
    def _missing_(cls, value: object) -> NoReturn:
        raise BlastError(f"{cls.__name__} is {value!r}: expected one of {', '.join(cls)}")


class Burst(NamedChoice):
    """Surroundings of a detonation."""

    AIR = "air"
    """Far from any surface: the wave is a sphere."""

    SURFACE = "surface"
    """On the ground, which sends back what goes down: the wave is a hemisphere."""


@dataclass(frozen=True, eq=False, slots=True)
class Wave:
    """A blast wave at some positions, arrays of one shape.

    Incident pressure and impulse act on a surface along the wave's path, reflected ones on a wall that it meets
    head-on.
    """

    peak_overpressure_pa: FloatArray
    reflected_overpressure_pa: FloatArray
    incident_impulse_pa_s: FloatArray  # per area, of the positive phase
    reflected_impulse_pa_s: FloatArray
    arrival_time_s: FloatArray  # from the detonation to the front
    positive_phase_duration_s: FloatArray

    def scaled(self, size: FloatArray) -> "Wave":
        """Return the wave at the same scaled distances from charges whose cube root is `size` times as large.

        Pressures stay, times and impulses grow with the cube root (Hopkinson 1915, Cranz 1926). Without any charge
        there is no wave: everything is 0.
        """
        there = size > 0.0
        return Wave(
            self.peak_overpressure_pa * there,
            self.reflected_overpressure_pa * there,
            self.incident_impulse_pa_s * size,
            self.reflected_impulse_pa_s * size,
            self.arrival_time_s * size,
            self.positive_phase_duration_s * size,
        )


def shock_speed(overpressure_pa: FloatArray) -> FloatArray:
    """Return the speed of a shock front, m/s: c₀ √(1 + 6 p₀ / 7 Pₐ)."""
    return SOUND_SPEED_M_S * np.sqrt(1.0 + 6.0 * np.asarray(overpressure_pa) / (7.0 * AMBIENT_PRESSURE_PA))


def reflected_overpressure(overpressure_pa: FloatArray) -> FloatArray:
    """Return the overpressure on a wall that a front meets head-on, Pa: 2 p₀ (7 Pₐ + 4 p₀) / (7 Pₐ + p₀).

    Between 2 p₀ for a weak front and 8 p₀ for a strong one. Air in front of a charge is hot enough to be no perfect
    gas any more, and reflects up to 13 p₀.
    """
    peak = np.asarray(overpressure_pa, float)
    return 2.0 * peak * (7.0 * AMBIENT_PRESSURE_PA + 4.0 * peak) / (7.0 * AMBIENT_PRESSURE_PA + peak)


def scaled_distance(stand_off_m: ArrayLike, tnt_kg: ArrayLike) -> FloatArray:
    """Return the scaled distance Z = R / W^(1/3), m/kg^(1/3), the report's equation 5 with a transmission factor of 1.

    Stand-offs (m) and charges (kg of TNT) broadcast; without charge the distance is infinite.
    """
    stand_off = checked(stand_off_m, "stand-off", "m")
    size = cube_root(checked(tnt_kg, "charge", "kg of TNT"))
    shape = np.broadcast_shapes(stand_off.shape, np.shape(size))
    scaled: FloatArray = np.divide(stand_off, size, out=np.full(shape, np.inf), where=size > 0.0)
    return scaled


def checked(values: ArrayLike, name: str, unit: str) -> FloatArray:
    """Return values as floats; raise where one is below 0 or not finite."""
    numbers = np.asarray(values, float)
    wrong = numbers[~((numbers >= 0.0) & np.isfinite(numbers))]
    if wrong.size:
        raise BlastError(f"{name} is {wrong.flat[0]:g}: expected a finite number of at least 0 ({unit})")
    return numbers
