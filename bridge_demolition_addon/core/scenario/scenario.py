"""A whole scenario, made of its tables."""

from dataclasses import dataclass, field
from typing import ClassVar

from ..errors import ScenarioError
from .ball import Ball
from .bodies import Ground, ShardSettings
from .bridge import Bridge
from .connections import ConnectionSettings
from .fracture import FractureSettings
from .key import LARGEST_INTEGER, ROUNDING, Table, key
from .output import PictureSettings, RecordingSettings
from .time import TimeSettings


@dataclass(frozen=True, slots=True, kw_only=True)
class Scenario(Table):
    """A whole scenario: everything that a run depends on."""

    table: ClassVar[str] = "scenario"

    title: str = key("Title of the results.")
    seed: int = key(
        "Start of the random numbers: the same seed cuts the same shards.",
        default=0,
        at_least=0,
        at_most=LARGEST_INTEGER,
    )
    time: TimeSettings
    bridge: Bridge
    ground: Ground = field(default_factory=Ground)
    fracture: FractureSettings
    connections: ConnectionSettings
    shards: ShardSettings = field(default_factory=ShardSettings)
    ball: Ball | None = None
    recording: RecordingSettings = field(default_factory=RecordingSettings)
    pictures: PictureSettings = field(default_factory=PictureSettings)

    def _check_together(self) -> None:
        if self.ball:
            self._check_release(self.ball)
            self._check_target(self.ball)

    def _check_release(self, ball: Ball) -> None:
        if self.time.step.frames(ball.release_time_s) >= self.time.frames:
            raise ScenarioError(
                f"ball.release_time_s is {ball.release_time_s}: "
                f"expected less than time.duration_s, {self.time.duration_s} (s), "
                f"by a frame of {self.time.step.frame_s:.3g} s"
            )

    def _check_target(self, ball: Ball) -> None:
        overhang = self.bridge.deck.overhang_m
        half_width = self.bridge.deck.width_m / 2.0
        deck = ((-overhang, self.bridge.spans_m + overhang), (-half_width, half_width))
        for place, (position, (lowest, highest)) in enumerate(zip(ball.target_m, deck, strict=True)):
            slack = ROUNDING * (highest - lowest)
            if not lowest - slack <= position <= highest + slack:
                raise ScenarioError(
                    f"ball.target_m[{place}] is {position}: "
                    f"expected a place on the deck, from {lowest:.6g} to {highest:.6g} (m)"
                )
