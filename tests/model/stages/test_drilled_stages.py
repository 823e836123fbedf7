# SPDX-License-Identifier: GPL-3.0-or-later
"""Blast zones as steps between stages."""

import csv

import pytest
from support.checkout import EXAMPLES
from support.drilled_columns import LOAD_N, ZONE, column_model, column_scenario

from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.stages.misfires import ALL_FIRE, misfire_sentences, misfires
from bridge_demolition_addon.model.stages.stages import criticality, stages_of
from bridge_demolition_addon.model.stages.standing import StandingBridge
from bridge_demolition_addon.model.stages.tables import write_tables
from bridge_demolition_addon.report.sections.stages import stages_section


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


def test_what_stands_if_a_zone_fails(tmp_path):
    """The column holds 51 t of block: all of it comes down if the zone fires, and nothing if it fails."""
    scenario = column_scenario(tmp_path, ZONE)
    model = column_model(scenario)
    fired, failed = misfires(scenario, StandingBridge(model, scenario.joints), lambda done, of: None)
    block_kg, column_kg = LOAD_N / 9.80665, 2400.0 * 0.49 * 4.0
    above_kg = 2400.0 * 0.49 * 1.75  # of the column, from 2.25 m on
    assert fired.fails == ALL_FIRE
    assert fired.falls_kg == pytest.approx(block_kg + above_kg)
    assert fired.stands_kg == pytest.approx(2400.0 * 0.49 * 0.75)  # its stump
    assert fired.falls_share == pytest.approx((block_kg + above_kg) / (block_kg + column_kg))
    assert fired.members == ()
    assert (failed.fails, failed.falls_kg, failed.members) == ("zone", 0.0, ("column", "block"))
    assert misfire_sentences([fired, failed]) == [
        "if all zones fire: 53.0 t come down, 95%; no member stands",
        "if zone fails: nothing comes down; column, block stand",
    ]


def test_tables_and_report_have_the_misfires(tmp_path):
    scenario = column_scenario(tmp_path, ZONE)
    bridge = StandingBridge(column_model(scenario), scenario.joints)
    stages = stages_of(scenario, bridge, lambda done, of: None)
    failures = misfires(scenario, bridge, lambda done, of: None)
    write_tables(tmp_path / "stages", stages, criticality(bridge, lambda done, of: None), bridge, failures)
    with (tmp_path / "stages" / "misfires.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["fails"] for row in rows] == [ALL_FIRE, "zone"]
    assert float(rows[0]["falls_kg"]) == pytest.approx(failures[0].falls_kg, rel=1e-5)  # six digits
    section = stages_section(tmp_path / "stages")
    (table,) = [block for block in section.blocks if getattr(block, "name", "") == "misfires"]
    assert len(table.rows) == 2


def test_without_zones_nothing_can_fail(tmp_path):
    scenario = column_scenario(tmp_path)
    assert misfires(scenario, StandingBridge(column_model(scenario), scenario.joints), lambda done, of: None) == []
