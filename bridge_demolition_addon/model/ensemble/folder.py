"""The folder of a study, a search or an optimisation: what was asked, the outcome of each run, tables and results.

A run lies in ``draws/`` under the digest of everything that it depends on. It appears there whole, once it has ended,
so that a crash or a kill at any moment loses no more than the runs that are under way. This module writes the folder
and reads it.
"""

from __future__ import annotations

import json
import os
import shutil
import zipfile
import zlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from ...errors import Faults, OutputError, ScenarioError, UnreadableError
from ...system.array_files.archive import read_archive
from ...system.disk import own_folder, write_whole_text, writing
from ...system.folder_lock import LOCK_FILE, FolderLock, check_unlocked
from ...system.reading import MEGABYTE, check_file, file_text
from ..optimise.conclusions import Best, best_of, tried_candidates, write_candidates
from ..optimise.file import Optimisation, read_optimisation
from ..run_folder.files import SCENARIO_FILE
from ..search.conclusions import Answer, answer_of, write_curve
from ..search.file import Search, read_search
from ..study.conclusions import Conclusions, conclusions
from ..study.file import (
    CANDIDATES_FILE,
    CURVE_FILE,
    OPTIMISE_FILE,
    OUTCOME_FILE,
    OUTLINES_FILE,
    RUNS_FOLDER,
    SEARCH_FILE,
    SHEET_FILE,
    SIMULATED_FILE,
    STUDY_FILE,
    VERSIONS_FILE,
    Ensemble,
    Study,
    read_study,
)
from ..study.outcome import Outlines
from ..study.runs_table import (
    DONE,
    KILLED,
    OUT_OF_MEMORY,
    STATUSES,
    RunOutcome,
    RunsTable,
    cells_of,
    read_runs,
    write_runs,
    write_sheet,
)
from ..toml_tables import document_of_file

EnsembleResult = Conclusions | Answer | Best
"""Statements of an ensemble: numbers, which ``report/wording`` puts into sentences."""

RETRIED = (KILLED, OUT_OF_MEMORY)
"""Outcomes that are worth retrying: a user, or a lack of memory, ended the run. All others stay."""

_READERS: dict[str, Callable[[Path], Ensemble]] = {
    STUDY_FILE: read_study,
    SEARCH_FILE: read_search,
    OPTIMISE_FILE: read_optimisation,
}
_PART = ".part"
_MOST_BYTES = 100 * MEGABYTE
_NOT_OUTLINES = (OSError, RuntimeError, ValueError, KeyError, zipfile.BadZipFile, zlib.error)
_GO_ON = "go on with the command that started the"


