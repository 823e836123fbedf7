# SPDX-License-Identifier: GPL-3.0-or-later
"""What is not of a run stays: files of the user beside results, and what links lead to."""

import os
import sys

import pytest

from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.model.run_folder.files import check_free, list_report, remove_report
from bridge_demolition_addon.model.run_folder.folder import check_folder, prepare_folder
from bridge_demolition_addon.system.disk import own_folder, write_whole_text
from bridge_demolition_addon.system.folder_lock import FolderLock

links = pytest.mark.skipif(sys.platform == "win32", reason="links are for administrators there")


def fill(folder, *names):
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text("kept")


def names_in(folder):
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())


def test_tables_of_the_user_stay(tmp_path):
    mine = ["tables/my_own_measurements.csv", "tables/road.csv", "my.csv"]
    fill(tmp_path / "no run", *mine)
    fill(tmp_path / "before", *mine, "summary.json", "force_log.csv", "report.html", "tables/zones.csv")
    fill(tmp_path / "listed", *mine, "summary.json", "force_log.csv", "tables/zones.csv", "tables/new_kind.csv")
    list_report(tmp_path / "listed", ["report.html", "tables/new_kind.csv"])
    for name, left in (("no run", mine), ("before", mine), ("listed", [*mine, "tables/zones.csv"])):
        prepare_folder(tmp_path / name, overwrite=True).release()
        assert names_in(tmp_path / name) == sorted(left)


@pytest.mark.parametrize("name", ["summary.json", "frames/before.png", "contours.mp4", "report.pdf", "scene.blend"])
def test_a_file_of_the_user_with_the_name_of_a_result_is_refused(tmp_path, name):
    fill(tmp_path, name, "notes.txt")
    with pytest.raises(OutputError, match=r"is there already, and no (run|report) wrote it"):
        prepare_folder(tmp_path, overwrite=True)
    assert names_in(tmp_path) == sorted([name, "notes.txt"])


def test_a_report_replaces_its_own_files_alone(tmp_path):
    fill(tmp_path, "report.html", "report.pdf", "tables/zones.csv", "tables/mine.csv")
    check_free(tmp_path, ["report.html", "tables/zones.csv"])  # of before, when there was no list
    with pytest.raises(OutputError, match=r"tables/mine\.csv: is there already, and no report wrote it"):
        check_free(tmp_path, ["tables/mine.csv"])
    list_report(tmp_path, ["tables/zones.csv"])
    list_report(tmp_path, ["tables/runs.csv"])
    check_free(tmp_path, ["tables/zones.csv", "tables/runs.csv"])
    remove_report(tmp_path)
    assert names_in(tmp_path) == ["tables/mine.csv"]


def test_a_list_that_names_other_files_takes_none_of_them(tmp_path):
    folder = tmp_path / "run"
    fill(tmp_path, "victim.csv", "tables/victim.csv", "run/scenario.toml", "run/a.csv", "run/tables/deep/b.csv")
    listed = ["../victim.csv", "tables/../../victim.csv", str(tmp_path / "victim.csv"), "scenario.toml", "a.csv"]
    before = names_in(tmp_path)
    list_report(folder, [*listed, "tables/deep/b.csv", "tables/..", "./tables/deep/b.csv", ""])
    remove_report(folder)
    assert names_in(tmp_path) == before


@links
@pytest.mark.parametrize("name", ["tables", "frames"])
def test_a_folder_that_is_a_link_is_refused_and_nothing_behind_it_is_touched(tmp_path, name):
    fill(tmp_path, "elsewhere/before.png", "elsewhere/zones.csv", "run/force_log.csv", "run/report.html")
    (tmp_path / "run" / name).symlink_to(tmp_path / "elsewhere")
    before = names_in(tmp_path)
    with pytest.raises(OutputError, match=rf"{name}: is a link, to .*elsewhere: expected no link"):
        prepare_folder(tmp_path / "run", overwrite=True)
    with pytest.raises(OutputError, match="is a link"):
        own_folder(tmp_path / "run" / name)
    assert names_in(tmp_path) == before


@links
@pytest.mark.parametrize("link", [os.symlink, os.link])
def test_nothing_is_written_through_a_lock_or_a_part_that_is_a_link(tmp_path, link):
    fill(tmp_path, "victim", "run/notes.txt")
    link(tmp_path / "victim", tmp_path / "run" / "run.lock")
    link(tmp_path / "victim", tmp_path / "run" / "report.part.html")
    with pytest.raises(OutputError, match=r"run\.lock: is a (link|file of another name)"):
        FolderLock(tmp_path / "run")
    write_whole_text(tmp_path / "run" / "report.html", "new")
    assert (tmp_path / "victim").read_text() == "kept"
    assert (tmp_path / "run" / "report.html").read_text() == "new"
    assert not (tmp_path / "run" / "report.html").is_symlink()
    check_folder(tmp_path / "run", overwrite=True)
