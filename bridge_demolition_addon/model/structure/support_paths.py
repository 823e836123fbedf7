"""What holds each shard of a model before anything is worked out: connections, contact with others, or nothing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...engineering.elasticity.equations import connected_parts
from ...engineering.geometry.proximity import boxes_that_meet
from .model import Model

_TOUCHING_M = 0.005
"""Distance between the boxes of two shards, or of one and the ground, up to which they may touch: shards are cut with
gaps of about a millimetre. Boxes are larger than shards, so that what falls for certain touches nothing."""


@dataclass(frozen=True, slots=True, eq=False)
class SupportPaths:
    """How the n shards of a model are held.

    Attributes
    ----------
    connected : (n,) bool
        Whether connections lead from a shard to the ground or to a support.
    loose : (n,) bool
        Whether none do, but it touches what is connected so or the ground, maybe by way of others.
    """

    connected: np.ndarray
    loose: np.ndarray

    @property
    def falling(self) -> np.ndarray:
        """Return which shards (n,) neither connections nor contacts hold."""
        return ~self.connected & ~self.loose


def support_paths(model: Model) -> SupportPaths:
    """Return what holds each shard of a model."""
    count = len(model.shards)
    moves = np.append(~model.fixed, False)  # the ground is the last body
    first, second = (model.connections.pairs % (count + 1)).T
    label = connected_parts(moves, first, second)
    to_support = label[np.concatenate((first[~moves[second]], second[~moves[first]]))]
    connected = model.fixed | np.isin(label[:-1], to_support[to_support >= 0])
    boxes = np.array([shard.bounds for shard in model.shards])
    meeting = boxes_that_meet(boxes[:, 0], boxes[:, 1], _TOUCHING_M)
    ground_m = model.ground.heights_at(boxes.mean(axis=1)[:, :2])
    stands = np.isfinite(ground_m) & (boxes[:, 0, 2] <= np.nan_to_num(ground_m) + _TOUCHING_M)
    on_ground = np.flatnonzero(stands)
    touching = connected_parts(
        np.ones(count + 1, bool),
        np.concatenate((meeting[:, 0], on_ground, np.flatnonzero(connected), first)),
        np.concatenate((meeting[:, 1], np.full(len(on_ground) + int(connected.sum()), count), second)),
    )
    return SupportPaths(connected, ~connected & (touching[:-1] == touching[-1]))
