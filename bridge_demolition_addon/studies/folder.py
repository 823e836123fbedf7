"""The folder of a study: what was asked, what became of each draw, and tables of all of them.

A draw lies in ``draws/`` under the digest of all that it depends on. It appears there whole, once it has ended, so that
whatever ends the study, at any moment, loses no more than the draws that are at work.
"""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from ..errors import OutputError, ScenarioError, UnreadableError
from ..model.optimise.file import Optimisation
from ..model.run_folder.files import SCENARIO_FILE
from ..model.search.file import Search
from ..model.study.file import Study, read_study
from ..model.study.files import DRAW_FOLDER, OUTCOME_FILE, STUDY_FILE, VERSIONS_FILE
from ..model.study.runs_table import KILLED, OUT_OF_MEMORY, STATUSES
from ..system.disk import write_whole_text, writing
from ..system.folder_lock import LOCK_FILE, FolderLock, check_unlocked
from ..system.reading import MEGABYTE, file_text
from .draw_process import End

_PART = ".part"
TRIED_AGAIN = (KILLED, OUT_OF_MEMORY)
"""What somebody, or a lack of memory, did to a draw: it need not be so once more. All else is as it is."""

_MOST_BYTES = 10 * MEGABYTE


class StudyFolder:
    """The folder of a study, which only its holder writes to until it is released.

    Parameters
    ----------
    path
        Where it is or is to be.
    study
        What is asked: a study, a search or an optimisation.
    versions
        What its draws are run with.

    Raises
    ------
    OutputError
        It is of another study or another version, is no folder of a study, or cannot be written; or another process
        is at work in it. Nothing in it is changed then.
    """

    def __init__(self, path: Path, study: Study | Search | Optimisation, versions: Mapping[str, str]):
        self.path = path
        check_study_folder(path, study, versions)
        with writing(path):
            self.draws.mkdir(parents=True, exist_ok=True)
        self._lock = FolderLock(path)
        try:
            with writing(path):
                self._clear_parts()
                if not (path / study.file_name).exists():
                    write_whole_text(path / VERSIONS_FILE, json.dumps(dict(versions), indent=2) + "\n")
                    write_whole_text(path / SCENARIO_FILE, study.scenario_text)
                    write_whole_text(
                        path / study.file_name, study.text
                    )  # last: it says that the folder is one of a study
        except BaseException:
            self._lock.release()
            raise

    @property
    def draws(self) -> Path:
        """Where the draws are."""
        return self.path / DRAW_FOLDER

    def draw(self, address: str) -> Path:
        """Return where a draw is, once it has ended."""
        return self.draws / address

    def work_folder(self, address: str) -> Path:
        """Return where a draw's files are written while it is at work; no process of a study that was killed does."""
        return self.draws / f"{address}-{os.getpid()}{_PART}"

    def end_of(self, address: str) -> End | None:
        """Return what became of a draw; None where it is still to be run."""
        return end_in(self.draw(address))

    def keep(self, address: str, inputs: Mapping[str, Any], end: End) -> None:
        """Keep what became of a draw, with all files in its work folder, whole or not at all.

        Raises
        ------
        OSError
            The disk is full, for one. The draw is as one that was not run.
        """
        part, place = self.work_folder(address), self.draw(address)
        if end.status in TRIED_AGAIN:
            shutil.rmtree(part, ignore_errors=True)
            return
        part.mkdir(exist_ok=True)
        outcome = {
            "inputs": dict(inputs),
            "status": end.status,
            "reason": end.reason,
            "outputs": dict(end.outputs),
            "fingerprint": dict(end.fingerprint),
            "wall_time_s": round(end.wall_time_s, 3),
        }
        write_whole_text(part / OUTCOME_FILE, json.dumps(outcome, indent=1) + "\n")
        if place.exists():  # what is damaged there, as by a loss of power
            shutil.rmtree(place)
        os.replace(part, place)

    def release(self) -> None:
        """Let others write to the folder."""
        self._clear_parts()
        self._lock.release()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None):
        self.release()

    def _clear_parts(self) -> None:
        for part in self.draws.glob(f"*{_PART}"):
            shutil.rmtree(part, ignore_errors=True)


def end_in(draw: Path) -> End | None:
    """Return what became of a draw by its folder; None where it is not there or damaged."""
    try:
        kept = json.loads((draw / OUTCOME_FILE).read_text(encoding="utf-8"))
        end = End(kept["status"], kept["reason"], kept["outputs"], kept["fingerprint"], float(kept["wall_time_s"]))
        return end if end.status in STATUSES else None
    except (FileNotFoundError, NotADirectoryError, ValueError, KeyError, TypeError):
        return None


def check_study_folder(path: Path, study: Study | Search | Optimisation, versions: Mapping[str, str]) -> None:
    """See that a folder is new, or of that very study, search or optimisation, without changing anything.

    Raises
    ------
    OutputError
        It is neither, or another process is at work in it.
    """
    with writing(path):
        if path.exists() and not path.is_dir():
            raise OutputError(f"{path}: expected a folder for the study, found a file")
        if not path.exists():
            return
        check_unlocked(path)
        if not (path / study.file_name).exists():
            _check_empty(path)
            return
    if _text(path / study.file_name) != study.text or _text(path / SCENARIO_FILE) != study.scenario_text:
        name = SCENARIO_FILE if _text(path / study.file_name) == study.text else study.file_name
        raise OutputError(
            f"{path}: was begun with another study or scenario, see {name} there: go on with the same, or choose "
            "another folder"
        )
    begun = versions_of(path)
    differing = [
        f"{name} {begun.get(name)}" for name in sorted({*begun, *versions}) if begun.get(name) != versions.get(name)
    ]
    if differing:
        raise OutputError(
            f"{path}: was begun with {', '.join(differing)}, which is another version here: go on with that one, or "
            "choose another folder"
        )


def study_in(path: Path) -> Study:
    """Return the study of a folder.

    Raises
    ------
    OutputError
        It has none.
    """
    if not (path / STUDY_FILE).is_file():
        raise OutputError(f"{path}: expected the folder of a study, with {STUDY_FILE} in it")
    try:
        return read_study(path / STUDY_FILE)
    except ScenarioError as error:
        raise OutputError(str(error)) from error


def versions_of(path: Path) -> dict[str, str]:
    """Return the versions that a study was begun with."""
    try:
        return dict(json.loads(_text(path / VERSIONS_FILE)))
    except ValueError as error:
        raise OutputError(f"{path / VERSIONS_FILE}: expected the versions of a study ({error})") from error


def _check_empty(path: Path) -> None:
    """Refuse a folder that holds what is not of a study that was killed as it began."""
    ours = {VERSIONS_FILE, SCENARIO_FILE, DRAW_FOLDER, LOCK_FILE}
    for each in _names(path):
        if each not in ours or (each == DRAW_FOLDER and any((path / each).iterdir())):
            raise OutputError(f"{path}: exists already and is not the folder of a study: choose another folder")


def _names(path: Path) -> Iterator[str]:
    return (each.name for each in path.iterdir())


def _text(path: Path) -> str:
    try:
        return file_text(path, _MOST_BYTES)
    except UnreadableError as error:
        raise OutputError(f"{path}: {error}") from error
