# SPDX-License-Identifier: GPL-3.0-or-later
"""Blast zones as steps between stages."""

import csv
from dataclasses import replace

import numpy as np
import pytest
from support.checkout import EXAMPLES
from support.drilled_columns import LOAD_N, ZONE, column_model, column_scenario
from support.long_cases import long_but

from bridge_demolition_addon.model.scenario import Removal
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.stages.misfires import ALL_FIRE, misfire_sentences, misfires
from bridge_demolition_addon.model.stages.stages import criticality, stages_of
from bridge_demolition_addon.model.stages.standing import StandingBridge, made_elastic
from bridge_demolition_addon.model.stages.tables import write_tables
from bridge_demolition_addon.report.sections.stages import stages_section

pytestmark = pytest.mark.slow


def test_a_column_holds_its_block_until_its_zone_fires(tmp_path):
    scenario = column_scenario(tmp_path, ZONE)
    model = column_model(scenario)
    built, fired = stages_of(scenario, StandingBridge(model, scenario.joints), lambda done, of: None)
    block = model.member_of_shard == 1
    assert built.standing.held[block].all() and not fired.standing.held[block].any()
    assert fired.step == "zone of column: thrown out"
    assert fired.removed.sum() > 0 and not fired.removed[block].any()


@pytest.mark.long
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


@pytest.mark.long
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


G = 9.80665
BAR_M2 = np.pi * 0.025**2 / 4.0
CURVE_C = {0.4: 0.8379, 0.9: 0.4605, 1.5: 0.2122}
"""χ of bars of 25 mm bared over so much, by hand: λ = 0.5093, 1.1459 and 1.9099."""


def pressed_n(height_m):
    """Weight of the block and of the column above a zone about 1.5 m, N."""
    return LOAD_N + 0.49 * (4.0 - 1.5 - height_m / 2.0) * 2400.0 * G


@pytest.mark.parametrize(
    ("height_m", "holes", "count"),
    long_but([(0.4, 1, 8), (0.9, 3, 8)], [(0.4, 1, 8), (0.9, 3, 8), (1.5, 5, 12)], several=True),
)
def test_bare_bars_carry_up_to_what_they_may_be_counted_on_for(tmp_path, height_m, holes, count):
    """Bars of 25 mm by hand, χ A f_y each; factors by weight."""
    zone = replace(ZONE, height_m=height_m, holes_a_row=holes, charge_g=100.0, bars=count, bar_diameter_mm=25.0)
    scenario = column_scenario(tmp_path, zone)
    model = column_model(scenario)
    _, fired = stages_of(scenario, StandingBridge(model, scenario.joints), lambda done, of: None)
    (bars,) = fired.bars
    most_n = count * CURVE_C[height_m] * 500e6 * BAR_M2
    assert bars.force_n == pytest.approx(-pressed_n(height_m), rel=1e-3)
    assert bars.resisted_n == pytest.approx(most_n, rel=1e-3)
    assert fired.standing.held[model.member_of_shard == 1].all()
    assert fired.collapse_factor == pytest.approx(most_n / pressed_n(height_m), rel=0.015)
    shortened_m = pressed_n(height_m) * height_m / (200e9 * count * BAR_M2)
    assert fired.standing.sag_m > shortened_m


@pytest.mark.long
def test_bars_that_resist_less_than_the_weight_are_no_support(tmp_path):
    """8 bars of 25 mm over 1.5 m may be counted on for 417 kN of 520 kN; straight they would resist 538 kN."""
    scenario = column_scenario(tmp_path, replace(ZONE, bars=8, bar_diameter_mm=25.0))
    model = column_model(scenario)
    bridge = StandingBridge(model, scenario.joints)
    _, fired = stages_of(scenario, bridge, lambda done, of: None)
    assert not fired.standing.held[model.member_of_shard == 1].any()
    assert fired.bars == ()
    assert 8 * CURVE_C[1.5] * 500e6 * BAR_M2 == pytest.approx(0.80 * pressed_n(1.5), rel=0.01)
    assert np.isnan(fired.collapse_factor)  # there is none of what is left where part of the bridge is not held
    all_fire, _ = misfires(scenario, bridge, lambda done, of: None)
    assert all_fire.falls_kg == pytest.approx(pressed_n(1.5) / G, rel=1e-6)


