"""Shards that still move when a run ends: their throws are those of a moment, and not final."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...engineering.geometry.vectors import length
from ...texts import UP, Quantity, Text
from .arrays import Results
from .collapse import REST_SPEED_M_S
from .motion import relative_to_ground

FARTHEST_THROW_M = 1000.0
LARGEST_SPEED_M_S = 340.0
"""Throw and speed of a shard above which a run has gone wrong: fragments are found up to some hundred metres away, and
what is faster than sound is no shard."""


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
    one = moving["shards"] == 1
    text = Text(
        "{} of {} shards still moves at the end, at up to {} ({}): throws and debris distances are not final"
        if one
        else "{} of {} shards still move at the end, at up to {} ({}): throws and debris distances are not final",
        moving["shards"],
        moving["of_shards"],
        Quantity(moving["fastest_m_s"], "m/s", ".1f"),
        moving["body"],
    )
    # All together rested by their energy: only another limit lets such a run go on.
    if summary.get("came_to_rest_s") is not None:
        rests = "{}. As a whole it rests; a lower time.rest_speed_m_s, or no time.stop_at_rest, lets the run go on"
        return Text(rests, text)
    if summary.get("completed", True):
        return Text("{}. Let the run last longer: time.duration_s", text)
    return text


def gone_text(summary: Mapping[str, Any]) -> str:
    """Return that shards flew as no debris does, as a sentence without a full stop; empty where none did."""
    throw, moving = summary.get("largest_throw"), summary.get("moving_at_end")
    if throw and throw["throw_m"] > FARTHEST_THROW_M:
        far = Quantity(throw["throw_m"] / 1000.0, "km", ".1f", UP)
        return Text(
            "This run is not to be used: {} flew {}, as no part of a bridge does; look for what gave it that energy",
            throw["body"],
            far,
        )
    if moving and moving["fastest_m_s"] > LARGEST_SPEED_M_S:
        fast = Quantity(moving["fastest_m_s"], "m/s", ".0f")
        return Text(
            "This run is not to be used: {} still moves at {}, as no part of a bridge does; look for what gave it "
            "that energy",
            moving["body"],
            fast,
        )
    return ""


def still_moving_note(results: Results) -> str:
    """Return the words that go with every throw of a run whose shards still moved; empty where all rested."""
    moving = moving_of(results)
    count = len(results.inventory.of_kind("shard"))
    return Text("not final: {} of {} shards still moved", len(moving), count) if len(moving) else ""
