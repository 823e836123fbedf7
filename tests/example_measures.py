"""Quantities of an example's run that differ from one draw of its shards to the next.

`scripts/seeds` prints their ranges over many draws. A new one is a function of a run that returns values by name, None
for what did not happen, in `OF_EVERY_RUN` or, where it belongs to one example, in `OF_EXAMPLES`.
"""

from collections.abc import Callable
from itertools import pairwise

import numpy as np
from example_runs import ExampleRun

from bridge_demolition_addon.core.bridge.layout import pier_axes
from bridge_demolition_addon.core.results.summary import first_hit_s

Measure = Callable[[ExampleRun], dict[str, float | None]]


def throws(run: ExampleRun) -> dict[str, float | None]:
    """How far debris gets on plan."""
    throws_m = run.throws_m(run.shards)
    return {"largest_throw_m": throws_m.max(), "throw_95_percent_m": np.quantile(throws_m, 0.95)}


def broken_connections(run: ExampleRun) -> dict[str, float | None]:
    """How many connections are broken in the end."""
    return {"broken_connections": run.summary["connections"]["broken"]}


def deck_falls(run: ExampleRun) -> dict[str, float | None]:
    """How far half of each span's deck has come down, and the share of it that is more than 2 m lower."""
    if run.scenario.bridge is None:
        return {}
    deck = run.of_members("deck")
    along_m = run.results.frames.positions_m[0, deck, 0]
    found = {}
    for number, (begin_m, end_m) in enumerate(pairwise(pier_axes(run.scenario.bridge)), start=1):
        fallen_m = run.fallen_m(deck[(along_m > begin_m) & (along_m < end_m)])
        found[f"span_{number}_median_fall_m"] = np.median(fallen_m)
        found[f"span_{number}_share_fallen_2_m"] = (fallen_m > 2.0).mean()
    return found


def times(run: ExampleRun) -> dict[str, float | None]:
    """When the ball first hits, and since when everything rests."""
    return {"first_impact_s": first_hit_s(run.summary), "came_to_rest_s": run.summary["came_to_rest_s"]}


OF_EVERY_RUN: tuple[Measure, ...] = (throws, broken_connections, deck_falls, times)
OF_EXAMPLES: dict[str, tuple[Measure, ...]] = {}
"""More of single examples, by their names."""


def measures_of(name: str, run: ExampleRun) -> dict[str, float | None]:
    """All quantities of a run of an example, by name."""
    found = {}
    for measure in (*OF_EVERY_RUN, *OF_EXAMPLES.get(name, ())):
        found |= {quantity: None if value is None else float(value) for quantity, value in measure(run).items()}
    return found
