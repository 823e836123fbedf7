"""Motion of bodies as it is read for results: from the ground, without removed shards; travel, throw and first hit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...engineering.geometry.vectors import distance, length
from .arrays import Results

_HIT_SHARE = 0.5
"""A frame counts as a hit when velocity departs from free fall by more than this share of the frame's g·t."""

MOVED_M = 0.1
"""A shard that ends farther than this from where it began is debris; the rest of the bridge still stands."""

REMOVED = "removed"
"""Kind of body of a shard that was removed."""

OUT_OF_REACH_M = 1000.0
"""How far below its position a removed body stays. What ends more than half as far down was put there, not dropped."""


def relative_to_ground(results: Results) -> Results:
    """Return a run in the axes of the ground: the same where the ground rests, or is not there."""
    frames = results.frames
    for body in results.inventory.of_kind("ground"):
        shifts = frames.positions_m[:, body] - frames.positions_m[0, body]
        velocities = np.asarray(frames.velocities_m_s[:, body])
        if shifts.any() or velocities.any():
            seen = replace(
                frames,
                positions_m=frames.positions_m - shifts[:, None],
                velocities_m_s=frames.velocities_m_s - velocities[:, None],
            )
            return replace(results, frames=seen)
    return results


def travel(first: np.ndarray, last: np.ndarray) -> np.ndarray:
    """Return the straight-line distance (n,) between first and last positions (n, 3), m."""
    return distance(last, first)


def throw(first: np.ndarray, last: np.ndarray) -> np.ndarray:
    """Return the horizontal distance (n,) between first and last positions (n, 3), m."""
    return distance(last[:, :2], first[:, :2])


def first_hit(velocities: np.ndarray, times: np.ndarray, gravity: np.ndarray) -> int | None:
    """Return the first step in which something other than gravity acted on a falling body; None if nothing did.

    Velocities (k, 3) and times (k,) are those at its release and after each step since then.
    """
    steps = np.diff(times)
    departures = length(np.diff(velocities, axis=0) - steps[:, None] * gravity)
    hits = np.flatnonzero(departures > _HIT_SHARE * steps * length(gravity))
    return int(hits[0]) + 1 if len(hits) else None


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
