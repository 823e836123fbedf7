# SPDX-License-Identifier: GPL-3.0-or-later
"""Undo in the middle of a simulation goes back to the start frame, and the panel says so."""

import pytest
from support.checkout import SMALL

from bridge_demolition_addon.ui.scenario.hints import undo_note


@pytest.fixture
def built(extension, settings):
    settings.scenario_path = str(SMALL)
    extension.ops.bda.load_scenario()
    settings.scenario.fracture.shards = 10
    extension.ops.bda.build_scenario()
    return extension


def test_it_is_said_until_the_timeline_goes_on(built):
    built.ops.ed.undo_push(message="before")
    built.context.scene.bda.scenario.seed = 5
    built.ops.ed.undo_push(message="after")
    for frame in (2, 3):
        built.context.scene.frame_set(frame)
    assert undo_note(built.context.scene) == ""
    built.ops.ed.undo()
    scene = built.context.scene
    assert scene.frame_current == 1 and undo_note(scene).startswith("Undo began the simulation again")
    scene.frame_set(2)
    assert undo_note(scene) == ""
    scene.frame_set(1)
    assert undo_note(scene) == ""
