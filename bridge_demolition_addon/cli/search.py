"""``bda search``: find where along one quantity a demolition succeeds as often as it has to."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path

from ..errors import OutputError
from ..model.search.conclusions import Answer, sentences
from ..model.search.curve import curve_of, write_curve
from ..model.search.file import Search, read_search
from ..model.search.files import ANSWER_FILE, CURVE_FILE, CURVE_PICTURE, TRIALS_FILE
from ..studies.folder import StudyFolder
from ..studies.search_run import SearchRun
from ..system.signals import Interrupted, signals_noted
from .progress import CommandProgress, progress_on
from .study import add_engine_options, engine_of

_LOOK_EVERY_S = 0.2
_SHOWN_REASONS = 5


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser(
        "search",
        help="find the charge, drop height or strength at which a demolition succeeds as often as it has to",
        description="Make the trials of a search, each a run with inputs of its own, and write trials.csv, search.json "
        "and the curve to DIR. The same command goes on with a search that was stopped, and repeats no trial.",
        allow_abbrev=False,
    )
    parser.add_argument("search", metavar="SEARCH.toml", type=Path, help="search file, see docs/search.md")
    parser.add_argument("--output", metavar="DIR", type=Path, required=True, help="folder of the search, made if new")
    add_engine_options(parser)
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    parser.set_defaults(execute=execute)


def execute(arguments: argparse.Namespace) -> None:
    """Make the trials of a search."""
    search = read_search(arguments.search)
    if arguments.output.is_file():
        raise OutputError(f"{arguments.output}: expected a folder for the search, found a file")
    progress = progress_on(sys.stdout, quiet=arguments.quiet)
    with (
        signals_noted() as signals,
        closing(engine_of(search.study, arguments)) as engine,
        StudyFolder(arguments.output, search, engine.versions) as folder,
    ):
        run = SearchRun(search, folder, engine)
        try:
            _play(run, signals, progress)
        finally:
            engine.close()  # before the folder is free for others
            run.write_trials()
        answer = run.write_answer()
    paths = [arguments.output / name for name in (TRIALS_FILE, ANSWER_FILE)]
    paths += _draw(search, run, answer, arguments.output)
    if not arguments.quiet:
        _print(search, run, answer, paths)


def _play(run: SearchRun, signals: Sequence[int], progress: CommandProgress) -> None:
    """Make all trials, unless a signal stops that."""
    try:
        while run.reason is None:
            run.step(_LOOK_EVERY_S)
            progress.draws(run.done, run.total, run.lost)
            if signals and run.reason is None:
                raise Interrupted(signals[0])
    finally:
        progress.finish()


def _draw(search: Search, run: SearchRun, answer: Answer, output: Path) -> list[Path]:
    """Write the curve and its picture, and return their paths."""
    from ..charts.search_curve import save_search_curve  # loading matplotlib takes a second

    curve, paths = curve_of(search, run.trials), []
    if curve is not None:
        write_curve(curve, output / CURVE_FILE)
        paths.append(output / CURVE_FILE)
    save_search_curve(output / CURVE_PICTURE, search, run.values, run.trials.successes, answer, curve)
    return [*paths, output / CURVE_PICTURE]


def _print(search: Search, run: SearchRun, answer: Answer, paths: Sequence[Path]) -> None:
    print()
    for line in sentences(search, answer, run.reason):
        print(line)
    for number, reason in list(run.reasons.items())[:_SHOWN_REASONS]:
        print(f"trial {number} did not finish, and counts as no success: {reason}")
    if len(run.reasons) > _SHOWN_REASONS:
        print(f"{len(run.reasons) - _SHOWN_REASONS} more did not finish, see status in {TRIALS_FILE}")
    print()
    for path in paths:
        print(path)
