"""``bda stages``: how the bridge stands between the steps of its demolition, and which members hold it."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Sequence
from functools import partial
from pathlib import Path

from ..core.errors import OutputError, writing
from ..core.scenario.file import read_scenario
from ..core.sequence.checked_model import checked_model
from ..core.stages.made_elastic import made_elastic
from ..core.stages.stages import Criticality, Stage, criticality, stages_of
from ..core.stages.standing import StandingBridge
from ..core.stages.tables import (
    CRITICALITY_COLUMNS,
    CRITICALITY_FILE,
    STAGE_COLUMNS,
    STAGES_FILE,
    UTILISATION_COLUMNS,
    UTILISATION_FILE,
    criticality_row,
    stage_row,
    utilisation_rows,
    write_table,
)
from .arguments import naming
from .progress import progress_on


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser(
        "stages",
        help="say how the bridge stands between the steps of its demolition, and which members hold it",
        description="Work out the bridge at rest before each step of a scenario and after the last, by the stiffness "
        "of its connections and without a simulation, and write stages.csv, utilisation.csv and criticality.csv.",
        allow_abbrev=False,
    )
    parser.add_argument("scenario", metavar="SCENARIO.toml", type=Path, help="scenario file, see docs/stages.md")
    parser.add_argument("--output", metavar="DIR", type=Path, required=True, help="folder for the tables, made if new")
    parser.add_argument("--overwrite", action="store_true", help="replace tables that are there")
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    parser.set_defaults(execute=execute)


def execute(arguments: argparse.Namespace) -> None:
    """Work out the stages, write their tables and print what they say."""
    scenario = read_scenario(arguments.scenario)
    output: Path = arguments.output
    paths = [output / name for name in (STAGES_FILE, UTILISATION_FILE, CRITICALITY_FILE)]
    if not arguments.overwrite and (there := [path for path in paths if path.exists()]):
        raise OutputError(f"{there[0]}: exists already; choose another folder, or add --overwrite")
    progress = progress_on(sys.stdout, quiet=arguments.quiet)
    try:
        with naming(arguments.scenario):
            model = checked_model(made_elastic(scenario))
            bridge = StandingBridge(model, scenario.joints)
            stages = stages_of(scenario, bridge, partial(progress.part, text="stages"))
            members = criticality(bridge, partial(progress.part, text="members taken away"))
    finally:
        progress.finish()
    with writing(output):
        output.mkdir(parents=True, exist_ok=True)
        rows = [stage_row(number, stage, bridge) for number, stage in enumerate(stages, start=1)]
        write_table(paths[0], STAGE_COLUMNS, rows)
        used = (row for number, stage in enumerate(stages, start=1) for row in utilisation_rows(number, stage, bridge))
        write_table(paths[1], UTILISATION_COLUMNS, used)
        write_table(paths[2], CRITICALITY_COLUMNS, map(criticality_row, members))
    if not arguments.quiet:
        _print(stages, rows, members, paths)


def _print(
    stages: Sequence[Stage], rows: Sequence[dict], members: Sequence[Criticality], paths: Sequence[Path]
) -> None:
    print()
    for stage, row in zip(stages, rows, strict=True):
        print(f"stage {row['stage']}, from {stage.time_s:g} s: {stage.step}")
        if stage.equipment:
            print(f"  with {row['equipment']}")
        if row["not_held"]:
            print(
                f"  {row['not_held']} shards, {row['not_held_kg'] / 1000.0:.1f} t, held by no connection to a support"
            )
        if row["largest_utilisation"] is not None:
            print(
                f"  used most: {row['largest_utilisation']:.0%} by {row['governed_by']}, in {row['between']} at "
                f"[{row['at_x_m']:.1f}, {row['at_y_m']:.1f}, {row['at_z_m']:.1f}] m"
            )
        print(f"  {_factor_in_words(stage.collapse_factor)}")
    print()
    falls = [each for each in members if each.falls_kg]
    for each in sorted(falls, key=lambda one: -one.falls_kg):
        print(f"without {each.member}: {each.falls_kg / 1000.0:.1f} t come down, {each.share:.0%}")
    if not falls:
        print("without any one member the others stand")
    print()
    for path in paths:
        print(path)


def _factor_in_words(factor: float) -> str:
    if math.isnan(factor):
        return "no connection to a support holds anything"
    return f"comes down at {f'{factor:.2f} times' if math.isfinite(factor) else 'more than 64 times'} its load"
