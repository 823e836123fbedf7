"""What ``bda study --check`` prints: some runs, and how long all of them take."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ..model.ensemble.folder import check_folder, versions_of
from ..model.sequence.checked_model import checked_model
from ..model.study.file import Study
from ..model.study.files import STUDY_FILE
from ..model.study.sampled_runs import sampled_run
from ..studies.estimate import FACTOR, seconds_by_runs, seconds_by_size

_SHOWN_RUNS = 5


def study_facts(study: Study, output: Path | None, jobs: int) -> Iterator[str]:
    """Yield lines on the runs of a study, and on how long so many jobs take; of a folder, by what is done in it."""
    settings = study.settings
    yield study.scenario.title
    yield ""
    yield f"{settings.runs} runs, of which the first are:"
    for number in range(1, min(settings.runs, _SHOWN_RUNS) + 1):
        values = ", ".join(f"{name} {_shown(value)}" for name, value in sampled_run(study, number).inputs.items())
        yield f"{number:>5}  {values}"
    yield ""
    yield _estimate(study, output, jobs)


def _estimate(study: Study, output: Path | None, jobs: int) -> str:
    """Return how long all runs take, by those that are done or else by the size of the model."""
    seconds, why = None, ""
    if output is not None and output.exists():
        versions = versions_of(output) if (output / STUDY_FILE).exists() else {}
        check_folder(output, study, versions)
        seconds, why = seconds_by_runs(study, output, versions), "as those that are done"
    if seconds is None:
        seconds = seconds_by_size(study.scenario, checked_model(study.scenario))
        why = f"to a factor of {FACTOR:g}, by the size of the model"
    whole = _duration(seconds * study.settings.runs / min(jobs, study.settings.runs))
    at_a_time = "one run at a time" if jobs == 1 else f"{jobs} runs at a time on as many cores"
    return f"{_duration(seconds)} for a run and {whole} for all, with {at_a_time}: {why}"


def _duration(seconds: float) -> str:
    for unit, length in (("days", 86400.0), ("hours", 3600.0), ("minutes", 60.0)):
        if seconds >= 2.0 * length:
            return f"{seconds / length:.2g} {unit}" if seconds < 10.0 * length else f"{seconds / length:.0f} {unit}"
    return f"{seconds:.2g} s" if seconds < 10.0 else f"{seconds:.0f} s"


def _shown(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
