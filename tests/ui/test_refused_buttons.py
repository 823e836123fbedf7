# SPDX-License-Identifier: GPL-3.0-or-later
"""Buttons that cannot work are greyed with the reason: outside object mode, and in a scene of another file."""

from dataclasses import replace

import pytest
from support.checkout import REPORT_2019

from bridge_demolition_addon.errors import SimulationError
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.sequence.checked_model import checked_model

EXPLOSIVES = REPORT_2019 / "single_span_explosives.toml"
MODES = ("EDIT", "SCULPT", "WEIGHT_PAINT")

IN_A_LINKED_SCENE = {
    "dismiss_messages": "There are no messages",
    "draw_charts": "Nothing was recorded yet",
    "export_run": "Nothing was recorded yet",
    "go_to_body": "Nothing was recorded yet",
    "go_to_peak": "This run has no chart of forces",
    "look_at_section": "Nothing was recorded yet",
    "make_report": "Run the scene first",
    "make_word_report": "Run the scene first",
    "open_report": "Run the scene first",
    "open_tradeoff": "No optimisation has ended yet",
    "open_walkthrough": "no xdg-open",
    "open_results": "Nothing was recorded yet",
    "open_search_curve": "No search has ended yet",
    "pause_study": "No study is at work",
    "resume_study": "No study is paused",
    "show_picture": "This run has no pictures yet",
    "show_study": "Choose the folder of a study first",
    "stop_optimise": "No optimisation is at work",
    "stop_run_beside": "No run goes on beside Blender",
    "stop_search": "No search is at work",
    "stop_study": "No study is at work",
    "unregister_handler": "No recording runs",
    "write_section": "Nothing was recorded yet",
}
"""What buttons say that only look at a scene; all others change it."""


@pytest.fixture
def busy(extension, request):
    """Blender in another mode than object mode."""
    extension.ops.mesh.primitive_cube_add()
    extension.ops.object.mode_set(mode=request.param)
    yield extension
    extension.ops.object.mode_set(mode="OBJECT")


def settings_of(scene):
    """All plain settings of a scene, its units and its rendering, and what it keeps under names of its own."""
    found = {
        name: str(getattr(value, "to_list", lambda value=value: value)())
        for name, value in scene.items()
        if name != "bda"
    }
    for part in (scene, scene.unit_settings, scene.render):
        for prop in part.bl_rna.properties:
            if prop.type in ("BOOLEAN", "INT", "FLOAT", "STRING", "ENUM"):
                value = getattr(part, prop.identifier)
                found[part.bl_rna.identifier, prop.identifier] = tuple(value) if getattr(prop, "is_array", 0) else value
    return found


def everything(bpy):
    kinds = (bpy.data.objects, bpy.data.meshes, bpy.data.collections, bpy.data.actions)
    return {operator for kind in kinds for operator in kind}


@pytest.mark.parametrize("busy", MODES, indirect=True)
def test_buttons_that_make_or_remove_objects_need_object_mode(busy):
    busy.context.scene.bda.scenario_path = str(EXPLOSIVES)
    before = everything(busy)
    buttons = ("build_scenario", "load_scenario", "new_scenario", "add_source_point", "remove_demolition")
    for button in buttons:
        with pytest.raises(RuntimeError, match="Go to object mode first"):
            getattr(busy.ops.bda, button)()
    assert everything(busy) == before


@pytest.mark.parametrize("busy", MODES, indirect=True)
def test_a_script_that_builds_in_another_mode_leaves_nothing(busy):
    from bridge_demolition_addon.scene.demolition import build_demolition

    scenario, scene, before = read_scenario(EXPLOSIVES), busy.context.scene, everything(busy)
    scene.gravity, scene.unit_settings.system, scene.unit_settings.scale_length = (1.0, 2.0, -3.0), "IMPERIAL", 0.5
    scene.render.fps, scene.render.fps_base, scene.frame_start, scene.frame_end = 30, 1.001, 7, 90
    scene["bda_strength_pa"], scene["bda_blast_explosion"], scene["mine"] = [1.0, 2.0, 3.0, 4.0], False, "stays"
    scene.frame_set(12)
    settings = settings_of(scene)
    scenario = replace(
        scenario, fracture=replace(scenario.fracture, shards=20), blast=replace(scenario.blast, apply="fields")
    )
    with pytest.raises(SimulationError, match="go to object mode first, or apply the blast directly"):
        build_demolition(scene, scenario, checked_model(scenario))
    assert everything(busy) == before
    assert settings_of(scene) == settings
    assert scene.rigidbody_world is None
    busy.ops.object.mode_set(mode="OBJECT")
    build_demolition(scene, scenario, checked_model(scenario))
    assert scene.rigidbody_world


def test_a_scene_of_another_file_is_not_changed(extension, settings, tmp_path):
    settings.scenario_path = str(EXPLOSIVES)
    extension.ops.bda.load_scenario()
    settings.scenario.fracture.shards = 20
    extension.ops.bda.build_scenario()
    path = str(tmp_path / "bridge.blend")
    extension.ops.wm.save_as_mainfile(filepath=path)
    extension.ops.wm.read_factory_settings(use_empty=True)
    with extension.data.libraries.load(path, link=True) as (stored, linked):
        linked.scenes = stored.scenes
    extension.context.window.scene = linked.scenes[0]
    before = everything(extension)
    for button in dir(extension.ops.bda):
        said = IN_A_LINKED_SCENE.get(button, r"linked from bridge\.blend: open that file to change it")
        with pytest.raises(RuntimeError, match=said):
            getattr(extension.ops.bda, button)()
    assert everything(extension) == before
    for frame in range(1, 4):
        linked.scenes[0].frame_set(frame)
