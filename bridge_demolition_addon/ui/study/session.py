"""The study that is at work beside Blender, and the one whose map is shown: there is one of each at most.

Draws run in processes of their own. Blender looks in on them a few times a second, and answers the user meanwhile.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import bpy
import numpy as np
from manifold3d import CrossSection

from ...display.ground_lines import map_triangles, outline_lines
from ...errors import DemolitionError, text_of
from ...model.study.file import Ensemble, Study
from ...report.ensemble.study_folder import read_study_runs
from ...report.ensemble.study_runs import StudyRuns
from ...report.wording.study import study_sentences
from ...studies.engine import LocalProcesses
from ...studies.run_process import RunLimits
from ...studies.run_program import run_program_command
from ...studies.session import EnsembleSession
from ...studies.versions import versions_with
from .prop import redraw_views

_LOOK_EVERY_S = 0.3

_at_work: list[StudyAtWork] = []
_shown: list[ShownStudy] = []
_ended: list[str] = []
"""Why the last study ended before its end, if it did."""


@dataclass(frozen=True, slots=True, eq=False)
class ShownStudy:
    """A study that the panel tells of and the 3D view shows.

    Attributes
    ----------
    runs
        The study and its runs.
    sentences
        What it says.
    triangles
        Cells that runs hit: corners (3 k, 3), m, and their colours (3 k, 4).
    limit_lines : (2 k, 3) float
        Lines around what holds the limit, m; none before all runs are there.
    """

    runs: StudyRuns
    sentences: tuple[str, ...]
    triangles: tuple[np.ndarray, np.ndarray]
    limit_lines: np.ndarray

    @classmethod
    def of(cls, runs: StudyRuns) -> ShownStudy:
        """Work out what is shown of a study."""
        total = runs.study.settings.runs
        said = (f"{len(runs.table)} of {total} draws are there: a study says nothing before all of them are.",)
        if runs.said:
            said = tuple(study_sentences(runs.study, runs.said))
        triangles = map_triangles(runs.map) if runs.map else (np.zeros((0, 3)), np.zeros((0, 4)))
        return cls(runs, said, triangles, outline_lines(runs.limit or CrossSection()))


class StudyAtWork:
    """A study whose draws are run.

    Parameters
    ----------
    study
        What is asked.
    path
        Its folder.
    jobs
        Draws at a time.

    Raises
    ------
    OutputError
        The folder is another's, or cannot be written.
    """

    def __init__(self, study: Study, path: Path, jobs: int):
        self.path = path
        self.run = EnsembleSession(study, path, engine_for(study, jobs))

    def end(self) -> None:
        """End all draws at work, and keep the table of those that have ended; once more is nothing."""
        self.run.stop()

    def finish(self) -> None:
        """Keep what follows from all draws."""
        self.run.finish()


def engine_for(study: Ensemble, jobs: int) -> LocalProcesses:
    """Return what runs the draws of a study, each in a Blender like this one, some at a time."""
    limits = RunLimits.of(study.settings)
    command = run_program_command(bpy.app.binary_path)  # an empty path where Blender is a module of Python
    return LocalProcesses(jobs, limits, command, versions_with(".".join(map(str, bpy.app.version))))


def begin(study: Study, path: Path, jobs: int) -> None:
    """Begin a study, or go on with it.

    Raises
    ------
    OutputError
        Its folder is another's, or cannot be written.
    """
    _ended.clear()
    _at_work.append(StudyAtWork(study, path, jobs))
    if not bpy.app.timers.is_registered(look_in):
        bpy.app.timers.register(look_in, persistent=True)


def study_at_work() -> StudyAtWork | None:
    """Return the study that is at work, None where none is."""
    return _at_work[0] if _at_work else None


def end(why: str = "") -> None:
    """End the study at work, if there is one; what is done is kept."""
    _ended[:] = [why] if why else []
    if _at_work:
        _at_work.pop().end()


def why_ended() -> str:
    """Return why the last study ended before its end; empty where it did not, or was stopped by the user."""
    return _ended[0] if _ended else ""


def show(path: Path) -> ShownStudy:
    """Show the study in a folder, in place of any other.

    Raises
    ------
    OutputError
        There is none, or no run of it finished.
    """
    _shown[:] = [ShownStudy.of(read_study_runs(path))]
    redraw_views(bpy.context)
    return _shown[0]


def shown_study() -> ShownStudy | None:
    """Return the study whose map is shown, None where none is."""
    return _shown[0] if _shown else None


def look_in() -> float | None:
    """Take in what draws came to since the last look; called by Blender's timer, which gets when to call again."""
    if not _at_work:
        return None
    at_work = _at_work[0]
    before = at_work.run.done
    try:
        at_work.run.step(0.0)
        if at_work.run.is_finished:
            _at_work.clear()
            at_work.finish()
            show(at_work.path)
    except (DemolitionError, OSError) as error:
        _end_for(error, at_work)
    if at_work.run.done != before or not _at_work:
        redraw_views(bpy.context)
    return _LOOK_EVERY_S if _at_work else None


def unregister() -> None:
    """End the study at work, and forget the one that is shown."""
    if bpy.app.timers.is_registered(look_in):
        bpy.app.timers.unregister(look_in)
    end()
    _shown.clear()


def _end_for(error: Exception, at_work: StudyAtWork) -> None:
    """End a study that cannot go on, and remember why; its folder is free then, whatever can still be written."""
    _at_work.clear()
    _ended[:] = [text_of(error)]
    try:
        at_work.end()
    except OSError as other:
        _ended[:] = [f"{text_of(error)}; {text_of(other)}"]
