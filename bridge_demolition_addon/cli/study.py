"""``bda study``: run a scenario many times with inputs that vary by chance, and state what holds for such runs."""

from __future__ import annotations

import argparse
import math
import subprocess
import sys
from collections.abc import Iterator, Mapping
from contextlib import suppress
from functools import partial
from pathlib import Path

from ..errors import OutputError, ScenarioError, SimulationError
from ..model.ensemble.folder import check_folder, outcome_in, study_in, versions_of
from ..model.schema import given
from ..model.sequence.checked_model import checked_model
from ..model.study.conclusions import holds, proportion_leaving
from ..model.study.file import AGAIN_FOLDER, RUNS_FOLDER, STUDY_FILE, Study, read_study
from ..model.study.runs_table import DONE
from ..model.study.sampled_runs import sampled_run
from ..report.wording.study import planned_limit_text, study_sentences, verified_sentence
from ..studies.engine import cores
from ..studies.estimate import FACTOR, duration_text, seconds_by_size
from ..studies.session import EnsembleSession
from ..system.programs import program_command
from .ensemble import add_ensemble_options, execute_ensemble, folder_beside, whole_number
from .progress import CommandProgress, StepsOfLongWork, progress_on
from .run import run_with_everything

_MOST_LOOKED_AT = 20
_SHOWN_RUNS = 5


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser(
        "study",
        description="Make all runs of a study, each in a process of its own, and write runs.csv and study.json to DIR. "
        "The same command goes on with a study that was stopped, and reruns nothing that is done.",
        allow_abbrev=False,
    )
    parser.add_argument(
        "study", metavar="STUDY.toml", help="study file, see docs/studies.md; with --again, the folder of a study"
    )
    parser.add_argument(
        "--output", metavar="DIR", type=Path, help="folder of the study, made if new (NAME_study for NAME.toml)"
    )
    add_ensemble_options(parser)
    parser.add_argument("--check", action="store_true", help="print some runs and how long it takes, and run nothing")
    parser.add_argument("--again", metavar="N", type=_number, help="make run N of a study again, and keep everything")
    parser.add_argument(
        "--verify",
        metavar="ZONE",
        help="state how often debris leaves this zone of the scenario, from the runs of the study in a folder",
    )
    parser.set_defaults(execute=execute)


def execute(arguments: argparse.Namespace) -> None:
    """Run a study, print what it would be, or make one of its runs again."""
    if arguments.again is not None:
        _repeat(Path(arguments.study), arguments.again, quiet=arguments.quiet)
        return
    if arguments.verify is not None:
        print(_verified(Path(arguments.study), arguments.verify))
        return
    if arguments.check:
        with StepsOfLongWork(sys.stderr, 2) as progress:
            progress.stage("reads the study, and looks at what each key varies: seconds")
            study = read_study(arguments.study)
            progress.stage("draws its first runs, and cuts its bridge to know how long one takes: seconds")
            for line in study_facts(study, arguments.output, arguments.jobs or cores()):
                print(line)
        return
    study = read_study(arguments.study)
    arguments.output = arguments.output or folder_beside(arguments.study, study.kind)
    execute_ensemble(study, arguments, partial(study_sentences, study), _make_pictures)


def study_facts(study: Study, output: Path | None, jobs: int) -> Iterator[str]:
    """Yield what ``--check`` prints: some runs of a study, and how long the study takes with this number of jobs."""
    settings = study.settings
    yield study.scenario.title
    yield ""
    yield f"{settings.runs} runs. The first are:"
    for number in range(1, min(settings.runs, _SHOWN_RUNS) + 1):
        values = ", ".join(f"{name} {_shown(value)}" for name, value in sampled_run(study, number).inputs.items())
        yield f"{number:>5}  {values}"
    yield ""
    yield planned_limit_text(settings)
    if not settings.vary:
        yield "Nothing varies but what the seed decides, such as how the bridge is cut: add [[vary]] for the rest."
    yield ""
    yield _estimate(study, output, jobs)