class EnsembleFolder:
    """The folder of an ensemble, new or begun, which only its holder writes to until it is released.

    Its runs are made with `versions`. Nothing is changed in a folder of another ensemble or version, or of a process
    that is at work in it.
    """

    def __init__(self, path: Path, ensemble: Ensemble, versions: Mapping[str, str]):
        self.path, self.ensemble, self.versions = path, ensemble, dict(versions)
        check_folder(path, ensemble, versions)
        with writing(path):
            path.mkdir(parents=True, exist_ok=True)
            own_folder(self._runs)
        self._lock = FolderLock(path)
        try:
            with writing(path):
                self._clear_parts()
                self._write_settings()
        except BaseException:
            self._lock.release()
            raise

    def work_folder(self, cache_key: str) -> Path:
        """Return where a run's files are written while it is under way, unique to this process.

        What another process left there that had simulated it, and not evaluated it, is in it.
        """
        part = self._runs / f"{cache_key}-{os.getpid()}{_PART}"
        for left in self._runs.glob(f"{cache_key}-*{_PART}"):
            if left != part and not part.exists():
                os.replace(left, part)
        return part

    def outcome_of(self, cache_key: str) -> RunOutcome | None:
        """Return the outcome of a run; None where it is still to be made."""
        return outcome_in(self._runs / cache_key)

    def keep(self, cache_key: str, inputs: Mapping[str, Any], outcome: RunOutcome) -> None:
        """Keep the outcome of a run, with all files in its work folder, whole or not at all."""
        part, target = self.work_folder(cache_key), self._runs / cache_key
        if outcome.status in RETRIED:
            _clear_part(part)
            return
        part.mkdir(exist_ok=True)
        kept = {
            "inputs": dict(inputs),
            "status": outcome.status,
            "reason": outcome.reason,
            "outputs": dict(outcome.outputs),
            "fingerprint": dict(outcome.fingerprint),
            "wall_time_s": round(outcome.wall_time_s, 3),
        }
        write_whole_text(part / OUTCOME_FILE, json.dumps(kept, indent=1) + "\n")
        if target.exists():  # damaged, as by a loss of power
            shutil.rmtree(target)
        os.replace(part, target)

    def write_tables(self, table: RunsTable) -> list[Path]:
        """Write the tables of the runs that count so far, and return their paths."""
        paths = [self.path / self.ensemble.table_file]
        write_runs(table, paths[0])
        match self.ensemble:
            case Study() if write_sheet(table, self.path / SHEET_FILE):
                paths.append(self.path / SHEET_FILE)
            case Optimisation():
                paths.append(self.path / CANDIDATES_FILE)
                write_candidates(tried_candidates(self.ensemble, table), paths[-1])
        return paths

    def write_result(self, result: EnsembleResult) -> list[Path]:
        """Write the result of the ensemble, and return the paths of the files."""
        paths = [self.path / self.ensemble.result_file]
        write_whole_text(paths[0], json.dumps({**result.as_json(), "versions": self.versions}, indent=2) + "\n")
        if isinstance(result, Answer) and result.curve is not None:
            paths.append(self.path / CURVE_FILE)
            write_curve(result.curve, paths[-1])
        return paths

    def release(self) -> None:
        """Let others write to the folder."""
        self._clear_parts()
        self._lock.release()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.release()

    @property
    def _runs(self) -> Path:
        return self.path / RUNS_FOLDER

    def _write_settings(self) -> None:
        """Write the settings of a new folder, or the number of runs where it was raised."""
        settings_path = self.path / self.ensemble.file_name
        if not settings_path.exists():
            write_whole_text(self.path / VERSIONS_FILE, json.dumps(self.versions, indent=2) + "\n")
            write_whole_text(self.path / SCENARIO_FILE, self.ensemble.scenario_text)
        if not settings_path.exists() or _text(settings_path) != self.ensemble.text:
            write_whole_text(settings_path, self.ensemble.text)  # last: it says whose folder this is

    def _clear_parts(self) -> None:
        for part in self._runs.glob(f"*{_PART}"):
            _clear_part(part)


def _clear_part(part: Path) -> None:
    """Remove what a run left that did not end, unless it was simulated to its end: that is evaluated later."""
    if part.is_symlink():
        part.unlink()
    elif not (part / SIMULATED_FILE).exists():
        shutil.rmtree(part, ignore_errors=True)


def check_folder(path: Path, ensemble: Ensemble, versions: Mapping[str, str]) -> None:
    """Check that a folder is new, or of that very ensemble apart from its number of runs, without changing anything."""
    with writing(path):
        if path.exists() and not path.is_dir():
            raise OutputError(f"{path}: expected a folder for the {ensemble.kind}, found a file")
        if not path.exists():
            return
        check_unlocked(path)
        if not (path / ensemble.file_name).exists():
            _check_empty(path, ensemble)
            return
    begun = versions_of(path)
    differing = [
        f"{name} {begun.get(name)}" for name in sorted({*begun, *versions}) if begun.get(name) != versions.get(name)
    ]
    if differing:
        raise OutputError(
            f"{path}: was begun with {', '.join(differing)}, which is another version here: go on with that one, or "
            "choose another folder"
        )
    is_same = _without_counts(_text(path / ensemble.file_name), ensemble) == _without_counts(ensemble.text, ensemble)
    if not is_same or _text(path / SCENARIO_FILE) != ensemble.scenario_text:
        name = SCENARIO_FILE if is_same else ensemble.file_name
        raise OutputError(
            f"{path}: was begun with another {ensemble.kind} or scenario, see {name} there: go on with the same, or "
            "choose another folder"
        )


