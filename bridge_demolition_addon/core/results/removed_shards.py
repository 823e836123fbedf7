"""Shards that were taken away in the course of a run: they are no debris, and nobody sees them any more."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .arrays import Results

TAKEN_AWAY = "taken away"
"""What such a shard is called instead."""

OUT_OF_REACH_M = 1000.0
"""How far below its place a body stays that was taken out of the simulation. What ends more than half as far below its
first place was put there, not dropped."""


def without_taken_away(results: Results) -> tuple[Results, int]:
    """A run without the shards that were taken away, and how many these are.

    They are no shards any more, and have no mass, so that nothing that is told of shards or energies counts them, also
    not for the time before.
    """
    shards = results.inventory.of_kind("shard")
    heights = results.frames.positions_m[:, shards, 2]
    gone = shards[heights[0] - heights[-1] > OUT_OF_REACH_M / 2.0]
    if not len(gone):
        return results, 0
    kinds, masses = results.inventory.body_kinds.astype(object), results.inventory.masses_kg.copy()
    kinds[gone], masses[gone] = TAKEN_AWAY, 0.0
    inventory = replace(results.inventory, body_kinds=np.array(kinds, str), masses_kg=masses)
    return replace(results, inventory=inventory), len(gone)
