"""What the commands ``study``, ``search`` and ``optimise`` share: where runs are made, progress, what is printed."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from ..engineering.unit_systems import UnitSystem
from ..errors import OutputError
from ..model.ensemble.folder import RETRIED, EnsembleResult
from ..model.study.file import Ensemble
from ..report.languages.translation import ENGLISH, Translation
from ..studies.engine import Engine, LocalProcesses, cores
from ..studies.run_process import RunLimits
from ..studies.session import EnsembleSession
from ..system.signals import Interrupted, signals_noted
from .arguments import add_report_options
from .progress import CommandProgress, progress_on

_LOOK_EVERY_S = 0.2
_SHOWN_REASONS = 5
_MOST_JOBS = 1000


def folder_beside(file: str | Path, kind: str) -> Path:
    """Return the folder here that an ensemble goes to where none is named: the same each time, so that it goes on."""
    return Path(f"{Path(file).stem}_{kind}")


def add_ensemble_options(parser: argparse.ArgumentParser) -> None:
    """Add the options that say where runs are made, and what is printed."""
    parser.add_argument("--jobs", metavar="N", type=_jobs, help="runs at a time (as many as this machine has cores)")
    parser.add_argument(
        "--dask", metavar="ADDRESS", help="run on the Dask cluster of this scheduler, as tcp://host:8786"
    )
    parser.add_argument("--report", action="store_true", help="make a report at the end, in DIR/report")
    add_report_options(parser)
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")


def execute_ensemble(
    ensemble: Ensemble,
    arguments: argparse.Namespace,
    sentences: Callable[[Any], Iterable[str]],
    before_report: Callable[[EnsembleSession, CommandProgress], None] | None = None,
) -> None:
    """Make all runs, write a report if it is wanted, and print what the runs state.

    `before_report` makes what the report also shows, such as pictures of single runs.
    """
    session, result, paths = _run(ensemble, arguments)
    if arguments.report:
        from ..report.write import write_report  # loading matplotlib takes a second

        progress = progress_on(sys.stdout, quiet=arguments.quiet)
        try:
            if before_report:
                before_report(session, progress)
            options = {"language": arguments.language, "units": arguments.units}
            paths += write_report([arguments.output], None, **options, progress=progress)
        finally:
            progress.finish()
    if not arguments.quiet:
        asked = arguments.units or ensemble.scenario.report.units or UnitSystem.METRIC
        shown = Translation.into(ENGLISH, UnitSystem(asked)).text
        _print(session, map(shown, sentences(result)), paths)


def _run(ensemble: Ensemble, arguments: argparse.Namespace) -> tuple[EnsembleSession, EnsembleResult, list[Path]]:
    """Make all runs, unless a signal stops that, and return the session, its result and the files that it wrote."""
    if arguments.output.is_file():
        raise OutputError(f"{arguments.output}: expected a folder for the {ensemble.kind}, found a file")
    progress = progress_on(sys.stdout, quiet=arguments.quiet)
    with signals_noted() as signals:
        session = EnsembleSession(ensemble, arguments.output, _engine(ensemble, arguments))
        progress.stage(f"making {session.planner.total} runs in {arguments.output}")
        try:
            while not session.planner.is_finished:
                session.step(_LOOK_EVERY_S)
                progress.runs(session.planner.done, session.planner.total, session.planner.lost)
                if signals and not session.planner.is_finished:
                    raise Interrupted(signals[0])
            progress.finish()
            return session, *session.finish()
        finally:
            progress.finish()
            session.stop()


def _print(session: EnsembleSession, sentences: Iterable[str], paths: Iterable[Path]) -> None:
    """Print what all runs state, why some did not finish, and the files that were written."""
    print()
    for line in sentences:
        print(line)
    reasons, ensemble = session.reasons, session.planner.ensemble
    for number, reason in list(reasons.items())[:_SHOWN_REASONS]:
        print(f"run {number} did not finish: {reason}")
    if len(reasons) > _SHOWN_REASONS:
        print(f"{len(reasons) - _SHOWN_REASONS} more did not finish, see status in {ensemble.table_file}")
    if again := sum(session.statuses.get(status, 0) for status in RETRIED):
        print(f"{again} of them were killed or had no memory: the same command makes these runs again")
    print()
    for path in paths:
        print(path)


def _engine(ensemble: Ensemble, arguments: argparse.Namespace) -> Engine:
    """Return what makes the runs, by the options of the command line."""
    limits = RunLimits.of(ensemble.settings)
    if arguments.dask is None:
        return LocalProcesses(arguments.jobs or cores(), limits)
    if arguments.jobs is not None:
        raise OutputError("--jobs is for this machine: leave it out with --dask, whose workers say how many they take")
    from ..studies.dask_cluster import DaskCluster  # loading Dask takes a second

    return DaskCluster(arguments.dask, limits)


def whole_number(text: str, largest: int) -> int:
    """Return a whole number from 1 on that an option was given."""
    if not (text.isascii() and text.isdecimal() and len(text) < 9 and 1 <= int(text) <= largest):
        raise argparse.ArgumentTypeError(f"{text!r} is wrong: expected a whole number from 1 to {largest}")
    return int(text)


def _jobs(text: str) -> int:
    return whole_number(text, _MOST_JOBS)
