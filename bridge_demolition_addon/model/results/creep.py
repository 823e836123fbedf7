"""Shards that creep: so slow that they seem to rest, and yet on their way when the run ends."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...engineering.geometry.vectors import distance, dot, length
from ...texts import Quantity, Text
from .arrays import Results
from .collapse import REST_SPEED_M_S
from .motion import relative_to_ground

CREEP_S = 1.0
"""Time at the end of a run in which a shard is looked at: its two halves tell going on from swinging."""

LEAST_CREEP_M_S = 0.005
"""Mean speed from which on a shard creeps. What lies on others by contact under elastic connections slips at up to
4.9 mm/s by the solver alone, where sub-steps are 2 ms or shorter (docs/elastic.md)."""

_SAME_WAY = 0.5
"""Cosine between the ways in the two halves from which on they are one way."""

NAMED = 10
"""Shards that a summary names."""


@dataclass(frozen=True, slots=True, eq=False)
class Creep:
    """c shards that creep, the fastest first.

    `bodies` (c,) are their indices, `speeds_m_s` (c,) mean speeds over `CREEP_S`, and `moved_m` (c,) distances from
    where they were at first.
    """

    bodies: np.ndarray
    speeds_m_s: np.ndarray
    moved_m: np.ndarray

    def __len__(self) -> int:
        return len(self.bodies)


def creep_of(results: Results) -> Creep:
    """Return what creeps at the end of a run; nothing where the run is shorter than that is looked at for.

    In the last second a shard was never faster than one at rest may be, and in both halves of it went on the same way.
    """
    results = relative_to_ground(results)
    frames, shards = results.frames, results.inventory.of_kind("shard")
    rows = np.searchsorted(frames.time_s, frames.time_s[-1] - CREEP_S * np.array([1.0, 0.5]) + 1e-6, side="right") - 1
    if rows[0] < 0 or not rows[0] < rows[1] < len(frames) - 1:
        return Creep(np.zeros(0, int), np.zeros(0), np.zeros(0))
    first, middle, last = (frames.positions_m[row, shards] for row in (*rows.tolist(), -1))
    times_s = frames.time_s[[*rows, -1]]
    ways = middle - first, last - middle
    went_on = dot(*ways) >= _SAME_WAY * length(ways[0]) * length(ways[1])
    for way, time_s in zip(ways, np.diff(times_s), strict=True):
        went_on &= length(way) >= LEAST_CREEP_M_S * time_s
    slow = (length(frames.velocities_m_s[rows[0] :, shards]) <= REST_SPEED_M_S).all(axis=0)
    speeds = distance(last, first) / (times_s[-1] - times_s[0])
    chosen = np.flatnonzero(went_on & slow)
    chosen = chosen[np.argsort(-speeds[chosen], kind="stable")]
    moved = distance(last, frames.positions_m[0, shards])
    return Creep(shards[chosen], speeds[chosen], moved[chosen])


def creep_summary(results: Results) -> dict[str, Any] | None:
    """Return what creeps at the end of a run, ready for JSON; None where nothing does."""
    creep, inventory = creep_of(results), results.inventory
    if not len(creep):
        return None
    return {
        "shards": len(creep),
        "mass_kg": float(inventory.masses_kg[creep.bodies].sum()),
        "fastest": [
            {
                "body": str(inventory.body_names[creep.bodies[row]]),
                "member": str(inventory.body_members[creep.bodies[row]]),
                "speed_m_s": float(creep.speeds_m_s[row]),
                "moved_m": float(creep.moved_m[row]),
            }
            for row in range(min(NAMED, len(creep)))
        ],
    }


def creep_text(summary: Mapping[str, Any]) -> str:
    """Return what a run's summary says under ``creeping``, as a sentence without a full stop; empty for nothing."""
    creeping = summary.get("creeping")
    if not creeping:
        return ""
    fastest = creeping["fastest"][0]
    body = fastest["body"]
    if fastest["member"]:
        body = Text("{} of {}", body, fastest["member"])
    return Text(
        (
            "{} shard creeps at the end, by up to {} ({}, {} from where it was): it neither rests nor falls. Simulate "
            "for longer to see whether more comes down"
        )
        if creeping["shards"] == 1
        else (
            "{} shards creep at the end, by up to {} ({}, {} from where it was): they neither rest nor fall. "
            "Simulate for longer to see whether more comes down"
        ),
        creeping["shards"],
        Quantity(1000.0 * fastest["speed_m_s"], "mm/s", ".0f"),
        body,
        Quantity(1000.0 * fastest["moved_m"], "mm", ".0f"),
    )
