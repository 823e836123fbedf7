"""Jackhammers on the deck."""

import math
from dataclasses import dataclass
from typing import ClassVar

from ..schema import SHORTEST_LENGTH_M, Table, key
from .time import TimeSettings

FRAMES_PER_BLOW = 4
"""Animation gives a place at each frame only: with this many a blow, each reaches at least 85 % of its stroke."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Jackhammer(Table):
    """A jackhammer: a chisel of steel that goes up and down while it moves along the deck. Nothing stops it, so it
    pushes away whatever is in its way. Before and after its time it stays clear above the deck.
    """

    table: ClassVar[str] = "jackhammers"

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
    friction: float = key("Coefficient of friction.", default=0.5, at_least=0)

    @property
    def largest_speed_m_s(self) -> float:
        """Return the largest speed of the chisel up and down, m/s."""
        return math.pi * self.blows_per_second * self.stroke_m

    def _check_together(self) -> None:
        if self.end_time_s <= self.start_time_s:
            raise self.unexpected("end_time_s", f"more than jackhammers.start_time_s, {self.start_time_s} (s)")
        if self.stroke_m <= self.depth_m:
            wanted = f"more than jackhammers.depth_m, {self.depth_m} (m), so that the chisel leaves the deck"
            raise self.unexpected("stroke_m", wanted)

    def check_time(self, time: TimeSettings) -> None:
        """Check that it ends before the run does, and that frames are short enough for its blows.

        Raises
        ------
        ScenarioError
            It does not, or they are not.
        """
        if self.end_time_s > time.duration_s - time.step.frame_s:
            wanted = f"less than time.duration_s, {time.duration_s} (s), by a frame of {time.step.frame_s:.3g} s"
            raise self.unexpected("end_time_s", wanted)
        most = 1.0 / (FRAMES_PER_BLOW * time.step.frame_s)
        if self.blows_per_second > most * (1.0 + 1e-9):
            needed = math.ceil(FRAMES_PER_BLOW * self.blows_per_second * time.time_scale * time.frames_per_second_base)
            wanted = f"at most {most:.6g} (1/s), one in {FRAMES_PER_BLOW} frames"
            raise self.unexpected("blows_per_second", f"{wanted}, or a time.frames_per_second of at least {needed}")
