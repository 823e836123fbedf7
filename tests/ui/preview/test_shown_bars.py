# SPDX-License-Identifier: GPL-3.0-or-later
"""Bars of what is built, as they are drawn."""

from dataclasses import replace

import numpy as np
import pytest
from support.bridges_by_rule import LM1, bridge, scenario

from bridge_demolition_addon.model.scenario import Ground
from bridge_demolition_addon.model.scenario.file import scenario_text


@pytest.fixture
def shown(settings):
    from bridge_demolition_addon.ui.preview.bars import shown_bars

    return lambda: shown_bars(settings)


def test_bars_are_shown_once_they_are_built_and_wanted(settings, shown, extension, tmp_path):
    path = tmp_path / "bridge.toml"
    path.write_text(scenario_text(scenario(bridge(LM1))), encoding="utf-8")
    settings.scenario_path = str(path)
    assert extension.ops.bda.load_scenario() == {"FINISHED"}
    settings.show_bars = True
    assert not len(shown()[0])  # nothing is built
    assert extension.ops.bda.build_scenario() == {"FINISHED"}
    lines, reason = shown()
    assert reason == ""
    ends = lines.reshape(-1, 2, 3)
    lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    assert {13.0, 3.7, 4.9} <= set(lengths.round(6).tolist())  # along and across the deck, and up the columns
    assert extension.context.scene.objects  # and nothing of it is data
    assert not any(mesh.name.startswith("Bar") for mesh in extension.data.meshes)
    settings.show_bars = False
    assert not len(shown()[0])


def test_files_that_are_gone_are_said(settings, shown):
    settings.show_bars = True
    settings.built_scenario = scenario_text(replace(scenario(bridge(LM1)), ground=Ground(file="/nowhere/terrain.stl")))
    lines, reason = shown()
    assert not len(lines) and "terrain.stl" in reason
