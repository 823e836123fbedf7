"""Jackhammers on the deck."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np

from ...engineering.arithmetic import cosine
from ...engineering.geometry.vectors import points_along
from ...texts import Text, point_text
from ..actions import Fact, HeightAt, Place, Plan, PlannedAction, Point, Worksite
from ..schema import SHORTEST_LENGTH_M, key
from .contacts import FRICTION, OWN_VALUE, TOOLS, BodyInContact

FRAMES_PER_BLOW = 4
"""Animation gives a position at each frame only: with this many a blow, it has at least 85 % of its stroke."""

_RAISED_M = 1.0
"""How far a chisel is raised after its last blow."""

_RAISING_S = 1.0
"""How long raising takes."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Jackhammer(BodyInContact, PlannedAction):
    """A jackhammer: a chisel of steel that goes up and down while it moves along the deck. Nothing stops it, so it
    pushes away whatever is in its way. Before and after its time it stays clear above the deck.
    """

    table: ClassVar[str] = "jackhammers"
    contact: ClassVar[str] = TOOLS
    noun: ClassVar[str] = "jackhammer"
    older_values: ClassVar[Mapping[str, float]] = {FRICTION: 0.5}

    start_time_s: float = key("When the first blow begins, from above the deck.", unit="s", at_least=0)
    end_time_s: float = key("When it stops and is raised; before `time.duration_s` is over.", unit="s", above=0)
    path_m: tuple[tuple[float, float], ...] = key(
        "Points that it passes in straight lines, each along the road from the first pier's axis and across it from "
        "its middle: `[[2.0, 0.0], [4.0, 0.0]]`. At the last one it stays, as at the only one.",
        unit="m",
    )
    speed_m_s: float = key("Speed along the path.", default=0.1, unit="m/s", above=0)
    blows_per_second: float = key(
        f"Blows in a second: at most one in {FRAMES_PER_BLOW} frames.", default=4.0, unit="1/s", above=0
    )
    stroke_m: float = key("How far the chisel goes up and down; more than `depth_m`.", unit="m", above=0)
    depth_m: float = key("How far its tip goes below the top of the deck.", unit="m", above=0)
    diameter_m: float = key("Diameter of the chisel.", default=0.15, unit="m", at_least=SHORTEST_LENGTH_M)
    length_m: float = key("Length of the chisel.", default=1.0, unit="m", at_least=SHORTEST_LENGTH_M)
    friction: float | None = key(OWN_VALUE, default=None, at_least=0)

    @property
    def largest_speed_m_s(self) -> float:
        """Return the largest speed of the chisel up and down."""
        return math.pi * self.blows_per_second * self.stroke_m

    def tip_positions(self, deck_top_m: float, times_s: np.ndarray) -> np.ndarray:
        """Return the positions (k, 3) of the chisel's tip at times (k,), m.

        It goes up and down as a cosine from the top of its stroke to its depth below the deck, beginning at the top.
        """
        times = np.asarray(times_s, float)
        worked_s = np.clip(times, self.start_time_s, self.end_time_s) - self.start_time_s
        level = points_along(np.array(self.path_m), self.speed_m_s * worked_s)
        blows = self.blows_per_second * worked_s
        raised = 0.5 * (1.0 + cosine(2.0 * np.pi * (blows - np.floor(blows))))
        height = deck_top_m - self.depth_m + self.stroke_m * raised
        share = np.clip((times - self.end_time_s) / _RAISING_S, 0.0, 1.0)
        clear = deck_top_m - self.depth_m + self.stroke_m + _RAISED_M
        return np.column_stack((level, height + share * (clear - height)))

    @property
    def held_by_machine(self) -> str:
        return self.table

    def begins_s(self, plan: Plan) -> float:
        return self.start_time_s

    def ends_s(self, plan: Plan) -> float:
        return self.end_time_s

    def scaled_in_time(self, factor: float) -> Self:
        return replace(
            self,
            start_time_s=self.start_time_s * factor,
            end_time_s=self.end_time_s * factor,
            speed_m_s=self.speed_m_s * (1.0 / factor),
            blows_per_second=self.blows_per_second * (1.0 / factor),
        )

    def targets(self) -> Iterator[tuple[str, Place]]:
        for number, position in enumerate(self.path_m, start=1):
            yield f"{self.table}.path_m.{number}", position

    def starts_above(self) -> tuple[Place, ...]:
        return self.path_m[:1]

    def points_of_interest(self, height_at: HeightAt) -> Iterator[Point]:
        """Yield the upper ends of the chisel at the top of its stroke, all along its path."""
        (tip,) = self.tip_positions(height_at(self.path_m[0]), np.array([self.start_time_s]))
        for along, across in self.path_m:
            yield along, across, float(tip[2]) + self.length_m

    def described(self) -> tuple[str, str]:
        ends = point_text(self.path_m[0]), point_text(self.path_m[-1])
        return Text("jackhammer works"), Text("from {} to {}", *ends)

    def facts(self, site: Worksite) -> Iterator[Fact]:
        work = f"jackhammer until {self.end_time_s:g} s, at up to {self.largest_speed_m_s:.1f} m/s"
        yield f"{self.start_time_s:.3f} s", work

    def check_plan(self, plan: Plan) -> None:
        """Check that it ends before the run does, and that frames are short enough for its blows."""
        frame_s = plan.time.step.frame_s
        if self.end_time_s > plan.time.duration_s - frame_s:
            wanted = f"less than time.duration_s, {plan.time.duration_s} (s), by a frame of {frame_s:.3g} s"
            raise self.unexpected("end_time_s", wanted)
        most = 1.0 / (FRAMES_PER_BLOW * frame_s)
        if self.blows_per_second > most * (1.0 + 1e-9):
            step = plan.time.step
            needed = math.ceil(FRAMES_PER_BLOW * self.blows_per_second * step.time_scale * step.frames_per_second_base)
            wanted = f"at most {most:.6g} (1/s), one in {FRAMES_PER_BLOW} frames"
            raise self.unexpected("blows_per_second", f"{wanted}, or a time.frames_per_second of at least {needed}")

    def _check_together(self) -> None:
        if self.end_time_s <= self.start_time_s:
            raise self.unexpected("end_time_s", f"more than jackhammers.start_time_s, {self.start_time_s} (s)")
        if self.stroke_m <= self.depth_m:
            wanted = f"more than jackhammers.depth_m, {self.depth_m} (m), so that the chisel leaves the deck"
            raise self.unexpected("stroke_m", wanted)
