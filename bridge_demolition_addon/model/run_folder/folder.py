"""The folder of a run: made or cleared, locked, and read again."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from ...engineering.ground_motion import GroundRecord
from ...errors import OutputError
from ...system.disk import check_no_link, own_folder, part_of, write_whole_text, writing
from ...system.folder_lock import FolderLock, check_unlocked, writer_in
from ..ground_motion.record_files import record_text
from ..results.arrays import FRAMES_FILE, RESULTS_FILE
from ..scenario import Scenario
from ..scenario.file import read_scenario, scenario_text
from .files import (
    FORCE_LOG,
    GROUND_MOTION_FILE,
    PICTURE_FOLDER,
    REPORT_FILES,
    RESULT_FILES,
    SCENARIO_FILE,
    TABLE_FOLDER,
    check_free,
    remove_report,
)
from .summary import read_summary

_LONGEST_NAME = 60
"""Letters of a title that the name of a folder has."""

_RUN = "a run"
"""What the lock of a run says that it is."""

_BLENDERS_LONGEST_PATH = 1023
"""Bytes; Blender cuts off the rest silently (FILE_MAX in its BLI_path_utils.h is one more)."""


def numbered_folder(parent: Path, title: str) -> Path:
    """Return a folder that is not there yet: named after a title, with the next number that no other has."""
    name = re.sub(r"[^\w.-]+", "_", title)[:_LONGEST_NAME].strip("._") or "demolition"
    numbered = re.compile(re.escape(name) + r"_(\d+)", re.IGNORECASE)
    taken = (numbered.fullmatch(path.name) for path in (parent.iterdir() if parent.is_dir() else ()))
    return parent / f"{name}_{max((int(match[1]) for match in taken if match), default=0) + 1}"


def prepare_folder(folder: Path, *, overwrite: bool) -> FolderLock:
    """Make the folder, or clear it of an earlier run's results and of nothing else, and keep others out of it."""
    check_folder(folder, overwrite=overwrite)
    is_new = not folder.exists()
    with writing(folder):
        folder.mkdir(parents=True, exist_ok=True)
    lock = FolderLock(folder, is_new=is_new, work=_RUN)
    try:
        with writing(folder):
            _clear(folder)
    except OutputError:
        lock.release()
        raise
    return lock


def lock_in_place(lock: FolderLock) -> FolderLock:
    """Return the lock of the folder in which a run can still leave its results: its own.

    A folder that was moved or deleted is made again; where something else has its name, the new one gets a number.
    """
    if lock.in_place:
        return lock
    lock.release()
    folder, number = lock.folder, 1
    while folder.exists():
        number += 1
        folder = lock.folder.with_name(f"{lock.folder.name}_{number}")
    with writing(folder):
        (folder / PICTURE_FOLDER).mkdir(parents=True)
    return FolderLock(folder, work=_RUN)


def withdraw_folder(lock: FolderLock) -> None:
    """Remove a folder that was prepared for a run without results; one that was there before stays."""
    folder = lock.folder
    lock.release()
    for name in RESULT_FILES:
        (folder / name).unlink(missing_ok=True)
    for empty in (folder / PICTURE_FOLDER, *([folder] if lock.is_new else [])):
        if empty.is_dir() and not any(empty.iterdir()):
            empty.rmdir()


def check_folder(folder: Path, *, overwrite: bool) -> None:
    """See that a folder for results is new or empty, or may be overwritten, without changing anything."""
    with writing(folder):
        if folder.exists() and not folder.is_dir():
            raise OutputError(f"{folder}: expected a folder for the results, found a file")
        if folder.exists() and not overwrite and any(folder.iterdir()):
            raise OutputError(
                f"{folder}: exists already, and is not empty: choose another folder, or allow overwriting (--overwrite)"
            )
        for inner in (PICTURE_FOLDER, TABLE_FOLDER):
            check_no_link(folder / inner)
        _check_ours(folder)
        longest = max(len(os.fsencode(folder.resolve() / name)) for name in RESULT_FILES)
    if (excess := longest - _BLENDERS_LONGEST_PATH) > 0:
        raise OutputError(
            f"{folder}: its path is {excess} bytes too long, as Blender writes to none of more than "
            f"{_BLENDERS_LONGEST_PATH} bytes: choose a shorter one"
        )
    check_unlocked(folder)


def _check_ours(folder: Path) -> None:
    """Refuse files that a run would replace, and that no run or report wrote."""
    names = [name for name in RESULT_FILES if name not in REPORT_FILES]
    is_of_run = holds_run(folder) or (folder / SCENARIO_FILE).exists()
    if taken := [name for name in names if not is_of_run and os.path.lexists(folder / name)]:
        raise OutputError(f"{folder / taken[0]}: is there already, and no run wrote it: choose another folder")
    check_free(folder)


def _clear(folder: Path) -> None:
    """Remove what earlier runs left, parts of files of one that was killed included, and make the inner folder."""
    own_folder(folder / PICTURE_FOLDER)
    remove_report(folder)
    for name in RESULT_FILES:
        (folder / name).unlink(missing_ok=True)
        part_of(folder / name).unlink(missing_ok=True)


def keep_scenario(folder: Path, scenario: Scenario, made_by_hand: Sequence[str] = ()) -> None:
    """Write the scenario of a run, and in comments above it the changes in Blender that no scenario can say."""
    lines = [f"# Changed in Blender, and not in this scenario: {change}.\n" for change in made_by_hand]
    write_whole_text(folder / SCENARIO_FILE, "".join([*lines, scenario_text(scenario)]))


def keep_site(folder: Path, site: Mapping[str, Any]) -> None:
    """Put other zones, another exclusion zone and the like, by fields of a scenario, into a run's, if it has one.

    They take no part in the simulation: reports read them there.
    """
    if not (folder / SCENARIO_FILE).is_file():
        return
    kept = read_scenario(folder / SCENARIO_FILE)
    scenario = replace(kept, **site)
    if scenario != kept:
        with FolderLock(folder):
            keep_scenario(folder, scenario, read_summary(folder).made_by_hand)


def keep_ground_motion(folder: Path, record: GroundRecord, start_s: float) -> None:
    """Write how the ground moved, from a time on."""
    write_whole_text(folder / GROUND_MOTION_FILE, record_text(record, start_s))


def holds_run(folder: Path) -> bool:
    """Return whether a folder holds anything that a run recorded."""
    return any((folder / name).exists() for name in (RESULTS_FILE, FRAMES_FILE, FORCE_LOG))


def writer_of_run(folder: Path) -> str | None:
    """Return which process still writes the run in a folder; None where the run has ended.

    Writing a report also locks the folder.
    """
    writer = writer_in(folder)
    return writer if writer and writer.endswith(_RUN) and not (folder / RESULTS_FILE).exists() else None
