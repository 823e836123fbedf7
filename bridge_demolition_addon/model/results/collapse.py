"""Collapse: heights of the spans, connections cracked and torn, how far the collapse is, and when all is at rest."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ...engineering.elasticity.crack_state import BARS_HOLD, BARS_YIELDED
from ...engineering.geometry.vectors import length
from ...engineering.terrain.surface import RecordedGround
from .arrays import Results
from .motion import relative_to_ground
from .records import BarsAtEnd, ConnectionsOfRun

REST_SPEED_M_S = 0.1
"""A shard that moves more slowly than this is at rest."""

_DECK = "deck"
_WHOLE = "whole structure"
_OF_PIER = re.compile(r"pier (\d+)\b")
"""How the name of a member of a pier begins."""

FALLEN, STANDS = 0.5, 0.1
"""Parts of its height from which on a span or a pier is down, and up to which it stands."""


@dataclass(frozen=True, eq=False, slots=True)
class Span:
    """Height of one span over k recorded steps; `bodies` (b,) are its shards.

    `heights_m` and `lowest_m` (k,) are the heights of its shards' centres of mass above the ground below each, the mean
    by mass and the least; `levels_m` (k,) the height of its own centre of mass above the scenario's origin.
    """

    name: str
    bodies: np.ndarray
    heights_m: np.ndarray
    lowest_m: np.ndarray
    levels_m: np.ndarray

    @property
    def drop_m(self) -> float:
        """Return the height by which its centre of mass came down."""
        return float(self.levels_m[0] - self.levels_m[-1])


def spans_of(results: Results, span_lengths_m: Sequence[float] = ()) -> tuple[Span, ...]:
    """Return the spans of the deck, with lengths from x = 0 on, divided by where their shards were at first.

    Shards beyond the first or last axis belong to the nearest span. Without lengths, or where no shard is of the deck,
    everything is one span.
    """
    results = relative_to_ground(results)
    shards, ground = results.inventory.of_kind("shard"), results.ground()
    deck = shards[results.inventory.body_member_kinds[shards] == _DECK]
    if not len(shards):
        return ()
    if not len(deck):
        return (_span(results, ground, _WHOLE, shards),)
    inner_axes = np.cumsum(span_lengths_m)[:-1] if len(span_lengths_m) else np.zeros(0)
    numbers = np.searchsorted(inner_axes, results.frames.positions_m[0, deck, 0], side="right")
    names = ["deck"] if not len(inner_axes) else [f"span {number + 1}" for number in range(len(inner_axes) + 1)]
    parts = ((name, deck[numbers == row]) for row, name in enumerate(names))
    return tuple(_span(results, ground, name, bodies) for name, bodies in parts if len(bodies))


def piers_of(results: Results) -> dict[int, Span]:
    """Return the piers by their number, all columns and the cap of each together; none where no member is of one."""
    results = relative_to_ground(results)
    ground, shards = results.ground(), results.inventory.of_kind("shard")
    bodies: dict[int, list[int]] = {}
    for shard in shards.tolist():
        if found := _OF_PIER.match(str(results.inventory.body_members[shard])):
            bodies.setdefault(int(found[1]), []).append(shard)
    return {number: _span(results, ground, f"pier {number}", np.array(bodies[number])) for number in sorted(bodies)}


def collapse_progress(results: Results) -> np.ndarray:
    """Return how far the collapse is at each recorded step, (k,) from 0 to 1, a little below 0 where shards rise.

    The part of the height of the shards' masses above the ground under each that is lost: 0 stands as it did, 1 would
    be all of it flat on the ground.
    """
    shards = results.inventory.of_kind("shard")
    masses = results.inventory.masses_kg[shards]
    if not masses.sum() > 0.0:
        return np.zeros(len(results.frames.time_s))
    results = relative_to_ground(results)
    heights = _mean_by_mass(_above(results.ground(), results.frames.positions_m[:, shards]), masses)
    return 1.0 - heights / heights[0] if heights[0] > 0.0 else np.zeros(len(heights))


@dataclass(frozen=True, slots=True)
class ShardRest:
    """When a shard first moved, and from when on all rested; None where that never was.

    `moving_at_end` counts those that still moved then.
    """

    first_motion_s: float | None
    at_rest_s: float | None
    moving_at_end: int


class Rested(NamedTuple):
    """When everything came to rest, as the run found it; None where it did not."""

    came_to_rest_s: float | None


def rest_of(results: Results, noted: Rested | None = None) -> ShardRest:
    """Return when the shards began to move on the ground, by `REST_SPEED_M_S`, and when they came to rest on it.

    The run has found that by energy, and noted it; of a run without, it is by that speed.
    """
    shards = results.inventory.of_kind("shard")
    moving = length(relative_to_ground(results).frames.velocities_m_s[:, shards]) > REST_SPEED_M_S
    at_times = np.flatnonzero(moving.any(axis=1))
    if not len(at_times):
        return ShardRest(None, None, 0)
    at_end = int(moving[-1].sum())
    at_rest = None if at_end else float(results.frames.time_s[at_times[-1] + 1])
    if noted:
        at_rest = noted.came_to_rest_s
    return ShardRest(float(results.frames.time_s[at_times[0]]), at_rest, at_end)


def _span(results: Results, ground: RecordedGround, name: str, bodies: np.ndarray) -> Span:
    positions, masses = results.frames.positions_m[:, bodies], results.inventory.masses_kg[bodies]
    above = _above(ground, positions)
    levels = _mean_by_mass(positions[..., 2], masses)
    return Span(name, bodies, _mean_by_mass(above, masses), above.min(axis=1), levels)


def _above(ground: RecordedGround, positions: np.ndarray) -> np.ndarray:
    """Return heights (k, b) of positions (k, b, 3) above the ground; looked up again only where a body has moved."""
    if ground.is_flat:
        return positions[..., 2]
    moved = np.ones(positions.shape[:2], bool)
    moved[1:] = (positions[1:, :, :2] != positions[:-1, :, :2]).any(axis=-1)
    step, body = np.nonzero(moved)
    heights = np.zeros(positions.shape[:2])
    heights[step, body] = ground.heights_at(positions[step, body, :2])
    latest = np.maximum.accumulate(np.where(moved, np.arange(len(positions))[:, None], 0), axis=0)
    return positions[..., 2] - np.take_along_axis(heights, latest, axis=0)


def _mean_by_mass(heights: np.ndarray, masses: np.ndarray) -> np.ndarray:
    """Return the mean (k,) of heights (k, b), weighted by masses (b,)."""
    return (heights * masses).sum(axis=1) / masses.sum()


@dataclass(frozen=True, slots=True)
class ConnectionCounts:
    """Connections at some moment of a run; None where it did not record whether bars hold.

    Attributes
    ----------
    connections : int
    broken : int
        Those whose concrete has cracked, held by bars or not.
    cracked : int or None
        Those that bars hold.
    yielded : int or None
        Of these, those whose bars have yielded.
    torn : int or None
        Those that nothing but contact holds any more: without bars, with bars that ruptured, cut or blasted.
    """

    connections: int
    broken: int
    cracked: int | None = None
    yielded: int | None = None
    torn: int | None = None

    @classmethod
    def of_frame(cls, intact: np.ndarray, bars: np.ndarray | None) -> ConnectionCounts:
        """Return the counts of connections (m,) that are intact or not, by what `FrameLoads` has of their bars (m,)."""
        broken = ~np.asarray(intact)
        count, all_broken = len(broken), int(broken.sum())
        if bars is None or np.isnan(bars).any():
            return cls(count, all_broken)
        cracked, yielded = (int((broken & (bars >= state)).sum()) for state in (BARS_HOLD, BARS_YIELDED))
        return cls(count, all_broken, cracked, yielded, all_broken - cracked)

    @classmethod
    def of_results(cls, results: Results, row: int = -1) -> ConnectionCounts:
        """Return the counts of a recorded row."""
        bars = results.frames.loads.connection_bars
        return cls.of_frame(results.frames.intact[row], None if bars is None else bars[row])

    @classmethod
    def at_end(cls, known: ConnectionsOfRun, bars: BarsAtEnd | None) -> ConnectionCounts:
        """Return the counts at the end of a run, by its summary; for earlier runs as far as that says."""
        if known.cracked is None and bars:
            return cls(known.count, known.broken, bars.held_at_end, None, known.broken - bars.held_at_end)
        return cls(known.count, known.broken, known.cracked, known.yielded, known.torn)

    def to_json(self) -> dict[str, int | None]:
        """Those that `broken` does not tell apart, ready for JSON."""
        return {"cracked": self.cracked, "yielded": self.yielded, "torn": self.torn}

    @property
    def text(self) -> str:
        """All of them in a line."""
        if self.cracked is None:
            return f"cracked or torn: {self.broken} of {self.connections} connections"
        torn = f"torn: {self.torn} of {self.connections} connections"
        if not self.cracked:
            return torn
        yielded = "" if self.yielded is None else f", of these yielded: {self.yielded}"
        return f"cracked (bars hold): {self.cracked}{yielded}; {torn}"
