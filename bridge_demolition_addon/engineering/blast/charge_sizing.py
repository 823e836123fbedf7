"""The distance up to which a charge gives a wanted load, and the smallest charge that gives it at a distance.

Both follow from the farthest scaled distance with that load. It is on the safe side, also where the tables are not
monotonic: the incident impulse has a bump near Z = 0.8 m/kg^(1/3), and pieces of a table meet in small steps.
"""

from collections.abc import Callable
from functools import cache, lru_cache

import numpy as np

from ...errors import BlastError
from ..arithmetic import cube_root, power
from ..arrays import FloatArray
from .pulses import BlastModel, blast_wave
from .wave import SMALLEST_SCALED_DISTANCE, Burst, checked

_FARTHEST_SCALED_DISTANCE = 1e6
"""End of the search: the overpressure there is less than 0.1 Pa."""

_GRID_POINTS = 4001
_PARTS = np.arange(257) / 256
_DIVISIONS = 6
"""Enough to divide a cell of the grid by 256 down to rounding."""


def stand_off_for_overpressure(
    overpressure_pa: float,
    tnt_kg: float,
    burst: Burst | str = Burst.AIR,
    model: BlastModel | str = BlastModel.KINGERY_BULMASH,
) -> float:
    """Return the farthest stand-off at which a charge gives a peak incident overpressure, m; 0 for no charge."""
    _check(overpressure_pa, "overpressure", "Pa")
    size = float(cube_root(checked(tnt_kg, "charge", "kg of TNT")))
    return size * _distance_of_overpressure(overpressure_pa, Burst(burst), BlastModel(model))


def smallest_charge_for_overpressure(
    overpressure_pa: float,
    stand_off_m: float,
    burst: Burst | str = Burst.AIR,
    model: BlastModel | str = BlastModel.KINGERY_BULMASH,
) -> float:
    """Return the smallest charge that gives a peak incident overpressure at a stand-off, kg of TNT."""
    _check(overpressure_pa, "overpressure", "Pa")
    _check(stand_off_m, "stand-off", "m")
    z = _distance_of_overpressure(overpressure_pa, Burst(burst), BlastModel(model))
    return _charge_at(stand_off_m, z)


def smallest_charge_for_impulse(
    impulse_pa_s: float,
    stand_off_m: float,
    burst: Burst | str = Burst.AIR,
    model: BlastModel | str = BlastModel.KINGERY_BULMASH,
) -> float:
    """Return the smallest charge that gives an incident impulse per area at a stand-off, kg of TNT.

    The impulse of W kg is the impulse of 1 kg at the same Z, times W^(1/3) = R/Z. So Z is where (impulse of 1 kg) / Z
    is the wanted impulse over R.
    """
    _check(impulse_pa_s, "impulse", "Pa·s")
    _check(stand_off_m, "stand-off", "m")
    burst, model = Burst(burst), BlastModel(model)
    z = _farthest(impulse_pa_s / stand_off_m, _impulse_over_distance, burst, model)
    if z is None:
        most = _on_grid(_impulse_over_distance, burst, model).max() * stand_off_m
        raise BlastError(f"impulse is {impulse_pa_s:g}: expected up to {most:.4g} (Pa·s) at {stand_off_m:g} m")
    return _charge_at(stand_off_m, z)


def _charge_at(stand_off_m: float, scaled_distance: float) -> float:
    """Return the charge, kg of TNT, by a stand-off and its scaled distance."""
    size = stand_off_m / scaled_distance
    return size * size * size


@lru_cache(maxsize=1000)
def _distance_of_overpressure(overpressure_pa: float, burst: Burst, model: BlastModel) -> float:
    """Return the farthest scaled distance at which the peak overpressure is reached, m/kg^(1/3)."""
    z = _farthest(overpressure_pa, _peak_overpressure, burst, model)
    if z is None:
        most = _on_grid(_peak_overpressure, burst, model).max()
        raise BlastError(
            f"overpressure is {overpressure_pa / 1e3:g} kPa: expected up to {most / 1e3:.4g}, that of TNT in contact"
        )
    return z


def _peak_overpressure(z: FloatArray, burst: Burst, model: BlastModel) -> FloatArray:
    return blast_wave(z, 1.0, burst, model).peak_overpressure_pa


def _impulse_over_distance(z: FloatArray, burst: Burst, model: BlastModel) -> FloatArray:
    return blast_wave(z, 1.0, burst, model).incident_impulse_pa_s / z


def _farthest(wanted: float, load: Callable[..., FloatArray], burst: Burst, model: BlastModel) -> float | None:
    """Return the farthest scaled distance with a load, None if there is none."""
    distances, loads = _distances(), _on_grid(load, burst, model)
    reached = np.flatnonzero(loads >= wanted)
    if not len(reached):
        return None
    if reached[-1] == len(distances) - 1:
        raise BlastError(f"load is {wanted:g}: expected more than {loads[-1]:.2g}, that beyond any distance")
    near, far = distances[reached[-1]], distances[reached[-1] + 1]
    for _ in range(_DIVISIONS):
        between = near + (far - near) * _PARTS
        last = np.flatnonzero(load(between[:-1], burst, model) >= wanted).max(initial=0)
        near, far = between[last], between[last + 1]
    return float(near)


@cache
def _distances() -> FloatArray:
    span = _FARTHEST_SCALED_DISTANCE / SMALLEST_SCALED_DISTANCE
    return SMALLEST_SCALED_DISTANCE * power(span, np.linspace(0.0, 1.0, _GRID_POINTS))


@cache
def _on_grid(load: Callable[..., FloatArray], burst: Burst, model: BlastModel) -> FloatArray:
    return load(_distances(), burst, model)


def _check(value: float, name: str, unit: str) -> None:
    if not (np.isfinite(value) and value > 0.0):
        raise BlastError(f"{name} is {value}: expected a finite number above 0 ({unit})")
