"""The schedule of bars: layers and links of each member, what they are for and weigh, and links spread over them."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from ...engineering.geometry.vectors import AXES
from ...engineering.reinforced_concrete.least_areas import BarChoice
from ...engineering.reinforced_concrete.materials import STEEL_DENSITY_KG_M3
from ...texts import Quantity, Text
from ..actions import Fact
from ..bridge.member import Member
from ..materials import BarLayer
from ..scenario import Scenario
from ..scenario.scenario import rules_of_bars
from ..schema import given

_MM2 = 1e6
"""mm² in a m²."""

_MM = 1e3

USUAL_KG_M3 = (80, 150)
"""Steel of most bridge decks of reinforced concrete by their concrete, kg/m³, as estimators take it. A table of ratios
of highway bridges designed to BS 5400, for tenders without drawings, has 150 for walls and abutments."""


@dataclass(frozen=True, slots=True)
class ScheduledBars:
    """A layer of bars that the members of one kind have alike."""

    layer: BarLayer  # with the names of its members
    kind: str
    choice: BarChoice | None  # None where only a ratio is given
    section_m2: float  # of the concrete that the bars cross
    required_m2: float
    reason: str  # what the required area is for
    length_m: float  # of a bar in one member

    @property
    def area_m2(self) -> float:
        """Area of bars in one section of one member."""
        return self.layer.ratio * self.section_m2 if self.layer.is_spread else self.layer.area_m2

    @property
    def ratio(self) -> float:
        return self.area_m2 / self.section_m2

    @property
    def utilisation(self) -> float:
        """Required area over the bars' area."""
        return self.required_m2 / self.area_m2

    @property
    def mass_kg(self) -> float:
        """Mass in all members together."""
        return len(self.layer.members) * self.area_m2 * self.length_m * STEEL_DENSITY_KG_M3

    @property
    def where(self) -> str:
        if self.layer.is_spread:
            return Text("spread along {}", self.layer.along)
        between = (
            ""
            if self.layer.from_m is None
            else Text(
                ", {} to {}",
                Quantity(self.layer.from_m, "m", ".1f", shown=False),
                Quantity(given(self.layer.to_m), "m", ".1f"),
            )
        )
        return Text(
            "{} at {}, along {}{}",
            self.layer.side,
            Quantity(_MM * given(self.layer.depth_m), "mm", ".0f"),
            self.layer.along,
            between,
        )

    @property
    def bars_text(self) -> str:
        if self.layer.is_spread:
            return Text("both faces")
        if self.choice is None:
            return Text("by ratio")
        bars = Text("{} Ø{}", self.choice.number, f"{_MM * self.choice.diameter_m:g}")
        if self.choice.rows > 1:
            return Text("{} in {} rows", bars, self.choice.rows)
        return (
            bars
            if math.isnan(self.choice.spacing_m)
            else Text("{} / s = {}", bars, Quantity(_MM * self.choice.spacing_m, "mm", ".0f"))
        )

    @property
    def members(self) -> tuple[str, ...]:
        return self.layer.members

    def of_members(self, names: tuple[str, ...]) -> ScheduledBars:
        """Return the same of other members."""
        return replace(self, layer=replace(self.layer, members=names))


@dataclass(frozen=True, slots=True)
class ScheduledLinks:
    """Links that the members of one kind have alike: bars around the others, across the member."""

    members: tuple[str, ...]
    kind: str
    link_area_mm2_per_m: float  # A_sw / s: of the legs in a section together, by length along the member
    required_mm2_per_m: float
    reason: str
    legs: int
    diameter_m: float  # 0 where only a ratio is given
    spacing_m: float
    width_m: float  # b_w
    loop_m: float  # total length of bars of one set of links
    length_m: float  # of one member
    shear_n: float = 0.0
    concrete_n: float = 0.0  # V_Rd,c
    cot_strut: float = 2.5

    @property
    def ratio(self) -> float:
        return self.link_area_mm2_per_m / _MM2 / self.width_m

    @property
    def utilisation(self) -> float:
        return self.required_mm2_per_m / self.link_area_mm2_per_m

    @property
    def mass_kg(self) -> float:
        """Mass in all members together."""
        by_leg_m2 = self.link_area_mm2_per_m / _MM2 / self.legs
        return len(self.members) * by_leg_m2 * self.loop_m * self.length_m * STEEL_DENSITY_KG_M3

    @property
    def bars_text(self) -> str:
        if not self.diameter_m:
            return Text("by ratio")
        return Text(
            "{} legs Ø{} / s = {}", self.legs, f"{_MM * self.diameter_m:g}", Quantity(_MM * self.spacing_m, "mm", ".0f")
        )

    def of_members(self, names: tuple[str, ...]) -> ScheduledLinks:
        """Return the same of other members."""
        return replace(self, members=names)


