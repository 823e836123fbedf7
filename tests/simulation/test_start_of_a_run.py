# SPDX-License-Identifier: GPL-3.0-or-later
"""A run begins with what was built, whatever the scene shows and whatever was done to it before."""

import json

import pytest
from support.blocks import Blocks
from support.checkout import SMALL

from bridge_demolition_addon.display.contours import ContourSettings
from bridge_demolition_addon.errors import SimulationError
from bridge_demolition_addon.scene.as_built import changed_bodies
from bridge_demolition_addon.scene.bodies import Kind, bodies_of, kind_of
from bridge_demolition_addon.scene.world import keep_played_frames
from bridge_demolition_addon.simulation.blender_events import contours_of, running_recording, shown_results
from bridge_demolition_addon.simulation.display.shown_results import ShownResults
from bridge_demolition_addon.simulation.recording.recorder import Recording
from bridge_demolition_addon.ui.messages import messages_of

HEIGHT_M, FRAMES = 5.0, 25


@pytest.fixture
def falling(blender):
    """A block above another."""
    blocks = Blocks()
    blocks.block((0.0, 0.0, 0.0))
    blocks.block((0.0, 0.0, HEIGHT_M), 10.0)
    yield blocks
    contours_of(blocks.scene).hide()
    shown_results(blocks.scene).forget()


def shown_where_it_fell(blocks, folder):
    """Play, and show the last frame in colours after Blender has forgotten the frames that it played."""
    folder.mkdir()
    blocks.play(folder, FRAMES)
    contours_of(blocks.scene).show(ContourSettings())
    blocks.scene.frame_set(FRAMES)
    blocks.world.solver_iterations += 1
    contours_of(blocks.scene).refresh()


def position_shown_m(blender, blocks):
    block = blocks.world.collection.objects[1]
    return tuple(block.evaluated_get(blender.context.evaluated_depsgraph_get()).matrix_world.translation)


def height_shown_m(blender, blocks):
    return position_shown_m(blender, blocks)[2]


def test_a_run_begins_with_the_bridge_where_colours_show_the_rubble_of_the_last(blender, falling, tmp_path):
    shown_where_it_fell(falling, tmp_path / "first")
    assert height_shown_m(blender, falling) < 2.0
    (tmp_path / "second").mkdir()
    second = falling.play(tmp_path / "second", FRAMES)
    assert second.frames.positions_m[0, 1, 2] == HEIGHT_M


def test_so_does_what_is_played_without_recording(blender, falling, tmp_path):
    shown_where_it_fell(falling, tmp_path / "first")
    for frame in (1, 2, 3):
        falling.scene.frame_set(frame)
    contours_of(falling.scene).settings = None  # shows where Blender has the block, and edits nothing
    falling.scene.frame_set(4)
    assert height_shown_m(blender, falling) > HEIGHT_M - 0.2


def parent(block, beside):
    block.parent = beside


def constrain(block, beside):
    constraint = block.constraints.new("COPY_LOCATION")
    constraint.target, constraint.use_offset = beside, True


@pytest.mark.parametrize("follow", [parent, constrain])
def test_it_also_begins_where_a_parent_or_a_constraint_has_a_body(follow, blender, falling, tmp_path):
    beside = blender.data.objects.new("beside", None)
    falling.scene.collection.objects.link(beside)
    beside.location.x = 2.0
    follow(falling.world.collection.objects[1], beside)
    shown_where_it_fell(falling, tmp_path / "first")
    for frame in (1, 2, 3):
        falling.scene.frame_set(frame)
    contours_of(falling.scene).settings = None
    falling.scene.frame_set(4)
    assert position_shown_m(blender, falling) == pytest.approx((2.0, 0.0, HEIGHT_M - 0.1), abs=0.1)


SHARDS, BUILT_FRAMES = 12, 6


@pytest.fixture
def built(extension, settings, tmp_path):
    """A small bridge and a ball, built by the sidebar."""
    settings.scenario_path = str(SMALL)
    extension.ops.bda.load_scenario()
    settings.scenario.time.duration_s = (BUILT_FRAMES - 2) / 24
    settings.scenario.fracture.shards = SHARDS
    extension.ops.bda.build_scenario()
    settings.output_directory, settings.overwrite = str(tmp_path / "results"), True
    return extension


def bodies_of_kind(scene, kind):
    return [body for body in bodies_of(scene) if kind_of(body) == kind]


def told(scene):
    return [message.text for message in messages_of(scene)]


def summary_in(folder):
    return json.loads((folder / "summary.json").read_text(encoding="utf-8"))


def test_nothing_is_said_of_a_bridge_as_it_was_built(built, tmp_path):
    assert built.ops.bda.run() == {"FINISHED"}
    assert summary_in(tmp_path / "results")["changed_bodies"] == []
    assert not any("Not as it was built" in text for text in told(built.context.scene))


