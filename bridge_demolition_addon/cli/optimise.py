"""``bda optimise``: find the charges, delays, places or order of steps that do best, and confirm them on fresh runs."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path

from ..errors import OutputError
from ..model.optimise.candidates_table import Tried
from ..model.optimise.conclusions import Best, sentences
from ..model.optimise.file import Optimisation, read_optimisation
from ..model.optimise.files import BEST_FILE, CANDIDATES_FILE, TRADEOFF_PICTURE, TRIALS_FILE
from ..studies.folder import StudyFolder
from ..studies.optimise_run import OptimiseRun
from ..studies.proposals import OptunaProposals, check_optuna
from ..system.signals import Interrupted, signals_noted
from .progress import CommandProgress, progress_on
from .study import add_engine_options, engine_of

_LOOK_EVERY_S = 0.2
_SHOWN_REASONS = 5


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser(
        "optimise",
        help="find the charges, delays, places or order of steps that do best, where a demolition has to succeed",
        description="Try candidates, each in some runs, choose among the best on fresh runs, confirm the one that is "
        "chosen on others, and write trials.csv, candidates.csv and optimise.json to DIR. The same command goes on "
        "with an optimisation that was stopped, and repeats no run.",
        allow_abbrev=False,
    )
    parser.add_argument("optimise", metavar="OPTIMISE.toml", type=Path, help="optimisation file, see docs/optimise.md")
    parser.add_argument("--output", metavar="DIR", type=Path, required=True, help="its folder, made if new")
    add_engine_options(parser)
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    parser.set_defaults(execute=execute)


def execute(arguments: argparse.Namespace) -> None:
    """Make the runs of an optimisation."""
    optimisation = read_optimisation(arguments.optimise)
    if arguments.output.is_file():
        raise OutputError(f"{arguments.output}: expected a folder for the optimisation, found a file")
    optuna = check_optuna()
    proposals = OptunaProposals(optimisation.space.size, optimisation.settings.seed)
    progress = progress_on(sys.stdout, quiet=arguments.quiet)
    with (
        signals_noted() as signals,
        closing(engine_of(optimisation.study, arguments)) as engine,
        StudyFolder(arguments.output, optimisation, {**engine.versions, "optuna": optuna}) as folder,
    ):
        run = OptimiseRun(optimisation, folder, engine, proposals)
        try:
            _play(run, signals, progress)
        finally:
            engine.close()  # before the folder is free for others
            tried = run.write_trials()
        best = run.write_best()
    paths = [arguments.output / name for name in (TRIALS_FILE, CANDIDATES_FILE, BEST_FILE)]
    paths += _draw(optimisation, tried, best, arguments.output)
    if not arguments.quiet:
        _print(optimisation, run, best, paths)


def _play(run: OptimiseRun, signals: Sequence[int], progress: CommandProgress) -> None:
    """Make all runs, unless a signal stops that."""
    try:
        while not run.is_finished:
            run.step(_LOOK_EVERY_S)
            progress.draws(run.done, run.total, run.lost)
            if signals and not run.is_finished:
                raise Interrupted(signals[0])
    finally:
        progress.finish()


def _draw(optimisation: Optimisation, tried: Sequence[Tried], best: Best, output: Path) -> list[Path]:
    """Draw charge against reach, where there are charges, and return the path of the picture."""
    if not any(each.charge_kg > 0.0 for each in tried):
        return []
    from ..charts.tradeoff import save_tradeoff  # loading matplotlib takes a second

    save_tradeoff(output / TRADEOFF_PICTURE, optimisation.settings, tried, best.candidate)
    return [output / TRADEOFF_PICTURE]


def _print(optimisation: Optimisation, run: OptimiseRun, best: Best, paths: Sequence[Path]) -> None:
    print()
    for line in sentences(optimisation, best):
        print(line)
    for number, reason in list(run.reasons.items())[:_SHOWN_REASONS]:
        print(f"run {number} did not finish, and counts as no success: {reason}")
    if len(run.reasons) > _SHOWN_REASONS:
        print(f"{len(run.reasons) - _SHOWN_REASONS} more did not finish, see status in {TRIALS_FILE}")
    print()
    for path in paths:
        print(path)
