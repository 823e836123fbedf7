"""Forces of bearings over a run: sums over the connections at their pads."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..scenario.bearings import Bearing
from .arrays import Results


@dataclass(frozen=True, slots=True, eq=False)
class BearingHistory:
    """Force of a bearing on what lies above it, at k recorded steps.

    Attributes
    ----------
    name
        The member above ``on`` the one below.
    forces_n
        (k, 3), each the mean over its frame; nan where it is not known, as that of bodies that have slept so far.
    intact
        (k,) part of its connections that are there.
    """

    name: str
    forces_n: np.ndarray
    intact: np.ndarray


def bearing_histories(results: Results, tables: Sequence[Bearing]) -> list[BearingHistory]:
    """Return the forces of all bearings of a scenario, by name; a bearing is all that connects its two members."""
    inventory = results.inventory
    if not tables or not len(inventory.pairs):
        return []
    above, below = inventory.pairs.T
    names, kinds = inventory.body_members, inventory.body_member_kinds
    histories = []
    for pair in np.unique(names[inventory.pairs], axis=0).tolist():
        rows = np.flatnonzero((names[above] == pair[0]) & (names[below] == pair[1]))
        of_pair = tuple((str(names[body]), str(kinds[body])) for body in (above[rows[0]], below[rows[0]]))
        if pair[0] != pair[1] and any(table.joins(*of_pair) for table in tables):
            forces_n = results.frames.loads.connection_forces_n[:, rows].astype(float).sum(axis=1)
            intact = results.frames.intact[:, rows].mean(axis=1)
            forces_n[_unsolved(results, rows) & (intact > 0.0)] = np.nan
            histories.append(BearingHistory(f"{pair[0]} on {pair[1]}", forces_n, intact))
    return histories


def _unsolved(results: Results, rows: np.ndarray) -> np.ndarray:
    """Return the steps (k,) at which some connections had no forces as their bodies had slept until then."""
    frames = results.frames
    sleep = frames.asleep[:, results.inventory.pairs[rows]].any(axis=2).all(axis=1)
    return sleep & ~frames.loads.connection_forces_n[:, rows].any(axis=(1, 2))
