# SPDX-License-Identifier: GPL-3.0-or-later
"""Blast zones as a user writes them: what is refused with which numbers, times, and how they are kept."""

import tomllib
from dataclasses import replace

import numpy as np
import pytest
from support.checkout import EXAMPLES
from support.drilled_columns import ZONE, column_scenario
from support.scenarios import I235

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.blast.blast_zones import length_of_charge_m
from bridge_demolition_addon.model.bridge.preparation import prepared_members
from bridge_demolition_addon.model.scenario import BlastZone
from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_from_text, scenario_text
from bridge_demolition_addon.model.structure.blast_zones import placed_zone


@pytest.mark.parametrize(
    ("values", "text"),
    [
        (
            {"charge_g": 350.0},
            # 1.134e-3 m² × 0.25 m × 1200 kg/m³
            r"blast_zones.charge_g is 350.0: expected at most 340.2 \(g\), which a hole of 38 mm holds in 0.25 m",
        ),
        ({"holes_a_row": 6}, r"height_m is 1.5: expected at least the length of its rows, 1.65 \(m\) with 6 holes"),
        ({"stemming_m": 0.45}, r"stemming_m is 0.45: expected less than blast_zones.depth_m, 0.45 \(m\)"),
        ({"side": "top"}, r'side is "top": expected one beside a member along z: start, end, right, left'),
        ({"bars": 8}, r"bar_diameter_mm is missing: expected it with blast_zones.bars, 8"),
        ({"break_kg_m3": 1.2}, r"break_kg_m3 is 1.2: expected less than blast_zones.throw_kg_m3, 1 \(kg/m³\)"),
        ({"explosive": "sand"}, r'explosive is "sand": expected one of "gelatine", "emulsion", "ANFO", "TNT"'),
        ({"rows": 0}, r"rows is 0: expected a whole number from 1 to 100"),
    ],
)
def test_wrong_zones_are_refused_with_their_numbers(values, text):
    with pytest.raises(ScenarioError, match=text):
        replace(ZONE, **values)


def test_zones_that_overlap_are_refused(tmp_path):
    above = replace(ZONE, name="above", middle_m=2.9)  # from 2.15 m; the other ends at 2.25
    with pytest.raises(ScenarioError, match=r'"zone" ends at 2.25 m of column, and "above" begins at 2.15 m'):
        column_scenario(tmp_path, ZONE, above)
    column_scenario(tmp_path, ZONE, replace(above, middle_m=3.0))  # they touch
    column_scenario(tmp_path, ZONE, replace(above, member="other"))


def test_zones_of_one_member_run_along_one_axis(tmp_path):
    other = replace(ZONE, name="other", along="x", side="left", middle_m=9.0)
    with pytest.raises(ScenarioError, match="run along z and x: expected one axis for all zones of a member"):
        column_scenario(tmp_path, ZONE, other)


def test_zones_fire_within_the_run(tmp_path):
    with pytest.raises(
        ScenarioError, match=r"zone fires from 1.1 to 1.1 s .*: expected at least connections.warm_up_s"
    ):
        column_scenario(tmp_path, replace(ZONE, delay_ms=800.0))
    misfire = column_scenario(tmp_path, replace(ZONE, delay_ms=800.0, fires=False)).blast_zones[0]
    assert not misfire.goes_off


def test_names_are_their_own():
    unnamed = replace(ZONE, name=None)
    names = [zone.name for zone in replace(I235, blast_zones=(unnamed, replace(unnamed, member="b"))).blast_zones]
    assert names == ["Zone 1", "Zone 2"]
    with pytest.raises(ScenarioError, match=r'number 1 and \[\[blast_zones\]\] number 2 have one name, "zone"'):
        replace(I235, blast_zones=(ZONE, replace(ZONE, member="b")))


def test_zones_are_written_without_loss(tmp_path):
    scenario = column_scenario(
        tmp_path, replace(ZONE, delay_ms=0.1 + 0.2, cover_factor=0.3, bars=8, bar_diameter_mm=25)
    )
    (written,) = tomllib.loads(scenario_text(scenario))["blast_zones"]
    assert BlastZone(**written) == scenario.blast_zones[0]


def test_totals_of_the_worked_example():
    assert (ZONE.holes, ZONE.mass_kg, ZONE.drilled_m) == pytest.approx((10, 0.735, 4.5))
    assert length_of_charge_m(ZONE) == pytest.approx(0.0735 / (np.pi / 4 * 0.038**2 * 1200))


def test_rows_fire_one_after_the_other():
    zone = replace(ZONE, delay_ms=300.0, row_delay_ms=25.0, detonator="shock tube")
    assert zone.row_times_s() == pytest.approx([0.300, 0.325])
    assert zone.deviations_s() == pytest.approx([0.006, 0.0065])  # 2 % of 300 ms are 6 ms


