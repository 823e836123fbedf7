# SPDX-License-Identifier: GPL-3.0-or-later
"""Run Beside: a run in a process of its own, whose results are shown as those of Run."""

import json
import os
import signal
import time

import pytest
from support.checkout import SMALL
from support.processes import is_alive

from bridge_demolition_addon.scene.bodies import Kind, bodies_of, kind_of
from bridge_demolition_addon.simulation.blender_events import running_recording, shown_results
from bridge_demolition_addon.simulation.kept_run import is_run_of
from bridge_demolition_addon.ui.messages import messages_of

pytestmark = pytest.mark.slow  # each starts a Blender, which takes seconds

PATIENCE_S = 300.0
FRAMES, SHARDS = 12, 12


@pytest.fixture
def runs(extension):
    from bridge_demolition_addon.ui.recording.ui import runs_beside

    yield runs_beside
    runs_beside.stop()


@pytest.fixture
def built(extension, settings, runs, tmp_path):
    """The small bridge with its ball, built, for a short run without pictures."""
    settings.scenario_path = str(SMALL)
    extension.ops.bda.load_scenario()
    settings.scenario.time.duration_s = (FRAMES - 2) / 24
    settings.scenario.fracture.shards = SHARDS
    extension.ops.bda.build_scenario()
    settings.output_directory, settings.pictures_of_run = str(tmp_path / "beside"), False
    return extension


def told(scene):
    return [message.text for message in messages_of(scene)]


def look_until(runs, happens):
    """Look as often as Blender does, until something happens."""
    until = time.monotonic() + PATIENCE_S
    while not happens():
        assert time.monotonic() < until
        runs.look_in()
        time.sleep(0.05)


def fingerprint_in(folder):
    return json.loads((folder / "summary.json").read_text(encoding="utf-8"))["fingerprint"]["result"]


def test_its_results_are_those_of_run_and_shown_as_they_are(built, runs, tmp_path):
    scene = built.context.scene
    assert built.ops.bda.run_beside() == {"FINISHED"}
    process_id = runs.run.process_id
    assert running_recording() is None and scene.frame_current == 1
    assert not built.ops.bda.run_beside.poll()  # one at a time
    look_until(runs, lambda: runs.run is None)
    assert told(scene) == [f"Results are in {tmp_path / 'beside'}"]
    assert shown_results(scene).are_loaded and is_run_of(scene, tmp_path / "beside")
    assert not is_alive(process_id)
    scene.bda.output_directory = str(tmp_path / "here")
    assert built.ops.bda.run() == {"FINISHED"}
    assert fingerprint_in(tmp_path / "here") == fingerprint_in(tmp_path / "beside")


def test_stopping_it_ends_its_process_and_so_does_switching_the_extension_off(built, runs, tmp_path):
    from bridge_demolition_addon.ui.recording import ui

    for end in (built.ops.bda.stop_run_beside, ui.unregister):
        built.ops.bda.run_beside()
        process_id = runs.run.process_id
        assert is_alive(process_id)
        end()
        assert runs.run is None and not is_alive(process_id)
    assert told(built.context.scene) == [f"Stopped; what was written by then is in {tmp_path / 'beside'}"]


def test_one_that_is_stopped_is_kept_and_shown_also_of_what_was_built_for_it(built, runs, tmp_path):
    built.context.scene.bda.output_directory = str(tmp_path / "here")
    built.ops.ed.undo_push(message="built")
    built.ops.bda.run()
    built.ops.ed.undo_push(message="after a run here")
    built.ops.ed.undo()
    scene = built.context.scene
    scene.bda.output_directory = str(tmp_path / "beside")
    scene.bda.scenario.fracture.shards, scene.bda.scenario.time.duration_s = SHARDS + 1, 60.0
    assert built.ops.bda.run_beside(build_anew=True) == {"FINISHED"}
    look_until(runs, lambda: runs.run.state.frames)
    assert built.ops.bda.stop_run_beside() == {"FINISHED"} and runs.is_stopping
    look_until(runs, lambda: runs.run is None)
    summary = json.loads((tmp_path / "beside" / "summary.json").read_text(encoding="utf-8"))
    shown = shown_results(scene).series
    assert not summary["completed"] and 1 < len(shown) == summary["frames"] < 60 * 24
    assert is_run_of(scene, tmp_path / "beside")
    assert sum(kind_of(body) == Kind.SHARD for body in bodies_of(scene)) == SHARDS + 1
    stopped, kept = told(scene)
    assert stopped.startswith("Stopped after ") and kept == f"Results are in {tmp_path / 'beside'}"
    scene.frame_set(summary["frames"])  # the first frame is not recorded
    (ball,) = (body for body in bodies_of(scene) if kind_of(body) == Kind.BALL)
    height_m = ball.evaluated_get(scene.view_layers[0].depsgraph).matrix_world.translation.z
    row = shown.row_at(scene.frame_current)
    assert height_m == pytest.approx(shown.frame(row).positions_m[shown.body_names.index(ball.name), 2], abs=1e-4)


def test_a_process_that_is_killed_is_told_of(built, runs):
    built.ops.bda.run_beside()
    os.kill(runs.run.process_id, signal.SIGKILL)
    look_until(runs, lambda: runs.run is None)
    (text,) = told(built.context.scene)
    assert text.startswith("the process of the run ended with status -9")


def test_what_was_changed_by_hand_or_in_the_panels_is_refused(built, runs):
    scene = built.context.scene
    scene.gravity[2] = -5.0
    with pytest.raises(RuntimeError, match="of which a run beside knows nothing: gravity; use Run, or build again"):
        built.ops.bda.run_beside()
    scene.gravity[2] = -9.81
    shard = next(body for body in bodies_of(scene) if kind_of(body) == Kind.SHARD)
    shard.location.x += 0.5
    with pytest.raises(RuntimeError, match="1 shard is moved"):
        built.ops.bda.run_beside()
    shard.location.x -= 0.5
    scene.bda.scenario.fracture.shards = SHARDS + 1
    with pytest.raises(RuntimeError, match="values have changed since the scene was built"):
        built.ops.bda.run_beside()
    assert runs.run is None


def test_a_bridge_that_was_built_anew_meanwhile_does_not_show_them(built, runs, tmp_path):
    scene = built.context.scene
    built.ops.bda.run_beside()
    scene.bda.scenario.fracture.shards = SHARDS + 1
    built.ops.bda.build_anew()
    look_until(runs, lambda: runs.run is None)
    assert told(scene) == [
        f"Results are in {tmp_path / 'beside'}; they are not shown, as another bridge is built here now"
    ]
    assert not shown_results(scene).are_loaded
