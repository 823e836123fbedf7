"""Bars and tendons in a report: as designed, how far cracks used the bars, and the energy that tendons let go."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import partial

from ...charts.reinforced_sections import draw_sections, sections_to_draw
from ...engineering.reinforced_concrete.materials import (
    CONCRETE_FACTOR,
    PERMANENT_FACTOR,
    STEEL_FACTOR,
    VARIABLE_FACTOR,
)
from ...errors import DemolitionError, text_of
from ...model.bridge.member import Member
from ...model.bridge.preparation import prepared_members
from ...model.reinforcement.concrete_members import plain_concrete_text
from ...model.reinforcement.design import bar_schedule
from ...model.reinforcement.schedule import Schedule, ScheduledBars, ScheduledLinks, named_text, steel_facts
from ...model.results.records import BarsOfKind, TendonOfRun
from ...model.scenario import BridgeReinforcement, Scenario
from ...model.scenario.scenario import rules_of_bars
from ...texts import Quantity, Text, joined
from ..document.blocks import Block, Column, DataTable, Paragraph, Picture, Section, facts
from ..run_folder import ReportedRun

_HEIGHT_MM = 130.0

_COLUMNS = (
    Column("Members", "members"),
    Column("Bars", "side"),
    Column("along", "along"),
    Column("from", "from_m", ".1f"),
    Column("to", "to_m", ".1f"),
    Column("below the side", "depth_mm", ".0f"),
    Column("area", "area_mm2", ".0f", unit="mm²"),
    Column("area of links", "area_of_links_mm2_m", ".0f", unit="mm²/m"),
    Column("choice", "choice"),
    Column("of the section", "ratio_percent", ".2f"),
    Column("used", "used_percent", ".0f"),
    Column("for", "for"),
)

_NOTES = Text(
    "Used: area that the design requires by the area of the bars. Bars run along the whole of a member, or "
    "between two positions; laps, hooks and bars that detailing adds are not in it. Fatigue, widths of cracks, "
    "punching and torsion are not designed for."
)


def reinforcement_section(scenario: Scenario) -> Section | None:
    """Return the section; None where all members have bars by hand, are no concrete, or have none on purpose."""
    plain = plain_concrete_text(scenario)
    blocks: list[Block] = [Paragraph(Text("{}.", Text(plain).capital), is_notice=True)] if plain else []
    if rules_of_bars(scenario):
        try:
            members = prepared_members(scenario).members
            blocks += _schedule_blocks(scenario, members, bar_schedule(scenario, members))
        except (DemolitionError, OSError) as error:  # of the ground, whose file may be elsewhere by now
            blocks.append(
                Paragraph(Text("The schedule of bars cannot be made again: {}", text_of(error)), is_notice=True)
            )
    return Section("Reinforcement", tuple(blocks)) if blocks else None


def _schedule_blocks(scenario: Scenario, members: Sequence[Member], schedule: Schedule) -> Iterator[Block]:
    for rule in rules_of_bars(scenario):
        bars = rule.described, rule.steel, Quantity(1e3 * rule.cover_m, "mm", "g")
        if isinstance(rule, BridgeReinforcement) and not rule.is_designed:
            yield Paragraph(Text("Bars by {}, of {} with {} of cover.", *bars))
        else:
            factors = (f"{each:g}" for each in (PERMANENT_FACTOR, VARIABLE_FACTOR, CONCRETE_FACTOR, STEEL_FACTOR))
            designed = (
                "Bars by {}, of {} with {} of cover. Designed by EN 1992-1-1 with {} G + {} Q, γ_c = {}, γ_s = "
                "{}; elastic moments, traffic at its worst."
            )
            yield Paragraph(Text(designed, *bars, *factors))
    yield DataTable("reinforcement", "Schedule of bars", _COLUMNS, [_row(row) for row in schedule.rows])
    yield facts("Steel", list(steel_facts(members, schedule)))
    yield Paragraph(_NOTES)
    for note in schedule.notes:
        yield Paragraph(Text("{}.", Text(note).capital))
    if sections := sections_to_draw(members, schedule):
        caption = Text(
            "Sections square to the axis of members, bars as large as they are: red across, blue in the section."
        )
        yield Picture(partial(draw_sections, sections=sections, schedule=schedule), caption, _HEIGHT_MM)


def _row(row: ScheduledBars | ScheduledLinks) -> tuple[str | float | None, ...]:
    numbers = 100.0 * row.ratio, 100.0 * row.utilisation
    if isinstance(row, ScheduledBars):
        layer = row.layer
        depth = None if layer.depth_m is None else 1e3 * layer.depth_m
        side = Text("spread" if layer.is_spread else layer.side)
        shown: tuple[str | float | None, ...] = (
            side,
            Text(layer.along),
            layer.from_m,
            layer.to_m,
            depth,
            1e6 * row.area_m2,
            None,
        )
    else:
        shown = Text("links"), "", None, None, None, None, row.link_area_mm2_per_m
    return named_text(row), *shown, row.bars_text, *numbers, Text(row.reason)


_BAR_NOTES = Text(
    "Ruptured are cracks that all their bars let go, in part those that some did: of a hinge that folds, bars at the "
    "closed edge stay. How far bars are from their rupture is not given: under an impact it depends on the length of "
    "sub-steps. Cracks at work are in bar_log.csv, frame by frame."
)


def bar_blocks(run: ReportedRun) -> list[Block]:
    """Return a table of bars by kind of member; none without reinforcement across elastic connections."""
    bars = run.summary.reinforcement if run.summary else None
    if not bars:
        return []
    if not bars.cracked:
        return [Paragraph(Text("None of the {} connections with bars cracked.", bars.with_bars))]
    return [_by_kind(bars.by_kind), Paragraph(_BAR_NOTES)]


def _by_kind(kinds: Sequence[BarsOfKind]) -> DataTable:
    columns = (
        Column("member", "member_kind", "", lambda kind: Text(kind.kind)),
        Column("cracked", "cracked", "", lambda kind: kind.cracked),
        Column("yielded", "yielded", "", lambda kind: kind.yielded),
        Column("ruptured", "ruptured", "", lambda kind: kind.ruptured),
        Column("in part", "ruptured_in_part", "", lambda kind: kind.ruptured_in_part),
        Column("held at the end", "held_at_end", "", lambda kind: kind.held_at_end),
    )
    return DataTable.of("cracked_connections", "Cracked connections with bars, by kind of member", columns, kinds)


_KILO = 1000.0

_DANGER = Text(
    "Energy of tendons is let go at once and hurts people: strands and anchorages fly out along the line of a "
    "tendon. Keep everybody off that line and away from both anchorages from before a cut until all of them are "
    "known to be without force. How far parts fly is not simulated."
)

_TENDON_COLUMNS = (
    Column("Tendon", "tendon", "", lambda tendon: tendon.name),
    Column("in", "member", "", lambda tendon: tendon.member),
    Column("force", "force_kN", ".0f", lambda tendon: tendon.force_n / _KILO),
    Column("energy", "stored_kJ", ".1f", lambda tendon: tendon.stored_j / _KILO),
    Column(Text("let go", context="energy"), "released_kJ", ".1f", lambda tendon: _released_j(tendon) / _KILO),
    Column("at", "first_s", ".3f", lambda tendon: tendon.released[0].time_s if tendon.released else None),
    Column("how", "how", "", lambda tendon: _how(tendon)),
)


def tendon_section(run: ReportedRun) -> Section | None:
    """Return the section; None without tendons."""
    tendons = run.summary.tendons if run.summary else ()
    if not tendons:
        return None
    table = DataTable.of("tendons", "Tendons, and the energy that they let go in this run", _TENDON_COLUMNS, tendons)
    return Section("Tendons", (Paragraph(_DANGER, is_notice=True), table))


def _how(tendon: TendonOfRun) -> str:
    return joined("{}, {}", [Text(how) for how in dict.fromkeys(part.how for part in tendon.released)])


def _released_j(tendon: TendonOfRun) -> float:
    return math.fsum(part.energy_j for part in tendon.released)
