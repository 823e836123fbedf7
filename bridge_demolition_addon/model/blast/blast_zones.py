"""Blast zones: parts of members that charges in drill holes break."""

import math
import zlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase
from itertools import pairwise
from typing import ClassVar, Self

import numpy as np

from ...engineering.arithmetic import cosine, logarithm
from ...engineering.drilled_charges.drill_holes import charge_length_m, hole_capacity_kg
from ...engineering.drilled_charges.specific_charge import THROW_KG_M3, DrilledElement
from ...engineering.geometry.vectors import AXES, SIDES
from ...errors import ScenarioError
from ...texts import Quantity, Text
from ..actions import CutPlane, Fact, Plan, PlannedAction, PlannedStep, Worksite
from ..changes.zone_firings import ZoneFiring
from ..schema import POSITION, SHARE, SIZE, given, key, shown
from .charges import LARGEST_CHARGE_KG, MS_PER_S

KG_PER_G = 1e-3
M_PER_MM = 1e-3


@dataclass(frozen=True, slots=True)
class DrilledExplosive:
    """An explosive for drill holes."""

    name: str
    density_kg_m3: float  # as it lies in the hole
    relative_strength: float  # relative weight strength: its energy over ANFO's, which has 100
    source: str


DRILLED_EXPLOSIVES = {
    explosive.name: explosive
    for explosive in (
        DrilledExplosive("gelatine", 1450.0, 120.0, "gelatinous explosives, 4.8 MJ/kg over 3.9 of ANFO"),
        DrilledExplosive("emulsion", 1200.0, 100.0, "packaged emulsion: data sheets have 74 to 116"),
        DrilledExplosive("ANFO", 850.0, 100.0, "the reference"),
        DrilledExplosive("TNT", 1600.0, 115.0, "Cunningham, Kuz-Ram (1987)"),
    )
}
"""Explosives by name. Data sheets of the product say better: both numbers vary by some 20 %."""

NO_SCATTER, SHOCK_TUBE, ELECTRONIC = "exact", "shock tube", "electronic"

DETONATORS = {NO_SCATTER: (0.0, 0.0), SHOCK_TUBE: (0.0, 0.02), ELECTRONIC: (0.00034, 0.0)}
"""Standard deviation of the time that a detonator fires at: in s, and as a part of its delay."""

RUBBLE_AT_FOOT, THROWN_AWAY = "rubble", "thrown"

