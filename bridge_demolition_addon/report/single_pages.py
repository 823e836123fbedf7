"""Single pages to hand out, made of the blocks of a report: for the client, for the authority, for the crew."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from ..engineering.units import mass_text
from ..model.blast.blast_zones import ELECTRONIC
from ..model.run_folder.files import SINGLE_PAGES
from ..model.scenario import Ball, Scenario
from ..texts import Text, Unit, joined
from .document.blocks import Block, Column, DataTable, Document, Paragraph, facts
from .sections.cover import limits_of
from .wording.verdict import CORDON

CLIENT, AUTHORITY, CREW = SINGLE_PAGES

_AROUND = ("neighbours", "charge_neighbours", "touchdown", "neighbours_of_runs", "zones", "fragments")
"""Tables on what is around the bridge, as far as a report has them."""

_MOST_ROWS = 16
"""Rows of a table that fit on the crew's page beside all else."""

_NOT_FOR_CREW = ("Done to the bridge", "Came down by", "Outcome", "Rests on")
"""Rows of the plan that the verdict says in short, or the planned sequence in full."""

_BLANK = "________"
_LINE_FACTOR, _CRANE_FACTOR = 4.0, 2.0
"""29 CFR 1926.859(b): the ball weighs at most a quarter of the strength of its line, and half of the crane's load."""

_PLANNED = Text(
    "Times and distances are those of a simulation. The blaster and the one in charge of the demolition decide: "
    "this page is no release."
)


@dataclass(frozen=True, slots=True)
class CrewCheck:
    """What the crew has to have done, by a public source, with explosives only or always."""

    what: str
    source: str
    only_with_explosives: bool = False


CHECKS = (
    CrewCheck(Text("Service lines are cut off or protected"), "29 CFR 1926.850(c)"),
    CrewCheck(Text("The exclusion zone is clear of people; guards stand at all ways into it"), "BS 6187:2011, 13"),
    CrewCheck(Text("Traffic is stopped on roads through the zone"), "29 CFR 1926.909", True),
    CrewCheck(Text("Surplus explosives are in a safe place"), "29 CFR 1926.909", True),
    CrewCheck(Text("Warning signal was given"), "29 CFR 1926.909", True),
    CrewCheck(Text("Firing line is disconnected after the blast"), "29 CFR 1926.910(a)", True),
    CrewCheck(Text("Blaster has looked for charges that did not fire"), "29 CFR 1926.910(b)", True),
    CrewCheck(Text("All clear was given"), "29 CFR 1926.909", True),
    CrewCheck(
        Text("Debris is at rest, and what still stands was looked at before anyone goes near"), "29 CFR 1926.859(g)"
    ),
)
"""What the crew ticks, in order of time."""


def single_pages(document: Document, scenario: Scenario | None) -> dict[str, Document]:
    """Return the single pages of a report, by whom they are for."""
    return {
        CLIENT: _page(document, "For the client. {}", iter(document.summary)),
        AUTHORITY: _page(document, "For the authority. {}", _for_authority(document, scenario)),
        CREW: _page(document, "For the crew. {}", _for_crew(document, scenario)),
    }


def _page(document: Document, audience: str, blocks: Iterator[Block]) -> Document:
    control = replace(document.control, cover=(), signatures=())  # the foot says which document it is of
    return Document(document.title, _subtitle(document, audience), (), tuple(blocks), control)


def _subtitle(document: Document, audience: str) -> str:
    return Text(audience, document.subtitle)


def _for_authority(document: Document, scenario: Scenario | None) -> Iterator[Block]:
    """Yield verdict and limits, what is around, what to doubt, and what the model leaves out."""
    verdict, plan, doubts = _first_words(document)
    yield from verdict
    yield from plan
    yield from (table for name in _AROUND if (table := document.table(name)))
    if scenario is None or not scenario.neighbours:
        yield Paragraph("The scenario names no neighbours: vibration and pressure at buildings are not stated.")
    if scenario is None or not scenario.zones:
        yield Paragraph("The scenario names no zones, such as a road that has to stay free.")
    yield DataTable(
        "", "What this does not say", (Column("", "text"),), [(text,) for text in _caveats(document, scenario, doubts)]
    )


def _caveats(document: Document, scenario: Scenario | None, doubts: Sequence[Paragraph]) -> Iterator[str]:
    """Yield what is to be doubted, what the model leaves out, and what the report does not answer."""
    if doubts:
        yield Text("On these results: {}", joined("{} {}", [block.text for block in doubts]))
    yield Text("Not modelled: {}", joined("{} {}", limits_of(scenario)))
    if (contents := document.table("plan_contents")) is not None:
        yield Text(
            "Blank in the contents of the plan: {}.",
            joined("{}, {}", [str(row[0]) for row in contents.rows if row[2] is None]),
        )


