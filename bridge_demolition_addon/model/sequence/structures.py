"""Bodies and connections as they were built, of a model and of a scene that is recorded."""

from __future__ import annotations

import numpy as np

from ..as_built import Structure
from ..results.inventory import Inventory
from ..structure.model import Model
from ..structure.tendons import ModelTendons


def model_structure(model: Model) -> Structure:
    """Return the structure of a model, where all connections to the ground end at one more body after the shards."""
    members = [model.members[member] for member in model.member_of_shard]
    count, held = len(model.shards), np.append(model.fixed, False)
    return Structure(
        centres_m=np.concatenate((model.centres_m, np.zeros((1, 3)))),
        masses_kg=np.append(np.where(model.fixed, 0.0, model.masses_kg), 0.0),
        member_names=np.array([*(member.name for member in members), ""]),
        member_kinds=np.array([*(member.kind for member in members), ""]),
        is_shard=np.append(~model.fixed, False),
        held=held,
        pairs=np.where(model.connections.pairs < 0, count, model.connections.pairs),
        points_m=model.connections.points,
        normals=model.connections.normals,
        bearings=model.bearings.springs.rows if model.bearings else np.zeros(0, int),
        boxes_m=np.concatenate((np.array([shard.bounds for shard in model.shards]), np.zeros((1, 2, 3)))),
        tendons=model.tendons,
    )


def recorded_structure(
    inventory: Inventory,
    bearings: np.ndarray,
    centres_m: np.ndarray,
    boxes_m: np.ndarray,
    tendons: ModelTendons | None = None,
) -> Structure:
    """Return the structure of bodies that are recorded, before anything moves.

    `bearings` (b,) are rows of connections, `centres_m` (n, 3) centres of mass of the bodies, `boxes_m` (n, 2, 3) the
    corners of the boxes around them.
    """
    shards = inventory.body_kinds == "shard"
    return Structure(
        centres_m=centres_m,
        masses_kg=inventory.masses_kg,
        member_names=inventory.body_members,
        member_kinds=inventory.body_member_kinds,
        is_shard=shards & inventory.moves,
        held=shards & ~inventory.moves,
        pairs=inventory.pairs,
        points_m=inventory.points_m,
        normals=inventory.normals,
        bearings=bearings,
        boxes_m=boxes_m,
        tendons=tendons,
    )
