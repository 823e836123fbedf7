# SPDX-License-Identifier: GPL-3.0-or-later
"""A file that was saved after a run and is opened again: at its start frame, with the motion that was recorded."""

import json
import shutil

import numpy as np
import pytest
from support.checkout import SMALL
from support.long_cases import long_but

from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.simulation.blender_events import contours_of, shown_results
from bridge_demolition_addon.ui.recording import session
from bridge_demolition_addon.ui.results.shown_run import shown_run

LAST = 14


@pytest.fixture
def ran(extension, settings, tmp_path):
    """The small bridge, built, run and saved at its last frame; the results are beside the file."""
    settings.scenario_path = str(SMALL)
    extension.ops.bda.build_scenario()
    settings.output_directory = str(tmp_path / "results")
    extension.context.scene.frame_end = LAST
    extension.ops.bda.run()
    extension.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    return extension


def reopen(bpy, path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.open_mainfile(filepath=str(path))
    return bpy.context.scene


def shown(scene, names):
    depsgraph = scene.view_layers[0].depsgraph
    objects = scene.rigidbody_world.collection.all_objects
    return np.array([objects[name].evaluated_get(depsgraph).matrix_world.translation for name in names])


@pytest.mark.parametrize("contours", long_but([False], [False, True]))
def test_it_shows_what_was_recorded_whatever_frame_is_gone_to(ran, tmp_path, contours):
    results = load_results(tmp_path / "results" / "results.npz")
    ran.context.scene.bda.contours = contours
    ran.ops.wm.save_mainfile()
    scene = reopen(ran, tmp_path / "scene.blend")
    assert scene.frame_current == 1
    names, moves = results.inventory.body_names, results.inventory.masses_kg > 0.0
    start = shown(scene, names)
    assert start == pytest.approx(results.frames.positions_m[0], abs=1e-4)
    fell = 0.0
    for frame in (LAST, 3, 9, 1, LAST - 1):
        scene.frame_set(frame)
        row = max(frame - 2, 0)  # the first frame that is recorded is the second
        assert results.frames.number[row] == max(frame, 2)
        positions = shown(scene, names)
        assert positions[moves] == pytest.approx(results.frames.positions_m[row][moves], abs=1e-4)
        fell = max(fell, float(np.abs(positions - start).max()))
    assert fell > 0.3, "the ball falls 0.3 m"


def test_a_colour_is_that_of_the_recorded_frame(ran, tmp_path):
    scene = reopen(ran, tmp_path / "scene.blend")
    scene.bda.contours = True
    scene.frame_set(LAST)
    frame, row = contours_of(scene).shown_frame()
    assert row == LAST - 2 and np.isfinite(frame.screen_colours).any()
    body = scene.rigidbody_world.collection.all_objects["Shard 000001"]
    row = shown_results(scene).series.body_names.index("Shard 000001")
    painted = body.evaluated_get(scene.view_layers[0].depsgraph).color
    screen = frame.screen_colours[row][:3]
    linear = np.where(screen <= 0.04045, screen / 12.92, ((screen + 0.055) / 1.055) ** 2.4)  # IEC 61966-2-1
    assert np.array(painted)[:3] == pytest.approx(linear, abs=1e-3)


def test_results_that_moved_with_the_file_are_found(ran, tmp_path):
    (tmp_path / "elsewhere").mkdir()
    for name in ("scene.blend", "results"):
        shutil.move(tmp_path / name, tmp_path / "elsewhere" / name)
    scene = reopen(ran, tmp_path / "elsewhere" / "scene.blend")
    assert shown_results(scene).are_loaded and shown_results(scene).missing == ""


@pytest.mark.parametrize("wrong", ["gone", "another run", "unreadable"])
def test_results_that_are_not_its_own_are_not_shown_and_it_says_so(ran, tmp_path, wrong):
    folder = tmp_path / "results"
    if wrong == "gone":
        shutil.rmtree(folder)
    elif wrong == "another run":
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        summary["fingerprint"]["result"] = "0" * 64
        (folder / "summary.json").write_text(json.dumps(summary), encoding="utf-8")
    else:
        (folder / "results.npz").write_bytes(b"PK nothing")
    scene = reopen(ran, tmp_path / "scene.blend")
    assert scene.frame_current == 1 and not shown_results(scene).are_loaded
    assert str(folder) in shown_results(scene).missing
    start = shown(scene, ["Shard 000001", "Shard 000002"])
    assert np.abs(start).max() > 0.5, "no shard is at the origin"


@pytest.mark.long
def test_what_is_recorded_next_is_shown_instead(ran, tmp_path):
    scene = reopen(ran, tmp_path / "scene.blend")
    scene.bda.overwrite = True
    ran.ops.bda.run()
    assert not shown_results(scene).are_loaded
    assert shown_results(scene).recording.last_frame == LAST


def test_blender_plays_on_its_own_where_that_is_wanted(ran, tmp_path):
    scene = reopen(ran, tmp_path / "scene.blend")
    scene.frame_set(LAST)
    ran.ops.bda.forget_results()
    assert scene.frame_current == 1
    before = shown(scene, ["Shard 000001"])
    scene.frame_set(LAST)  # which Blender does not simulate without the frames before it
    assert shown(scene, ["Shard 000001"]) == pytest.approx(before)
    with pytest.raises(RuntimeError, match="Blender's own motion is shown"):
        ran.ops.bda.forget_results()


def test_the_panel_of_results_says_what_it_said_after_the_run(ran, tmp_path):
    before = shown_run(ran.context.scene)
    session.unregister()  # as after Blender was closed
    after = shown_run(reopen(ran, tmp_path / "scene.blend"))
    assert (after.folder, after.title, after.lines) == (before.folder, before.title, before.lines)
    assert (after.peak_force, after.largest_throw) == (before.peak_force, before.largest_throw)
    assert after.largest_throw.frame == LAST
    assert ran.ops.bda.draw_charts() == {"FINISHED"}
    assert (tmp_path / "results" / "charts" / "force_over_time.png").is_file()


def test_results_of_a_run_that_is_gone_are_said_to_be_gone(ran, tmp_path):
    session.unregister()
    shutil.rmtree(tmp_path / "results")
    scene = reopen(ran, tmp_path / "scene.blend")
    with pytest.raises(OutputError, match="holds the results of this scene's run no more"):
        shown_run(scene)
    with pytest.raises(RuntimeError, match="no more"):
        ran.ops.bda.draw_charts()


@pytest.mark.parametrize("key", long_but(["connections"], ["mass_kg", "connections", "largest_resultant", "title"]))
def test_a_summary_that_lacks_something_is_refused(ran, tmp_path, key):
    session.unregister()
    path = tmp_path / "results" / "summary.json"
    summary = json.loads(path.read_text(encoding="utf-8"))
    del summary[key]
    path.write_text(json.dumps(summary), encoding="utf-8")
    with pytest.raises(OutputError, match="is not what a run writes"):
        shown_run(reopen(ran, tmp_path / "scene.blend"))


def test_a_file_with_bodies_that_are_not_ours_stays_at_its_frame(extension, tmp_path):
    from support.blocks import Blocks

    blocks = Blocks()
    blocks.block((0, 0, 5), 100.0)
    blocks.scene.frame_set(7)
    extension.ops.wm.save_as_mainfile(filepath=str(tmp_path / "mine.blend"))
    assert reopen(extension, tmp_path / "mine.blend").frame_current == 7
