"""The folder that a run keeps its results in."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from ..engineering.ground_motion.record import GroundRecord
from ..errors import OutputError
from ..model.ground_motion.record_file import record_text
from ..model.results.arrays import Results
from ..model.results.files import (
    FORCE_CHART,
    GROUND_MOTION_FILE,
    PICTURE_FOLDER,
    REPORT_FILES,
    RESULT_FILES,
    RESULTS_FILE,
    SCENARIO_FILE,
    SUMMARY_FILE,
    TABLE_FOLDER,
)
from ..model.results.summary import first_hit_s
from ..model.scenario import Scenario
from ..model.scenario.file import read_scenario, scenario_text
from ..system.disk import part_of, write_whole_text, writing
from ..system.folder_lock import FolderLock, check_unlocked

_BLENDERS_LONGEST_PATH = 1023
"""Bytes; Blender cuts off the rest without a word (FILE_MAX in its BLI_path_utils.h is one more)."""


def prepare_folder(folder: Path, *, overwrite: bool) -> FolderLock:
    """Make the folder, or clear it of an earlier run's results and of nothing else, and keep others out of it.

    Raises
    ------
    OutputError
        The folder has something in it and may not be overwritten, is no folder, cannot be written, or another run is at
        work in it.
    """
    check_folder(folder, overwrite=overwrite)
    is_new = not folder.exists()
    with writing(folder):
        folder.mkdir(parents=True, exist_ok=True)
    lock = FolderLock(folder, is_new=is_new)
    try:
        with writing(folder):
            _clear(folder)
    except OutputError:
        lock.release()
        raise
    return lock


def lock_in_place(lock: FolderLock) -> FolderLock:
    """Return the lock of the folder in which a run can still leave its results.

    That is its own. Where it was moved or deleted it is made again, or, where something else is in its place, a folder
    beside it that has a number.
    """
    if lock.in_place:
        return lock
    lock.release()
    place, number = lock.folder, 1
    while place.exists():
        number += 1
        place = lock.folder.with_name(f"{lock.folder.name}_{number}")
    with writing(place):
        (place / PICTURE_FOLDER).mkdir(parents=True)
    return FolderLock(place)


def withdraw_folder(lock: FolderLock) -> None:
    """Take back a folder that was prepared for a run which came to nothing; one that was there before stays."""
    folder = lock.folder
    lock.release()
    for name in RESULT_FILES:
        (folder / name).unlink(missing_ok=True)
    for empty in (folder / PICTURE_FOLDER, *([folder] if lock.is_new else [])):
        if empty.is_dir() and not any(empty.iterdir()):
            empty.rmdir()


def check_folder(folder: Path, *, overwrite: bool) -> None:
    """See that a folder for results is new or empty, or may be overwritten, without changing anything.

    Raises
    ------
    OutputError
        The folder has something in it and may not be overwritten, is no folder, has a path that is too long for
        Blender, or another run is at work in it.
    """
    with writing(folder):
        if folder.exists() and not folder.is_dir():
            raise OutputError(f"{folder}: expected a folder for the results, found a file")
        if folder.exists() and not overwrite and any(folder.iterdir()):
            raise OutputError(f"{folder}: exists already, and is not empty; choose another folder or allow overwriting")
        longest = max(len(os.fsencode(folder.resolve() / name)) for name in RESULT_FILES)
    if (excess := longest - _BLENDERS_LONGEST_PATH) > 0:
        raise OutputError(
            f"{folder}: its path is {excess} bytes too long, as Blender writes to none of more than "
            f"{_BLENDERS_LONGEST_PATH} bytes: choose a shorter one"
        )
    check_unlocked(folder)


def remove_report(folder: Path) -> None:
    """Remove the report that is kept in a folder, with its tables, if there is one: of a new run it would be wrong."""
    for name in REPORT_FILES:
        (folder / name).unlink(missing_ok=True)
    for table in (folder / TABLE_FOLDER).glob("*.csv"):
        table.unlink()


def _clear(folder: Path) -> None:
    """Remove what earlier runs left, parts of files of one that was killed included, and make the inner folder."""
    for name in RESULT_FILES:
        (folder / name).unlink(missing_ok=True)
        part_of(folder / name).unlink(missing_ok=True)
    remove_report(folder)
    (folder / PICTURE_FOLDER).mkdir(exist_ok=True)


def checked_log(path: Path, *, overwrite: bool) -> Path:
    """A file for a log, after seeing that it can be written.

    Raises
    ------
    OutputError
        It is there already and may not be overwritten, is no file, or cannot be written.
    """
    if path.is_dir():
        raise OutputError(f"{path}: expected a file for the log, found a folder")
    if path.exists() and not path.is_file():
        raise OutputError(f"{path}: expected a file for the log, found a pipe or a device")
    if path.exists() and not overwrite:
        raise OutputError(f"{path}: exists already; choose another file or allow overwriting")
    with writing(path):
        existed = path.exists()
        path.open("ab").close()  # the only sure way to know; what is in it stays until it is written
        if not existed:
            path.unlink()
    return path


def keep_scenario(folder: Path, scenario: Scenario, made_by_hand: Sequence[str] = ()) -> None:
    """Write the scenario of a run, and in comments above it what was made by hand and no scenario can say."""
    lines = [f"# Changed in Blender, and not in this scenario: {each}.\n" for each in made_by_hand]
    write_whole_text(folder / SCENARIO_FILE, "".join([*lines, scenario_text(scenario)]))


def keep_site(folder: Path, site: Mapping[str, Any]) -> None:
    """Put other zones, another exclusion zone and the like into the scenario of a run that has one.

    They take no part in the simulation: reports read them there.

    Parameters
    ----------
    folder
        Of the run.
    site
        Values of fields of a scenario.

    Raises
    ------
    OutputError
        The folder is being written to, or cannot be.
    ScenarioError
        Its scenario cannot be read.
    """
    if not (folder / SCENARIO_FILE).is_file():
        return
    kept = read_scenario(folder / SCENARIO_FILE)
    scenario = replace(kept, **site)
    if scenario != kept:
        with FolderLock(folder):
            summary = json.loads((folder / SUMMARY_FILE).read_text(encoding="utf-8"))
            keep_scenario(folder, scenario, summary.get("made_by_hand", ()))


def keep_results(folder: Path, results: Results, summary: dict[str, Any]) -> None:
    """Write arrays, summary and force chart of a recording beside its logs."""
    results.save(folder / RESULTS_FILE)
    keep_summary(folder, summary)
    # Loading matplotlib takes a second, which neither other commands nor switching the add-on on wait for. Where it
    # is missing or broken, the results are written by now.
    from ..charts.force_chart import plot_forces

    plot_forces(results, folder / FORCE_CHART, summary["title"], first_hit_s(summary))


def keep_ground_motion(folder: Path, record: GroundRecord, start_s: float) -> None:
    """Write how the ground moved, from a time on."""
    write_whole_text(folder / GROUND_MOTION_FILE, record_text(record, start_s))


def keep_summary(folder: Path, summary: dict[str, Any]) -> None:
    """Write the summary, in place of one that is there."""
    write_whole_text(folder / SUMMARY_FILE, json.dumps(summary, indent=2) + "\n")
