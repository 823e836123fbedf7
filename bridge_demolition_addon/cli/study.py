"""``bda study``: run a scenario many times with inputs drawn by chance, and say what holds for such runs."""

from __future__ import annotations

import argparse
import subprocess
import sys
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path

from ..errors import OutputError, SimulationError
from ..model.study.conclusions import Conclusions, sentences
from ..model.study.draws import draw_of
from ..model.study.file import Study, read_study
from ..model.study.files import AGAIN_FOLDER, CONCLUSIONS_FILE, DRAW_FOLDER, RUNS_FILE, SHEET_FILE
from ..model.study.runs_table import DONE, RunsTable
from ..model.study.statements import verified_sentence
from ..model.study.verification import chance_of_leaving, holds
from ..studies.draw_process import Limits
from ..studies.engine import Engine
from ..studies.folder import TRIED_AGAIN, StudyFolder, end_in, study_in, versions_of
from ..studies.local import LocalProcesses, cores
from ..studies.study_run import StudyRun
from ..system.programs import program_command
from ..system.signals import Interrupted, signals_noted
from .progress import CommandProgress, progress_on
from .run import run_with_everything
from .study_check import study_facts

_LOOK_EVERY_S = 0.2
_SHOWN_REASONS = 5
_MOST_JOBS = 1000


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser(
        "study",
        help="run a scenario many times with inputs drawn by chance",
        description="Run all draws of a study, each in a process of its own, and write runs.csv and study.json to DIR. "
        "The same command goes on with a study that was stopped, and reruns nothing that is done.",
        allow_abbrev=False,
    )
    parser.add_argument(
        "study", metavar="STUDY.toml", help="study file, see docs/studies.md; with --again, the folder of a study"
    )
    parser.add_argument("--output", metavar="DIR", type=Path, help="folder of the study, made if new")
    add_engine_options(parser)
    parser.add_argument("--report", action="store_true", help="make the report of the study at its end, in DIR/report")
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    parser.add_argument("--check", action="store_true", help="print some draws and how long it takes, and run nothing")
    parser.add_argument(
        "--again", metavar="N", type=_number, help="run draw N of a study once more, and keep everything"
    )
    parser.add_argument(
        "--verify",
        metavar="ZONE",
        help="say how likely debris leaves this zone of the scenario, from the runs of the study in a folder",
    )
    parser.set_defaults(execute=execute)


def add_engine_options(parser: argparse.ArgumentParser) -> None:
    """Add the options that say where draws run."""
    parser.add_argument("--jobs", metavar="N", type=_jobs, help="draws at a time (as many as this machine has cores)")
    parser.add_argument(
        "--dask", metavar="ADDRESS", help="run on the Dask cluster of this scheduler, as tcp://host:8786"
    )


def execute(arguments: argparse.Namespace) -> None:
    """Run a study, print what it would be, or run one of its draws once more."""
    if arguments.again is not None:
        _play_again(Path(arguments.study), arguments.again, quiet=arguments.quiet)
        return
    if arguments.verify is not None:
        print(_verified(Path(arguments.study), arguments.verify))
        return
    study = read_study(arguments.study)
    if arguments.check:
        for line in study_facts(study, arguments.output, arguments.jobs or cores()):
            print(line)
        return
    if arguments.output is None:
        raise OutputError("--output is missing: name the folder of the study")
    _run(study, arguments)


def _run(study: Study, arguments: argparse.Namespace) -> None:
    progress = progress_on(sys.stdout, quiet=arguments.quiet)
    with (
        signals_noted() as signals,
        closing(engine_of(study, arguments)) as engine,
        StudyFolder(arguments.output, study, engine.versions) as folder,
    ):
        run = StudyRun(study, folder, engine)
        try:
            _play(run, signals, progress)
        finally:
            engine.close()  # before the folder is free for others
            run.write_tables()
        said = run.write_conclusions()
    report = _report(run.table(), arguments.output, progress) if arguments.report else []
    if not arguments.quiet:
        _print_results(study, run, said, arguments.output, report)


def _play(run: StudyRun, signals: Sequence[int], progress: CommandProgress) -> None:
    """Run all draws, unless a signal stops that."""
    try:
        while not run.is_finished:
            run.step(_LOOK_EVERY_S)
            progress.draws(run.done, run.total, run.done - run.statuses.get(DONE, 0))
            if signals:
                raise Interrupted(signals[0])
    finally:
        progress.finish()


