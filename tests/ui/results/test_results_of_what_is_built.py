# SPDX-License-Identifier: GPL-3.0-or-later
"""Results belong to the bridge in view: undo and redo bring them back with it, and those of another are not shown."""

import numpy as np
import pytest
from support.checkout import SMALL
from support.panel_layouts import texts_drawn

from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.simulation.blender_events import shown_results
from bridge_demolition_addon.simulation.kept_run import has_run
from bridge_demolition_addon.ui.results.shown_run import shown_run
from bridge_demolition_addon.ui.results.ui import BDA_PT_results
from bridge_demolition_addon.ui.scenario.hints import undo_note

LAST = 8
BALL = "Wrecking ball"


@pytest.fixture
def built(extension, settings, tmp_path):
    """A small bridge with its ball, built, as its step of undo has it."""
    settings.scenario_path = str(SMALL)
    extension.ops.bda.load_scenario()
    settings.scenario.time.duration_s = LAST / 24
    settings.scenario.fracture.shards = 10
    extension.ops.ed.undo_push(message="loaded")
    extension.ops.bda.build_scenario()
    settings.output_directory = str(tmp_path / "first")
    extension.ops.ed.undo_push(message="built")
    return extension


def run(bpy):
    bpy.ops.bda.run()


def record_and_stop(bpy):
    """As a run that is stopped: no more than some frames are recorded."""
    bpy.ops.bda.register_handler()
    for frame in range(1, LAST - 1):
        bpy.context.scene.frame_set(frame)
    bpy.ops.bda.unregister_handler()


def record_and_undo(bpy):
    """As an undo while it is recorded, which ends that."""
    bpy.context.scene.cursor.location.y += 1.0
    bpy.ops.ed.undo_push(message="before it is recorded")
    bpy.ops.bda.register_handler()
    for frame in range(1, LAST - 1):
        bpy.context.scene.frame_set(frame)
    bpy.ops.ed.undo()
    bpy.ops.bda.unregister_handler()
    assert has_run(bpy.context.scene)
    assert_plays(bpy.context.scene, shown_run(bpy.context.scene).folder)


def do_something_else(bpy, name):
    """Move the cursor, which is nothing of a demolition, and make a step of undo of it."""
    bpy.context.scene.cursor.location.x += 1.0
    bpy.ops.ed.undo_push(message=name)


def shown_m(scene, names):
    objects, graph = scene.rigidbody_world.collection.all_objects, scene.view_layers[0].depsgraph
    return np.array([objects[name].evaluated_get(graph).matrix_world.translation for name in names])


def assert_plays(scene, folder):
    """Every frame that was recorded is shown as the file of results has it, in any order."""
    results = load_results(folder / "results.npz")
    names, frames = results.inventory.body_names, np.asarray(results.frames.number)
    moves = results.inventory.masses_kg > 0.0
    for row in (len(frames) - 1, 2, len(frames) - 2, 0):
        scene.frame_set(int(frames[row]))
        assert shown_m(scene, names)[moves] == pytest.approx(results.frames.positions_m[row][moves], abs=1e-4)
    ball = names.tolist().index(BALL)
    assert results.frames.positions_m[0, ball, 2] - results.frames.positions_m[-1, ball, 2] > 0.005, "it falls"


@pytest.mark.slow
@pytest.mark.parametrize("play", [run, record_and_stop, record_and_undo])
def test_undo_and_redo_show_what_was_recorded(built, tmp_path, play):
    play(built)
    folder = tmp_path / "first"
    do_something_else(built, "one")
    do_something_else(built, "two")
    for step in ("undo", "undo", "redo", "redo", "undo"):  # the second undo goes to before the run
        built.context.scene.frame_set(5)
        getattr(built.ops.ed, step)()
        scene = built.context.scene
        assert has_run(scene) and shown_run(scene).folder == folder
        assert scene.frame_current == 1 and undo_note(scene).endswith("it plays what was recorded")
        assert "First break" in [marker.name for marker in scene.timeline_markers] or play is not run
        assert_plays(scene, folder)
    scene.frame_set(1)
    scene.rigidbody_world.collection.all_objects[BALL].location.x += 1.0
    built.context.view_layer.update()
    ((x_m, _, _),) = shown_m(scene, [BALL])
    assert x_m == pytest.approx(5.0, abs=1e-4), "what is edited by hand is seen where the bridge is as it was built"


@pytest.mark.slow
def test_results_of_another_bridge_are_not_shown_beside_this_one(built, tmp_path, settings):
    run(built)
    do_something_else(built, "one")
    ops, scene = built.ops.bda, built.context.scene
    largest = shown_run(scene).peak_force
    settings = scene.bda
    settings.scenario.bridge.deck.thickness_m += 0.1
    settings.output_directory = str(tmp_path / "second")
    ops.build_anew()
    built.ops.ed.undo_push(message="built again")
    assert largest.body in scene.objects, "there is a body of the same name"
    said = f"The last results are of another bridge than is built here: Small bridge, wrecking ball, in {tmp_path}"
    assert shown_run(scene) is None and not has_run(scene) and shown_results(scene).series is None
    (sentence,) = texts_drawn(BDA_PT_results, built)
    assert sentence.startswith(said)
    for button in ("go_to_body", "open_results", "draw_charts", "export_run", "show_survey"):
        with pytest.raises(RuntimeError, match="of another bridge than is built here"):
            getattr(ops, button)()
    for button in ("go_to_peak", "show_picture", "render_run", "write_section"):
        assert not getattr(ops, button).poll()

    built.ops.ed.undo()
    scene = built.context.scene
    assert shown_run(scene).folder == tmp_path / "first"
    assert_plays(scene, tmp_path / "first")
    built.ops.ed.redo()
    scene = built.context.scene
    assert shown_run(scene) is None and shown_results(scene).series is None
    run(built)
    scene = built.context.scene
    assert shown_run(scene).folder == tmp_path / "second"
    do_something_else(built, "two")
    for step, folder in (("undo", "second"), ("undo", "first"), ("redo", "second")):
        getattr(built.ops.ed, step)()
        scene = built.context.scene
        assert shown_run(scene).folder == tmp_path / folder
        assert_plays(scene, tmp_path / folder)

    other = built.data.scenes.new("Other")
    assert shown_run(other) is None and shown_results(other).series is None


def test_a_bridge_that_is_gone_neither_stands_nor_runs(built):
    from bridge_demolition_addon.ui.scenario.hints import draws_verdict

    scene = built.context.scene
    assert draws_verdict(scene) and built.ops.bda.run.poll()
    shard = next(body for body in scene.rigidbody_world.collection.all_objects if body.name.startswith("Shard"))
    built.data.objects.remove(shard)
    assert not draws_verdict(scene)
    built.data.batch_remove(list(scene.rigidbody_world.collection.all_objects))
    assert not draws_verdict(scene)
    with pytest.raises(RuntimeError, match="Nothing is left of what was built: build the scenario again"):
        built.ops.bda.run()
