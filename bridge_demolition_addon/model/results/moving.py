"""Shards that still move or creep when a run ends: their throws are of a moment, and not final."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...engineering.geometry.vectors import distance, dot, length
from ...texts import UP, Quantity, Text
from .arrays import Results
from .collapse import REST_SPEED_M_S
from .motion import relative_to_ground
from .records import Creeping, CreepingShard, LargestThrow, StillMoving

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


def moving_summary(results: Results) -> StillMoving | None:
    """Return what still moves at the end of a run; None where nothing does."""
    moving, inventory = moving_of(results), results.inventory
    if not len(moving):
        return None
    fastest = moving.bodies[0]
    return StillMoving(
        shards=len(moving),
        of_shards=len(inventory.of_kind("shard")),
        mass_kg=float(inventory.masses_kg[moving.bodies].sum()),
        fastest_m_s=float(moving.speeds_m_s[0]),
        body=str(inventory.body_names[fastest]),
        member=str(inventory.body_members[fastest]),
    )


def moving_text(moving: StillMoving | None, came_to_rest_s: float | None = None, *, completed: bool = True) -> str:
    """Return what still moves at the end of a run, as a sentence without a full stop; empty for nothing.

    `came_to_rest_s` is when all together rested; `completed` whether the run went on for as long as planned.
    """
    if not moving:
        return ""
    one = moving.shards == 1
    text = Text(
        "{} of {} shards still moves at the end, at up to {} ({}): throws and debris distances are not final"
        if one
        else "{} of {} shards still move at the end, at up to {} ({}): throws and debris distances are not final",
        moving.shards,
        moving.of_shards,
        Quantity(moving.fastest_m_s, "m/s", ".1f"),
        moving.body,
    )
    # All together rested by their energy: only another limit lets such a run go on.
    if came_to_rest_s is not None:
        rests = "{}. As a whole it rests; a lower time.rest_speed_m_s, or no time.stop_at_rest, lets the run go on"
        return Text(rests, text)
    if completed:
        return Text("{}. Let the run last longer: time.duration_s", text)
    return text


def gone_text(throw: LargestThrow | None, moving: StillMoving | None) -> str:
    """Return that shards flew as no debris does, as a sentence without a full stop; empty where none did."""
    if throw and throw.throw_m > FARTHEST_THROW_M:
        far = Quantity(throw.throw_m / 1000.0, "km", ".1f", UP)
        return Text(
            "This run is not to be used: {} flew {}, as no part of a bridge does; look for what gave it that energy",
            throw.body,
            far,
        )
    if moving and moving.fastest_m_s > LARGEST_SPEED_M_S:
        fast = Quantity(moving.fastest_m_s, "m/s", ".0f")
        return Text(
            "This run is not to be used: {} still moves at {}, as no part of a bridge does; look for what gave it "
            "that energy",
            moving.body,
            fast,
        )
    return ""


def still_moving_note(results: Results) -> str:
    """Return the words that go with every throw of a run whose shards still moved; empty where all rested."""
    moving = moving_of(results)
    count = len(results.inventory.of_kind("shard"))
    return Text("not final: {} of {} shards still moved", len(moving), count) if len(moving) else ""


CREEP_S = 1.0
"""Time at the end of a run in which a shard is looked at: its two halves tell going on from swinging."""

LEAST_CREEP_M_S = 0.005
"""Mean speed from which on a shard creeps. What lies on others by contact under elastic connections slips at up to
1.5 mm/s by the solver alone, with 10 iterations (docs/elastic.md)."""

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


def creep_summary(results: Results) -> Creeping | None:
    """Return what creeps at the end of a run, `NAMED` shards by name; None where nothing does."""
    creep, inventory = creep_of(results), results.inventory
    if not len(creep):
        return None
    fastest = tuple(
        CreepingShard(
            body=str(inventory.body_names[creep.bodies[row]]),
            member=str(inventory.body_members[creep.bodies[row]]),
            speed_m_s=float(creep.speeds_m_s[row]),
            moved_m=float(creep.moved_m[row]),
        )
        for row in range(min(NAMED, len(creep)))
    )
    return Creeping(len(creep), float(inventory.masses_kg[creep.bodies].sum()), fastest)


def creep_text(creeping: Creeping | None) -> str:
    """Return what creeps at the end of a run, as a sentence without a full stop; empty for nothing."""
    if not creeping:
        return ""
    fastest = creeping.fastest[0]
    body = Text("{} of {}", fastest.body, fastest.member) if fastest.member else fastest.body
    return Text(
        (
            "{} shard creeps at the end, by up to {} ({}, {} from where it was): it neither rests nor falls. Simulate "
            "for longer to see whether more comes down"
        )
        if creeping.shards == 1
        else (
            "{} shards creep at the end, by up to {} ({}, {} from where it was): they neither rest nor fall. "
            "Simulate for longer to see whether more comes down"
        ),
        creeping.shards,
        Quantity(1000.0 * fastest.speed_m_s, "mm/s", ".0f"),
        body,
        Quantity(1000.0 * fastest.moved_m, "mm", ".0f"),
    )
