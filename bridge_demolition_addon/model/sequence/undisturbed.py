"""Whether a bridge stood until something was done to it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from ...texts import Quantity, Text
from ..results.arrays import Results
from ..results.motion import MOVED_M, travel
from ..scenario import Scenario
from ..scenario.scenario import no_actions

AWAKE_S = 5.0
"""How long a bridge is left alone to see whether it stands: what slides off its cracks has come down in 5 s, and not in
3 s (docs/stages.md)."""


def first_event_s(scenario: Scenario) -> float:
    """Return the time up to which nothing is done to the bridge, s; infinite where nothing ever is.

    A member that begins with a velocity is thrown at once.
    """
    if any(table.is_moving for table in scenario.geometry):
        return 0.0
    return min((action.begins_s(scenario) for action in scenario.actions), default=math.inf)


def left_alone(scenario: Scenario, seconds: float = AWAKE_S) -> Scenario:
    """Return a scenario in which nothing is done to the bridge, awake, for so long after its warm-up."""
    at_rest = (0.0, 0.0, 0.0)
    return replace(
        scenario,
        **no_actions(scenario),
        geometry=tuple(
            replace(table, velocity_m_s=at_rest, angular_velocity_rad_s=at_rest) for table in scenario.geometry
        ),
        shards=replace(scenario.shards, start_deactivated=False),
        time=replace(scenario.time, duration_s=scenario.warm_up_s + seconds, stop_at_rest=False),
    )


def fell_by_itself(results: Results, scenario: Scenario) -> dict[str, Any] | None:
    """Return what broke and moved before anything was done to a bridge, ready for JSON; None where it stood.

    It stood where no connection broke and no shard moved by more than `MOVED_M`; with bars, which hold cracks, where no
    shard moved so far. Shards that sleep until something hits them stand in any case. ``until_s`` is None where nothing
    was ever done.
    """
    first_s = first_event_s(scenario)
    rows = np.flatnonzero(results.frames.time_s <= first_s)
    if not len(rows):
        return None
    last = rows[-1]
    broken = (~results.frames.intact[rows]).sum(axis=1)
    shards = results.inventory.of_kind("shard")
    moves = travel(results.frames.positions_m[0, shards], results.frames.positions_m[last, shards])
    largest_move_m = float(moves.max(initial=0.0))
    if largest_move_m <= MOVED_M and (scenario.is_reinforced or not broken[-1]):
        return None
    breaks = np.flatnonzero(broken)
    return {
        "until_s": first_s if math.isfinite(first_s) else None,
        "first_break_s": float(results.frames.time_s[breaks[0]]) if len(breaks) else None,
        "broken": int(broken[-1]),
        "connections": len(results.inventory.connection_names),
        "largest_move_m": largest_move_m,
    }


def asleep_text(scenario: Scenario) -> str:
    """Return that a run cannot show whether the bridge stands, where its shards sleep at first; empty otherwise."""
    if not scenario.shards.start_deactivated:
        return ""
    return Text(
        "All shards sleep until something hits them, so a run does not show whether the "
        "bridge stands by itself: run it with shards.start_deactivated = false and without "
        "what is done to it"
    )


def self_collapse_text(summary: Mapping[str, Any]) -> str:
    """Return what a summary says under ``fell_by_itself``, as a sentence without a full stop; empty for nothing."""
    fall = summary.get("fell_by_itself")
    if not fall:
        return ""
    moved = Text("shards moved by up to {}", Quantity(fall["largest_move_m"], "m", ".2f"))
    parts = moved
    if fall["first_break_s"] is not None:
        breaks = fall["broken"], fall["connections"], f"{fall['first_break_s']:.2f}"
        parts = Text("{} and {}", Text("{} of {} connections broke, the first at {} s,", *breaks), moved)
    if fall["until_s"] is None:
        return Text(
            "The bridge does not stand by itself: {}, though nothing was done to it. Make its connections "
            "stronger, or cut it otherwise",
            parts,
        )
    return Text(
        "The bridge does not stand by itself: {} up to {} s, before anything was done to it. Make its connections "
        "stronger, or cut it otherwise",
        parts,
        f"{fall['until_s']:.2f}",
    )
