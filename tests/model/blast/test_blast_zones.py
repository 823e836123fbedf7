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
from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_text
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
