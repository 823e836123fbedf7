"""Contents of a demolition plan: what authorities and standards ask for, and where a report answers it.

Items and their sources are facts from public tables of contents, abstracts and laws. The text of standards that are
sold is not quoted, nor is the checklist of ASCE MOP 157, which was not at hand.
"""

from __future__ import annotations

from collections.abc import Container, Sequence
from dataclasses import dataclass, replace

from ...model.scenario import Scenario
from ..document.blocks import Column, DataTable, Document, Paragraph, Photo, Picture, Section

TITLE = "Contents of a demolition plan"

EXPLOSIVES, BALL = "explosives", "ball"
"""Means that an item is asked for with; others are always asked for."""

MOP_157 = "ASCE MOP 157"
BS_6187 = "BS 6187:2011"
DIN_18007 = "DIN 18007"
DGUV = "DGUV Regel 101-603, 5.2"
SPRENGV = "3. SprengV, § 1"
HONG_KONG = "Hong Kong CoP 2004"

_WORDS = (
    "What public sources ask a demolition plan to contain, and where this report says something about it. What it "
    "cannot say is left blank for those who are named. Clauses are named by their titles; what a law, a contract or "
    "the text of a standard asks for beyond that is for the engineer to find out. Hong Kong CoP 2004 is the Code of "
    "Practice for Demolition of Buildings; 3. SprengV is the third ordinance of the German law on explosives."
)
_BLANK = "________"


@dataclass(frozen=True, slots=True)
class PlanItem:
    """An item that a plan contains: where it is asked for, titles of sections that answer it, and who fills in what."""

    name: str
    sources: tuple[str, ...]
    sections: tuple[str, ...]
    by: str
    left: str  # what is to be filled in
    means: str = ""  # that it is asked for with; always where empty


PLAN_ITEMS = (
    PlanItem(
        "Roles and responsibilities", (f"{MOP_157}, 1.2 Roles and Responsibilities",), (), "client", "names, duties"
    ),
    PlanItem(
        "Permits and notices",
        (DGUV, "HSE, Demolition: notice to the local authority"),
        (),
        "contractor",
        "numbers and dates of permits",
    ),
    PlanItem("Notice of the blasting", (SPRENGV,), ("Charge plan", "Blast"), "blaster", "licence, date", EXPLOSIVES),
    PlanItem(
        "Survey of the structure and its condition",
        ("29 CFR 1926.850(a) engineering survey", f"{BS_6187}, 7 Knowledge of the site"),
        ("Reinforcement",),
        "engineer",
        "drawings, alterations, damage, what was measured on site",
    ),
    PlanItem(
        "Method, and why it was chosen",
        (f"{MOP_157}, 1.3 Choosing the Right Demolition Method", f"{DIN_18007}: methods and where they apply"),
        ("Planned sequence",),
        "engineer",
        "reasons",
    ),
    PlanItem(
        "Sequence of the work",
        (f"{HONG_KONG}, 2.1.3 Demolition Plan", "CDM 2015, regulation 20: arrangements in writing"),
        ("Planned sequence", "Stages"),
        "contractor",
        "work before and after",
    ),
    PlanItem(
        "Stability in each stage",
        (f"{BS_6187}, 15 Avoidance of unplanned structural collapses", f"{HONG_KONG}, 2.1.3 Stability Report"),
        ("Stages",),
        "engineer",
        "check by hand, name",
    ),
    PlanItem(
        "Temporary supports",
        (f"{BS_6187}, 16 Temporary structures for stability, support and access",),
        (),
        "engineer",
        "design",
    ),
    PlanItem(
        "Machines on the bridge and their loads",
        (f"{MOP_157}: equipment and tools; loads",),
        ("Planned sequence", "Stages"),
        "contractor",
        "types and masses of machines",
    ),
    PlanItem(
        "Crane and line of the ball",
        ("29 CFR 1926.859(b) mechanical demolition",),
        ("Planned sequence",),
        "contractor",
        "rated load of the crane, breaking strength of the line",
        BALL,
    ),
    PlanItem(
        "Course of the collapse, and where debris lies",
        (f"{BS_6187}, 14 Structural demolition: principles, mechanisms and hazards",),
        ("Findings", "Collapse", "Debris", "Tendons", "Pulls", "What this study says", "How far debris gets"),
        "engineer",
        "judgement of the forecast",
    ),
    PlanItem(
        "Exclusion zone: plan area, designed drop, predicted debris, buffer",
        (f"{BS_6187}, 13 Safe working spaces and exclusion zones",),
        ("Exclusion zone of one run", "Plan"),
        "engineer",
        "width of the buffer and its reasons; who guards the zone",
    ),
    PlanItem(
        "Flying fragments",
        (f"{DIN_18007}, Annex D flying fragments", SPRENGV),
        ("Charge plan", "How far fragments fly"),
        "blaster",
        "cover, test shots",
        EXPLOSIVES,
    ),
    PlanItem(
        "Charges, delays, largest charge per delay",
        (SPRENGV, f"{MOP_157}: demolition with explosives"),
        ("Charge plan", "Blast"),
        "blaster",
        "test shots, firing circuit",
        EXPLOSIVES,
    ),
    PlanItem(
        "Vibration of the ground",
        (f"{DIN_18007}, Annex A vibration", SPRENGV),
        ("Shaking of the ground by the fall", "Charge plan", "Blast", "Neighbours"),
        "engineer",
        "limits of each building, measurements",
    ),
    PlanItem(
        "Air pressure and noise",
        (f"{DIN_18007}, Annex B noise", SPRENGV),
        ("Blast", "Charge plan", "Neighbours"),
        "contractor",
        "noise of machines",
    ),
    PlanItem("Dust", (f"{DIN_18007}, Annex C dust",), (), "contractor", "measures"),
    PlanItem("Water", (f"{DIN_18007}, Annex E water",), (), "contractor", "measures"),
    PlanItem(
        "Neighbouring structures",
        ("29 CFR 1926.850(a) adjacent structures", f"{SPRENGV} site plan", f"{HONG_KONG}, 2.1.3 Demolition Plan"),
        ("Shaking of the ground by the fall", "Charge plan", "Blast", "Neighbours"),
        "engineer",
        "their condition before",
    ),
    PlanItem(
        "Service lines",
        ("29 CFR 1926.850(c) service lines", DGUV),
        (),
        "owners of the lines",
        "cut off or protected, date",
    ),
    PlanItem(
        "Hazardous substances",
        ("29 CFR 1926.850(e) hazardous substances", f"{BS_6187}, 10 Health hazards"),
        (),
        "surveyor",
        "findings, removal",
    ),
    PlanItem(
        "Traffic and the public",
        (f"{MOP_157}, 1.5 Ensuring Public Safety", f"{BS_6187}, 12 Protection of people and the environment"),
        ("Debris", "Plan"),
        "authority",
        "closures, times",
    ),
    PlanItem(
        "Signals, guards and all clear",
        ("29 CFR 1926.909 firing the blast",),
        (),
        "blaster",
        "signals, names of guards",
        EXPLOSIVES,
    ),
    PlanItem(
        "Inspection afterwards, and misfires",
        ("29 CFR 1926.910 inspection after blasting", "29 CFR 1926.911 misfires"),
        ("Stages",),
        "blaster",
        "waiting time, who inspects",
        EXPLOSIVES,
    ),
    PlanItem(
        "Emergencies",
        (f"{BS_6187}, 11 Health and safety of people on or off site",),
        (),
        "contractor",
        "rescue, first aid, telephone numbers",
    ),
    PlanItem("Competence", (f"{BS_6187}, Annex A Training and competencies",), (), "contractor", "evidence"),
    PlanItem(
        "Material, its masses and where it goes",
        (f"{BS_6187}, 18 Materials handling and processing",),
        ("The run", "Reinforcement"),
        "contractor",
        "breaking up, transport, disposal",
    ),
    PlanItem("Completion", (f"{BS_6187}, 20 Completion of the works",), (), "contractor", "hand-over of the site"),
    PlanItem(
        "Assumptions, and limits of the calculation",
        (f"{MOP_157}, 1.4 Engineering Analysis Considerations",),
        ("What is modelled, and how far to trust it",),
        "engineer",
        "independent check: name, date",
    ),
)
"""What a demolition plan contains, in the order of a plan."""

