"""Shards that were removed in the course of a run: they are no debris, and nobody sees them any more."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .arrays import Results

REMOVED = "removed"
"""Kind of body that such a shard becomes."""

OUT_OF_REACH_M = 1000.0
"""How far below its place a body stays that was taken out of the simulation. What ends more than half as far below its
first place was put there, not dropped."""


def without_removed(results: Results) -> tuple[Results, int]:
    """Return a run without the shards that were removed, and how many these are.

    They are no shards any more, and have no mass, so that no count of shards and no energy includes them, also not for
    the time before.
    """
    shards = results.inventory.of_kind("shard")
    heights = results.frames.positions_m[:, shards, 2]
    gone = shards[heights[0] - heights[-1] > OUT_OF_REACH_M / 2.0]
    if not len(gone):
        return results, 0
    kinds, masses = results.inventory.body_kinds.astype(object), results.inventory.masses_kg.copy()
    kinds[gone], masses[gone] = REMOVED, 0.0
    inventory = replace(results.inventory, body_kinds=np.array(kinds, str), masses_kg=masses)
    return replace(results, inventory=inventory), len(gone)
