"""What ``bda study --check`` prints: some draws, and how long all of them take."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ..model.sequence.checked_model import checked_model
from ..model.study.draws import inputs_of
from ..model.study.file import Study
from ..model.study.files import STUDY_FILE
from ..studies.estimate import FACTOR, seconds_by_draws, seconds_by_size
from ..studies.folder import check_study_folder, versions_of

_SHOWN_DRAWS = 5


def study_facts(study: Study, output: Path | None, jobs: int) -> Iterator[str]:
    """Yield lines on the draws of a study, and on how long so many jobs take; of a folder, by what is done in it."""
    settings = study.settings
    yield study.scenario.title
    yield ""
    yield f"{settings.runs} draws, of which the first are:"
    for number in range(1, min(settings.runs, _SHOWN_DRAWS) + 1):
        values = ", ".join(f"{name} {_shown(value)}" for name, value in inputs_of(study, number).items())
        yield f"{number:>5}  {values}"
    yield ""
    yield _estimate(study, output, jobs)


def _estimate(study: Study, output: Path | None, jobs: int) -> str:
    """Return how long all draws take, by those that are done or else by the size of the model."""
    seconds, why = None, ""
    if output is not None and output.exists():
        versions = versions_of(output) if (output / STUDY_FILE).exists() else {}
        check_study_folder(output, study, versions)
        seconds, why = seconds_by_draws(study, output, versions), "as those that are done"
    if seconds is None:
        seconds = seconds_by_size(study.scenario, checked_model(study.scenario))
        why = f"to a factor of {FACTOR:g}, by the size of the model"
    whole = _duration(seconds * study.settings.runs / min(jobs, study.settings.runs))
    at_a_time = "one draw at a time" if jobs == 1 else f"{jobs} draws at a time on as many cores"
    return f"{_duration(seconds)} for a draw and {whole} for all, with {at_a_time}: {why}"


def _duration(seconds: float) -> str:
    for unit, length in (("days", 86400.0), ("hours", 3600.0), ("minutes", 60.0)):
        if seconds >= 2.0 * length:
            return f"{seconds / length:.2g} {unit}" if seconds < 10.0 * length else f"{seconds / length:.0f} {unit}"
    return f"{seconds:.2g} s" if seconds < 10.0 else f"{seconds:.0f} s"


def _shown(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
