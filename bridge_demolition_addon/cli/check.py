"""``bda check``: print what follows from a scenario, without running it."""

import argparse
from collections.abc import Iterable, Iterator

from ..model.actions import Fact, PlannedAction
from ..model.bridge.layout import bridge_facts
from ..model.bridge.member import member_facts
from ..model.bridge.preparation import prepared_members
from ..model.reinforcement.design import bar_schedule
from ..model.reinforcement.facts import schedule_facts
from ..model.scenario import BlastZone, Charge, Scenario
from ..model.scenario.contact_facts import contact_facts
from ..model.scenario.file import read_scenario
from ..model.scenario.scenario import bars_by_rule
from ..model.sequence.checked_model import ModelWorksite, checked_model
from ..model.sequence.undisturbed import asleep_text
from ..model.stages.stages import equipment_facts
from ..model.stages.standing import made_elastic
from ..model.structure.blast_zones import placed_zones, zone_totals
from ..model.structure.facts import accuracy_facts, connection_facts, foundation_facts, overlap_facts, rest_facts
from ..model.structure.model import Model
from ..model.terrain.built import terrain_facts
from .arguments import naming


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser("check", help="read a scenario and say what follows from it", allow_abbrev=False)
    parser.add_argument("scenario", metavar="SCENARIO.toml", help="scenario file, see docs/scenario.md")
    parser.add_argument(
        "--stand",
        action="store_true",
        help="say how the bridge stands under its own weight, as with elastic connections, also where they are rigid",
    )
    parser.set_defaults(execute=check)


def check(arguments: argparse.Namespace) -> None:
    """Print what a planner wants to know before a run."""
    scenario = read_scenario(arguments.scenario)
    with naming(arguments.scenario):
        for line in scenario_facts(scenario, stand=arguments.stand):
            print(line)


def scenario_facts(scenario: Scenario, *, stand: bool = False) -> Iterator[str]:
    """Yield lines on a scenario's bridge, time steps, connections, contacts, ball, sequence and charges.

    With `stand` they say how a bridge with rigid connections would stand if these were elastic.
    """
    as_elastic = made_elastic(scenario) if stand else scenario  # refused before anything is said
    yield scenario.title
    prepared = prepared_members(scenario)
    if scenario.bridge:
        yield from _section("Bridge", bridge_facts(scenario.bridge, is_flat=scenario.has_flat_ground))
    yield from _section("Members", member_facts(prepared.members))
    if prepared.notes:
        yield from _section("Repaired", (note.partition(": ")[::2] for note in prepared.notes))
    if bars_by_rule(scenario):
        schedule = bar_schedule(scenario, prepared.members)
        yield from _section("Reinforcement", schedule_facts(scenario, prepared.members, schedule))
    yield from _section("Time", scenario.time.facts(scenario.timeline))
    model = checked_model(scenario, prepared.members)
    if not model.ground.is_plain:
        yield from _section("Ground", terrain_facts(model.ground))
    yield from _section("Shards and connections", connection_facts(scenario, model))
    if asleep := asleep_text(scenario):
        yield from _section("At first", [("asleep", asleep)])
    yield from _section("Contacts", contact_facts(scenario))
    if stand and model.stiffness is None:
        elastic = checked_model(as_elastic, prepared.members)
        yield from _section("At rest", rest_facts(scenario, elastic))
        yield from _section("Fineness", accuracy_facts(scenario, elastic))
    elif model.stiffness is not None:
        yield from _section("At rest", rest_facts(scenario, model))
        yield from _section("Fineness", accuracy_facts(scenario, model))
    yield from _section("Overlap at the start", overlap_facts(model))
    if model.soil:
        yield from _section("Foundations", foundation_facts(scenario, model))
    for heading, facts in _action_facts(scenario, model).items():
        yield from _section(heading, facts)
    if scenario.equipment:
        yield from _section("Equipment", equipment_facts(scenario, model))
    if not scenario.actions:
        yield from _section(
            "Sequence", [("nothing", "is done to the bridge: add [ball], [[charges]] or another action")]
        )
    if reason := scenario.pictures.why_not_without_window:
        yield from _section("Pictures", [("none can be taken", reason)])


def _action_facts(scenario: Scenario, model: Model) -> dict[str, list[Fact]]:
    """Return what all planned actions say of themselves, by section."""
    site = ModelWorksite(scenario, model)
    sections: dict[str, list[tuple[float, list[Fact]]]] = {}
    for action in scenario.actions:
        described = action.begins_s(scenario), list(action.facts(site))
        sections.setdefault(action.heading, []).append(described)
    sections.get(PlannedAction.heading, []).sort()
    lines = {heading: [fact for _, facts in parts for fact in facts] for heading, parts in sections.items()}
    if scenario.blast_zones:
        lines[BlastZone.heading] += zone_totals(placed_zones(scenario, model.members), model.members)
    if scenario.charges:
        lines[Charge.heading] += scenario.blast.facts(scenario.charges, scenario.fracture.shards)
    return lines


def _section(heading: str, facts: Iterable[Fact]) -> Iterator[str]:
    yield ""
    yield heading
    for name, value in facts:
        yield f"  {name:<23} {value}"
