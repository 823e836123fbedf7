# SPDX-License-Identifier: GPL-3.0-or-later
"""Blast zones as steps between stages."""

from support.checkout import EXAMPLES
from support.drilled_columns import ZONE, column_model, column_scenario

from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.stages.stages import stages_of
from bridge_demolition_addon.model.stages.standing import StandingBridge


def test_a_column_holds_its_block_until_its_zone_fires(tmp_path):
    scenario = column_scenario(tmp_path, ZONE)
    model = column_model(scenario)
    built, fired = stages_of(scenario, StandingBridge(model, scenario.joints), lambda done, of: None)
    block = model.member_of_shard == 1
    assert built.standing.held[block].all() and not fired.standing.held[block].any()
    assert fired.step == "zone of column: thrown out"
    assert fired.removed.sum() > 0 and not fired.removed[block].any()


def test_examples_can_be_built():
    paths = sorted((EXAMPLES / "drilled").glob("*.toml"))
    assert paths
    for path in paths:
        scenario = read_scenario(path)
        assert len(checked_model(scenario).shards) >= scenario.fracture.shards
