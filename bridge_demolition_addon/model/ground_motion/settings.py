"""How the ground moves: by a recorded accelerogram, a sweep of frequencies, or a record made from a spectrum."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar, Self

from ...engineering.units import STANDARD_GRAVITY_M_S2
from ...errors import ScenarioError
from ...texts import Text
from ..actions import Fact, Plan, PlannedAction, Worksite
from ..schema import Table, check_exactly_one, key

DIRECTIONS = ("along", "across", "up")
"""Names of the axes x, y and z."""

UNITS = ("g", "m/s2", "cm/s2")

HIGHEST_HZ = 50.0
"""Frequencies above this do not move a bridge, and would need very short sub-steps."""

_SOURCES = ("file", "sweep", "spectrum")


@dataclass(frozen=True, slots=True, kw_only=True)
class Sweep(Table):
    """A sine whose frequency goes evenly from one to another, as of a shaking table: it fades in and out within its
    first and last cycle. The same frequency twice is a sine."""

    table: ClassVar[str] = "ground_motion.sweep"

    from_hz: float = key("Frequency at the beginning.", unit="Hz", at_least=0.05, at_most=HIGHEST_HZ)
    to_hz: float = key("Frequency at the end.", unit="Hz", at_least=0.05, at_most=HIGHEST_HZ)
    duration_s: float = key("How long it lasts.", unit="s", above=0, at_most=600)
    acceleration_m_s2: float = key("Largest acceleration of each cycle.", unit="m/s²", above=0, at_most=50)

    def _check_together(self) -> None:
        cycles = 0.5 * (self.from_hz + self.to_hz) * self.duration_s
        if cycles < 3.0:
            raise self.unexpected("duration_s", f"at least 3 cycles, and not {cycles:.3g}")


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignSpectrum(Table):
    """A record with the response spectrum of EN 1998-1:2004, 3.2.2.2, for 5 % damping: sines with random phases under
    an envelope, as of D. A. Gasparini and E. H. Vanmarcke (1976). The scenario's seed draws the phases: another seed is
    another earthquake with the same spectrum."""

    table: ClassVar[str] = "ground_motion.spectrum"

    acceleration_m_s2: float = key(
        "Design ground acceleration a_g on rock, with the factor of importance.", unit="m/s²", above=0, at_most=20
    )
    ground_type: str = key(
        "Ground by EN 1998-1, table 3.1: `A` rock, `B` very dense, `C` dense or stiff, `D` loose or soft, `E` soft "
        "over rock.",
        choices=("A", "B", "C", "D", "E"),
    )
    type: int = key(
        "Type of the spectrum: 1, or 2 where no earthquake that counts has a surface-wave magnitude above 5.5.",
        default=1,
        at_least=1,
        at_most=2,
    )
    strong_s: float = key(
        "How long it shakes most; 2 s of rise come before and 5 s of decay after it. EN 1998-1, 3.2.3.1.2 (3), asks "
        "for 10 s or more.",
        default=10.0,
        unit="s",
        at_least=1,
        at_most=60,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class GroundMotion(PlannedAction):
    """The ground moves, and with it what is fixed to it: supports and bodies that never move. Give a `file`, a
    `[ground_motion.sweep]` or a `[ground_motion.spectrum]`."""

    table: ClassVar[str] = "ground_motion"
    heading: ClassVar[str] = "Ground motion"

    directions: tuple[str, ...] = key(
        "Where the accelerations act, in the order of the file's columns: `along` the road (x), `across` it (y), `up`. "
        "A sweep acts in all of them at once; of a spectrum each gets a record of its own, and `up` is not among them.",
        choices=DIRECTIONS,
    )
    file: str | None = key(
        "Path of a CSV file, from the scenario file's folder: in a row the time in s and the acceleration in each of "
        "the `directions`, with commas or semicolons between them. A first row of names is skipped.",
        default=None,
    )
    unit: str | None = key(
        "Unit of the file's accelerations. Needed with `file`, and only with it.", default=None, choices=UNITS
    )
    sweep: Sweep | None = None
    spectrum: DesignSpectrum | None = None
    factor: float = key(
        "Factor on all accelerations: sampled by a study, or an intensity that a search looks for.",
        default=1.0,
        at_least=0,
        at_most=100,
    )
    baseline: str = key(
        "What is taken off the accelerations, so that the ground ends at rest where it began: `linear` is the straight "
        "line in time that does so; `parabola` is of all parabolas that do so the one that leaves the least mean "
        "square velocity, as of G. V. Berg and G. W. Housner (1961); `none` takes nothing off, for a record that was "
        "corrected before, and may end elsewhere, but at rest.",
        default="linear",
        choices=("linear", "parabola", "none"),
    )
    start_s: float = key("When the record begins; until then the ground rests.", default=0.0, unit="s", at_least=0)

    def begins_s(self, plan: Plan) -> float:
        return self.start_s

    def described(self) -> tuple[str, str]:
        return Text("the ground moves"), ""

    @classmethod
    def means(cls, actions: Sequence[Self]) -> str:
        return Text("motion of the ground")

    def facts(self, site: Worksite) -> Iterator[Fact]:
        record = site.plan.ground_record
        assert record is not None
        end_s = self.start_s + record.duration_s
        yield "from, to", f"{self.start_s:g} s, {end_s:g} s, of {site.plan.time.duration_s:g} s"
        peaks = record.peaks()
        for axis, direction in enumerate(DIRECTIONS):
            if direction in self.directions:
                acceleration = peaks["accelerations_m_s2"][axis]
                yield (
                    direction,
                    f"up to {acceleration:.3g} m/s² = {acceleration / STANDARD_GRAVITY_M_S2:.3f} g, "
                    f"{peaks['velocities_m_s'][axis]:.3g} m/s, {peaks['displacements_m'][axis]:.3g} m",
                )

    def check_plan(self, plan: Plan) -> None:
        """Check that it begins within the run, and that no machine holds a tool that would not move with the ground."""
        for action in plan.actions:
            if key_of_machine := action.held_by_machine:
                raise ScenarioError(
                    f"{key_of_machine} is given together with ground_motion: expected one of them; tools that machines "
                    "hold do not move with the ground"
                )
        if self.start_s >= plan.time.duration_s:
            raise self.unexpected("start_s", f"less than time.duration_s, {plan.time.duration_s:g} (s)")

    def check_model(self, site: Worksite) -> None:
        """Check that there is a record, by reading its file or making it."""
        _ = site.plan.ground_record

    def _check_together(self) -> None:
        check_exactly_one(self, *_SOURCES)
        if len(set(self.directions)) < len(self.directions):
            raise ScenarioError(f"{self.table}.directions names one twice: expected each once")
        if (self.file is None) != (self.unit is None):
            wanted = f"one of {', '.join(UNITS)} with a file" if self.unit is None else "none without a file"
            raise self.unexpected("unit", wanted)
        if self.spectrum and "up" in self.directions:
            raise ScenarioError(
                f"{self.table}.directions has up: expected along or across with a spectrum, which is that of "
                "horizontal motion"
            )
