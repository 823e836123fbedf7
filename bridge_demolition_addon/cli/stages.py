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
from ..model.stages.design_loads import design_load_sentences, design_loads
from ..model.stages.misfires import misfire_sentences, misfires
from ..model.stages.stages import Stage, criticality, stages_of
from ..model.stages.standing import StandingBridge, made_elastic
from ..model.stages.tables import (
    FILES,
    all_reaction_rows,
    bearing_rows,
    bearing_sentences,
    criticality_sentences,
    reaction_sentences,
    stage_sentences,
    write_stages,
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
    parser.add_argument(
        "--no-factor",
        action="store_true",
        help="leave out at how many times its load the bridge comes down, which takes most of the time",
    )
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
            progress.stage("cutting the bridge")
            model = checked_model(made_elastic(scenario))
            bridge = StandingBridge(model, scenario.joints)

            progress.stage(f"working out the stages; each is in {output} as soon as it is done")

            def keep(done: Sequence[Stage]) -> None:
                with writing(output):
                    if len(done) == 1:  # tables of another time would stand next to them, if this is stopped
                        for path in paths:
                            path.unlink(missing_ok=True)
                    rows = write_stages(output, done, bridge)
                progress.finish()
                if not arguments.quiet:
                    _print_stage(done, rows, bridge)

            with_factor = not arguments.no_factor
            stages = stages_of(
                scenario, bridge, partial(progress.part, text="stages"), with_factor=with_factor, keep=keep
            )
            members = criticality(bridge, partial(progress.part, text="members taken away"))
            failures = misfires(scenario, bridge, partial(progress.part, text="zones that fail"))
            loads = partial(progress.part, text="loads of the design")
            designed = design_loads(scenario, bridge, loads) if with_factor else []
    finally:
        progress.finish()
    with writing(output):
        write_tables(output, stages, members, bridge, failures)
    if not arguments.quiet:
        if any(bearing_rows(stages, model)):
            print(ONE_CUT)
        print()
        for line in (*criticality_sentences(members), *misfire_sentences(failures), *design_load_sentences(designed)):
            print(line)
        print()
        for path in paths:
            print(path)


def _print_stage(stages: Sequence[Stage], rows: Sequence[dict], bridge: StandingBridge) -> None:
    """Print what the last of the stages that are done says."""
    number = rows[-1]["stage"]
    reactions, bearings = (
        [row for row in of_all if row["stage"] == number]
        for of_all in (all_reaction_rows(stages, bridge.model), bearing_rows(stages, bridge.model))
    )
    first, *others = [
        *stage_sentences(stages[-1], rows[-1]),
        *reaction_sentences(reactions),
        *bearing_sentences(bearings),
    ]
    print(first)
    for line in others:
        print(f"  {line}", flush=True)
