"""``bda stages``: how the bridge stands between the steps of its demolition, and which members hold it."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from functools import partial
from pathlib import Path

from ..errors import OutputError
from ..model.run_folder.folder import numbered_folder
from ..model.scenario.file import read_scenario
from ..model.sequence.checked_model import checked_model
from ..model.stages.bearing_rows import bearing_rows
from ..model.stages.design_loads import DesignLoad, design_load_sentences, design_loads
from ..model.stages.misfires import Misfire, misfire_sentences, misfires
from ..model.stages.stages import Criticality, Stage, criticality, stages_of
from ..model.stages.standing import StandingBridge, made_elastic
from ..model.stages.tables import (
    FILES,
    all_reaction_rows,
    bearing_sentences,
    criticality_sentences,
    reaction_sentences,
    stage_sentences,
    write_tables,
)
from ..model.structure.bearing_ranges import ONE_CUT
from ..system.disk import writing
from .arguments import naming
from .progress import progress_on


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser(
        "stages",
        help="say how the bridge stands between the steps of its demolition, and which members hold it",
        description="Work out the bridge at rest before each step of a scenario and after the last, by the stiffness "
        "of its connections and without a simulation, and write stages.csv, reactions.csv, bearings.csv, "
        "utilisation.csv, criticality.csv, misfires.csv and lifts.csv.",
        allow_abbrev=False,
    )
    parser.add_argument("scenario", metavar="SCENARIO.toml", type=Path, help="scenario file, see docs/stages.md")
    parser.add_argument(
        "--output", metavar="DIR", type=Path, help="folder for the tables, made if new (here, called like the scenario)"
    )
    parser.add_argument("--overwrite", action="store_true", help="replace tables that are there")
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    parser.set_defaults(execute=execute)


def execute(arguments: argparse.Namespace) -> None:
    """Work out the stages, write their tables and print what they say."""
    scenario = read_scenario(arguments.scenario)
    output: Path = arguments.output or numbered_folder(Path(), f"{scenario.title} stages")
    paths = [output / name for name in FILES]
    if not arguments.overwrite and (there := [path for path in paths if path.exists()]):
        raise OutputError(f"{there[0]}: exists already; choose another folder, or add --overwrite")
    progress = progress_on(sys.stdout, quiet=arguments.quiet)
    try:
        with naming(arguments.scenario):
            model = checked_model(made_elastic(scenario))
            bridge = StandingBridge(model, scenario.joints)
            stages = stages_of(scenario, bridge, partial(progress.part, text="stages"))
            members = criticality(bridge, partial(progress.part, text="members taken away"))
            failures = misfires(scenario, bridge, partial(progress.part, text="zones that fail"))
            designed = design_loads(scenario, bridge, partial(progress.part, text="loads of the design"))
    finally:
        progress.finish()
    with writing(output):
        rows = write_tables(output, stages, members, bridge, failures)
    if not arguments.quiet:
        reactions, bearings = all_reaction_rows(stages, model), list(bearing_rows(stages, model))
        _print(stages, rows, reactions, bearings, members, failures, designed, paths)


def _print(
    stages: Sequence[Stage],
    rows: Sequence[dict],
    reactions: Sequence[dict],
    bearings: Sequence[dict],
    members: Sequence[Criticality],
    failures: Sequence[Misfire],
    designed: Sequence[DesignLoad],
    paths: Sequence[Path],
) -> None:
    print()
    for stage, row in zip(stages, rows, strict=True):
        carried = reaction_sentences([reaction for reaction in reactions if reaction["stage"] == row["stage"]])
        on_bearings = bearing_sentences([bearing for bearing in bearings if bearing["stage"] == row["stage"]])
        first, *others = [*stage_sentences(stage, row), *carried, *on_bearings]
        print(first)
        for line in others:
            print(f"  {line}")
    if bearings:
        print(ONE_CUT)
    print()
    for line in (*criticality_sentences(members), *misfire_sentences(failures), *design_load_sentences(designed)):
        print(line)
    print()
    for path in paths:
        print(path)
