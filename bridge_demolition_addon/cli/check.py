"""``bda check``: print what follows from a scenario, without running it."""

import argparse
import sys
import time
from collections.abc import Iterable, Iterator

from ..model.actions import Fact, PlannedAction
from ..model.bridge.layout import bridge_facts
from ..model.bridge.member import mass_facts, member_facts
from ..model.bridge.preparation import prepared_members
from ..model.reinforcement.design import bar_schedule
from ..model.reinforcement.schedule import schedule_facts
from ..model.results.moving import moving_text
from ..model.results.stability import ZoneLoad
from ..model.scenario import BlastZone, Charge, Scenario
from ..model.scenario.contact_facts import contact_facts
from ..model.scenario.file import read_scenario
from ..model.scenario.scenario import rules_of_bars
from ..model.sequence.checked_model import ModelWorksite, checked_model
from ..model.sequence.ending import AWAKE_S, self_collapse_text
from ..model.stages.stability import stability_of
from ..model.stages.stages import count_of_stages, equipment_facts
from ..model.stages.standing import made_elastic
from ..model.structure.bearing_ranges import LEAST_CUTS, MOST_CUTS, bearing_ranges
from ..model.structure.blast_zones import placed_zones, zone_totals
from ..model.structure.charge_plan import fired_rows
from ..model.structure.cracking import RestingModel
from ..model.structure.dead_loads import dead_load_facts
from ..model.structure.facts import (
    accuracy_facts,
    connection_facts,
    convergence_facts,
    deck_facts,
    foundation_facts,
    overlap_facts,
    reaction_facts,
    rest_facts,
)
from ..model.structure.firing_order import firing_facts
from ..model.structure.model import Model, build_model
from ..model.structure.steel_bars import steel_facts
from ..model.structure.tendons import tendon_facts
from ..model.terrain.built import terrain_facts
from ..studies.estimate import (
    FACTOR,
    disk_megabytes,
    duration_text,
    megabytes_by_size,
    seconds_by_size,
    seconds_of_stages,
)
from ..system.progress import Progress
from .arguments import naming
from .console import simulation_module
from .progress import StepsOfLongWork

_STEPS = 3
"""Of `scenario_facts`."""


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser("check", allow_abbrev=False)
    parser.add_argument("scenario", metavar="SCENARIO.toml", help="scenario file, see docs/scenario.md")
    parser.add_argument(
        "--stand",
        action="store_true",
        help="say how the bridge stands under its own weight, as with elastic connections, also where they are rigid",
    )
    parser.add_argument(
        "--awake",
        action="store_true",
        help=f"run the bridge awake for {AWAKE_S:g} s without anything that is done to it, and say whether it stood",
    )
    parser.add_argument(
        "--cuts",
        type=_cuts,
        metavar="NUMBER",
        help=f"cut the bridge by so many seeds, {LEAST_CUTS} to {MOST_CUTS}, and say what each bearing carries in them",
    )
    parser.set_defaults(execute=check)


def check(arguments: argparse.Namespace) -> None:
    """Print what a planner wants to know before a run."""
    scenario = read_scenario(arguments.scenario)
    steps = _STEPS + bool(arguments.cuts) + arguments.awake
    with naming(arguments.scenario), StepsOfLongWork(sys.stderr, steps) as progress:
        for line in scenario_facts(scenario, stand=arguments.stand, progress=progress):
            print(line)
        if arguments.cuts:
            progress.stage(f"cuts the bridge {arguments.cuts} times, and works out how it stands each time")
            for line in _cut_lines(scenario, arguments.cuts):
                print(line)
        if arguments.awake:
            progress.stage(f"runs the bridge for {AWAKE_S:g} s without what is done to it")
            for line in _section("Awake", _awake_facts(scenario)):
                print(line)


def _cuts(text: str) -> int:
    """Return a number of cuts that can be compared."""
    if not text.isdecimal() or not LEAST_CUTS <= int(text) <= MOST_CUTS:
        raise argparse.ArgumentTypeError(f"{text!r} is wrong: expected a whole number from {LEAST_CUTS} to {MOST_CUTS}")
    return int(text)


def _cut_lines(scenario: Scenario, count: int) -> Iterator[str]:
    """Yield what bearings carry in several cuts, as with elastic connections."""
    elastic = made_elastic(scenario)
    ranges = bearing_ranges(elastic, build_model(elastic), count)
    yield from _section(f"Bearings in {count} cuts, seeds {ranges.seeds[0]} to {ranges.seeds[-1]}", ranges.facts())


