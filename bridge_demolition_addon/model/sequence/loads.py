"""Which shards carry each load or cable of a scenario, and how much of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np

from ...engineering.geometry.vectors import distance, length
from ...errors import ScenarioError
from ..loads import Load
from ..pulls import Pull
from ..structure.model import Model
from .events import Structure, in_box, of_members

Acting = TypeVar("Acting", bound=Load | Pull)
"""What acts on shards by a force."""


@dataclass(frozen=True, eq=False, slots=True)
class PlacedLoad(Generic[Acting]):
    """A load or a cable on shards as they were built."""

    load: Acting
    bodies: np.ndarray  # (b,), shards that carry it
    shares: np.ndarray  # (b,), part of it on each
    arm_m: np.ndarray | None  # (3,), from the centre of mass of its one shard; None where it acts there


def placed_loads(
    loads: Sequence[Acting], structure: Structure, masses_kg: np.ndarray, boxes_m: np.ndarray
) -> tuple[PlacedLoad[Acting], ...]:
    """Place loads on the bodies of a structure, by their masses (n,), 0 where they cannot move, and boxes (n, 2, 3)."""
    return tuple(_placed(number, load, structure, masses_kg, boxes_m) for number, load in enumerate(loads, start=1))


def placed_on_model(load: Acting, number: int, model: Model, structure: Structure) -> PlacedLoad[Acting]:
    """Place a load, of a number in its list, on the shards of a model with this structure."""
    masses_kg = np.append(np.where(model.fixed, 0.0, model.masses_kg), 0.0)
    boxes_m = np.concatenate(([shard.bounds for shard in model.shards], np.zeros((1, 2, 3))))
    return _placed(number, load, structure, masses_kg, boxes_m)


def _placed(
    number: int, load: Acting, structure: Structure, masses_kg: np.ndarray, boxes_m: np.ndarray
) -> PlacedLoad[Acting]:
    chosen = of_members(load, structure) & in_box(load, structure.centres_m) & structure.is_shard
    bodies = np.flatnonzero(chosen & (masses_kg > 0.0))
    if not len(bodies):
        raise ScenarioError(
            f"[[{load.table}]] number {number}: no shard that can move is there; expected members or a box with some "
            "that no support holds"
        )
    if load.point_m is None:
        return PlacedLoad(load, bodies, masses_kg[bodies] / masses_kg[bodies].sum(), None)
    point = np.array(load.point_m)
    outside_m = length(point - np.clip(point, boxes_m[bodies, 0], boxes_m[bodies, 1]))
    nearest = np.lexsort((distance(structure.centres_m[bodies], point), outside_m.round(6)))[:1]
    body = bodies[nearest]
    return PlacedLoad(load, body, np.ones(1), point - structure.centres_m[body[0]])