_COLUMNS = (
    Column("Item", "item"),
    Column("Asked for in", "asked_for_in", cites=True),
    Column("In this report", "in_this_report"),
    Column("To be filled in by", "to_be_filled_in_by"),
)


def with_plan_contents(document: Document, scenario: Scenario | None, before: str = "") -> Document:
    """Return a report with this section: before the one of a title, or at its end."""
    titles = [section.title for section in document.sections]
    place = titles.index(before) if before in titles else len(titles)
    titles.insert(place, TITLE)
    section = _section(titles, {section.title for section in document.sections if _says_something(section)}, scenario)
    return replace(document, sections=(*document.sections[:place], section, *document.sections[place:]))


def asked_items(scenario: Scenario | None) -> list[PlanItem]:
    """Return the items that are asked for with the means of a scenario; all where it is not known."""
    if scenario is None:
        return list(PLAN_ITEMS)
    used = {
        "": True,
        BALL: scenario.ball is not None,
        EXPLOSIVES: bool(scenario.charges or scenario.blast_zones or scenario.cuts),
    }
    return [item for item in PLAN_ITEMS if used[item.means]]


def _says_something(section: Section) -> bool:
    """Return whether a section has a table or a picture, and not only words on what is missing."""
    return any(isinstance(block, DataTable | Picture | Photo) for block in section.blocks)


def _section(titles: Sequence[str], telling: Container[str], scenario: Scenario | None) -> Section:
    rows = [
        (item.name, "; ".join(item.sources), _answered(item, titles, telling), f"{item.by}: {item.left} {_BLANK}")
        for item in asked_items(scenario)
    ]
    table = DataTable("plan_contents", "Items of the plan", _COLUMNS, rows)
    return Section(TITLE, (Paragraph(_WORDS), table))


def _answered(item: PlanItem, titles: Sequence[str], telling: Container[str]) -> str | None:
    """Return the numbers and titles of the sections that answer an item; None where there is none."""
    there = [f"{titles.index(title) + 1} {title}" for title in item.sections if title in titles and title in telling]
    return "; ".join(there) or None
