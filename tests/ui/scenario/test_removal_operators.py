# SPDX-License-Identifier: GPL-3.0-or-later
"""Remove Demolition and Remove Loose Connections, and what can be done after them."""

from pathlib import Path

import pytest
from support.checkout import REPORT_2019, SMALL

from bridge_demolition_addon.scene.bodies import Kind, bodies_of, kind_of
from bridge_demolition_addon.simulation.blender_events import running_recording, shown_results, stop_recording

EXPLOSIVES = REPORT_2019 / "single_span_explosives.toml"


@pytest.fixture
def built(extension, settings, tmp_path):
    """The small bridge with its ball, built, and a folder for the results."""
    settings.scenario_path = str(SMALL)
    extension.ops.bda.build_scenario()
    settings.output_directory, settings.overwrite = str(tmp_path / "results"), True
    return extension


def play(scene, frames=6):
    for frame in range(1, frames + 1):
        scene.frame_set(frame)


def record(bpy):
    bpy.ops.bda.register_handler()
    play(bpy.context.scene)
    bpy.ops.bda.unregister_handler()


@pytest.mark.parametrize("operator", ["remove_demolition", "remove_loose_connections"])
def test_an_empty_scene_and_a_running_recording_are_refused(built, operator):
    call = getattr(built.ops.bda, operator)
    built.ops.bda.register_handler()
    with pytest.raises(RuntimeError, match="A recording runs"):
        call()
    assert running_recording().error is None
    built.ops.bda.unregister_handler.poll()
    stop_recording()
    built.ops.bda.remove_demolition()
    with pytest.raises(RuntimeError, match="nothing to remove"):
        call()


def test_built_with_other_values_and_recorded_again(built, settings):
    record(built)
    assert shown_results(built.context.scene).series is not None
    settings.scenario.fracture.shards = 20
    built.ops.bda.remove_demolition()
    assert shown_results(built.context.scene).series is None, "what was recorded is of bodies that are gone"
    assert settings.scenario.fracture.shards == 20 and settings.built_scenario == ""
    built.ops.bda.build_scenario()
    assert len(built.context.scene.rigidbody_world.collection.objects) == 22
    record(built)
    assert shown_results(built.context.scene).recording.recorded_frames == 5


def test_a_deleted_shard_can_be_cleared_up_after(built):
    scene = built.context.scene
    built.data.objects.remove(scene.rigidbody_world.collection.objects["Shard 000003"])
    scene.view_layers[0].update()
    with pytest.raises(RuntimeError, match=r"lacks a body, and so do \d more: .* remove loose connections"):
        built.ops.bda.register_handler()
    assert not Path(built.context.scene.bda.output_directory).exists()
    built.ops.bda.remove_loose_connections()
    record(built)
    assert shown_results(built.context.scene).recording.error is None


@pytest.mark.long
def test_slow_motion_of_other_charges_is_refused(extension, settings, tmp_path):
    settings.scenario_path = str(EXPLOSIVES)
    extension.ops.bda.load_scenario()
    settings.scenario.fracture.shards = 20
    settings.scenario.blast.use_slow_frame_ms = True
    settings.scenario.blast.slow_frame_ms = 4.0
    extension.ops.bda.build_scenario()
    settings.output_directory, settings.overwrite = str(tmp_path / "results"), True
    record(extension)
    extension.data.objects["mid span"]["bda_delay_s"] = 0.5
    with pytest.raises(RuntimeError, match="slow motion was animated for the charges"):
        extension.ops.bda.register_handler()
    extension.ops.bda.remove_demolition()
    extension.ops.bda.build_scenario()
    record(extension)


@pytest.mark.long
def test_a_bridge_whose_ground_was_deleted_is_not_run_and_the_advice_fits(built, settings):
    scene = built.context.scene
    built.data.objects.remove(scene.rigidbody_world.collection.objects["Ground"])
    for operator in (built.ops.bda.run, built.ops.bda.register_handler):
        with pytest.raises(RuntimeError, match="the ground of scene 'Scene' is gone: undo what took it away, or build"):
            operator()
    with pytest.raises(RuntimeError, match="The ground is gone"):
        built.ops.bda.remove_loose_connections()
    built.ops.bda.build_anew()
    assert any(kind_of(body) == Kind.GROUND for body in bodies_of(scene))
    settings.overwrite = True
    assert built.ops.bda.run() == {"FINISHED"}
