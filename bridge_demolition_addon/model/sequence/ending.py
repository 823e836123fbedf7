"""How a run ended: when all came to rest, whether all that is planned was done, and what of it is doubtful.

That is also whether the bridge stood until something was done to it.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Self

import numpy as np

from ...engineering.geometry.vectors import distance
from ...texts import Quantity, Text, joined
from ..results.arrays import Results
from ..results.energy import much_made_text
from ..results.motion import MOVED_M, travel
from ..results.moving import gone_text, moving_text
from ..results.records import EventOfRun, Fall, SolverEnergy
from ..run_folder.summary import RunSummary
from ..scenario import Scenario
from ..scenario.scenario import no_actions
from .lifts import held_parts_text, pick_texts

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


def fell_by_itself(results: Results, scenario: Scenario) -> Fall | None:
    """Return what broke and moved before anything was done to a bridge; None where it stood.

    It stood where no connection broke and no shard moved by more than `MOVED_M`; with bars, which hold cracks, where no
    shard moved so far. Shards that sleep until something hits them stand in any case.
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
    return Fall(
        until_s=first_s if math.isfinite(first_s) else None,
        first_break_s=float(results.frames.time_s[breaks[0]]) if len(breaks) else None,
        broken=int(broken[-1]),
        connections=len(results.inventory.connection_names),
        largest_move_m=largest_move_m,
    )


def asleep_text(scenario: Scenario) -> str:
    """Return that a run cannot show whether the bridge stands, where its shards sleep at first; empty otherwise."""
    if not scenario.shards.start_deactivated:
        return ""
    return Text(
        "All shards sleep until something hits them, so a run does not show whether the "
        "bridge stands by itself: run it with shards.start_deactivated = false and without "
        "what is done to it"
    )


def self_collapse_text(fall: Fall | None) -> str:
    """Return that a bridge fell by itself, as a sentence without a full stop; empty for nothing."""
    if not fall:
        return ""
    moved = Text("shards moved by up to {}", Quantity(fall.largest_move_m, "m", ".2f"))
    parts = moved
    if fall.first_break_s is not None:
        breaks = fall.broken, fall.connections, f"{fall.first_break_s:.2f}"
        parts = Text("{} and {}", Text("{} of {} connections broke, the first at {} s,", *breaks), moved)
    if fall.until_s is None:
        return Text(
            "The bridge does not stand by itself: {}, though nothing was done to it. Make its connections "
            "stronger, or cut it otherwise",
            parts,
        )
    return Text(
        "The bridge does not stand by itself: {} up to {} s, before anything was done to it. Make its connections "
        "stronger, or cut it otherwise",
        parts,
        f"{fall.until_s:.2f}",
    )


class Undone(StrEnum):
    """What was still to come when a run ended, as summaries have it under ``ended_before``."""

    HIT = "the ball hit"
    FIRST = "anything was done to the bridge"
    LAST = "all that is planned was done"


@dataclass(frozen=True, slots=True)
class Ending:
    """When and how a run ended, and what was still to come; None where nothing was."""

    time_s: float
    how: str = "Ended at"
    undone: Undone | None = None

    @classmethod
    def of(cls, summary: RunSummary) -> Self:
        """Return how the run of a summary ended."""
        how = "Ended at" if summary.completed else "Stopped at"
        return cls(float(summary.simulated_s), how, Undone(summary.ended_before) if summary.ended_before else None)

    @property
    def has_outcome(self) -> bool:
        """Whether the run went on to its end, and all that is planned was done by then."""
        return self.how == "Ended at" and self.undone is None

    @property
    def is_before_demolition(self) -> bool:
        """Whether nothing was done to the bridge yet, so that the run says nothing of how it comes down."""
        return self.undone in (Undone.HIT, Undone.FIRST)

    @property
    def text(self) -> str:
        """What is to be said before anything else of the run, without a full stop; empty where it has an outcome."""
        if self.has_outcome:
            return ""
        before = Text(f"before {self.undone or 'its end'}")
        if self.how == "Ended at" and self.undone is Undone.HIT:
            before = Text("without a hit of the ball")
        meaning = "says nothing of the outcome" if self.is_before_demolition else "what follows is no outcome"
        return Text(f"{self.how} {{}} s, {{}}: {meaning}", f"{self.time_s:.2f}", before)


def undone_at_end(results: Results, scenario: Scenario, *, has_hit: bool) -> Undone | None:
    """Return what was still to come when a run of a scenario ended; None where nothing was, or nothing is planned.

    Where contacts were not recorded, a ball that was let go counts as one that hit.
    """
    end_s, ball = float(results.frames.time_s[-1]), scenario.ball
    begin_s = [action.begins_s(scenario) for action in scenario.actions if action is not ball]
    if ball and not has_hit and not any(begins_s < end_s for begins_s in begin_s):
        contacts_are_known = np.isfinite(results.frames.loads.body_contact_impulses_ns[1:]).all()
        if contacts_are_known or end_s <= ball.begins_s(scenario):
            return Undone.HIT
    if end_s <= first_event_s(scenario) < math.inf:
        return Undone.FIRST
    last_s = max((begins_s for begins_s in begin_s if math.isfinite(begins_s)), default=0.0)
    if ball and (ball.hits or not has_hit):
        last_s = max(last_s, ball.ends_s(scenario))
    return Undone.LAST if end_s < last_s else None


def doubts_of_run(summary: RunSummary) -> tuple[str, ...]:
    """Return all that is doubtful as sentences without full stops, what has to be said before any result first."""
    return *first_doubts(summary), *doubts_of_actions(summary)


