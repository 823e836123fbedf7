"""The folder that a run keeps its results in."""

from __future__ import annotations

from pathlib import Path

from ..core.errors import OutputError

RESULT_FILES = (
    "summary.json",
    "force_log.csv",
    "debris_log.csv",
    "results.npz",
    "force_over_time.png",
    "scene.blend",
    "frames/before.png",
    "frames/impact.png",
    "frames/after.png",
)
PICTURE_FOLDER = "frames"


def prepared_folder(folder: Path, *, overwrite: bool) -> Path:
    """Make the folder, or clear it of an earlier run's results and of nothing else.

    Raises
    ------
    OutputError
        The folder is there already and may not be overwritten, is no folder, or cannot be written.
    """
    if folder.exists() and not folder.is_dir():
        raise OutputError(f"{folder}: expected a folder for the results, found a file")
    if folder.exists() and not overwrite:
        raise OutputError(f"{folder}: exists already; choose another folder or allow overwriting")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name in RESULT_FILES:
            (folder / name).unlink(missing_ok=True)
        (folder / PICTURE_FOLDER).mkdir(exist_ok=True)
    except OSError as error:
        raise OutputError(f"{folder}: cannot be written ({error.strerror})") from error
    return folder
