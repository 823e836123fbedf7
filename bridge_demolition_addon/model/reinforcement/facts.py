"""What is said of the bars of a scenario: their schedule, and steel by concrete."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..actions import Fact
from ..bridge.member import Member
from ..scenario import Scenario
from ..scenario.scenario import rules_of_bars
from .schedule import USUAL_KG_M3, Schedule, named_text, row_text


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
        yield f"steel of {kind}", f"{mass_kg:.0f} kg in {volume_m3:.1f} m³ of concrete, {mass_kg / volume_m3:.0f} kg/m³"
        concrete_m3, steel_kg = concrete_m3 + volume_m3, steel_kg + mass_kg
    if concrete_m3:
        yield (
            "steel of all",
            f"{steel_kg:.0f} kg, {steel_kg / concrete_m3:.0f} kg/m³; "
            f"usual in decks are {USUAL_KG_M3[0]} to {USUAL_KG_M3[1]} kg/m³",
        )
