# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders of a demolition: of what was not played, of what was, and while a recording runs.

Without the extension the first of these ends the process with a segmentation fault, in Blender's own code.
"""

import pytest
from support.checkout import SMALL

from bridge_demolition_addon.simulation.blender_events import running_recording

FRAMES = 8


@pytest.fixture
def scene(extension, settings, tmp_path):
    """The small bridge, and a camera that takes tiny pictures."""
    settings.scenario_path = str(SMALL)
    extension.ops.bda.build_scenario()
    settings.output_directory = str(tmp_path / "results")
    scene = extension.context.scene
    scene.camera = extension.data.objects.new("Camera", extension.data.cameras.new("Camera"))
    scene.collection.objects.link(scene.camera)
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 1, False
    scene.world = None  # Cycles maps the light of the sky again for each picture
    scene.render.resolution_x, scene.render.resolution_y = 32, 24
    scene.render.filepath = str(tmp_path / "picture_")
    scene.frame_end = FRAMES
    return scene


@pytest.fixture
def simulated(extension):
    """Whether the world was simulated in each frame that is rendered."""
    found = []

    def note(scene, *_):
        found.append(scene.rigidbody_world.enabled)

    extension.app.handlers.render_pre.append(note)
    yield found
    extension.app.handlers.render_pre.remove(note)


def play(scene, frames=FRAMES):
    for frame in range(1, frames + 1):
        scene.frame_set(frame)


def shard_heights(scene):
    graph = scene.view_layers[0].depsgraph
    return [body.evaluated_get(graph).matrix_world.translation.z for body in scene.rigidbody_world.collection.objects]


def test_a_window_is_locked_while_it_renders(scene):
    assert scene.render.use_lock_interface


def test_the_world_rests_in_a_render_of_what_was_not_played(extension, scene, simulated):
    extension.ops.render.render(animation=True)
    assert simulated == [False] * FRAMES
    assert scene.rigidbody_world.enabled
    before = shard_heights(scene)
    play(scene)
    assert max(abs(now - then) for now, then in zip(shard_heights(scene), before, strict=True)) > 0.01


def test_what_was_played_is_rendered_as_it_was(extension, scene, simulated):
    play(scene)
    extension.ops.render.render(animation=True)
    assert simulated == [True] * FRAMES


def test_the_world_rests_where_blender_has_forgotten_what_was_played(extension, scene, simulated):
    play(scene)
    scene.rigidbody_world.substeps_per_frame += 1
    extension.ops.render.render()
    assert simulated == [False] and scene.rigidbody_world.enabled


def test_a_world_that_was_switched_off_stays_off(extension, scene, simulated):
    scene.rigidbody_world.enabled = False
    extension.ops.render.render()
    assert simulated == [False] and not scene.rigidbody_world.enabled


def test_a_still_does_not_disturb_a_recording(extension, scene):
    extension.ops.bda.register_handler()
    play(scene, 5)
    extension.ops.render.render()
    for frame in range(6, FRAMES + 1):
        scene.frame_set(frame)
    recording = running_recording()
    assert recording.error is None
    assert [frame.number for frame in recording.frames] == list(range(2, FRAMES + 1))


@pytest.mark.parametrize("played", [1, 5])
def test_a_render_of_what_was_not_played_ends_a_recording(extension, scene, played):
    extension.ops.bda.register_handler()
    play(scene, played)
    extension.ops.render.render(animation=True)
    recording = running_recording()
    assert "play the timeline, then render it" in str(recording.error)
    assert recording.recorded_frames == played - 1


def test_nothing_is_left_when_switched_off(blender):
    import bridge_demolition_addon

    bridge_demolition_addon.register()
    bridge_demolition_addon.unregister()
    lists = (getattr(blender.app.handlers, name) for name in ("render_init", "render_complete", "render_cancel"))
    assert not any(
        handler.__module__.startswith("bridge_demolition_addon") for handlers in lists for handler in handlers
    )
