"""The folder that a run keeps its results in."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from ..core.errors import OutputError, writing
from ..core.results.arrays import Results
from ..core.results.files import (
    FORCE_CHART,
    PICTURE_FOLDER,
    REPORT_FILES,
    RESULT_FILES,
    RESULTS_FILE,
    SUMMARY_FILE,
    TABLE_FOLDER,
)
from ..core.results.summary import first_hit_s


def prepared_folder(folder: Path, *, overwrite: bool) -> Path:
    """Make the folder, or clear it of an earlier run's results and of nothing else.

    Raises
    ------
    OutputError
        The folder is there already and may not be overwritten, is no folder, or cannot be written.
    """
    check_folder(folder, overwrite=overwrite)
    with writing(folder):
        folder.mkdir(parents=True, exist_ok=True)
        for name in RESULT_FILES:
            (folder / name).unlink(missing_ok=True)
        remove_report(folder)
        (folder / PICTURE_FOLDER).mkdir(exist_ok=True)
    return folder


def withdraw_folder(folder: Path) -> None:
    """Take back a folder that was prepared for a run which came to nothing; what is not of a run stays in it."""
    for name in RESULT_FILES:
        (folder / name).unlink(missing_ok=True)
    for empty in (folder / PICTURE_FOLDER, folder):
        if empty.is_dir() and not any(empty.iterdir()):
            empty.rmdir()


def check_folder(folder: Path, *, overwrite: bool) -> None:
    """See that a folder for results is new or may be overwritten, without changing anything.

    Raises
    ------
    OutputError
        The folder is there already and may not be overwritten, or is no folder.
    """
    with writing(folder):
        if folder.exists() and not folder.is_dir():
            raise OutputError(f"{folder}: expected a folder for the results, found a file")
        if folder.exists() and not overwrite:
            raise OutputError(f"{folder}: exists already; choose another folder or allow overwriting")


def remove_report(folder: Path) -> None:
    """Remove the report that is kept in a folder, with its tables, if there is one: of a new run it would be wrong."""
    for name in REPORT_FILES:
        (folder / name).unlink(missing_ok=True)
    for table in (folder / TABLE_FOLDER).glob("*.csv"):
        table.unlink()


def checked_log(path: Path, *, overwrite: bool) -> Path:
    """A file for a log, after seeing that it can be written.

    Raises
    ------
    OutputError
        It is there already and may not be overwritten, is no file, or cannot be written.
    """
    if path.is_dir():
        raise OutputError(f"{path}: expected a file for the log, found a folder")
    if path.exists() and not overwrite:
        raise OutputError(f"{path}: exists already; choose another file or allow overwriting")
    with writing(path):
        existed = path.exists()
        path.open("ab").close()  # the only sure way to know; what is in it stays until it is written
        if not existed:
            path.unlink()
    return path


def keep_results(folder: Path, results: Results, summary: dict[str, Any]) -> None:
    """Write arrays, summary and force chart of a recording beside its logs."""
    # Loading matplotlib takes a second, which neither other commands nor switching the add-on on need wait for.
    from ..charts.force_chart import plot_forces

    results.save(folder / RESULTS_FILE)
    (folder / SUMMARY_FILE).write_text(json.dumps(summary, indent=2) + "\n", encoding="utf-8")
    plot_forces(results, folder / FORCE_CHART, summary["title"], first_hit_s(summary))