def test_bodies_of_a_file_that_shows_its_run_have_the_shapes_of_their_meshes(built, tmp_path, capfd):
    """Blender makes a box of a body whose mesh is not evaluated yet as the simulation begins, and says so."""
    assert built.ops.bda.run() == {"FINISHED"}
    built.ops.wm.save_as_mainfile(filepath=str(tmp_path / "bridge.blend"))
    built.ops.wm.open_mainfile(filepath=str(tmp_path / "bridge.blend"))
    assert shown_results(built.context.scene).are_loaded
    for frame in range(2, BUILT_FRAMES):
        built.context.scene.frame_set(frame)
    assert "no vertices" not in "".join(capfd.readouterr())


def test_a_missing_ball_is_named_before_the_run_on_the_console_and_in_the_summary(built, tmp_path, caplog):
    scene = built.context.scene
    (ball,) = bodies_of_kind(scene, Kind.BALL)
    built.data.objects.remove(ball)
    assert built.ops.bda.register_handler() == {"FINISHED"}
    sentence = "the ball of the scenario is missing: 'Wrecking ball'"
    assert told(scene) == [f"Not as it was built: {sentence}"] and sentence in caplog.text
    for frame in range(1, BUILT_FRAMES):
        scene.frame_set(frame)
    built.ops.bda.unregister_handler()
    assert summary_in(tmp_path / "results")["changed_bodies"] == [sentence]


def test_shards_that_are_missing_added_or_moved_are_named(built, tmp_path):
    scene = built.context.scene
    first, second, third, *_ = bodies_of_kind(scene, Kind.SHARD)
    copy = third.copy()
    second.location.z += 0.5
    name = first.name
    joints = [obj.rigid_body_constraint for obj in scene.objects if obj.rigid_body_constraint]
    of_first = sum(first in (joint.object1, joint.object2) for joint in joints)
    built.data.objects.remove(first)
    built.ops.bda.remove_loose_connections()
    assert changed_bodies(scene) == [
        f"1 shard is missing, such as {name!r}",
        f"1 body is added, such as {copy.name!r}",
        f"1 shard is moved, such as {second.name!r} by 0.5 m",
        f"{of_first} connections fewer than built",
    ]


def test_the_end_of_a_run_says_what_is_missing_and_no_list_of_what_follows_from_it(built, tmp_path):
    scene = built.context.scene
    shard = bodies_of_kind(scene, Kind.SHARD)[0]
    built.data.objects.remove(shard)
    built.ops.bda.remove_loose_connections()
    scene.gravity[2] = -5.0
    assert built.ops.bda.run() == {"FINISHED"}
    missing, by_hand = [text for text in told(scene) if "as it was built" in text or "Changed in Blender" in text]
    assert missing.startswith("Not as it was built: 1 shard is missing, such as ")
    assert missing.endswith("connections fewer than built")
    assert by_hand == "Changed in Blender, and not in the scenario of the run: gravity"
    kept = (tmp_path / "results" / "scenario_as_run.toml").read_text(encoding="utf-8")
    assert "# Changed in Blender, and not in this scenario: which bodies there are" in kept  # the file says all of it


def test_a_bridge_that_was_moved_as_a_whole_runs(built):
    for shard in bodies_of_kind(built.context.scene, Kind.SHARD):
        shard.location.x += 1.0
    (sentence,) = changed_bodies(built.context.scene)
    assert sentence.startswith(f"{SHARDS} shards are moved, such as ")


def fallen(scene):
    """Leave shards as a simulation does whose positions are applied: each elsewhere, and turned in its own way."""
    for number, shard in enumerate(bodies_of_kind(scene, Kind.SHARD)):
        shard.location.z -= 0.1 * number
        shard.rotation_euler = (0.1 * number, 0.0, 0.05 * number)


@pytest.mark.parametrize("button", ["run", "register_handler"])
def test_rubble_is_refused_before_anything_runs(built, tmp_path, button):
    scene = built.context.scene
    fallen(scene)
    with pytest.raises(RuntimeError, match=r"begins with rubble: 11 of 12 shards .* undo what moved them, or build"):
        getattr(built.ops.bda, button)()
    assert running_recording() is None and not (tmp_path / "results").exists()
    built.ops.bda.build_anew()
    assert built.ops.bda.run() == {"FINISHED"}


def test_so_is_rubble_that_a_script_records(built, tmp_path):
    fallen(built.context.scene)
    with pytest.raises(SimulationError, match="begins with rubble"):
        Recording(built.context.scene, tmp_path)


def test_a_simulation_that_begins_elsewhere_than_its_scene_is_refused(blender, falling, tmp_path):
    """However Blender came to it: here by a display that leaves bodies where it shows them."""
    falling.play(tmp_path, FRAMES)
    contours_of(falling.scene).show(ContourSettings())
    falling.scene.frame_set(FRAMES)
    falling.world.solver_iterations += 1
    contours_of(falling.scene).refresh()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(ShownResults, "put_bodies_back", lambda _: None)
        with pytest.raises(SimulationError, match=r"begins with 1 of 1 shards elsewhere .* by 4 m: go to the start"):
            falling.play(tmp_path, FRAMES)


def test_a_baked_simulation_is_not_recorded(blender, falling, tmp_path):
    for frame in (1, 2, 3):
        falling.scene.frame_set(frame)
    keep_played_frames(falling.scene)
    with pytest.raises(SimulationError, match="is baked and only played back: delete the bake first"):
        Recording(falling.scene, tmp_path)
