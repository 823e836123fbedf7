"""Read the folder of a study, as `bda study` leaves it."""

from __future__ import annotations

import json
import zipfile
import zlib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from manifold3d import CrossSection

from ...engineering.geometry.plan_areas import united
from ...errors import OutputError, ScenarioError, UnreadableError
from ...model.study.file import read_study
from ...model.study.files import (
    AGAIN_FOLDER,
    DRAW_FOLDER,
    OUTCOME_FILE,
    OUTLINES_FILE,
    RUN_FOLDER,
    RUNS_FILE,
    STUDY_FILE,
    VERSIONS_FILE,
)
from ...model.study.outcome import Outlines
from ...model.study.runs_table import DONE, RunsTable, cells_of, read_runs
from ...system.array_files.archive import read_archive
from ...system.reading import MEGABYTE, check_file, file_text
from ..run_folder import pictures_in
from .study_runs import StudyRuns

_MOST_BYTES = 100 * MEGABYTE
_NOT_OUTLINES = (OSError, RuntimeError, ValueError, KeyError, zipfile.BadZipFile, zlib.error)
_GO_ON = "go on with the command that started the study"
_BEYOND_M2 = 1e-3
"""Area by which the plan of a bridge has to stick out of others to be another one."""


def is_study(folder: Path) -> bool:
    """Return whether a folder is one of a study."""
    return (folder / STUDY_FILE).is_file() and (folder / VERSIONS_FILE).is_file()


def read_study_runs(folder: Path) -> StudyRuns:
    """Read a study and its runs.

    Raises
    ------
    OutputError
        The folder is none of a study, no run of it is there, or what is kept of one cannot be read.
    """
    try:
        study = read_study(folder / STUDY_FILE)
    except ScenarioError as error:
        raise OutputError(str(error)) from error
    if not (folder / RUNS_FILE).exists():
        raise OutputError(f"{folder}: holds no {RUNS_FILE} yet: {_GO_ON}")
    table = read_runs(folder / RUNS_FILE)
    if not len(table):
        raise OutputError(f"{folder}: no run of this study is there yet: {_GO_ON}")
    draws = _draw_folders(folder / DRAW_FOLDER, table)
    outlines = {number: _outlines(draw) for number, draw in draws.items()}
    return StudyRuns(
        name=folder.resolve().name,
        study=study,
        table=table,
        swept=[outlines[row.number].swept if row.number in outlines else None for row in table.rows],
        bridge=_common_plan(each.bridge for each in outlines.values()),
        pictures=_pictures(folder, draws),
        versions=_versions(folder / VERSIONS_FILE),
    )


def _draw_folders(draws: Path, table: RunsTable) -> dict[int, Path]:
    """Return the folders of all draws that finished, by their numbers.

    They are known by their inputs: their addresses depend on the version that ran them, which may be another than this.
    """
    by_inputs = {}
    for path in draws.glob(f"*/{OUTCOME_FILE}"):
        if inputs := _inputs_of_done(path):
            by_inputs[cells_of(inputs, table.inputs)] = path.parent
    found = {}
    for row in table.rows:
        if row.status == DONE:
            draw = by_inputs.get(cells_of(row.inputs, table.inputs))
            if draw is None:
                raise OutputError(f"{draws}: draw {row.number} of {RUNS_FILE} is not there: {_GO_ON}")
            found[row.number] = draw
    return found


def _inputs_of_done(path: Path) -> dict[str, Any] | None:
    """Return the inputs of a draw that finished, None of another."""
    try:
        kept = json.loads(file_text(path, _MOST_BYTES))
        return dict(kept["inputs"]) if kept["status"] == DONE else None
    except (UnreadableError, ValueError, KeyError, TypeError) as error:
        raise OutputError(
            f"{path}: expected what came of a draw ({error}): delete {path.parent}, and {_GO_ON}"
        ) from error


def _versions(path: Path) -> dict[str, str]:
    try:
        return dict(json.loads(file_text(path, _MOST_BYTES)))
    except (UnreadableError, ValueError, TypeError) as error:
        raise OutputError(f"{path}: expected the versions that the study was run with ({error})") from error


def _outlines(draw: Path) -> Outlines:
    path = draw / OUTLINES_FILE
    try:
        check_file(path, _MOST_BYTES)
        return Outlines.of_arrays(read_archive(path))
    except (UnreadableError, *_NOT_OUTLINES) as error:
        raise OutputError(
            f"{path}: expected what debris covered in a run ({error}): delete {draw}, and {_GO_ON}"
        ) from error


def _common_plan(plans: Iterable[Iterable]) -> CrossSection:
    """Return what bridges cover together; nearly always all of them the same."""
    common = CrossSection()
    for rings in plans:
        plan = CrossSection(list(rings))
        if (plan - common).area() > _BEYOND_M2:
            common = united([common, plan])
    return common


def _pictures(folder: Path, draws: Mapping[int, Path]) -> dict[int, dict[str, Path]]:
    """Return pictures of draws that were run once more, or of which everything was kept, by number and name."""
    found = {}
    for number, draw in draws.items():
        for run in (folder / AGAIN_FOLDER / str(number), draw / RUN_FOLDER):
            if pictures := pictures_in(run, []):
                found[number] = pictures
                break
    return found