def scenario_facts(scenario: Scenario, *, stand: bool = False, progress: Progress | None = None) -> Iterator[str]:
    """Yield lines on a scenario's bridge, time steps, connections, contacts, ball, sequence and charges.

    With `stand` they say how a bridge with rigid connections would stand if these were elastic.
    """
    as_elastic = made_elastic(scenario) if stand else scenario  # refused before anything is said
    progress = progress or Progress()
    yield scenario.title
    began_s = time.monotonic()
    progress.stage("cuts the bridge into shards")
    prepared = prepared_members(scenario)
    model = checked_model(scenario, prepared.members)
    # As long as the cut at most for bridges of 100 to 200 shards that do not crack.
    likely_s = max(1.0, time.monotonic() - began_s)
    progress.stage(f"works out how it stands: about {likely_s:.0f} s, minutes where much cracks by its own weight")
    resting = RestingModel(model, scenario.joints)
    stability = stability_of(scenario, model, with_factor=stand or None, resting=resting)
    progress.stage("works out what follows for the run")
    yield from _section("Does it stand?", stability.facts())
    lying = dead_load_facts(scenario.dead_loads, prepared.members)
    yield from _section("Masses", (*mass_facts(prepared.members), *lying))
    if stand and model.stiffness is None:
        resting = RestingModel(checked_model(as_elastic, prepared.members), scenario.joints)
    is_elastic = resting.model.stiffness is not None
    if is_elastic and (reactions := list(reaction_facts(as_elastic, resting))):
        yield from _section("Reactions at rest", reactions)
    if scenario.bridge:
        yield from _section("Bridge", bridge_facts(scenario.bridge, is_flat=scenario.has_flat_ground))
    yield from _section("Members", member_facts(prepared.members))
    if prepared.notes:
        yield from _section("Repaired", (note.partition(": ")[::2] for note in prepared.notes))
    if rules_of_bars(scenario):
        schedule = bar_schedule(scenario, prepared.members)
        yield from _section("Reinforcement", schedule_facts(scenario, prepared.members, schedule))
    yield from _section("Time", (*scenario.time.facts(scenario.timeline), *_cost_facts(scenario, model)))
    if not model.ground.is_plain:
        yield from _section("Ground", terrain_facts(model.ground))
    yield from _section("Shards and connections", connection_facts(scenario, model))
    yield from _section("Contacts", contact_facts(scenario))
    if is_elastic:
        yield from _section("At rest", rest_facts(scenario, resting))
        runs = convergence_facts(scenario, len(model.member_of_shard)) if resting.model is model else ()
        yield from _section("Fineness", (*accuracy_facts(as_elastic, resting), *runs))
    if model.steel:
        of_steel = *steel_facts(scenario, model, resting.rest), *deck_facts(scenario, model, resting.rest)
        yield from _section("Steelwork", of_steel)
    if model.tendons:
        yield from _section("Tendons", tendon_facts(scenario, model.tendons))
    yield from _section("Overlap at the start", overlap_facts(model))
    if model.soil:
        yield from _section("Foundations", foundation_facts(scenario, resting))
    for heading, facts in _action_facts(scenario, model, stability.zones).items():
        yield from _section(heading, facts)
    if scenario.equipment:
        yield from _section("Equipment", equipment_facts(scenario, model))
    if not scenario.actions:
        yield from _section(
            "Sequence", [("nothing", "is done to the bridge: add [ball], [[charges]] or another action")]
        )
    if reason := scenario.pictures.why_not_without_window:
        yield from _section("Pictures", [("none can be taken", reason)])


def _cost_facts(scenario: Scenario, model: Model) -> Iterator[Fact]:
    """Yield about how long a run takes, and how much memory."""
    seconds, memory_mb = seconds_by_size(scenario, model), megabytes_by_size(model)
    at_most = " or less, as it ends at rest" if scenario.time.stop_at_rest else ""
    yield (
        "a run takes",
        f"about {duration_text(seconds)}{at_most}: on one core, without pictures, to a factor of {FACTOR:g}",
    )
    yield "", f"about {memory_mb:.0f} MB of memory, and {disk_megabytes(scenario, model):.0f} MB on the disk"
    if scenario.connections.is_elastic and (stages := count_of_stages(scenario, model)) > 1:
        at_rest_s, with_factors_s = seconds_of_stages(scenario, model, stages)
        yield (
            "bda stages takes",
            f"about {duration_text(with_factors_s)} for {stages} stages, to a factor of {FACTOR:g}",
        )
        yield "", f"about {duration_text(at_rest_s)} without load factors, by --no-factor"


def _awake_facts(scenario: Scenario) -> Iterator[Fact]:
    """Run a bridge alone and awake, and yield whether it stood."""
    summary = simulation_module("motion_run", one_thread=True).left_alone_run(scenario)
    fall = self_collapse_text(summary.fell_by_itself)
    moving = moving_text(summary.moving_at_end, summary.came_to_rest_s)
    if fall or moving:
        yield "comes down", fall or moving
        if fall and moving:
            yield "", moving
    else:
        yield "stands", f"nothing was done to it for {AWAKE_S:g} s, and it stood: this seed, this cut, these sub-steps"


def _action_facts(scenario: Scenario, model: Model, zones: tuple[ZoneLoad, ...]) -> dict[str, list[Fact]]:
    """Return what all planned actions say of themselves, by section."""
    site = ModelWorksite(scenario, model, zones)
    sections: dict[str, list[tuple[float, list[Fact]]]] = {}
    for action in scenario.actions:
        described = action.begins_s(scenario), list(action.facts(site))
        sections.setdefault(action.heading, []).append(described)
    sections.get(PlannedAction.heading, []).sort()
    lines = {heading: [fact for _, facts in parts for fact in facts] for heading, parts in sections.items()}
    if scenario.blast_zones:
        zones_placed = placed_zones(scenario, model.members, model.layers)
        lines[BlastZone.heading] += zone_totals(zones_placed, model.members)
        lines[BlastZone.heading] += firing_facts(fired_rows(scenario, zones_placed, model.members))
    if scenario.charges:
        lines[Charge.heading] += scenario.blast.facts(scenario.charges, scenario.fracture.shards)
    return lines


def _section(heading: str, facts: Iterable[Fact]) -> Iterator[str]:
    yield ""
    yield heading
    for name, value in facts:
        yield f"  {name:<23} {value}"
