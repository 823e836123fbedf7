# SPDX-License-Identifier: GPL-3.0-or-later
"""Recording by the buttons: handlers, log files, results."""

import csv
import json
import sys

import numpy as np
import pytest
from support.checkout import SMALL

from bridge_demolition_addon.display.contours import ContourSettings
from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.model.run_folder.summary import RunSummary
from bridge_demolition_addon.simulation.blender_events import running_recording, shown_results
from bridge_demolition_addon.ui.results.shown_run import explained_peak, lines_of

FRAMES = 20


@pytest.fixture
def built(extension, settings, tmp_path):
    """The small bridge with its ball, built, and a folder for the results."""
    settings.scenario_path = str(SMALL)
    extension.ops.bda.build_scenario()
    settings.output_directory = str(tmp_path / "results")
    return extension


def play(bpy, frames=FRAMES):
    for frame in range(1, frames + 1):
        bpy.context.scene.frame_set(frame)


def record(bpy):
    bpy.ops.bda.register_handler()
    play(bpy)
    bpy.ops.bda.unregister_handler()


def rows(path):
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_logs_go_to_the_folder_of_the_results(built, tmp_path):
    record(built)
    assert len(rows(tmp_path / "results" / "force_log.csv")) == 32 * (FRAMES - 1)
    assert running_recording() is None


def test_logs_go_where_they_were_sent(built, settings, tmp_path):
    force, debris = tmp_path / "forces.csv", tmp_path / "debris.csv"
    built.ops.bda.set_force_log(filepath=str(force))
    built.ops.bda.set_debris_log(filepath=str(debris.with_suffix("")))
    record(built)
    assert len(rows(force)) == 32 * (FRAMES - 1)
    assert len(rows(debris)) == 2 * 32
    assert not (tmp_path / "results" / "force_log.csv").exists()
    assert not (tmp_path / "results" / "debris_log.csv").exists()


def test_a_recording_that_a_deletion_ends_was_not_completed(built, tmp_path):
    built.ops.bda.register_handler()
    play(built)
    built.data.objects.remove(built.context.scene.rigidbody_world.constraints.objects[0])
    built.context.scene.frame_set(FRAMES + 1)
    built.ops.bda.unregister_handler()
    summary = json.loads((tmp_path / "results" / "summary.json").read_text())
    assert summary["completed"] is False
    assert summary["frames"] == FRAMES - 1


@pytest.mark.long
@pytest.mark.skipif(sys.platform == "win32", reason="Windows keeps a folder as long as files in it are open")
def test_a_folder_that_went_away_while_recording_is_made_again_for_the_results(built, tmp_path, capfd):
    built.ops.bda.register_handler()
    play(built)
    (tmp_path / "results").rename(tmp_path / "elsewhere")
    built.ops.bda.unregister_handler()
    assert f"{tmp_path / 'results'} was moved or deleted, and the logs with it" in capfd.readouterr().out
    assert load_results(tmp_path / "results" / "results.npz").frames.number[-1] == FRAMES
    assert running_recording() is None


@pytest.mark.parametrize("setting", ["force_log_path", "debris_log_path"])
def test_a_log_that_cannot_be_written_is_refused_before_anything_is_made(built, settings, tmp_path, setting):
    there = tmp_path / "there.csv"
    there.write_text("mine")
    wrong = {
        tmp_path / "no" / "log.csv": "cannot be written",
        tmp_path: "found a folder",
        there: "exists",
    }
    for path, message in wrong.items():
        setattr(settings, setting, str(path))
        with pytest.raises(RuntimeError, match=message):
            built.ops.bda.register_handler()
    for path in (tmp_path / "made", tmp_path / "made" / "results"):  # is no folder before the run makes it
        setattr(settings, setting, str(tmp_path / "made"))
        settings.output_directory = str(path)
        with pytest.raises(RuntimeError, match="found the folder of the results"):
            built.ops.bda.register_handler()
    settings.output_directory = str(tmp_path / "results")
    settings.force_log_path = settings.debris_log_path = str(tmp_path / "one.csv")
    with pytest.raises(RuntimeError, match="both logs"):
        built.ops.bda.register_handler()
    assert there.read_text() == "mine"
    assert not any((tmp_path / name).exists() for name in ("results", "one.csv", "made"))
    assert running_recording() is None


def test_an_earlier_log_is_replaced_once_that_is_allowed(built, settings, tmp_path):
    there = tmp_path / "there.csv"
    there.write_text("mine")
    settings.force_log_path, settings.overwrite = str(there), True
    record(built)
    assert len(rows(there)) == 32 * (FRAMES - 1)


def test_a_folder_is_no_file_for_a_log(built, settings, tmp_path):
    folder = tmp_path / "folder.csv"
    folder.mkdir()
    with pytest.raises(RuntimeError, match="found a folder"):
        built.ops.bda.set_force_log(filepath=str(folder))
    assert settings.force_log_path == ""


def test_loads_are_read_as_often_as_the_panel_says_and_contacts_are_kept(built, settings, tmp_path):
    settings.scenario.recording.every_substep = False
    settings.scenario.recording.contacts = True
    record(built)
    summary = json.loads((tmp_path / "results" / "summary.json").read_text())
    assert summary["reading"] == "last sub-step of each frame"
    assert load_results(tmp_path / "results").contacts is not None


def test_a_wrong_value_of_the_blast_is_refused_before_anything_is_made(built, settings, tmp_path):
    settings.scenario.blast.use_slow_frame_ms = True
    settings.scenario.blast.slow_frame_ms = 0.0
    with pytest.raises(RuntimeError, match=r"blast\.slow_frame_ms is 0\.0: expected a number above 0"):
        built.ops.bda.register_handler()
    assert not (tmp_path / "results").exists()