def test_hanging_bars_carry_up_to_yield(tmp_path):
    """A column that hangs from its block, which is held: 2 bars of 12 mm carry its 40 kN up to 2 A f_y = 113 kN."""
    from bridge_demolition_addon.engineering.geometry.solids import box
    from bridge_demolition_addon.model.bridge.member import Member
    from bridge_demolition_addon.model.scenario import Support
    from bridge_demolition_addon.model.structure.model import build_model

    scenario = replace(
        column_scenario(tmp_path, replace(ZONE, middle_m=4.0, bars=2, bar_diameter_mm=12.0)),
        supports=(Support(member="block"),),
    )
    model = build_model(
        scenario,
        [
            Member("column", "pier", box([0.7, 0.7, 4.0], [0.0, 0.0, 3.0]), 2400.0),
            Member("block", "deck", box([4.0, 4.0, 1.0], [0.0, 0.0, 5.5]), 2400.0),
        ],
    )
    _, fired = stages_of(scenario, StandingBridge(model, scenario.joints), lambda done, of: None)
    (bars,) = fired.bars
    hanging_n, most_n = 0.49 * 2.25 * 2400.0 * G, 2.0 * 500e6 * np.pi * 0.012**2 / 4.0
    assert bars.force_n == pytest.approx(hanging_n, rel=1e-3)
    assert bars.resisted_n == pytest.approx(most_n)
    assert fired.collapse_factor == pytest.approx(most_n / hanging_n, rel=0.015)


def test_what_comes_down_at_most_is_that_on_bars_that_sway_or_are_pressed_twice(tmp_path):
    """Over 0.9 m the bars resist 1.36 MN, more than twice the load, but a column alone sways on them: where their ends
    move sideways as those of a cantilever does, Euler's load of 12 bars is π² E I / (2 h)² = 140 kN, of 523 kN."""
    zone = replace(ZONE, height_m=0.9, holes_a_row=3, bars=12, bar_diameter_mm=25.0)
    scenario = column_scenario(tmp_path, zone)
    fired, failed = misfires(scenario, StandingBridge(column_model(scenario), scenario.joints), lambda done, of: None)
    assert fired.falls_kg == 0.0
    assert fired.falls_at_most_kg == pytest.approx(pressed_n(0.9) / G, rel=1e-6)
    assert failed.falls_at_most_kg == 0.0
    assert misfire_sentences([fired])[0] == (
        "if all zones fire: nothing comes down at rest, and up to 53.4 t where bars are pressed at once and sway; "
        "block stand"
    )


@pytest.mark.long
def test_bars_of_what_was_taken_away_are_gone(tmp_path):
    zone = replace(ZONE, height_m=0.9, holes_a_row=3, bars=8, bar_diameter_mm=25.0)
    scenario = replace(column_scenario(tmp_path, zone), removals=(Removal(time_s=0.6, members=("block",)),))
    model = column_model(scenario)
    *_, fired, last = stages_of(scenario, StandingBridge(model, scenario.joints), lambda done, of: None)
    assert fired.bars[0].force_n == pytest.approx(-pressed_n(0.9), rel=1e-3)
    assert last.bars[0].force_n == pytest.approx(-(pressed_n(0.9) - LOAD_N), rel=1e-2)


@pytest.mark.long
def test_what_stands_of_the_viaduct_if_a_zone_fails():
    """Walls of 0.8 × 5 m. A foot that fails leaves its wall up to the middle zone; a middle that fails comes down."""
    scenario = read_scenario(EXAMPLES / "drilled" / "viaduct_pier.toml")
    scenario = replace(scenario, fracture=replace(scenario.fracture, shards=60))
    model = checked_model(made_elastic(scenario))
    all_fire, *failed = misfires(scenario, StandingBridge(model, scenario.joints), lambda done, of: None)
    zones = {zone.name: zone.ends_along_m for zone in scenario.blast_zones}
    kg_m = 0.8 * 5.0 * 2450.0
    stumps_kg = kg_m * sum(begin_m for name, (begin_m, _) in zones.items() if "foot" in name)
    assert all_fire.stands_kg == pytest.approx(stumps_kg)
    assert [misfire.fails for misfire in failed] == list(zones)
    for misfire in failed:
        begin_m, end_m = zones[misfire.fails]
        pier = misfire.fails.split()[0]
        if "foot" in misfire.fails:
            left_kg = kg_m * (zones[f"{pier} middle"][0] - begin_m)
            assert misfire.stands_kg == pytest.approx(stumps_kg + left_kg)
        else:
            assert misfire.falls_kg == pytest.approx(all_fire.falls_kg + kg_m * (end_m - begin_m))
        assert misfire.falls_at_most_kg == misfire.falls_kg
