"""``bda search`` and ``bda optimise``: find values at which a demolition succeeds, or does best."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from ..model.optimise.file import read_optimisation
from ..model.search.file import read_search
from ..model.study.file import Ensemble
from ..report.wording.optimise import optimise_sentences
from ..report.wording.search import search_sentences
from .ensemble import add_ensemble_options, execute_ensemble, folder_beside


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add both commands to the command line."""
    search = commands.add_parser(
        "search",
        description="Make the runs of a search, each with inputs of its own, and write trials.csv, search.json and the "
        "curve to DIR. The same command goes on with a search that was stopped, and repeats no run.",
        allow_abbrev=False,
    )
    _complete(search, "search", read_search, search_sentences)
    optimise = commands.add_parser(
        "optimise",
        description="Try candidates, each in some runs, choose among the best on fresh runs, confirm the one that is "
        "chosen on others, and write trials.csv, candidates.csv and optimise.json to DIR. The same command goes on "
        "with an optimisation that was stopped, and repeats no run.",
        allow_abbrev=False,
    )
    _complete(optimise, "optimise", read_optimisation, optimise_sentences)


def _complete(
    parser: argparse.ArgumentParser,
    name: str,
    read: Callable[[Path], Ensemble],
    sentences: Callable[[Any], Iterable[str]],
) -> None:
    help_text = f"file that says what to {name}, see docs/{name}.md"
    parser.add_argument("file", metavar=f"{name.upper()}.toml", type=Path, help=help_text)
    parser.add_argument(
        "--output", metavar="DIR", type=Path, help=f"its folder, made if new (NAME_{name} for NAME.toml)"
    )
    add_ensemble_options(parser)

    def execute(arguments: argparse.Namespace) -> None:
        ensemble = read(arguments.file)
        arguments.output = arguments.output or folder_beside(arguments.file, name)
        execute_ensemble(ensemble, arguments, sentences)

    parser.set_defaults(execute=execute)
