# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that were saved when bodies had friction and restitution of their own, without a check box."""

import json
from dataclasses import replace

import pytest
from support.checkout import PRESETS, SMALL

from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.scene.bodies import bodies_of, kind_of
from bridge_demolition_addon.ui.scenario.built import changes, scenario_to_run
from bridge_demolition_addon.ui.scenario.earlier import mark_defaults, read_earlier_keys, tick_own_values
from bridge_demolition_addon.ui.scenario.hints import contact_note
from bridge_demolition_addon.ui.scenario.operator import build_and_show
from bridge_demolition_addon.ui.scenario.prop import default_scenario
from bridge_demolition_addon.ui.scenario.values import scenario_of

NAMES = ("friction", "restitution")


def saved_as_earlier(bpy, path, *, were_shown):
    """Build with bodies of 0.6, 0.8 and 0.5, and save it as those versions did.

    What had not been shown, as nothing was loaded, was not kept in the panels.
    """
    scenario = read_scenario(SMALL)
    scene = bpy.context.scene
    build_and_show(scene, replace(scenario, shards=replace(scenario.shards, friction=0.6)))
    settings = scene.bda
    for body in (settings.scenario.shards, settings.scenario.ground, settings.scenario.ball):
        for name in NAMES:
            body.property_unset("use_" + name)
            if not were_shown:
                body.property_unset(name)
    settings.scenario.property_unset("use_contacts")
    kept = json.loads(settings.built_values)
    del kept["contacts"]
    settings.built_values = json.dumps(kept)
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    bpy.ops.wm.read_factory_settings(use_empty=True)


@pytest.mark.parametrize("were_shown", [True, False])
def test_a_file_that_was_built_opens_and_can_be_run_as_it_was(extension, tmp_path, caplog, were_shown):
    saved_as_earlier(extension, tmp_path / "earlier.blend", were_shown=were_shown)
    extension.ops.wm.open_mainfile(filepath=str(tmp_path / "earlier.blend"))
    scene = extension.context.scene
    assert "friction and restitution are those of single bodies" in caplog.text
    assert changes(scene.bda) == []
    scenario = scenario_to_run(scene.bda)
    assert scenario.contacts is None
    assert (scenario.shards.friction, scenario.ground.friction, scenario.ball.friction) == (0.6, 0.8, 0.5)
    found = {kind_of(body).value: body.rigid_body.friction for body in bodies_of(scene)}
    assert found == pytest.approx({"shard": 0.6, "ground": 0.8, "ball": 0.5}, rel=1e-6)
    assert not tick_own_values(scene.bda), "it is read once"


def test_a_file_of_today_is_left_as_it_is(extension, settings, tmp_path):
    settings.scenario_path = str(SMALL)
    extension.ops.bda.load_scenario()
    extension.ops.bda.build_scenario()
    before = scenario_of(settings)
    extension.ops.wm.save_as_mainfile(filepath=str(tmp_path / "today.blend"))
    extension.ops.wm.open_mainfile(filepath=str(tmp_path / "today.blend"))
    settings = extension.context.scene.bda
    assert changes(settings) == [] and scenario_of(settings) == before
    assert settings.scenario.use_contacts and contact_note(settings.scenario) == ""


def test_a_script_that_sets_the_value_of_a_body_has_it(settings):
    settings.scenario.shards.friction = 0.25
    scenario = scenario_of(settings)
    assert scenario.contacts is None
    assert (scenario.shards.friction, scenario.ground.friction) == (0.25, 0.8)
    assert "a contact has the products" in contact_note(settings.scenario)
    settings.scenario.contacts.ground.friction = 0.3
    with pytest.raises(Exception, match=r"contacts.ground.friction and shards.friction are given together"):
        scenario_of(settings)
    settings.scenario.shards.use_friction = False
    assert scenario_of(settings).contacts.ground.friction == 0.3


def test_a_file_of_when_a_new_scene_had_other_values_keeps_them(extension, tmp_path):
    """Blender saves what was set alone: all else of such a file is a deck of 0.25 m without bars."""
    scene = extension.context.scene
    scene.bda.scenario.bridge.deck.width_m = 7.0
    scene.bda.scenario.use_ball = False
    extension.app.handlers.save_pre.remove(mark_defaults)
    extension.ops.wm.save_as_mainfile(filepath=str(tmp_path / "earlier.blend"))
    extension.app.handlers.save_pre.append(mark_defaults)
    extension.ops.wm.open_mainfile(filepath=str(tmp_path / "earlier.blend"))
    scenario = scenario_of(extension.context.scene.bda)
    of_2019 = read_scenario(PRESETS / "span_of_2019_ball.toml")
    bridge = replace(of_2019.bridge, deck=replace(of_2019.bridge.deck, width_m=7.0))
    assert scenario == replace(of_2019, bridge=bridge, ball=None)


@pytest.mark.parametrize("width_m", [None, 7.0])
def test_a_new_file_of_today_has_bars_also_when_it_is_opened_again(extension, tmp_path, width_m):
    scene = extension.context.scene
    if width_m:
        scene.bda.scenario.bridge.deck.width_m = width_m
    extension.ops.wm.save_as_mainfile(filepath=str(tmp_path / "today.blend"))
    extension.ops.wm.open_mainfile(filepath=str(tmp_path / "today.blend"))
    bridge = scenario_of(extension.context.scene.bda).bridge
    assert bridge.reinforcement.has_bars and bridge.deck.width_m == (width_m or default_scenario().bridge.deck.width_m)


def test_an_earlier_file_without_any_of_our_values_has_those_of_today(extension, tmp_path):
    extension.app.handlers.save_pre.remove(mark_defaults)
    extension.ops.wm.save_as_mainfile(filepath=str(tmp_path / "earlier.blend"))
    extension.app.handlers.save_pre.append(mark_defaults)
    extension.ops.wm.open_mainfile(filepath=str(tmp_path / "earlier.blend"))
    assert scenario_of(extension.context.scene.bda) == default_scenario()


def test_values_under_earlier_names_of_keys_are_read(settings):
    scenario = read_scenario(SMALL)
    settings.scenario.neighbours.add()
    kept = settings.scenario.neighbours[0].bl_system_properties_get(do_create=True)
    kept["place_m"] = [1.0, 2.0, 3.0]
    settings.built_values = '{"neighbours.1.place_m": 1}'
    read_earlier_keys()
    assert tuple(settings.scenario.neighbours[0].position_m) == (1.0, 2.0, 3.0)
    assert settings.built_values == '{"neighbours.1.position_m": 1}'
    assert scenario.time.rest_angular_velocity_rad_s > 0.0
