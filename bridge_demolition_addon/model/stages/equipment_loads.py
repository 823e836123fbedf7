"""Weights of equipment on the shards under it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...engineering.units import STANDARD_GRAVITY_M_S2
from ...errors import ScenarioError
from ..scenario import Equipment
from ..structure.model import Model

_AT_THE_TOP = 0.05
"""Of the depth of the bridge there, m: shards whose top is that close to the highest one bear what stands on it."""

_PLACES = 8
"""Along each side of a footprint: its weight stands on so many places by so many, as evenly as that."""


def equipment_loads(model: Model, equipment: Sequence[Equipment], removed: np.ndarray) -> np.ndarray:
    """Return forces and moments (6, n) on the shards by what stands on them.

    Each part of a footprint stands on the highest shard under it. A force at the edge of a shard turns it as well.
    """
    loads = np.zeros((6, len(model.shards)))
    boxes = np.array([each.bounds for each in model.shards])
    for each in equipment:
        weight_n = STANDARD_GRAVITY_M_S2 * each.mass_kg / _PLACES**2
        for place in _places(each):
            shard = _highest_under(place, boxes, removed)
            if shard is None:
                where = ", ".join(f"{number:.2f}" for number in place)
                raise ScenarioError(
                    f"equipment {each.name!r}: nothing of the bridge is under [{where}] m; move it, or let it be taken "
                    "away before what it stands on is"
                )
            arm_x, arm_y = place - model.centres_m[shard, :2]
            loads[2, shard] -= weight_n
            loads[3, shard] -= arm_y * weight_n
            loads[4, shard] += arm_x * weight_n
    return loads


def _places(equipment: Equipment) -> np.ndarray:
    """Middles (k, 2) of the parts of a footprint."""
    steps = (np.arange(_PLACES) + 0.5) / _PLACES - 0.5
    length_m, width_m = equipment.footprint_m
    x, y = np.meshgrid(steps * length_m, steps * width_m)
    return np.column_stack((x.ravel(), y.ravel())) + np.array(equipment.place_m)


def _highest_under(place: np.ndarray, boxes: np.ndarray, removed: np.ndarray) -> int | None:
    """The shard whose box (2, 3) is under a place (2,) and highest; of several, the one whose middle is nearest."""
    over = (boxes[:, 0, :2] <= place).all(axis=1) & (place <= boxes[:, 1, :2]).all(axis=1) & ~removed
    rows = np.flatnonzero(over)
    if not len(rows):
        return None
    tops = boxes[rows, 1, 2]
    rows = rows[tops >= tops.max() - _AT_THE_TOP]
    middles = boxes[rows, :, :2].mean(axis=1)
    return int(rows[np.argmin(np.square(middles - place).sum(axis=1))])
