"""Contents of a demolition plan: what authorities and standards ask for, and where a report answers it.

Items and their sources are facts from public tables of contents, abstracts and laws. The text of standards that are
sold is not quoted, nor is the checklist of ASCE MOP 157, which was not at hand.
"""

from __future__ import annotations

from collections.abc import Container, Sequence
from dataclasses import dataclass, replace

from ...model.scenario import Scenario
from ...texts import Text, joined
from ..document.blocks import Column, DataTable, Document, Paragraph, Photo, Picture, Section

TITLE = Text("Contents of a demolition plan")

EXPLOSIVES, BALL = "explosives", Text("ball")
"""Means that an item is asked for with; others are always asked for."""

MOP_157 = "ASCE MOP 157"
BS_6187 = "BS 6187:2011"
DIN_18007 = "DIN 18007"
DGUV = "DGUV Regel 101-603, 5.2"
SPRENGV = "3. SprengV, § 1"
HONG_KONG = "Hong Kong CoP 2004"

_WORDS = Text(
    "What public sources ask a demolition plan to contain, and where this report says something about it. What it "
    "cannot say is left blank for those who are named. Clauses are named by their titles; what a law, a contract "
    "or the text of a standard asks for beyond that is for the engineer to find out. Hong Kong CoP 2004 is the "
    "Code of Practice for Demolition of Buildings; 3. SprengV is the third ordinance of the German law on "
    "explosives."
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
        Text("Roles and responsibilities"),
        (f"{MOP_157}, 1.2 Roles and Responsibilities",),
        (),
        Text("client"),
        Text("names, duties"),
    ),
    PlanItem(
        Text("Permits and notices"),
        (DGUV, "HSE, Demolition: notice to the local authority"),
        (),
        Text("contractor"),
        Text("numbers and dates of permits"),
    ),
    PlanItem(
        Text("Notice of the blasting"),
        (SPRENGV,),
        (Text("Charge plan"), Text("Blast")),
        Text("blaster"),
        Text("licence, date"),
        EXPLOSIVES,
    ),
    PlanItem(
        Text("Survey of the structure and its condition"),
        ("29 CFR 1926.850(a) engineering survey", f"{BS_6187}, 7 Knowledge of the site"),
        (Text("Reinforcement"),),
        Text("engineer"),
        Text("drawings, alterations, damage, what was measured on site"),
    ),
    PlanItem(
        Text("Method, and why it was chosen"),
        (f"{MOP_157}, 1.3 Choosing the Right Demolition Method", f"{DIN_18007}: methods and where they apply"),
        (Text("Planned sequence"),),
        Text("engineer"),
        Text("reasons"),
    ),
    PlanItem(
        Text("Sequence of the work"),
        (f"{HONG_KONG}, 2.1.3 Demolition Plan", "CDM 2015, regulation 20: arrangements in writing"),
        (Text("Planned sequence"), Text("Stages")),
        Text("contractor"),
        Text("work before and after"),
    ),
    PlanItem(
        Text("Stability in each stage"),
        (f"{BS_6187}, 15 Avoidance of unplanned structural collapses", f"{HONG_KONG}, 2.1.3 Stability Report"),
        (Text("Stages"),),
        Text("engineer"),
        Text("check by hand, name"),
    ),
    PlanItem(
        Text("Temporary supports"),
        (f"{BS_6187}, 16 Temporary structures for stability, support and access",),
        (),
        Text("engineer"),
        Text("design"),
    ),
    PlanItem(
        Text("Machines on the bridge and their loads"),
        (f"{MOP_157}: equipment and tools; loads",),
        (Text("Planned sequence"), Text("Stages")),
        Text("contractor"),
        Text("types and masses of machines"),
    ),
    PlanItem(
        Text("Crane and line of the ball"),
        ("29 CFR 1926.859(b) mechanical demolition",),
        (Text("Planned sequence"),),
        Text("contractor"),
        Text("rated load of the crane, breaking strength of the line"),
        BALL,
    ),
    PlanItem(
        Text("Course of the collapse, and where debris lies"),
        (f"{BS_6187}, 14 Structural demolition: principles, mechanisms and hazards",),
        (
            Text("Findings"),
            Text("Collapse"),
            Text("Debris"),
            Text("Tendons"),
            Text("Pulls"),
            Text("What this study says"),
            Text("How far debris gets"),
        ),
        Text("engineer"),
        Text("judgement of the forecast"),
    ),
    PlanItem(
        Text("Exclusion zone: plan area, designed drop, predicted debris, buffer"),
        (f"{BS_6187}, 13 Safe working spaces and exclusion zones",),
        (Text("Exclusion zone of one run"), Text("Plan")),
        Text("engineer"),
        Text("width of the buffer and its reasons; who guards the zone"),
    ),
    PlanItem(
        Text("Flying fragments"),
        (f"{DIN_18007}, Annex D flying fragments", SPRENGV),
        (Text("Charge plan"), Text("How far fragments fly")),
        Text("blaster"),
        Text("cover, test shots"),
        EXPLOSIVES,
    ),
    PlanItem(
        Text("Charges, delays, largest charge per delay"),
        (SPRENGV, f"{MOP_157}: demolition with explosives"),
        (Text("Charge plan"), Text("Blast")),
        Text("blaster"),
        Text("test shots, firing circuit"),
        EXPLOSIVES,
    ),
    PlanItem(
        Text("Vibration of the ground"),
        (f"{DIN_18007}, Annex A vibration", SPRENGV),
        (Text("Shaking of the ground by the fall"), Text("Charge plan"), Text("Blast"), Text("Neighbours")),
        Text("engineer"),
        Text("limits of each building, measurements"),
    ),
    PlanItem(
        Text("Air pressure and noise"),
        (f"{DIN_18007}, Annex B noise", SPRENGV),
        (Text("Blast"), Text("Charge plan"), Text("Neighbours")),
        Text("contractor"),
        Text("noise of machines"),
    ),
    PlanItem(Text("Dust"), (f"{DIN_18007}, Annex C dust",), (), Text("contractor"), Text("measures")),
    PlanItem(Text("Water"), (f"{DIN_18007}, Annex E water",), (), Text("contractor"), Text("measures")),
    PlanItem(
        Text("Neighbouring structures"),
        ("29 CFR 1926.850(a) adjacent structures", f"{SPRENGV} site plan", f"{HONG_KONG}, 2.1.3 Demolition Plan"),
        (Text("Shaking of the ground by the fall"), Text("Charge plan"), Text("Blast"), Text("Neighbours")),
        Text("engineer"),
        Text("their condition before"),
    ),
    PlanItem(
        Text("Service lines"),
        ("29 CFR 1926.850(c) service lines", DGUV),
        (),
        Text("owners of the lines"),
        Text("cut off or protected, date"),
    ),
    PlanItem(
        Text("Hazardous substances"),
        ("29 CFR 1926.850(e) hazardous substances", f"{BS_6187}, 10 Health hazards"),
        (),
        Text("surveyor"),
        Text("findings, removal"),
    ),
    PlanItem(
        Text("Traffic and the public"),
        (f"{MOP_157}, 1.5 Ensuring Public Safety", f"{BS_6187}, 12 Protection of people and the environment"),
        (Text("Debris"), Text("Plan")),
        Text("authority"),
        Text("closures, times"),
    ),
    PlanItem(
        Text("Signals, guards and all clear"),
        ("29 CFR 1926.909 firing the blast",),
        (),
        Text("blaster"),
        Text("signals, names of guards"),
        EXPLOSIVES,
    ),
    PlanItem(
        Text("Inspection afterwards, and misfires"),
        ("29 CFR 1926.910 inspection after blasting", "29 CFR 1926.911 misfires"),
        (Text("Stages"),),
        Text("blaster"),
        Text("waiting time, who inspects"),
        EXPLOSIVES,
    ),
    PlanItem(
        Text("Emergencies"),
        (f"{BS_6187}, 11 Health and safety of people on or off site",),
        (),
        Text("contractor"),
        Text("rescue, first aid, telephone numbers"),
    ),
    PlanItem(
        Text("Competence"), (f"{BS_6187}, Annex A Training and competencies",), (), Text("contractor"), Text("evidence")
    ),
    PlanItem(
        Text("Material, its masses and where it goes"),
        (f"{BS_6187}, 18 Materials handling and processing",),
        (Text("The run"), Text("Reinforcement")),
        Text("contractor"),
        Text("breaking up, transport, disposal"),
    ),
    PlanItem(
        Text("Completion"),
        (f"{BS_6187}, 20 Completion of the works",),
        (),
        Text("contractor"),
        Text("hand-over of the site"),
    ),
    PlanItem(
        Text("Assumptions, and limits of the calculation"),
        (f"{MOP_157}, 1.4 Engineering Analysis Considerations",),
        (Text("What is modelled, and how far to trust it"),),
        Text("engineer"),
        Text("independent check: name, date"),
    ),
)
"""What a demolition plan contains, in the order of a plan."""

_COLUMNS = (
    Column("Item", "item"),
    Column("Asked for in", "asked_for_in"),
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
        (
            item.name,
            "; ".join(item.sources),
            _answered(item, titles, telling),
            Text("{}: {} {}", item.by, item.left, _BLANK),
        )
        for item in asked_items(scenario)
    ]
    table = DataTable("plan_contents", "Items of the plan", _COLUMNS, rows)
    return Section(TITLE, (Paragraph(_WORDS), table))


def _answered(item: PlanItem, titles: Sequence[str], telling: Container[str]) -> str | None:
    """Return the numbers and titles of the sections that answer an item; None where there is none."""
    there = [
        Text("{} {}", titles.index(title) + 1, Text(title))
        for title in item.sections
        if title in titles and title in telling
    ]
    return joined("{}; {}", there) or None
