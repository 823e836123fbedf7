"""Shards that still move when a run ends: their throws are those of a moment, and not final."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...engineering.geometry.vectors import length
from .arrays import Results
from .collapse import REST_SPEED_M_S
from .motion import relative_to_ground


@dataclass(frozen=True, slots=True, eq=False)
class Moving:
    """Shards (c,) that are faster than `REST_SPEED_M_S` in the last frame, the fastest first, and their speeds (c,)."""

    bodies: np.ndarray
    speeds_m_s: np.ndarray

    def __len__(self) -> int:
        return len(self.bodies)


def moving_of(results: Results) -> Moving:
    """Return what still moves at the end of a run, on ground that may move."""
    shards = results.inventory.of_kind("shard")
    speeds = length(np.asarray(relative_to_ground(results).frames.velocities_m_s[-1], float)[shards])
    rows = np.flatnonzero(speeds > REST_SPEED_M_S)
    rows = rows[np.argsort(-speeds[rows], kind="stable")]
    return Moving(shards[rows], speeds[rows])


def moving_summary(results: Results) -> dict[str, Any] | None:
    """Return what still moves at the end of a run, ready for JSON; None where nothing does."""
    moving, inventory = moving_of(results), results.inventory
    if not len(moving):
        return None
    fastest = moving.bodies[0]
    return {
        "shards": len(moving),
        "of_shards": len(inventory.of_kind("shard")),
        "mass_kg": float(inventory.masses_kg[moving.bodies].sum()),
        "fastest_m_s": float(moving.speeds_m_s[0]),
        "body": str(inventory.body_names[fastest]),
        "member": str(inventory.body_members[fastest]),
    }


def moving_text(summary: Mapping[str, Any]) -> str:
    """Return what a summary says under ``moving_at_end``, as a sentence without a full stop; empty for nothing."""
    moving = summary.get("moving_at_end")
    if not moving:
        return ""
    move = "moves" if moving["shards"] == 1 else "move"
    longer = ". Let the run last longer: time.duration_s" if summary.get("completed", True) else ""
    # All together rested by their energy: only another limit lets such a run go on.
    if summary.get("came_to_rest_s") is not None:
        longer = ". As a whole it rests; a lower time.rest_speed_m_s, or no time.stop_at_rest, lets the run go on"
    return (
        f"{moving['shards']} of {moving['of_shards']} shards still {move} at the end, at up to "
        f"{moving['fastest_m_s']:.1f} m/s ({moving['body']}): throws and debris distances are not final{longer}"
    )


def still_moving_note(results: Results) -> str:
    """Return the words that go with every throw of a run whose shards still moved; empty where all rested."""
    moving = moving_of(results)
    count = len(results.inventory.of_kind("shard"))
    return f"not final: {len(moving)} of {count} shards still moved" if len(moving) else ""