@dataclass(frozen=True, slots=True)
class Schedule:
    """All bars of a bridge by a rule."""

    bars: tuple[ScheduledBars, ...] = ()
    links: tuple[ScheduledLinks, ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def rows(self) -> tuple[ScheduledBars | ScheduledLinks, ...]:
        return (*self.bars, *self.links)

    @property
    def layers(self) -> tuple[BarLayer, ...]:
        return tuple(row.layer for row in self.bars)

    @property
    def mass_kg(self) -> float:
        return math.fsum(row.mass_kg for row in self.rows)

    def without(self, names: set[str]) -> Schedule:
        """Return the schedule without some members."""
        return Schedule(tuple(_without(self.bars, names)), tuple(_without(self.links, names)), self.notes)

    def link_area_mm2_per_m(self, member: str) -> float:
        """Return A_sw / s of a member; 0 without links."""
        return math.fsum(row.link_area_mm2_per_m for row in self.links if member in row.members)

    def mass_of_kg(self, kind: str) -> float:
        return math.fsum(row.mass_kg for row in self.rows if row.kind == kind)

    def masses(self, members: Sequence[Member]) -> list[tuple[str, float, float]]:
        """Return kinds of members with bars, their steel, kg, and their concrete, m³."""
        kinds = dict.fromkeys(row.kind for row in self.rows)
        volumes = {kind: math.fsum(member.volume_m3 for member in members if member.kind == kind) for kind in kinds}
        return [(kind, self.mass_of_kg(kind), volumes[kind]) for kind in kinds]


_Row = TypeVar("_Row", ScheduledBars, ScheduledLinks)


def _without(rows: Sequence[_Row], names: Collection[str]) -> Iterator[_Row]:
    for row in rows:
        if left := tuple(name for name in row.members if name not in names):
            yield row.of_members(left)


def named_text(row: ScheduledBars | ScheduledLinks) -> str:
    """Return the members of a row, by kind where it has several."""
    return row.members[0] if len(row.members) == 1 else Text("{} × {}", len(row.members), Text(row.kind))


def row_text(row: ScheduledBars | ScheduledLinks) -> str:
    """Return a row of the schedule as text."""
    if isinstance(row, ScheduledBars):
        area = f"{row.where}: {_MM2 * row.area_m2:.0f} mm²"
    else:
        area = Text("links: {}", Quantity(row.link_area_mm2_per_m, "mm²/m", ".0f"))
    return f"{area}, {row.bars_text}, {row.ratio:.2%}, {row.utilisation:.0%} used, {row.reason}"


def schedule_facts(scenario: Scenario, members: Sequence[Member], schedule: Schedule) -> Iterator[Fact]:
    """Yield the schedule of bars, line by line, with the steel by the concrete."""
    rules = rules_of_bars(scenario)
    if not rules:
        return
    for rule in rules:
        yield "by", f"{rule.described}; {rule.steel}, cover {1e3 * rule.cover_m:g} mm"
    for row in schedule.rows:
        yield named_text(row), row_text(row)
    yield from steel_facts(members, schedule)
    yield "", "bars run along the whole of a member where no positions are given; laps, hooks and bars that"
    yield "", "detailing adds are not in it"
    for note in schedule.notes:
        yield "note", note


def steel_facts(members: Sequence[Member], schedule: Schedule) -> Iterator[Fact]:
    """Yield the steel of each kind of member by its concrete."""
    concrete_m3, steel_kg = 0.0, 0.0
    for kind, mass_kg, volume_m3 in schedule.masses(members):
        yield (
            Text("steel of {}", kind),
            Text(
                "{} in {} of concrete, {}",
                Quantity(mass_kg, "kg", ".0f"),
                Quantity(volume_m3, "m³", ".1f"),
                Quantity(mass_kg / volume_m3, "kg/m³", ".0f"),
            ),
        )
        concrete_m3, steel_kg = concrete_m3 + volume_m3, steel_kg + mass_kg
    if concrete_m3:
        yield (
            Text("steel of {}", Text("all")),
            Text(
                "{}, {}; usual in decks are {} to {}",
                Quantity(steel_kg, "kg", ".0f"),
                Quantity(steel_kg / concrete_m3, "kg/m³", ".0f"),
                Quantity(USUAL_KG_M3[0], "kg/m³", shown=False),
                Quantity(USUAL_KG_M3[1], "kg/m³"),
            ),
        )


_USUAL_MM = 10.0
"""Diameter of links of which only a ratio is given."""


def link_layers(schedule: Schedule, members: Sequence[Member]) -> Iterator[BarLayer]:
    """Yield the links of a schedule: upright legs of what lies, and legs both ways of columns."""
    extents = {member.name: np.ptp(member.without_skew(member.solid.vertices), axis=0) for member in members}
    yields = [row.layer.yield_n_mm2 for row in schedule.bars]
    for row in schedule.links:
        along = AXES[int(np.argmax(extents[row.members[0]]))]
        for axis in ("x", "y") if along == "z" else ("z",):
            layer = BarLayer(
                members=row.members,
                along=axis,
                spread_mm2_m2=_MM2 * row.ratio,
                diameter_mm=_MM * row.diameter_m or _USUAL_MM,
            )
            yield layer if not yields else replace(layer, yield_n_mm2=yields[0])
