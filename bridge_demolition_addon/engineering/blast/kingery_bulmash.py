"""The blast wave of Kingery and Bulmash: polynomials fitted to tests with TNT, the standard of the field.

Spherical burst: Kingery and Bulmash, *Airblast Parameters from TNT Spherical Air Burst and Hemispherical Surface
Burst*, ARBRL-TR-02555 (1984). Hemispherical burst: Swisdak, *Simplified Kingery Airblast Calculations*, 26th DoD
Explosives Safety Seminar (1994). The coefficients are in ``data``; every quantity has its own range of scaled
distances, in one to four pieces that meet within 2.4 % (incident impulse of the surface burst at Z = 2.38), mostly
within 1 %.

Nearer than its range a quantity keeps the value at the near end. Beyond it the wave is taken for a sound wave:
pressures and impulses fall as 1/Z, more slowly than a shock and so on the safe side, the duration stays, and the front
goes at the speed of sound.
"""

import csv
from collections import defaultdict
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from functools import cache
from importlib import resources

import numpy as np
from numpy.polynomial import polynomial

from ..arithmetic import exponential, logarithm, power
from ..arrays import FloatArray
from .wave import SOUND_SPEED_M_S, Burst, Wave


class WaveQuantity(StrEnum):
    """Quantity in the tables, by its name there; the fields of a `Wave` come first, in its order."""

    PEAK_OVERPRESSURE = "incident_overpressure"
    REFLECTED_OVERPRESSURE = "reflected_overpressure"
    INCIDENT_IMPULSE = "incident_impulse"
    REFLECTED_IMPULSE = "reflected_impulse"
    ARRIVAL_TIME = "arrival_time"
    DURATION = "positive_phase_duration"
    SHOCK_FRONT_VELOCITY = "shock_front_velocity"


_SI = {"kPa": 1e3, "kPa ms/kg^(1/3)": 1.0, "ms/kg^(1/3)": 1e-3, "km/s": 1e3}
"""The tables' units in Pa, Pa·s/kg^(1/3), s/kg^(1/3) and m/s."""

_FALLING_AS_SOUND = {
    WaveQuantity.PEAK_OVERPRESSURE,
    WaveQuantity.REFLECTED_OVERPRESSURE,
    WaveQuantity.INCIDENT_IMPULSE,
    WaveQuantity.REFLECTED_IMPULSE,
}

_LN_10 = 2.302585092994045684

Formula = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True, slots=True)
class _Piece:
    nearest: float
    farthest: float
    value_at: Formula


def evaluate(quantity: WaveQuantity, scaled_distance: FloatArray, burst: Burst = Burst.AIR) -> FloatArray:
    """Return one quantity for 1 kg of TNT at scaled distances of any shape (m/kg^(1/3)), in Pa, Pa·s, s or m/s."""
    pieces = _tables()[burst][quantity]
    nearest, farthest = pieces[0].nearest, pieces[-1].farthest
    z = np.asarray(scaled_distance, float)
    within = np.clip(z, nearest, farthest)
    values = np.empty(z.shape)
    piece_of = np.searchsorted([piece.farthest for piece in pieces[:-1]], within)
    for number, piece in enumerate(pieces):
        rows = piece_of == number
        values[rows] = piece.value_at(within[rows])
    if quantity in _FALLING_AS_SOUND:
        falling: FloatArray = values * within / np.maximum(z, within)
        return falling
    if quantity is WaveQuantity.ARRIVAL_TIME:
        return values + np.maximum(z - farthest, 0.0) / SOUND_SPEED_M_S
    return values


def unit_wave(scaled_distance: FloatArray, burst: Burst = Burst.AIR) -> Wave:
    """Return the wave of 1 kg of TNT at scaled distances of any shape, m/kg^(1/3)."""
    of_wave = [quantity for quantity in WaveQuantity if quantity is not WaveQuantity.SHOCK_FRONT_VELOCITY]
    return Wave(*(evaluate(quantity, scaled_distance, burst) for quantity in of_wave))


@cache
def _tables() -> Mapping[Burst, Mapping[WaveQuantity, list[_Piece]]]:
    return {
        Burst.AIR: _read("kingery_bulmash_spherical.csv", _power_of_ten),
        Burst.SURFACE: _read("kingery_bulmash_hemispherical.csv", _power_of_e),
    }


def _read(name: str, value_of: Callable[[Mapping[str, str], float], Formula]) -> Mapping[WaveQuantity, list[_Piece]]:
    # Named from here, as the package has another name inside Blender.
    here = resources.files(__package__)
    pieces = defaultdict(list)
    for row in csv.DictReader((here / "data" / name).read_text(encoding="utf-8").splitlines()):
        piece = _Piece(float(row["z_min"]), float(row["z_max"]), value_of(row, _SI[row["unit"]]))
        pieces[WaveQuantity(row["quantity"])].append(piece)
    return pieces


def _power_of_ten(row: Mapping[str, str], unit: float) -> Formula:
    """10^(Σ cᵢ Uⁱ) with U = u₀ + u₁ log₁₀ Z."""
    coefficients, u0, u1 = _coefficients(row), float(row["u0"]), float(row["u1"])
    return lambda z: unit * power(10.0, polynomial.polyval(u0 + u1 * (logarithm(z) / _LN_10), coefficients))


def _power_of_e(row: Mapping[str, str], unit: float) -> Formula:
    """e^(Σ cᵢ (ln Z)ⁱ)."""
    coefficients = _coefficients(row)
    return lambda z: unit * exponential(polynomial.polyval(logarithm(z), coefficients))


def _coefficients(row: Mapping[str, str]) -> list[float]:
    return [float(value) for name, value in row.items() if name.startswith("c") and value]