@pytest.mark.slow
def test_times_scatter_as_the_detonators_do():
    """Over 1000 seeds: mean and standard deviation, each within four of its standard errors."""
    zone = replace(ZONE, rows=1, holes_a_row=5, delay_ms=500.0, detonator="shock tube")
    times = np.array([zone.fired_after_s(seed) for seed in range(1000)])
    assert times.mean() == pytest.approx(0.5, abs=4 * 0.01 / np.sqrt(1000))
    assert times.std() == pytest.approx(0.01, rel=4 / np.sqrt(2000))
    assert replace(zone, detonator="exact").fired_after_s(3) == 0.5
    electronic = [replace(zone, detonator="electronic").fired_after_s(seed) for seed in range(1000)]
    assert np.std(electronic) == pytest.approx(0.00034, rel=4 / np.sqrt(2000))
    assert zone.fired_after_s(7) == zone.fired_after_s(7)


def test_zones_in_steel_are_refused():
    scenario = read_scenario(EXAMPLES / "steel" / "composite_span_dropped.toml")
    members = prepared_members(scenario).members
    for member in [member.name for member in members if member.steel is not None]:
        with pytest.raises(ScenarioError, match="holes are drilled in; one of steel is severed"):
            placed_zone(replace(ZONE, member=member), members)


ROWS_OF_COLUMNS = """
[scenario]
title = "Three piers of three columns"
[time]
duration_s = 5.0
[bridge]
span_lengths_m = [12.0, 14.0, 14.0, 12.0]
density_kg_m3 = 2500
deck = { width_m = 9.0, thickness_m = 0.6 }
piers = { columns = 3, column_length_m = 1.0, column_width_m = 1.0, height_m = 8.0 }
abutments = { length_m = 1.5, width_m = 9.0 }
[fracture]
shards = 60
[connections]
material = "concrete"
method = "face"
type = "FIXED"
stiffness = "elastic"
[blast]
start_s = 0.5
[[blast_zones]]
name = "P"
member = "pier * column *"
middle_m = 2.2
height_m = 3.0
rows = 2
holes_a_row = 11
spacing_m = 0.27
depth_m = 0.8
stemming_m = 0.4
charge_g = 300.0
delay_ms = 250.0
axis_delay_ms = 100.0
column_delay_ms = 25.0
"""


def test_one_zone_stands_for_all_columns_of_its_names_with_delays_by_axis_and_column():
    zones = scenario_from_text(ROWS_OF_COLUMNS).blast_zones
    assert [(zone.name, zone.member, zone.delay_ms) for zone in zones] == [
        (
            f"P, pier {pier} column {column}",
            f"pier {pier} column {column}",
            250.0 + 100 * (pier - 1) + 25 * (column - 1),
        )
        for pier in (1, 2, 3)
        for column in (1, 2, 3)
    ]
    assert sum(zone.mass_kg for zone in zones) == pytest.approx(9 * 22 * 0.3)
    inner = scenario_from_text(ROWS_OF_COLUMNS.replace("pier *", "pier [13]").replace("column *", "column [2-3]"))
    assert [(zone.member, zone.delay_ms) for zone in inner.blast_zones] == [
        ("pier 1 column 2", 250.0),
        ("pier 1 column 3", 275.0),
        ("pier 3 column 2", 350.0),
        ("pier 3 column 3", 375.0),
    ]


def test_zones_of_several_members_are_written_one_by_one_and_read_again():
    scenario = scenario_from_text(ROWS_OF_COLUMNS)
    assert scenario_from_text(scenario_text(scenario)) == scenario


@pytest.mark.parametrize(
    ("old", "new", "text"),
    [
        ("pier * column *", "pier 9 column *", "names of columns, walls or legs of the bridge with .*; it has pier 1"),
        ("pier * column *", "pier 1 column 1", 'axis_delay_ms is 100.0: expected 0 with one member, "pier 1 column 1"'),
        ("[blast]", '[[blast_zones]]\n{0}\nname = "P, pier 1 column 2"\nmember = "deck"\n[blast]', "have one name"),
    ],
)
def test_patterns_that_fit_nothing_or_meet_other_zones_are_refused(old, new, text):
    sizes = {"middle_m": 5.0, "height_m": 1.0, "holes_a_row": 2, "depth_m": 0.4, "stemming_m": 0.2, "charge_g": 20}
    more = "\n".join(["along = 'x'", "side = 'top'", *(f"{name} = {value}" for name, value in sizes.items())])
    with pytest.raises(ScenarioError, match=text):
        scenario_from_text(ROWS_OF_COLUMNS.replace(old, new.format(more)))
