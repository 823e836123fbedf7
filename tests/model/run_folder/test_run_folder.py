# SPDX-License-Identifier: GPL-3.0-or-later
"""The folder of a run: what is made, what is cleared away and what is left alone."""

import json
import os
import sys
from pathlib import Path

import pytest
from matplotlib.image import imread
from support.sample_results import GRAVITY, hanging_chain

from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.model.results.summary import summarise
from bridge_demolition_addon.model.run_folder.files import FORCE_LOG, RESULT_FILES
from bridge_demolition_addon.model.run_folder.folder import prepare_folder, withdraw_folder, writer_of_run
from bridge_demolition_addon.simulation.kept_run import keep_results
from bridge_demolition_addon.simulation.recording.logs import checked_log
from bridge_demolition_addon.system.folder_lock import LOCK_FILE, FolderLock


def files_in(folder):
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())


@pytest.mark.parametrize("overwrite", [False, True])
def test_a_new_folder_is_made_with_its_parents(tmp_path, overwrite):
    with prepare_folder(tmp_path / "a" / "b", overwrite=overwrite) as lock:
        folder = lock.folder
        assert files_in(folder) == ["run.lock"]
    assert folder == tmp_path / "a" / "b"
    assert folder.is_dir() and files_in(folder) == []
    # Every result has a folder to go to.
    for name in RESULT_FILES:
        (folder / name).write_bytes(b"")


def test_a_folder_that_is_there_is_not_touched(tmp_path):
    (tmp_path / "summary.json").write_text("kept")
    with pytest.raises(OutputError, match=r"exists already, and is not empty: choose another folder, or"):
        prepare_folder(tmp_path, overwrite=False)
    assert (tmp_path / "summary.json").read_text() == "kept"


def test_an_empty_folder_is_as_good_as_a_new_one_and_stays(tmp_path):
    """As file browsers make them."""
    folder = tmp_path / "made"
    folder.mkdir()
    lock = prepare_folder(folder, overwrite=False)
    withdraw_folder(lock)
    assert folder.is_dir() and not list(folder.iterdir())


def test_overwriting_clears_results_and_nothing_else(tmp_path):
    (tmp_path / "frames").mkdir()
    (tmp_path / "tables").mkdir()
    others = ["notes.txt", "frames/mine.png", "scenario.toml", "summary.json.old", "tables/mine.txt"]
    for name in [*RESULT_FILES, "tables/debris.csv", *others]:
        (tmp_path / name).write_text("old")
    prepare_folder(tmp_path, overwrite=True).release()
    assert files_in(tmp_path) == sorted(others)


def test_a_folder_is_withdrawn_but_for_what_is_not_of_a_run(tmp_path):
    locks = []
    for name in ("alone", "shared"):
        locks.append(prepare_folder(tmp_path / name, overwrite=False))
        (tmp_path / name / "force_log.csv").write_text("", encoding="utf-8")
    (tmp_path / "shared" / "notes.txt").write_text("mine", encoding="utf-8")
    for lock in locks:
        withdraw_folder(lock)
    assert [path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*")] == ["shared", "shared/notes.txt"]


@pytest.mark.parametrize("overwrite", [False, True])
def test_a_file_is_no_folder(tmp_path, overwrite):
    (tmp_path / "results").write_text("kept")
    with pytest.raises(OutputError, match="expected a folder for the results, found a file"):
        prepare_folder(tmp_path / "results", overwrite=overwrite)
    with pytest.raises(OutputError, match="cannot be written"):
        prepare_folder(tmp_path / "results" / "inside", overwrite=overwrite)
    assert (tmp_path / "results").read_text() == "kept"


def test_a_folder_in_the_place_of_a_result_stays(tmp_path):
    (tmp_path / "results.npz").mkdir()
    with pytest.raises(OutputError, match="cannot be written"):
        prepare_folder(tmp_path, overwrite=True)
    assert (tmp_path / "results.npz").is_dir()


@pytest.mark.parametrize("drop", [True, False], ids=["ball hits", "nothing hits"])
def test_results_are_kept(tmp_path, drop):
    results = hanging_chain()
    summary = {"title": "Brücke", **summarise(results, GRAVITY)}
    if not drop:
        summary["impact"] = None
    keep_results(tmp_path, results, summary)
    assert json.loads((tmp_path / "summary.json").read_text(encoding="utf-8")) == summary
    assert (
        load_results(tmp_path / "results.npz").frames.loads.connection_forces_n.tolist()
        == results.frames.loads.connection_forces_n.tolist()
    )
    assert imread(tmp_path / "force_over_time.png").std() > 0.0
    assert set(files_in(tmp_path)) <= set(RESULT_FILES)


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such files")
def test_a_log_is_not_written_to_a_pipe_or_a_device(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    for path in (pipe, Path("/dev/zero")):
        with pytest.raises(OutputError, match="found a pipe or a device"):
            checked_log(path, overwrite=True)


@pytest.mark.parametrize("set_by_s", [-7200, 7200])
def test_a_run_is_at_work_whatever_the_clock_says(tmp_path, set_by_s):
    """A clock that is set back or forth between the lock and the frames."""
    with prepare_folder(tmp_path, overwrite=False):
        (tmp_path / FORCE_LOG).write_text("frame\n")
        began = (tmp_path / LOCK_FILE).stat().st_mtime
        os.utime(tmp_path / FORCE_LOG, (began + set_by_s, began + set_by_s))
        assert writer_of_run(tmp_path).startswith(f"process {os.getpid()} on ")
    assert writer_of_run(tmp_path) is None
    with FolderLock(tmp_path):  # as of a report on a run that was killed
        os.utime(tmp_path / FORCE_LOG, (began + set_by_s, began + set_by_s))
        assert writer_of_run(tmp_path) is None
