# SPDX-License-Identifier: GPL-3.0-or-later
"""What is said beforehand of the time of stages: for so many of them as there are."""

from dataclasses import replace

from support.checkout import EXAMPLES

from bridge_demolition_addon.cli.check import scenario_facts
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.stages.stages import count_of_stages, stages_of
from bridge_demolition_addon.model.stages.standing import StandingBridge
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.studies.estimate import seconds_of_stages

SCENARIO = read_scenario(EXAMPLES / "stages" / "excavator_on_the_deck.toml")
FEW = replace(SCENARIO, fracture=replace(SCENARIO.fracture, shards=30))


def test_check_says_how_long_its_stages_take():
    model = build_model(FEW)
    stages = stages_of(FEW, StandingBridge(model, FEW.joints), lambda done, of: None, with_factor=False)
    assert count_of_stages(FEW, model) == len(stages) > 1
    told = "\n".join(scenario_facts(FEW))
    assert f" for {len(stages)} stages, to a factor of 3\n" in told and "without load factors, by --no-factor" in told
    without, with_factors = seconds_of_stages(FEW, model, len(stages))
    assert 0.0 < without < with_factors
    undone = replace(FEW, equipment=(), removals=(), weakenings=(), saw_cuts=())
    assert count_of_stages(undone, model) == 1
