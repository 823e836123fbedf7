"""Soil under footings, kept with the connections that stand on it."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np

from ...engineering.foundations.footings import SoilSprings
from ..custom_properties import edited, kept_series
from .breaking_settings import set_strength

_SOIL = "bda_soil"
_COUNT = 4
"""How many numbers a footing has, and each point under it."""


def keep_soil(connections: Sequence[bpy.types.Object], soil: SoilSprings) -> None:
    """Keep soil with the connections that stand on it; no stress breaks these."""
    of_footings = zip(soil.stiffness_n_m3, soil.horizontal_n_m3, soil.capacity_pa, soil.friction, strict=True)
    positions = np.column_stack((soil.places_m, soil.areas_m2))
    for number, (row, values) in enumerate(zip(soil.rows.tolist(), of_footings, strict=True)):
        connections[row][_SOIL] = [*map(float, values), *positions[soil.footings == number].ravel().tolist()]
        set_strength(connections[row], None)


def soil_of(connections: Sequence[bpy.types.Object]) -> SoilSprings | None:
    """Return the soil under connections; None where the ground is rigid under all of them."""
    rows = [row for row, connection in enumerate(connections) if _SOIL in connection]
    if not rows:
        return None
    blocks = [_numbers(connections[row]) for row in rows]
    footings = np.array([block[0] for block in blocks])
    footing_of_point = np.repeat(np.arange(len(rows)), [len(block) - 1 for block in blocks])
    points = np.concatenate([block[1:] for block in blocks])
    return SoilSprings(np.array(rows), footing_of_point, points[:, :3], points[:, 3], *footings.T)


def _numbers(connection: bpy.types.Object) -> np.ndarray:
    """Return the numbers of a footing and of each point under it (1 + p, 4)."""
    expected = "the numbers of a footing and of the points under it"
    numbers = kept_series(connection, _SOIL, expected)
    if len(numbers) <= _COUNT or len(numbers) % _COUNT or not (numbers[:2] > 0.0).all():
        raise edited(connection, _SOIL, expected)
    return numbers.reshape(-1, _COUNT)