def doubts_of_actions(summary: RunSummary) -> tuple[str, ...]:
    """Return what is doubtful of the bridge and of what was done to it, as sentences without full stops."""
    of_lifts = held_parts_text(summary.events), *pick_texts(summary.lifts)
    texts = self_collapse_text(summary.fell_by_itself), *of_lifts, bare_bars_text(summary.events)
    return tuple(filter(None, texts))


def first_doubts(summary: RunSummary) -> tuple[str, ...]:
    """Return what has to be said before any result: no loads, no outcome, still moving, or energy gained."""
    texts = (
        only_motion_text(summary.only_motion_because),
        *unusable_texts(summary),
        Ending.of(summary).text,
        moving_text(summary.moving_at_end, summary.came_to_rest_s, completed=summary.completed),
        *(summary.stability.unusual if summary.stability else ()),
    )
    return tuple(filter(None, texts))


def unusable_texts(summary: RunSummary) -> tuple[str, ...]:
    """Return why a run is not to be used, as sentences without full stops: shards that are gone, energy made."""
    made = summary.energy.made_by_solver if summary.energy else SolverEnergy()
    much_made = much_made_text(made.counted_share, made.share_of_dissipated)
    return tuple(filter(None, (gone_text(summary.largest_throw, summary.moving_at_end), much_made)))


def only_motion_text(reason: str | None) -> str:
    """Return that no loads are known, as a sentence without a full stop, with the reason; empty where they are."""
    return (
        f"Only motion was recorded: what connections carry, and which broke, is not known. {reason}" if reason else ""
    )


_HOLD_M = 0.01
"""By how much the ends of bars come closer at most where they hold."""


def bare_bars_text(events: Iterable[EventOfRun]) -> str:
    """Return which bars held more than may be counted on, as a sentence without a full stop; empty for none."""
    used = {
        event.zone: event.cage_pressed_n / event.cage_compression_n
        for event in events
        if event.cage_pressed_n > event.cage_compression_n > 0.0 and event.cage_folded_m < _HOLD_M
    }
    if not used:
        return ""
    return Text(
        "Bare bars of {} held though they were pressed with up to {} times what may be counted on (EN 1993-1-1, "
        "curve c): bars of a run are straight, so that those of the bridge may fold",
        joined("{}, {}", used),
        f"{max(used.values()):.2f}",
    )


FASTEST = 10.0
"""A single body may be so many times as fast as the limit for all: at the usual 0.5 m/s what slides with a friction of
0.5 comes to rest within v² / 2μg = 25 mm, and what falls is faster within 0.05 s."""


class Rest:
    """Find frame by frame whether everything rests, and since when.

    By energy: everything rests while its kinetic energy per mass is below the value v² / 2 of bodies that all move at
    the speed limit, and no body is `FASTEST` times as fast. So one that creeps on a contact does not keep a run alive,
    and one that flies does. A rotation at the limit of angular velocity counts as much as that speed; what sleeps rests
    anyway. Everything has to rest for `hold_s`; before `not_before_s` no rest counts, as something is still to happen.
    Speeds come from positions and rotations of two frames, so that a solver's trembling within a frame is not motion.
    """

    def __init__(self, speed_m_s: float, angular_velocity_rad_s: float, hold_s: float, not_before_s: float):
        self.since_s: float | None = None  # None while anything moves
        self._limits = speed_m_s, angular_velocity_rad_s
        self._hold_s, self._not_before_s = hold_s, not_before_s
        self._last: tuple[float, np.ndarray, np.ndarray] | None = None
        self._time_s = 0.0

    def observe(
        self,
        time_s: float,
        positions_m: np.ndarray,
        rotations: np.ndarray,
        asleep: np.ndarray,
        masses_kg: np.ndarray,
    ) -> None:
        """Look at a frame: its time, and positions (n, 3), rotations (n, 3, 3), sleep (n,) and masses of the bodies."""
        if self._last and time_s > self._last[0]:
            before_s, before_m, before = self._last
            step_s = time_s - before_s
            speeds = distance(positions_m, before_m) / step_s
            # A rotation by a small angle φ changes the matrix by √2 φ in the Frobenius norm.
            angular_velocities = distance(rotations.reshape(-1, 9), before.reshape(-1, 9)) / (np.sqrt(2.0) * step_s)
            shares = speeds / self._limits[0], angular_velocities / self._limits[1]
            squares = shares[0] * shares[0] + shares[1] * shares[1]
            if not _rest(np.where(asleep, 0.0, squares), masses_kg) or before_s < self._not_before_s:
                self.since_s = None
            elif self.since_s is None:
                self.since_s = before_s
        self._last = time_s, positions_m, rotations
        self._time_s = time_s

    @property
    def is_reached(self) -> bool:
        """Return whether everything has been at rest for long enough."""
        return self.came_to_rest_s is not None

    @property
    def came_to_rest_s(self) -> float | None:
        """Return since when everything rests, where it has for long enough; None where it has not."""
        if self.since_s is None or self._time_s - self.since_s < self._hold_s * (1.0 - 1e-6):
            return None
        return self.since_s


def _rest(squares: np.ndarray, masses_kg: np.ndarray) -> bool:
    """Return whether bodies rest, by the squares (n,) of their speeds over the limit; what has no mass is not moved."""
    moved = masses_kg > 0.0
    if (squares[moved] >= FASTEST * FASTEST).any():
        return False
    return bool((masses_kg[moved] * squares[moved]).sum() < masses_kg[moved].sum() or not moved.any())


def last_event_s(scenario: Scenario, motion_end_s: float = 0.0) -> float:
    """Return the time after which a scenario plans nothing more, s; the ground stops moving at `motion_end_s`."""
    ends_s = (action.ends_s(scenario) for action in scenario.actions)
    return max(motion_end_s, scenario.connections.warm_up_s, *filter(math.isfinite, ends_s))
