"""Soil under footings, kept with the connections that stand on it."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np

from ...engineering.foundations.footings import SoilSprings
from ..custom_properties import edited
from .breaking_settings import set_strength

_SOIL = "bda_soil"
_OF_FOOTING, _OF_PLACE = 4, 4
"""How many numbers a footing has, and each place under it."""


def keep_soil(connections: Sequence[bpy.types.Object], soil: SoilSprings) -> None:
    """Keep with connections what they stand on; no stress breaks these."""
    of_footings = zip(soil.stiffness_n_m3, soil.horizontal_n_m3, soil.capacity_pa, soil.friction, strict=True)
    places = np.column_stack((soil.places_m, soil.areas_m2))
    for number, (row, values) in enumerate(zip(soil.rows.tolist(), of_footings, strict=True)):
        connections[row][_SOIL] = [*map(float, values), *places[soil.footings == number].ravel().tolist()]
        set_strength(connections[row], None)


def soil_of(connections: Sequence[bpy.types.Object]) -> SoilSprings | None:
    """Return what connections stand on; None where the ground does not give under any."""
    rows = [row for row, each in enumerate(connections) if _SOIL in each]
    if not rows:
        return None
    numbers = [_numbers(connections[row]) for row in rows]
    footings = np.array([number[:_OF_FOOTING] for number in numbers])
    places = [number[_OF_FOOTING:].reshape(-1, _OF_PLACE) for number in numbers]
    of_place = np.repeat(np.arange(len(rows)), [len(position) for position in places])
    each_place = np.concatenate(places)
    return SoilSprings(np.array(rows), of_place, each_place[:, :3], each_place[:, 3], *footings.T)


def _numbers(connection: bpy.types.Object) -> np.ndarray:
    try:
        numbers = np.array(connection[_SOIL], float)
    except (TypeError, ValueError):
        numbers = np.zeros(0)
    if len(numbers) <= _OF_FOOTING or (len(numbers) - _OF_FOOTING) % _OF_PLACE or not (numbers[:2] > 0.0).all():
        raise edited(connection, _SOIL, "the numbers of a footing and of the places under it")
    return numbers