def engine_of(study: Study, arguments: argparse.Namespace) -> Engine:
    """Return what runs the draws of a study, by the options of the command line."""
    limits = Limits.of(study.settings)
    if arguments.dask is None:
        return LocalProcesses(arguments.jobs or cores(), limits)
    if arguments.jobs is not None:
        raise OutputError("--jobs is for this machine: leave it out with --dask, whose workers say how many they take")
    from ..studies.dask_cluster import DaskCluster  # loading Dask takes a second

    return DaskCluster(arguments.dask, limits)


def _report(table: RunsTable, output: Path, progress: CommandProgress) -> list[Path]:
    """Write the report of a study, with pictures of its median and of its worst draw."""
    from ..report.write import write_report  # loading matplotlib takes a second

    try:
        for row in dict.fromkeys([table.median_row, table.worst_row]):
            if row is not None and not (output / AGAIN_FOLDER / str(table.numbers[row])).exists():
                progress.stage(f"running draw {table.numbers[row]} once more for its pictures")
                _play_again_elsewhere(output, int(table.numbers[row]))
        return write_report([output], None, progress=progress)
    finally:
        progress.finish()


def _print_results(study: Study, run: StudyRun, said: Conclusions, output: Path, report: Sequence[Path]) -> None:
    print()
    for line in sentences(study, said):
        print(line)
    for number, reason in list(run.reasons.items())[:_SHOWN_REASONS]:
        print(f"draw {number} is not done: {reason}")
    if len(run.reasons) > _SHOWN_REASONS:
        print(f"{len(run.reasons) - _SHOWN_REASONS} more are not done, see status in {RUNS_FILE}")
    if again := sum(run.statuses.get(status, 0) for status in TRIED_AGAIN):
        print(f"{again} of them were killed or had no memory: the same command runs these once more")
    print()
    for name in (RUNS_FILE, SHEET_FILE, CONCLUSIONS_FILE):
        if (output / name).exists():
            print(output / name)
    for path in report:
        print(path)


def _play_again_elsewhere(path: Path, number: int) -> None:
    """Run a draw once more in a process of its own, as Blender is never loaded here, and say why if that fails."""
    command = [*program_command("__main__"), "study", str(path), "--again", str(number), "--quiet"]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace")
    if done.returncode:
        reason = (done.stderr.strip().splitlines() or [f"exit status {done.returncode}"])[-1]
        print(f"draw {number} has no pictures in the report: {reason}", file=sys.stderr)


def _play_again(path: Path, number: int, *, quiet: bool) -> None:
    """Run a draw of the study in a folder once more with everything, and see that it comes to the same."""
    study = study_in(path)
    if number > study.settings.runs:
        raise OutputError(f"--again {number}: the study in {path} has draws 1 to {study.settings.runs}")
    draw = draw_of(study, number)
    before = end_in(path / DRAW_FOLDER / draw.address(versions_of(path)))
    progress = progress_on(sys.stdout, quiet=quiet)
    output = path / AGAIN_FOLDER / str(number)
    try:
        summary = run_with_everything(draw.scenario, output, progress, quiet=quiet)
    finally:
        progress.finish()
    if before is None or before.status != DONE:
        return
    differing = [name for name, digest in before.fingerprint.items() if summary["fingerprint"][name] != digest]
    if differing:
        raise SimulationError(f"{output}: draw {number} came to something else than in the study: {differing} differs")
    if not quiet:
        print(f"draw {number} came to the same as in the study, bit by bit: {output}")


def _verified(path: Path, name: str) -> str:
    """Return what the runs of the study in a folder say of a zone of its scenario."""
    from ..report.ensemble.study_folder import read_study_runs

    runs = read_study_runs(path)
    settings, zones = runs.study.settings, {zone.name: zone for zone in runs.study.scenario.zones}
    if len(runs.table) < settings.runs:
        raise OutputError(f"{path}: {len(runs.table)} of {settings.runs} runs are there: go on with the study first")
    if name not in zones:
        known = ", ".join(zones) or "none"
        raise OutputError(f"--verify {name}: expected a zone from [[zones]] of the scenario, which has {known}")
    if not holds(zones[name], runs.bridge):
        raise OutputError(f"--verify {name}: expected a zone that holds the bridge, of which a part is outside")
    return verified_sentence(chance_of_leaving(zones[name], runs.swept, settings.confidence), settings.quantile)


def _jobs(text: str) -> int:
    return _whole(text, _MOST_JOBS)


def _number(text: str) -> int:
    return _whole(text, 10_000_000)


def _whole(text: str, largest: int) -> int:
    if not (text.isascii() and text.isdecimal() and len(text) < 9 and 1 <= int(text) <= largest):
        raise argparse.ArgumentTypeError(f"{text!r} is wrong: expected a whole number from 1 to {largest}")
    return int(text)