_FARTHEST_DEVIATIONS = 3.0
"""A time further from its delay than this many standard deviations is that of a misfire."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BlastZone(PlannedAction):
    """A part of a member that stemmed charges in drill holes break: it no longer carries from its time on. The member
    is cut along the zone's two planes. See [drilled charges](drilled_charges.md). Charges are fixed by test shots and a
    licensed blaster, not by this program.
    """

    table: ClassVar[str] = "blast_zones"
    heading: ClassVar[str] = "Blast zones"
    numbered: ClassVar[str] = "Zone"
    noun: ClassVar[str] = "blast zone"

    name: str | None = key("What it is called in plans; by default Zone and its number.", default=None)
    member: str = key(
        "The member, by a name that `bda check` lists; with `*` for any letters, or `[2-4]` for one of some, all "
        "columns or legs of such names have this zone, as `pier [2-4] column *`."
    )
    along: str = key(
        "Axis of the bridge that the member runs along, and so the zone's height and the rows of its holes.",
        default="z",
        choices=AXES,
    )
    side: str = key(
        "Side of the member that is drilled; `right` is towards negative y, `start` backwards along the road.",
        default="start",
        choices=tuple(SIDES),
    )
    middle_m: float = key("Where its middle is along that axis: of a column, the height above the ground.", **POSITION)
    height_m: float = key("How high it is: its length along that axis.", **SIZE)
    rows: int = key("Rows of holes beside each other, each along the member.", default=1, at_least=1, at_most=100)
    holes_a_row: int = key("Holes in each row.", at_least=1, at_most=1000)
    spacing_m: float = key("Distance of holes within a row.", default=0.3, unit="m", above=0)
    row_spacing_m: float | None = key(
        "Distance between rows; by default the rows are spread evenly over the member's width.",
        default=None,
        unit="m",
        above=0,
    )
    depth_m: float = key("Depth of the holes.", unit="m", above=0)
    hole_diameter_mm: float = key("Diameter of the holes.", default=38.0, unit="mm", at_least=10, at_most=500)
    stemming_m: float = key("Length of the stemming in each hole.", unit="m", at_least=0)
    charge_g: float = key("Explosive in each hole.", unit="g", at_least=0, at_most=LARGEST_CHARGE_KG)
    explosive: str = key("What it is.", default="gelatine", choices=tuple(DRILLED_EXPLOSIVES))
    delay_ms: float = key(
        "Time from `blast.start_s` to its first row.", default=0.0, unit="ms", at_least=0, at_most=1e6
    )
    row_delay_ms: float = key(
        "Time from each row to the next. The zone stops carrying with its last row.",
        default=0.0,
        unit="ms",
        at_least=0,
        at_most=1e6,
    )
    axis_delay_ms: float = key(
        "With several members, time from those of each axis to those of the next, in their order along the road.",
        default=0.0,
        unit="ms",
        at_least=0,
        at_most=1e6,
    )
    column_delay_ms: float = key(
        "With several members, time from each column of an axis to the next, in the order of their numbers.",
        default=0.0,
        unit="ms",
        at_least=0,
        at_most=1e6,
    )
    detonator: str = key(
        "Kind of its detonators, by which their times scatter: `shock tube` by 2 % of the delay, `electronic` by "
        "0.34 ms (standard deviations). The seed decides the times of a run.",
        default=NO_SCATTER,
        choices=tuple(DETONATORS),
    )
    cover_factor: float = key(
        "Factor on the speed of fragments by a cover: about 0.6 with one layer of net and fleece, 0.3 with two.",
        default=1.0,
        above=0,
        at_most=1,
    )
    fires: bool = key("Whether it fires; `false` is a misfire.", default=True)
    probability_fires: float = key(
        "Probability that it fires, by which each run of a study samples `fires`.", default=1.0, **SHARE
    )
    debris: str = key(
        "What is thrown out of the reinforcement falls as `rubble` at the foot, or is `thrown` to all sides.",
        default=RUBBLE_AT_FOOT,
        choices=(RUBBLE_AT_FOOT, THROWN_AWAY),
    )
    element: str | None = key(
        "What is drilled, for the specific charge that breaks it; by default by the kind of the member.",
        default=None,
        choices=tuple(element.value for element in DrilledElement),
    )
    break_kg_m3: float | None = key(
        "Specific charge that breaks the concrete, by test shots; by default that of the table.",
        default=None,
        unit="kg/m³",
        above=0,
    )
    throw_kg_m3: float = key(
        "Specific charge that throws the concrete out of its reinforcement: 0.6 to 1.5, up to 2 inside spirals.",
        default=THROW_KG_M3,
        unit="kg/m³",
        above=0,
    )
    bars: int = key(
        "Bars along the member that stay when the concrete is gone, evenly at its sides; without it those that "
        "`[[reinforcement]]` or `[bridge.reinforcement]` gives the member.",
        default=0,
        at_least=0,
        at_most=100_000,
    )
    bar_diameter_mm: float | None = key("Diameter of these bars.", default=None, unit="mm", above=0, at_most=100)

    @property
    def has_pattern(self) -> bool:
        """Whether its member stands for several."""
        return any(letter in self.member for letter in "*?[")

    def repeated(self, axes: Sequence[Sequence[str]]) -> tuple[Self, ...]:
        """Return the zones of the members that it stands for, one of each.

        Parameters
        ----------
        axes
            Names of the columns, walls or legs of each axis of the bridge.

        Raises
        ------
        ScenarioError
            No member has such a name.
        """
        found = [[name for name in names if fnmatchcase(name, self.member)] for names in axes]
        zones: list[Self] = []
        for axis, columns in enumerate(row for row in found if row):
            for number, name in enumerate(columns):
                delay_ms = self.delay_ms + axis * self.axis_delay_ms + number * self.column_delay_ms
                one = replace(self, name=f"{self.name}, {name}", member=name, axis_delay_ms=0.0, column_delay_ms=0.0)
                zones.append(replace(one, delay_ms=delay_ms))
        if not zones:
            known = ", ".join(name for names in axes for name in names) or "none"
            raise self.unexpected("member", f"names of columns, walls or legs of the bridge with *; it has {known}")
        return tuple(zones)

    @property
    def holes(self) -> int:
        return self.rows * self.holes_a_row

    @property
    def charge_kg(self) -> float:
        """Explosive in each hole, kg."""
        return KG_PER_G * self.charge_g

    @property
    def mass_kg(self) -> float:
        """Explosive in all holes, kg."""
        return self.holes * self.charge_kg

    @property
    def drilled_m(self) -> float:
        """Total length of the holes, m."""
        return self.holes * self.depth_m

    @property
    def hole_diameter_m(self) -> float:
        return M_PER_MM * self.hole_diameter_mm

    @property
    def made_of(self) -> DrilledExplosive:
        return DRILLED_EXPLOSIVES[self.explosive]

    @property
    def ends_along_m(self) -> tuple[float, float]:
        """Where it begins and ends along its member, m."""
        return self.middle_m - self.height_m / 2.0, self.middle_m + self.height_m / 2.0

    @property
    def axes(self) -> tuple[int, int, int]:
        """Axes along its member, along its holes, and across them."""
        along, drilled = AXES.index(self.along), SIDES[self.side][0]
        return along, drilled, 3 - along - drilled

    @property
    def is_upright(self) -> bool:
        """Whether its member runs upwards there."""
        return self.along == "z"

    @property
    def goes_off(self) -> bool:
        """Return whether anything in it detonates."""
        return self.fires and self.mass_kg > 0.0

    def row_times_s(self) -> tuple[float, ...]:
        """Return the times of its rows after the start of the blasting, as planned."""
        return tuple((self.delay_ms + row * self.row_delay_ms) / MS_PER_S for row in range(self.rows))

    def deviations_s(self) -> tuple[float, ...]:
        """Return the standard deviations of these times."""
        fixed_s, share = DETONATORS[self.detonator]
        return tuple(fixed_s + share * time_s for time_s in self.row_times_s())

    def fired_after_s(self, seed: int) -> float:
        """Return when its last row fires in a run with a seed, after the start of the blasting, s."""
        times = [
            scattered_time_s(time_s, deviation_s, seed, f"{self.name} {row}")
            for row, (time_s, deviation_s) in enumerate(zip(self.row_times_s(), self.deviations_s(), strict=True))
        ]
        return max(times)

    def begins_s(self, plan: Plan) -> float:
        return plan.detonation_s(self.row_times_s()[0]) if self.goes_off else math.inf

    def ends_s(self, plan: Plan) -> float:
        last_s = self.row_times_s()[-1] + _FARTHEST_DEVIATIONS * self.deviations_s()[-1]
        return plan.detonation_s(last_s) if self.goes_off else math.inf

    @classmethod
    def run_tables(cls) -> tuple[type[PlannedAction], ...]:
        return (ZoneFiring,)

    def in_run(self, site: Worksite) -> Iterator[PlannedAction]:
        yield from site.firings_of(self)

    def described(self) -> tuple[str, str]:
        holes = self.holes, Quantity(self.mass_kg, "kg", ".3g"), Text(self.explosive)
        if self.rows == 1:
            return Text("{} fires: a row, {} holes, {} of {}", self.name, *holes), self.member
        return Text("{} fires: {} rows, {} holes, {} of {}", self.name, self.rows, *holes), self.member

    def planned(self, plan: Plan) -> Iterator[PlannedStep]:
        """Yield it with its end as planned, without what detonators scatter."""
        begins_s = self.begins_s(plan)
        ends_s = plan.detonation_s(self.row_times_s()[-1]) if math.isfinite(begins_s) else math.inf
        yield PlannedStep(begins_s, ends_s, *self.described())

    @classmethod
    def means(cls, actions: Sequence[Self]) -> str:
        mass_kg = math.fsum(zone.mass_kg for zone in actions)
        last_ms = MS_PER_S * max(zone.row_times_s()[-1] for zone in actions)
        one = "{} blast zone with {} in drill holes, fired within {} ms"
        more = "{} blast zones with {} in drill holes, fired within {} ms"
        many = len(actions)
        return Text(one if many == 1 else more, many, Quantity(mass_kg, "kg", ".3g"), f"{last_ms:.0f}")

    def facts(self, site: Worksite) -> Iterator[Fact]:
        yield from site.facts_of_zone(self)

    def cut_planes(self) -> tuple[CutPlane, ...]:
        return tuple(CutPlane(self.member, self.along, end_m, self.table) for end_m in self.ends_along_m)

    def check_plan(self, plan: Plan) -> None:
        """Check that it fires after the settling and before the end of the run, if at all."""
        first_s, last_s = self.begins_s(plan), self.ends_s(plan)
        check_fires_within(plan, first_s, last_s, f"{self.name} fires from {first_s:g} to {last_s:g} s")

    def check_model(self, site: Worksite) -> None:
        site.check_zone(self)

    def _check_together(self) -> None:
        if AXES[SIDES[self.side][0]] == self.along:
            beside = ", ".join(name for name, (axis, _) in SIDES.items() if AXES[axis] != self.along)
            raise self.unexpected("side", f"one beside a member along {self.along}: {beside}")
        if not self.has_pattern and (self.axis_delay_ms or self.column_delay_ms):
            name = "axis_delay_ms" if self.axis_delay_ms else "column_delay_ms"
            raise self.unexpected(name, f"0 with one member, {shown(self.member)}: it needs several, by * in its name")
        if self.bars and self.bar_diameter_mm is None:
            raise self.unexpected("bar_diameter_mm", f"it with blast_zones.bars, {self.bars}")
        if self.break_kg_m3 is not None and not self.break_kg_m3 < self.throw_kg_m3:
            raise self.unexpected("break_kg_m3", f"less than blast_zones.throw_kg_m3, {self.throw_kg_m3:g} (kg/m³)")
        self._check_holes()

    def _check_holes(self) -> None:
        staggered_m = self.spacing_m / 2.0 if self.rows > 1 else 0.0
        row_m = (self.holes_a_row - 1) * self.spacing_m + staggered_m
        if row_m > self.height_m:
            raise self.unexpected(
                "height_m", f"at least the length of its rows, {row_m:.4g} (m) with {self.holes_a_row} holes in each"
            )
        if self.stemming_m >= self.depth_m:
            raise self.unexpected("stemming_m", f"less than blast_zones.depth_m, {self.depth_m:g} (m)")
        most_kg = hole_capacity_kg(self.depth_m, self.stemming_m, self.hole_diameter_m, self.made_of.density_kg_m3)
        if self.charge_kg > most_kg * (1.0 + 1e-9):
            raise self.unexpected(
                "charge_g",
                f"at most {most_kg / KG_PER_G:.1f} (g), which a hole of {self.hole_diameter_mm:g} mm holds in "
                f"{self.depth_m - self.stemming_m:.3g} m below its stemming",
            )


def length_of_charge_m(zone: BlastZone) -> float:
    """Return the length of the charge in each hole of a zone, m."""
    return charge_length_m(zone.charge_kg, zone.hole_diameter_m, zone.made_of.density_kg_m3)


def check_zones_apart(zones: Sequence[BlastZone]) -> None:
    """Check that no two zones of one member overlap, and that all of them run along one axis of it."""
    by_place = sorted(zones, key=lambda zone: (zone.member, zone.ends_along_m))
    for zone, after in pairwise(by_place):
        if zone.member != after.member:
            continue
        if zone.along != after.along:
            raise ScenarioError(
                f"blast_zones {shown(zone.name)} and {shown(after.name)} of {zone.member} run along {zone.along} and "
                f"{after.along}: expected one axis for all zones of a member"
            )
        end_m, begin_m = zone.ends_along_m[1], after.ends_along_m[0]
        if begin_m < end_m - 1e-9 * abs(end_m):
            raise ScenarioError(
                f"blast_zones {shown(zone.name)} ends at {end_m:g} m of {zone.member}, and {shown(after.name)} begins "
                f"at {begin_m:g} m: expected zones that do not overlap"
            )


def check_fires_within(plan: Plan, first_s: float, last_s: float, when: str) -> None:
    """Check that charges fire after the settling and before the end, if at all; `when` says which do, and when."""
    latest_s = plan.time.duration_s - plan.time.step.frame_s
    if math.isfinite(first_s) and not plan.warm_up_s <= first_s <= last_s < latest_s:
        raise ScenarioError(
            f"{when} (blast.start_s and what delays it): expected at least connections.warm_up_s, {plan.warm_up_s:g} "
            f"(s), and less than {latest_s:.6g} (s), a frame before time.duration_s is over"
        )


def scattered_time_s(time_s: float, deviation_s: float, seed: int, name: str) -> float:
    """Return when a detonator of a name fires in a run with a seed, by its planned time and standard deviation."""
    return max(time_s + deviation_s * _normal(seed, name), 0.0)


def _normal(seed: int, name: str) -> float:
    """Return a normal number of a seed and a name, within 3: G. E. P. Box and M. E. Muller (1958)."""
    generator = np.random.default_rng([seed, zlib.crc32(name.encode())])
    first, second = generator.random(2)
    value = float(np.sqrt(-2.0 * logarithm(1.0 - first)) * cosine(2.0 * np.pi * second))
    return min(max(value, -_FARTHEST_DEVIATIONS), _FARTHEST_DEVIATIONS)


def element_of_kind(kind: str) -> DrilledElement:
    """Return what a member of a kind is drilled as, where the zone does not say."""
    return {
        "deck": DrilledElement.SLAB,
        "pier cap": DrilledElement.CAP_BEAM,
        "abutment": DrilledElement.PLAIN,
    }.get(kind, DrilledElement.BEAM_OR_COLUMN)


def element_of(zone: BlastZone, kind: str) -> DrilledElement:
    """Return what a zone in a member of a kind is drilled as."""
    return DrilledElement(given(zone.element)) if zone.element else element_of_kind(kind)
