"""How long the simulation runs, and in which steps."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import ClassVar, Self

from ...engineering.timing.timeline import MOST_SUBSTEPS, Timeline, TimeStep
from ..actions import Fact
from ..schema import Table, key

FARTHEST_WITH_BARS_M = 0.01
"""How far a body goes in a sub-step where bars hold cracks: bars yield once these have opened by some millimetres."""

PASSES, PASSES_OF_ELASTIC = 10, 200
"""Passes of the solver: as in Blender, and at most where elastic connections spread what contacts stop."""

MOST_FRAMES = 1_000_000
"""Blender's timeline ends at frame 1 048 574; a run needs a few frames of it before time begins."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TimeSettings(Table):
    """How long the simulation runs, and in which steps."""

    table: ClassVar[str] = "time"

    duration_s: float = key(
        "Simulated time, or where the run ends at rest the longest that it lasts. What falls from a bridge lies still "
        "some seconds later.",
        default=20.0,
        unit="s",
        above=0,
    )
    frames_per_second: int = key("Blender's frame rate.", default=24, unit="1/s", at_least=1, at_most=32767)
    frames_per_second_base: float = key(
        "Divisor of the frame rate: 30 with a base of 1.001 is 29.97 frames per second.",
        default=1.0,
        above=0,
        at_most=1_000_000,
    )
    substeps_per_frame: int = key("Steps of the physics in one frame.", default=10, at_least=1, at_most=MOST_SUBSTEPS)
    farthest_per_substep_m: float | None = key(
        "How far a body may go in one step of the physics. A frame at whose beginning one is too fast for that has "
        f"more steps, up to {MOST_SUBSTEPS}. 0.01 takes two to three times as long as without, and the solver makes a "
        f"third of the energy. Where it is left out bridges with bars have {FARTHEST_WITH_BARS_M:g}.",
        default=None,
        unit="m",
        above=0,
    )
    solver_iterations: int | None = key(
        "Most passes over all connections and contacts in one sub-step; more make a stiffer bridge. Elastic "
        "connections need no more once none changes a velocity, and with few their pile creeps. Where it is left out "
        f"{PASSES_OF_ELASTIC} with these, else {PASSES}.",
        default=None,
        at_least=1,
        at_most=1000,
    )
    split_impulse: bool = key(
        "Whether bodies that overlap by more than 4 cm are moved apart without gaining speed. Off, as in 2019 and by "
        "Blender's default, the solver makes energy of the overlap.",
        default=True,
    )
    time_scale: float = key(
        "Simulated seconds in one second of animation: below 1 is slow motion.", default=1.0, above=0, at_most=100
    )

    stop_at_rest: bool = key(
        "Whether the run ends before `duration_s` once everything rests and nothing planned is still to happen.",
        default=True,
    )
    rest_speed_m_s: float = key(
        "Everything rests while its kinetic energy per mass is below that of bodies which all move at this speed, and "
        "none moves at 10 times the speed; what sleeps rests anyway. 0.05 is the energy of a fall by 0.13 mm.",
        default=0.05,
        unit="m/s",
        above=0,
    )
    rest_angular_velocity_rad_s: float = key(
        "Angular velocity that counts as much as `rest_speed_m_s`.", default=0.1, unit="rad/s", above=0
    )
    rest_hold_s: float = key("How long everything has to rest.", default=1.0, unit="s", above=0)

    def completed(self, *, is_elastic: bool, has_bars: bool) -> Self:
        """Return the settings with what was left out; bars need short steps where bodies are fast."""
        farthest_m, passes = self.farthest_per_substep_m, self.solver_iterations
        if is_elastic and has_bars and farthest_m is None:
            farthest_m = FARTHEST_WITH_BARS_M
        if passes is None:
            passes = PASSES_OF_ELASTIC if is_elastic else PASSES
        return replace(self, farthest_per_substep_m=farthest_m, solver_iterations=passes)

    @property
    def step(self) -> TimeStep:
        return TimeStep(self.frames_per_second, self.frames_per_second_base, self.substeps_per_frame, self.time_scale)

    @property
    def frames(self) -> int:
        """Whole frames that cover the duration."""
        return self.step.frames(self.duration_s)

    def facts(self, timeline: Timeline) -> Iterator[Fact]:
        """Yield duration, frames and sub-steps of a run with these frames."""
        yield "duration", f"{self.duration_s:g} s"
        shortest = timeline.frame_lengths_s.min()
        slowed = "" if shortest > 0.999 * self.step.frame_s else f", down to {shortest:.3g} s around detonations"
        yield "frames", f"{len(timeline)} of {self.step.frame_s:.6g} s{slowed}"
        farthest_m = self.farthest_per_substep_m
        shortened = "" if farthest_m is None else f", more where a body would move by more than {farthest_m:g} m in one"
        yield "sub-step", f"{self.step.substep_s:.6g} s, {self.substeps_per_frame} in a frame{shortened}"

    def _check_together(self) -> None:
        if self.duration_s / self.step.frame_s > MOST_FRAMES or not 1 <= self.frames <= MOST_FRAMES:
            raise self.unexpected("duration_s", f"1 to {MOST_FRAMES} frames, each of {self.step.frame_s:.3g} s")
