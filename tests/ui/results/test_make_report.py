# SPDX-License-Identifier: GPL-3.0-or-later
"""The button that makes a report."""

import csv
import shutil

import docx
import pytest
from support.checkout import SMALL
from support.run_folders import flying_shards, keep_run
from support.scenarios import I235

from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.ui.results import operator


@pytest.fixture
def ran(extension, settings, tmp_path):
    """The small bridge, built and run."""
    settings.scenario_path = str(SMALL)
    extension.ops.bda.build_scenario()
    settings.output_directory = str(tmp_path / "run")
    extension.context.scene.frame_end = 14
    extension.ops.bda.run()
    return extension


def exclude(settings, buffer_m):
    settings.scenario.use_exclusion = True
    settings.scenario.exclusion.buffer_m = buffer_m


def reach(folder):
    """How far the exclusion zone reaches along the road, m."""
    with (folder / "tables" / "exclusion_corners_of_one_run.csv").open(encoding="utf-8", newline="") as file:
        along = [float(row["x_m"]) for row in csv.DictReader(file)]
    return max(along) - min(along)


@pytest.mark.long
def test_a_report_has_zones_as_the_panels_show_them_now(ran, settings, tmp_path):
    folder = tmp_path / "run"
    before = read_scenario(folder / "scenario_as_run.toml")
    reaches = []
    for buffer_m in (3.0, 8.0):
        exclude(settings, buffer_m)
        ran.ops.bda.make_report()
        reaches.append(reach(folder))
    # A buffer goes around everything else: five metres more of it are ten metres more of the zone.
    assert reaches[1] - reaches[0] == pytest.approx(10.0, abs=0.05)
    after = read_scenario(folder / "scenario_as_run.toml")
    assert after.exclusion.buffer_m == 8.0
    assert before.exclusion is None and after.ball == before.ball and after.time == before.time


def test_a_zone_that_cannot_be_is_named_and_nothing_is_written(ran, settings, tmp_path):
    before = (tmp_path / "run" / "scenario_as_run.toml").read_bytes()
    settings.scenario.zones.add().corners_m = "[[0, 0], [1, 1]]"
    with pytest.raises(RuntimeError, match=r"number 1: zones\."):
        ran.ops.bda.make_report()
    assert (tmp_path / "run" / "scenario_as_run.toml").read_bytes() == before
    assert not (tmp_path / "run" / "report.html").exists()


@pytest.mark.long
def test_what_is_changed_by_hand_stays_said_beside_the_zones(extension, settings, tmp_path):
    settings.scenario_path = str(SMALL)
    extension.ops.bda.build_scenario()
    settings.output_directory = str(tmp_path / "run")
    extension.context.scene.gravity.z = -1.62
    extension.context.scene.frame_end = 14
    extension.ops.bda.run()
    exclude(settings, 2.0)
    extension.ops.bda.make_report()
    text = (tmp_path / "run" / "scenario_as_run.toml").read_text(encoding="utf-8")
    assert text.startswith("# Changed in Blender, and not in this scenario: gravity") and "[exclusion]" in text


@pytest.mark.long
def test_a_run_of_another_scene_keeps_its_own_zones(ran, settings, tmp_path):
    other = keep_run(tmp_path / "other", flying_shards(6, 13), I235)
    before = (other / "scenario_as_run.toml").read_bytes()
    exclude(settings, 9.0)
    settings.output_directory = str(other)
    ran.ops.bda.make_report()
    assert (other / "scenario_as_run.toml").read_bytes() == before
    shutil.rmtree(other)


def test_the_button_makes_a_report_of_the_folder(extension, tmp_path):
    folder = keep_run(tmp_path / "run", flying_shards(6, 13), I235)
    assert not extension.ops.bda.make_report.poll()  # no folder yet
    extension.context.scene.bda.output_directory = str(folder)
    assert extension.ops.bda.make_report() == {"FINISHED"}
    assert (folder / "report.html").stat().st_size > 0
    assert (folder / "report.pdf").stat().st_size > 0


@pytest.mark.long
def test_another_button_makes_it_with_a_word_file(extension, tmp_path):
    folder = keep_run(tmp_path / "run", flying_shards(6, 13), I235)
    extension.context.scene.bda.output_directory = str(folder)
    assert extension.ops.bda.make_word_report() == {"FINISHED"}
    assert (folder / "report.pdf").stat().st_size > 0
    assert docx.Document(str(folder / "report.docx")).paragraphs[0].text == I235.title


def test_without_the_library_the_button_says_what_is_missing(extension, tmp_path, monkeypatch):
    monkeypatch.setattr(operator, "writes_word_files", lambda: False)
    extension.context.scene.bda.output_directory = str(tmp_path)
    assert extension.ops.bda.make_report.poll() and not extension.ops.bda.make_word_report.poll()
    with pytest.raises(RuntimeError, match="A Word file needs python-docx"):
        extension.ops.bda.make_word_report()


def test_a_folder_without_results_is_refused_with_a_sentence(extension, tmp_path):
    extension.context.scene.bda.output_directory = str(tmp_path)
    with pytest.raises(RuntimeError, match="holds no run: expected results"):
        extension.ops.bda.make_report()
    assert not list(tmp_path.iterdir())