def holds_ensemble(folder: Path, file_name: str = "") -> bool:
    """Return whether a folder holds an ensemble, of any kind or of the kind with this file of settings."""
    return _file_name_in(folder) in ((file_name,) if file_name else _READERS)


def ensemble_of_file(path: Path) -> Ensemble:
    """Read the file of a study, a search or an optimisation, whichever its heading says."""
    try:
        document = document_of_file(path, "a study", faults=Faults())
    except ScenarioError:  # the reader below says so, with the file's name
        document = {}
    name = next((name for name in _READERS if Path(name).stem in document), STUDY_FILE)
    return _READERS[name](path)


def ensemble_in(folder: Path) -> Ensemble:
    """Return the study, the search or the optimisation of a folder."""
    name = _file_name_in(folder)
    if name is None:
        raise OutputError(f"{folder}: expected the folder of a study, with {STUDY_FILE} in it")
    try:
        return _READERS[name](folder / name)
    except ScenarioError as error:
        raise OutputError(str(error)) from error


def study_in(folder: Path) -> Study:
    """Return the study of a folder."""
    ensemble = ensemble_in(folder)
    if not isinstance(ensemble, Study):
        raise OutputError(f"{folder}: expected the folder of a study, with {STUDY_FILE} in it")
    return ensemble


@dataclass(frozen=True, eq=False)
class EnsembleRuns:
    """An ensemble and its runs that count so far, as read from its folder."""

    folder: Path
    ensemble: Ensemble
    table: RunsTable
    versions: Mapping[str, str]  # that they were made with, by name

    @property
    def name(self) -> str:
        """Name of the folder."""
        return self.folder.resolve().name

    def result(self) -> EnsembleResult:
        """Return the result of the runs; all of them have to be there."""
        return result_of_runs(self.ensemble, self.table)

    def run_folders(self) -> dict[int, Path]:
        """Return the folders of finished runs, by their numbers.

        Their inputs identify them: cache keys depend on the version that made the runs, which may be another.
        """
        names, by_inputs = self.table.inputs, {}
        for path in (self.folder / RUNS_FOLDER).glob(f"*/{OUTCOME_FILE}"):
            if done := self._inputs_of_done(path):
                by_inputs[cells_of(done, names)] = path.parent
        folders = {}
        for row in self.table.rows:
            if row.status != DONE:
                continue
            inputs = cells_of(row.inputs, names)
            if inputs not in by_inputs:
                where = f"{self.folder / RUNS_FOLDER}: run {row.number} of {self.ensemble.table_file}"
                raise OutputError(f"{where} is not there: {self._go_on}")
            folders[row.number] = by_inputs[inputs]
        return folders

    def outlines_in(self, run_folder: Path) -> Outlines:
        """Return what debris covered in a run, by its folder."""
        path = run_folder / OUTLINES_FILE
        try:
            check_file(path, _MOST_BYTES)
            return Outlines.of_arrays(read_archive(path))
        except (UnreadableError, *_NOT_OUTLINES) as error:
            raise OutputError(
                f"{path}: expected what debris covered in a run ({error}): delete {run_folder}, and {self._go_on}"
            ) from error

    @property
    def _go_on(self) -> str:
        return f"{_GO_ON} {self.ensemble.kind}"

    def _inputs_of_done(self, path: Path) -> dict[str, Any] | None:
        """Return the inputs of a run that finished, None of another."""
        try:
            kept = json.loads(file_text(path, _MOST_BYTES))
            return dict(kept["inputs"]) if kept["status"] == DONE else None
        except (UnreadableError, ValueError, KeyError, TypeError) as error:
            raise OutputError(
                f"{path}: expected the outcome of a run ({error}): delete {path.parent}, and {self._go_on}"
            ) from error