def _for_crew(document: Document, scenario: Scenario | None) -> Iterator[Block]:
    """Yield times, distances, what is done afterwards, and what is to be ticked."""
    verdict, plan, _ = _first_words(document)
    yield from verdict
    yield Paragraph(_PLANNED, is_notice=True)
    left_out = (*_NOT_FOR_CREW, CORDON) if _has_cordon(scenario) else _NOT_FOR_CREW  # which people are clear of
    yield from (replace(table, rows=[row for row in table.rows if row[0] not in left_out]) for table in plan)
    if (sequence := document.table("sequence")) is not None:
        yield _shortened(sequence)
    yield facts("Who stands where, and when", list(_safety(scenario, plan)))
    if (misfires := document.table("misfires")) is not None:
        yield _shortened(misfires)
    yield _checklist(scenario)


def _first_words(document: Document) -> tuple[list[Paragraph], list[DataTable], list[Paragraph]]:
    """Return the verdict with what is said before it and the plan from the first page, and what is to be doubted."""
    plan = [block for block in document.summary if isinstance(block, DataTable)]
    ends = document.summary.index(plan[0]) if plan else len(document.summary)
    first, later = document.summary[:ends], document.summary[ends:]
    verdict, doubts = ([block for block in part if isinstance(block, Paragraph)] for part in (first, later))
    return verdict, plan, doubts


def _safety(scenario: Scenario | None, plan: Sequence[DataTable]) -> Iterator[tuple[str, str]]:
    if _has_cordon(scenario):
        yield Text("Clear of people within"), next(row[1] for table in plan for row in table.rows if row[0] == CORDON)
    else:
        yield (
            Text("Clear of people within"),
            Text("{} {} of the bridge's plan: to be filled in by the engineer", _BLANK, Unit("m")),
        )
    yield Text("Guards, and the one who gives the signal"), Text("{}: to be filled in by the one in charge", _BLANK)
    if scenario and scenario.ball:
        yield Text("Crane and line"), _crane_text(scenario.ball)
    if scenario and _has_explosives(scenario):
        kinds = {zone.detonator for zone in scenario.blast_zones} | {cut.detonator for cut in scenario.cuts}
        electronic = ELECTRONIC in kinds
        minutes = "30" if electronic else Text("15, or 30 with a fuse or electronic detonators")
        yield (
            Text("If a charge may not have fired"),
            (
                Text(
                    "wait at least {} minutes, or as long as its maker says (30 CFR 56.6310, of mines); the law "
                    "of the site may ask for more. Only the blaster goes near (29 CFR 1926.911)",
                    minutes,
                )
            ),
        )
    yield Text("No one goes near before"), Text("debris is at rest, and what still stands was looked at")


def _has_cordon(scenario: Scenario | None) -> bool:
    return scenario is not None and scenario.exclusion is not None and scenario.exclusion.cordon_m is not None


def _crane_text(ball: Ball) -> str:
    own, crane, line = (mass_text(factor * ball.mass_kg, 1) for factor in (1.0, _CRANE_FACTOR, _LINE_FACTOR))
    return Text(
        "ball of {}: crane for at least {} with the boom as it is used, line that carries at least {} before it "
        "breaks (29 CFR 1926.859(b))",
        own,
        crane,
        line,
    )


def _checklist(scenario: Scenario | None) -> DataTable:
    """Return what is to be ticked, with blanks."""
    explosives = scenario is None or _has_explosives(scenario)
    columns = tuple(Column(name, name) for name in ("Check", "Source", "Name", "Time"))
    checks = [check for check in CHECKS if explosives or not check.only_with_explosives]
    return DataTable("", "To be ticked", columns, [(check.what, check.source, _BLANK, _BLANK) for check in checks])


def _has_explosives(scenario: Scenario) -> bool:
    return bool(scenario.charges or scenario.blast_zones or scenario.cuts)


def _shortened(table: DataTable) -> DataTable:
    """Return a table that fits on the page, and says how many of its rows are in the report alone."""
    left = len(table.rows) - _MOST_ROWS
    if left <= 0:
        return table
    title = Text("{}: the first {}; {} more are in the report", table.title, _MOST_ROWS, left)
    return replace(table, title=title, rows=table.rows[:_MOST_ROWS])