def _estimate(study: Study, output: Path | None, jobs: int) -> str:
    """Return how long all runs take, by those that are done or else by the size of the model."""
    seconds, why = None, ""
    if output is not None and output.exists():
        versions = versions_of(output) if (output / STUDY_FILE).exists() else {}
        check_folder(output, study, versions)
        seconds, why = _seconds_by_runs(study, output, versions), "as those that are done"
    if seconds is None:
        seconds = seconds_by_size(study.scenario, checked_model(study.scenario))
        why = f"to a factor of {FACTOR:g}, by the size of the model"
    whole = duration_text(seconds * study.settings.runs / min(jobs, study.settings.runs))
    at_a_time = "one run at a time" if jobs == 1 else f"{jobs} runs at a time on as many cores"
    return f"{duration_text(seconds)} for a run and {whole} for all, with {at_a_time}: {why}"


def _seconds_by_runs(study: Study, folder: Path, versions: Mapping[str, str]) -> float | None:
    """Return how long the first runs that are done in a study's folder took, in the mean; None without any."""
    seconds = []
    for number in range(1, min(study.settings.runs, _MOST_LOOKED_AT) + 1):
        with suppress(ScenarioError):  # inputs that the scenario cannot have together take no time
            outcome = outcome_in(folder / RUNS_FOLDER / sampled_run(study, number).cache_key(versions))
            if outcome and outcome.status == DONE:
                seconds.append(outcome.wall_time_s)
    return math.fsum(seconds) / len(seconds) if seconds else None


def _shown(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _make_pictures(session: EnsembleSession, progress: CommandProgress) -> None:
    """Make the median and the worst run again, for their pictures in the report."""
    table, output = session.planner.table, session.folder.path
    for row in dict.fromkeys([table.median_row, table.worst_row]):
        if row is not None and not (output / AGAIN_FOLDER / str(table.numbers[row])).exists():
            progress.stage(f"making run {table.numbers[row]} again for its pictures")
            _repeat_elsewhere(output, int(table.numbers[row]))


def _repeat_elsewhere(path: Path, number: int) -> None:
    """Make a run again in a process of its own, as Blender is never loaded here, and print why if that fails."""
    command = [*program_command("__main__"), "study", str(path), "--again", str(number), "--quiet"]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace")
    if done.returncode:
        reason = (done.stderr.strip().splitlines() or [f"exit status {done.returncode}"])[-1]
        print(f"run {number} has no pictures in the report: {reason}", file=sys.stderr)


def _repeat(path: Path, number: int, *, quiet: bool) -> None:
    """Make a run of the study in a folder again with everything, and check that its result is the same."""
    study = study_in(path)
    if number > study.settings.runs:
        raise OutputError(f"--again {number}: the study in {path} has runs 1 to {study.settings.runs}")
    run = sampled_run(study, number)
    before = outcome_in(path / RUNS_FOLDER / run.cache_key(versions_of(path)))
    progress = progress_on(sys.stdout, quiet=quiet)
    output = path / AGAIN_FOLDER / str(number)
    try:
        summary = run_with_everything(run.scenario, output, progress, quiet=quiet)
    finally:
        progress.finish()
    if before is None or before.status != DONE:
        return
    differing = [name for name, digest in before.fingerprint.items() if given(summary.fingerprint)[name] != digest]
    if differing:
        raise SimulationError(f"{output}: run {number} has another result than in the study: {differing} differs")
    if not quiet:
        print(f"run {number} has the same result as in the study, bit by bit: {output}")


def _verified(path: Path, name: str) -> str:
    """Return what the runs of the study in a folder state about a zone of its scenario."""
    from ..report.ensemble.reported_ensemble import read_study_runs

    runs = read_study_runs(path)
    settings, zones = runs.ensemble.settings, {zone.name: zone for zone in runs.ensemble.scenario.zones}
    if len(runs.table) < settings.runs:
        raise OutputError(f"{path}: {len(runs.table)} of {settings.runs} runs are there: go on with the study first")
    if name not in zones:
        known = ", ".join(zones) or "none"
        raise OutputError(f"--verify {name}: expected a zone from [[zones]] of the scenario, which has {known}")
    if not holds(zones[name], runs.bridge):
        raise OutputError(f"--verify {name}: expected a zone that contains the whole bridge")
    return verified_sentence(proportion_leaving(zones[name], runs.swept, settings.confidence), settings.quantile)


def _number(text: str) -> int:
    return whole_number(text, 10_000_000)
