# SPDX-License-Identifier: GPL-3.0-or-later
"""A bridge that falls before anything is done to it is told of in the window, on the console and in the report."""

import json
from dataclasses import replace

import pytest
from support.checkout import SMALL

from bridge_demolition_addon.model.scenario import ConnectionSettings
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.structure.equilibrium import model_at_rest, overloaded
from bridge_demolition_addon.report.run_folder import read_run
from bridge_demolition_addon.ui.scenario.values import show_scenario

SAID = "The bridge does not stand by itself: "


@pytest.mark.parametrize("stands", [False, True])
def test_a_coarse_preset_falls_by_itself_and_that_is_said(extension, settings, tmp_path, capfd, stands):
    extension.ops.bda.load_preset(preset="span_of_2019_explosives")
    settings.scenario.fracture.shards = 40
    settings.scenario.time.duration_s = 0.6
    if stands:
        settings.scenario.connections.breaking_force_n = 1e8
    extension.ops.bda.build_scenario()
    settings.output_directory = str(tmp_path / "run")
    extension.ops.bda.run()
    summary = json.loads((tmp_path / "run" / "summary.json").read_text(encoding="utf-8"))
    fall = summary["fell_by_itself"]
    assert (fall is None) == stands
    if fall:  # charges go off at 0.4 s, and nothing breaks in the warm-up of 0.2 s
        assert fall["until_s"] == 0.4 and 0.2 < fall["first_break_s"] < 0.4 and fall["broken"] > 0
    assert (SAID in capfd.readouterr().out) != stands
    assert any(text.startswith(SAID) for text in read_run(tmp_path / "run").shortcomings) != stands


def test_a_bridge_that_is_hit_is_not_told_of(extension, settings, tmp_path):
    settings.scenario_path = str(SMALL)
    extension.ops.bda.build_scenario()
    settings.output_directory = str(tmp_path / "run")
    extension.ops.bda.run()
    assert json.loads((tmp_path / "run" / "summary.json").read_text(encoding="utf-8"))["fell_by_itself"] is None


@pytest.mark.parametrize("material, stands", [("masonry", False), ("steel", True)])
def test_it_falls_where_bda_check_says_so(extension, settings, tmp_path, material, stands):
    connections = ConnectionSettings(type="FIXED", method="face", material=material, stiffness="elastic")
    scenario = replace(read_scenario(SMALL), connections=connections, ball=None)
    awake = replace(scenario.shards, use_deactivation=False, start_deactivated=False)
    scenario = replace(scenario, shards=awake, time=replace(scenario.time, duration_s=0.4))
    model = checked_model(scenario)
    broken = overloaded(model, model_at_rest(model, scenario.joints), scenario.joints).sum()
    assert (broken == 0) == stands
    show_scenario(settings, scenario)
    extension.ops.bda.build_scenario()
    settings.output_directory = str(tmp_path / "run")
    extension.ops.bda.run()
    fall = json.loads((tmp_path / "run" / "summary.json").read_text(encoding="utf-8"))["fell_by_itself"]
    assert (fall is None) == stands
    if fall:
        assert fall["until_s"] is None and fall["broken"] >= broken
