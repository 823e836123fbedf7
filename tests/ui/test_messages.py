# SPDX-License-Identifier: GPL-3.0-or-later
"""Messages that stay in the sidebar until their button is pressed again."""

import pytest
from support.checkout import SMALL

from bridge_demolition_addon.ui.messages import messages_of


def texts(bpy):
    return [(message.level, message.text) for message in messages_of(bpy.context.scene)]


def test_an_error_stays_until_its_button_works(extension, settings):
    settings.scenario_path = "no_such.toml"
    with pytest.raises(RuntimeError):
        extension.ops.bda.build_scenario()
    ((level, text),) = texts(extension)
    assert level == "ERROR" and "no_such.toml" in text
    extension.ops.bda.new_scenario()
    assert len(texts(extension)) == 1
    settings.scenario_path = str(SMALL)
    extension.ops.bda.build_scenario()
    assert texts(extension) == []


def test_what_a_run_warned_of_stays_in_its_scene_alone(extension, settings, tmp_path):
    settings.scenario_path = str(SMALL)
    extension.ops.bda.build_scenario()
    extension.context.scene.gravity.z = -1.62
    extension.context.scene.frame_end = 5
    settings.output_directory = str(tmp_path / "run")
    extension.ops.bda.run()
    found = texts(extension)
    assert [level for level, _ in found] == ["WARNING", "WARNING", "INFO"]
    assert "without a hit of the ball" in found[0][1]
    assert "gravity" in found[1][1] and str(tmp_path / "run") in found[2][1]
    extension.ops.scene.new(type="EMPTY")
    assert texts(extension) == []


def test_what_was_said_of_the_bridge_before_goes_as_another_is_built(extension, settings, tmp_path):
    settings.scenario_path = str(SMALL)
    extension.ops.bda.build_scenario()
    extension.context.scene.gravity.z = -1.62
    extension.context.scene.frame_end = 5
    settings.output_directory = str(tmp_path / "run")
    extension.ops.bda.run()
    assert len(texts(extension)) == 3
    extension.ops.bda.build_anew()
    assert texts(extension) == []


def test_they_can_be_dismissed(extension, settings):
    assert not extension.ops.bda.dismiss_messages.poll()
    settings.scenario_path = "no_such.toml"
    with pytest.raises(RuntimeError):
        extension.ops.bda.load_scenario()
    extension.ops.bda.dismiss_messages()
    assert texts(extension) == [] and not extension.ops.bda.dismiss_messages.poll()
