"""Studies, searches and optimisations at work outside Blender, and the results of the ones that ended last.

There is one of each kind at most. Runs are made in processes of their own. A few times a second Blender looks for those
that have ended, and answers the user meanwhile.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import bpy

from ...errors import DemolitionError, text_of
from ...model.scenario import Scenario
from ...model.study.file import Ensemble
from ...model.study.settings import EnsembleSettings
from ...studies.engine import LocalProcesses
from ...studies.run_process import RunLimits
from ...studies.run_program import run_program_command
from ...studies.session import EnsembleSession
from ...studies.versions import versions_with
from ..languages.words import translated
from ..scenario.built import panels_show
from ..task_progress import time_left_text
from ..viewport import redraw_views

_LOOK_EVERY_S = 0.3


class ShownResult(Protocol):
    """Result of runs as sentences, which a panel shows."""

    @property
    def sentences(self) -> tuple[str, ...]: ...


@dataclass(frozen=True, slots=True)
class SentencesAndPicture:
    """Result of a search or an optimisation."""

    sentences: tuple[str, ...]
    picture: Path | None

    @classmethod
    def of(cls, session: EnsembleSession, sentences: Iterable[str], picture: str) -> SentencesAndPicture:
        """Return the result of a session that has ended; the picture is there where it was drawn."""
        lost = [f"{session.planner.lost} runs did not finish, and count as no success"] if session.planner.lost else []
        path = session.folder.path / picture
        return cls((*sentences, *lost), path if path.exists() else None)


class Work:
    """The session of one kind that is at work, if any, and the result that is shown.

    Parameters
    ----------
    key
        Begin of its properties' names in the scene, and end of its buttons' names: ``optimise``.
    name
        Its name in messages: ``optimisation``.
    settings_class
        Keys of its files.
    shown
        Returns what is shown of a session that has ended.

    Attributes
    ----------
    scenario : Scenario or None
        What the session, or else the result, is of.
    why_ended : str
        Error that ended the last session; empty where there was none.
    """

    def __init__(
        self,
        key: str,
        name: str,
        settings_class: type[EnsembleSettings],
        shown: Callable[[EnsembleSession], ShownResult],
    ):
        self.key, self.name, self.settings_class, self._shown = key, name, settings_class, shown
        self.session: EnsembleSession | None = None
        self.result: ShownResult | None = None
        self.scenario: Scenario | None = None
        self.why_ended = ""

    def begin(self, ensemble: Ensemble, path: Path, jobs: int) -> None:
        """Begin, or go on where the folder stands; a folder that cannot be used raises DemolitionError."""
        self.why_ended = ""
        self.session = EnsembleSession(ensemble, path, engine_for(ensemble, jobs))
        self.result, self.scenario = None, ensemble.scenario
        if not bpy.app.timers.is_registered(look_in):
            bpy.app.timers.register(look_in, persistent=True)

    def stop(self) -> None:
        """End the session, if there is one; all runs that are done are kept."""
        self.why_ended = ""
        session, self.session = self.session, None
        if session:
            session.stop()

    def is_of_other(self, settings: bpy.types.PropertyGroup) -> bool:
        """Return whether the result that is shown is of other values than the panels show."""
        return bool(self.result and self.scenario and not panels_show(settings, self.scenario))

    def look_in(self) -> None:
        """Take the runs that have ended since the last look."""
        session = self.session
        if session is None:
            return
        before = session.planner.done
        try:
            session.step(0.0)
            if session.planner.is_finished:
                self.session = None
                session.finish()
                self.result = self._shown(session)
        except (DemolitionError, OSError) as error:
            self._end_for(error, session)
        if session.planner.done != before or self.session is None:
            redraw_views()

    def _end_for(self, error: Exception, session: EnsembleSession) -> None:
        """End a session that cannot go on, which unlocks its folder even if nothing more can be written."""
        self.session, self.why_ended = None, text_of(error)
        try:
            session.stop()
        except OSError as other:
            self.why_ended += f"; {text_of(other)}"

    @property
    def progress(self) -> list[str]:
        """The progress in short lines."""
        session = self.session
        done = translated("{} of {} runs, paused") if session.is_paused else translated("{} of {} runs")
        lines = [done.format(session.planner.done, session.planner.total)]
        if session.planner.lost:
            lines.append(translated("{} of them did not finish").format(session.planner.lost))
        if not session.is_paused and session.remaining_s:
            lines.append(time_left_text(session.remaining_s))
        return lines


def look_in() -> float | None:
    """Take the ended runs of every kind, and return when Blender's timer calls again, s."""
    for work in WORKS:
        work.look_in()
    return _LOOK_EVERY_S if any(work.session for work in WORKS) else None


def engine_for(ensemble: Ensemble, jobs: int) -> LocalProcesses:
    """Return processes that make runs, each in a Blender like this one, `jobs` at a time."""
    limits = RunLimits.of(ensemble.settings)
    # An empty path where Blender is a module of Python.
    command = run_program_command(bpy.app.binary_path, one_thread=limits.one_thread)
    versions = versions_with(".".join(map(str, bpy.app.version)))
    return LocalProcesses(jobs, limits, command, versions)


def unregister() -> None:
    """End all sessions, and forget the results."""
    if bpy.app.timers.is_registered(look_in):
        bpy.app.timers.unregister(look_in)
    for work in WORKS:
        work.stop()
        work.result = None


WORKS: list[Work] = []
"""One of each kind, which its module adds."""
