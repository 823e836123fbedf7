"""``bda optimise``: find the charges, delays, positions or order of steps that do best, and confirm them."""

from __future__ import annotations

import argparse
from pathlib import Path

from ..model.optimise.file import read_optimisation
from ..report.wording.optimise import optimise_sentences
from .ensemble import add_ensemble_options, execute_ensemble


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser(
        "optimise",
        help="find the charges, delays, positions or order of steps that do best, where a demolition has to succeed",
        description="Try candidates, each in some runs, choose among the best on fresh runs, confirm the one that is "
        "chosen on others, and write trials.csv, candidates.csv and optimise.json to DIR. The same command goes on "
        "with an optimisation that was stopped, and repeats no run.",
        allow_abbrev=False,
    )
    parser.add_argument("optimise", metavar="OPTIMISE.toml", type=Path, help="optimisation file, see docs/optimise.md")
    parser.add_argument("--output", metavar="DIR", type=Path, required=True, help="its folder, made if new")
    add_ensemble_options(parser)
    parser.set_defaults(execute=execute)


def execute(arguments: argparse.Namespace) -> None:
    """Make the runs of an optimisation."""
    execute_ensemble(read_optimisation(arguments.optimise), arguments, optimise_sentences)