def read_ensemble(folder: Path) -> EnsembleRuns:
    """Read a study, a search or an optimisation, and its runs."""
    ensemble = ensemble_in(folder)
    path = folder / ensemble.table_file
    if not path.exists():
        raise OutputError(f"{folder}: holds no {ensemble.table_file} yet: {_GO_ON} {ensemble.kind}")
    table = read_runs(path)
    if not len(table):
        raise OutputError(f"{folder}: no run of this {ensemble.kind} is there yet: {_GO_ON} {ensemble.kind}")
    return EnsembleRuns(folder, ensemble, table, versions_of(folder))


def result_of_runs(ensemble: Ensemble, table: RunsTable) -> EnsembleResult:
    """Return the result of an ensemble."""
    try:
        match ensemble:
            case Study():
                return conclusions(ensemble, table)
            case Search():
                result = answer_of(ensemble, table)
                if result.ended_as is None:
                    raise OutputError(
                        f"{len(table)} of up to {ensemble.settings.trials} runs are there: {_GO_ON} search"
                    )
                return result
            case _:
                assert isinstance(ensemble, Optimisation)
                return best_of(ensemble, table)
    except StopIteration:
        raise OutputError(f"no run of the confirmation is there yet: {_GO_ON} {ensemble.kind}") from None
    except (KeyError, TypeError, ValueError) as error:
        raise OutputError(f"{ensemble.table_file} is damaged ({error}): {_GO_ON} {ensemble.kind}") from error


def outcome_in(run_folder: Path) -> RunOutcome | None:
    """Return the outcome of a run by its folder; None where it is not there or damaged."""
    try:
        kept = json.loads((run_folder / OUTCOME_FILE).read_text(encoding="utf-8"))
        outcome = RunOutcome(
            kept["status"], kept["reason"], kept["outputs"], kept["fingerprint"], float(kept["wall_time_s"])
        )
        return outcome if outcome.status in STATUSES else None
    except (FileNotFoundError, NotADirectoryError, ValueError, KeyError, TypeError):
        return None


def versions_of(folder: Path) -> dict[str, str]:
    """Return the versions that a study was begun with."""
    try:
        return dict(json.loads(_text(folder / VERSIONS_FILE)))
    except (ValueError, TypeError) as error:
        raise OutputError(
            f"{folder / VERSIONS_FILE}: expected the versions that the runs were made with ({error})"
        ) from error


def _file_name_in(folder: Path) -> str | None:
    """Name of the file of settings in a folder that was begun; None in another."""
    return next((name for name in _READERS if (folder / name).is_file() and (folder / VERSIONS_FILE).is_file()), None)


def _without_counts(text: str, ensemble: Ensemble) -> list[str]:
    """Lines of a file of settings without the numbers of runs, which may be raised later."""
    counts = ensemble.settings.raised_later
    return [line for line in text.splitlines() if line.partition(" = ")[0] not in counts]


def _check_empty(path: Path, ensemble: Ensemble) -> None:
    """Refuse a folder that holds more than what is left where an ensemble was killed as it began."""
    ours = {VERSIONS_FILE, SCENARIO_FILE, RUNS_FOLDER, LOCK_FILE}
    for inner in path.iterdir():
        if inner.name not in ours or (inner.name == RUNS_FOLDER and any(inner.iterdir())):
            raise OutputError(
                f"{path}: exists already and is not the folder of a {ensemble.kind}: choose another folder"
            )


def _text(path: Path) -> str:
    try:
        return file_text(path, _MOST_BYTES)
    except UnreadableError as error:
        raise OutputError(f"{path}: {error}") from error