@pytest.mark.long
def test_an_explosion_without_charges_changes_nothing(extension, tmp_path):
    logs = []
    for explosion in (False, True):
        extension.ops.wm.read_factory_settings(use_empty=True)  # Blender repeats itself to the last digit from there
        settings = extension.context.scene.bda
        settings.scenario_path = str(SMALL)
        extension.ops.bda.build_scenario()
        settings.scenario.blast.explosion = explosion
        settings.output_directory = str(tmp_path / str(explosion))
        record(extension)
        logs.append((tmp_path / str(explosion) / "force_log.csv").read_bytes())
    lines = [log.splitlines() for log in logs]
    assert [pair for pair in zip(*lines, strict=True) if pair[0] != pair[1]][:3] == []
    assert not (tmp_path / "True" / "explosion_log.csv").exists()


@pytest.mark.long
def test_a_charge_that_is_ticked_off_changes_nothing_and_one_that_is_on_does(built, settings, tmp_path):
    built.context.scene.cursor.location = (4.0, 0.0, 1.5)
    built.ops.bda.add_source_point()
    built.ops.bda.build_force_objects()
    settings.scenario.blast.start_s = 0.2
    for explosion in (False, True):
        settings.scenario.blast.explosion = explosion
        settings.output_directory = str(tmp_path / str(explosion))
        record(built)
        assert (tmp_path / str(explosion) / "explosion_log.csv").exists() == explosion


def test_results_lead_to_body_and_frame(built, tmp_path):
    record(built)
    summary = json.loads((tmp_path / "results" / "summary.json").read_text())
    largest = summary["largest_resultant"]
    built.ops.bda.go_to_body(body=largest["body"], frame=largest["frame"])
    assert built.context.scene.frame_current == largest["frame"]
    assert [selected_object.name for selected_object in built.context.selected_objects] == [largest["body"]]
    assert built.context.view_layer.objects.active.name == largest["body"]
    with pytest.raises(RuntimeError, match="not in this scene any more"):
        built.ops.bda.go_to_body(body="Shard 99999", frame=1)


def test_the_way_back_to_the_bridge_says_where_no_shard_is_shown(built):
    scene = built.context.scene
    scene.frame_set(3)
    collection = scene.rigidbody_world.collection
    scene.collection.children.unlink(collection)
    with pytest.raises(RuntimeError, match="no shard is in this view layer"):
        built.ops.bda.look_at_bridge()
    assert scene.frame_current == 3
    scene.collection.children.link(collection)
    built.ops.bda.look_at_bridge()
    assert scene.frame_current == 1


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="other systems open folders by themselves")
def test_a_system_that_opens_no_folders_is_told_of(built, monkeypatch):
    record(built)
    monkeypatch.setenv("PATH", "")
    with pytest.raises(RuntimeError, match="no xdg-open, which opens folders"):
        built.ops.bda.open_results()


def test_results_tell_the_totals(built, tmp_path):
    record(built)
    summary = json.loads((tmp_path / "results" / "summary.json").read_text())
    # The deck is 9 m x 4 m x 0.4 m, and each of two piers 0.8 m x 2 m x 3 m, of 2400 kg/m³.
    assert lines_of(RunSummary.of(summary))[0] == "Total mass: 57 600 kg"
    broken, count = summary["connections"]["broken"], len(built.context.scene.rigidbody_world.constraints.objects)
    assert lines_of(RunSummary.of(summary))[1] == f"Torn: {broken} of {count} connections"


def test_the_peak_force_of_the_results_is_that_of_contours_with_peaks(built, tmp_path):
    record(built)
    summary = json.loads((tmp_path / "results" / "summary.json").read_text())
    series = shown_results(built.context.scene).series
    shards = [name.startswith("Shard") for name in series.body_names]
    last = series.show(len(series.frames) - 1, ContourSettings(peak=True)).values[shards]
    assert last.max() == pytest.approx(summary["largest_resultant"]["force_N"], rel=1e-6)
    results = load_results(tmp_path / "results" / "results.npz")
    means = np.linalg.norm(results.frames.loads.body_forces_n[:, shards], axis=2)
    shown = [series.show(row, ContourSettings()).values[shards].max() for row in range(len(series.frames))]
    assert max(shown) == pytest.approx(means.max(), rel=1e-6)
    assert max(shown) < last.max(), "an impact lasts a part of a frame"
    # 1/240 s: the small bridge has 24 frames a second and the default of ten sub-steps.
    assert "worst sub-step, of 4.17 ms" in explained_peak(RunSummary.of(summary))


def test_charts_are_drawn_into_the_folder(built, tmp_path):
    assert not built.ops.bda.draw_charts.poll()
    assert not built.ops.bda.open_results.poll()
    record(built)
    built.ops.bda.draw_charts()
    charts = sorted((tmp_path / "results" / "charts").glob("*.png"))
    assert [chart.name for chart in charts] == ["debris_plan.png", "force_over_time.png"], (
        "a ball is nothing to choose charges by"
    )
    assert all(chart.read_bytes().startswith(b"\x89PNG") for chart in charts)


@pytest.mark.long
def test_charts_to_choose_charges_by_are_drawn_where_there_were_charges(built, settings, tmp_path):
    built.context.scene.cursor.location = (4.0, 0.0, 1.5)
    built.ops.bda.add_source_point()
    built.ops.bda.build_force_objects()
    settings.scenario.blast.start_s = 0.2
    record(built)
    built.ops.bda.draw_charts()
    charts = {path.name for path in (tmp_path / "results" / "charts").glob("*.png")}
    assert "force_over_time.png" in charts and len(charts) > 2
