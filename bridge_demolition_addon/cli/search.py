"""``bda search``: find where along one quantity a demolition succeeds as often as it has to."""

from __future__ import annotations

import argparse
from pathlib import Path

from ..model.search.file import read_search
from ..report.wording.search import search_sentences
from .ensemble import add_ensemble_options, execute_ensemble


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser(
        "search",
        help="find the charge, drop height or strength at which a demolition succeeds as often as it has to",
        description="Make the runs of a search, each with inputs of its own, and write trials.csv, search.json and the "
        "curve to DIR. The same command goes on with a search that was stopped, and repeats no run.",
        allow_abbrev=False,
    )
    parser.add_argument("search", metavar="SEARCH.toml", type=Path, help="search file, see docs/search.md")
    parser.add_argument("--output", metavar="DIR", type=Path, required=True, help="folder of the search, made if new")
    add_ensemble_options(parser)
    parser.set_defaults(execute=execute)


def execute(arguments: argparse.Namespace) -> None:
    """Make the runs of a search."""
    execute_ensemble(read_search(arguments.search), arguments, search_sentences)
