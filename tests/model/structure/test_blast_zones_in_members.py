# SPDX-License-Identifier: GPL-3.0-or-later
"""Blast zones in their members: worked example, warnings, cuts along their planes, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest
from support.drilled_columns import ZONE, column_members, column_model, column_scenario

from bridge_demolition_addon.engineering.drilled_charges.specific_charge import Effect
from bridge_demolition_addon.engineering.geometry.solids import box, cylinder
from bridge_demolition_addon.errors import GeometryError, ScenarioError
from bridge_demolition_addon.model.bridge.member import Member
from bridge_demolition_addon.model.changes.change import schedule
from bridge_demolition_addon.model.materials import BarLayer
from bridge_demolition_addon.model.scenario import Support
from bridge_demolition_addon.model.scenario.fracture import FracturePoint
from bridge_demolition_addon.model.sequence.checked_model import check_actions
from bridge_demolition_addon.model.sequence.lifts import model_structure
from bridge_demolition_addon.model.structure.blast_zones import (
    POSSIBLE_G_T,
    RECORDED_G_T,
    grams_per_tonne,
    placed_zone,
    zone_firings,
)

MEMBERS = column_members()


def placed(**values):
    return placed_zone(replace(ZONE, **values), MEMBERS)


def test_the_worked_example():
    """0.7 × 0.7 × 1.5 m with 10 holes of 73.5 g: 0.735 m³, 1 kg/m³, and its concrete is thrown out."""
    zone = placed()
    assert zone.volume_m3 == pytest.approx(0.735)
    assert zone.specific_kg_m3 == zone.effective_kg_m3 == pytest.approx(1.0)
    assert (zone.width_m, zone.thickness_m) == pytest.approx((0.7, 0.7))
    assert zone.burden_m == pytest.approx(0.175)  # two rows, a quarter of the width from each side
    assert zone.effect == Effect.THROWN
    # 22.5 g/t of a structure of 196 t with six such columns.
    structure = [Member("all", "bridge", MEMBERS[0].solid, 196e3 / 1.96)]
    assert grams_per_tonne(6 * zone.zone.mass_kg, structure) == pytest.approx(22.5, abs=0.05)


@pytest.mark.parametrize(
    ("charge_g", "effect"),
    [(7.35, Effect.NOTHING), (20.0, Effect.LOOSENED), (40.0, Effect.RUBBLE), (73.5, Effect.THROWN)],
)
def test_effects_by_the_charge(charge_g, effect):
    assert placed(charge_g=charge_g).effect == effect


def test_stronger_explosives_count_for_more():
    assert placed(explosive="gelatine").effective_kg_m3 == pytest.approx(1.2)
    assert placed(explosive="gelatine").specific_kg_m3 == pytest.approx(1.0)


def test_bars_stay_with_their_buckling():
    """8 bars of 25 mm: 1.96 MN in tension; in compression 0.460 of it over 0.9 m, λ 1.146, 0.838 over 0.4 m, λ 0.509.

    Straight ones resist 1.5 MN over 0.9 m, by Euler, and 1.96 MN over 0.4 m.
    """
    bars = {"bars": 8, "bar_diameter_mm": 25.0, "holes_a_row": 1}
    assert placed(height_m=0.9, **bars).cage_n == pytest.approx((1.963e6, 0.9041e6), rel=1e-3)
    assert placed(height_m=0.9, **bars).straight_cage_n == pytest.approx(1.495e6, rel=1e-3)
    assert placed(height_m=0.4, **bars).cage_n == pytest.approx((1.963e6, 1.645e6), rel=1e-3)
    assert placed(height_m=0.4, **bars).straight_cage_n == pytest.approx(1.963e6, rel=1e-3)
    assert placed().cage_n == (0.0, 0.0)


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ({"stemming_m": 0.16}, "stemming of 0.16 m is less than the burden, 0.175 m"),
        ({"depth_m": 0.6}, "holes are 0.86 of the thickness deep: 0.5 to 0.75 are usual"),
        ({"charge_g": 7.35}, "0.10 kg/m³ are outside half to twice the table"),
        ({"charge_g": 150.0}, "2.04 kg/m³ are outside half to twice the table"),
        (
            {"bars": 8, "bar_diameter_mm": 50.0},
            # 30 diameters: λ 0.955, χ 0.566
            "bars of 50 mm bared over 1.50 m resist 57% of their yield force, and all of it if they are straight: from "
            "1.57 m on these buckle, too",
        ),
        ({}, "scaled depth of burial 0.54 m/kg^(1/3) is below 0.8, and nothing covers the holes"),
    ],
)
def test_warnings(values, text):
    assert any(warning.startswith(text) for warning in placed(**values).warnings())


def test_nothing_is_said_of_a_zone_by_the_rules():
    assert list(placed(cover_factor=0.6, bars=8, bar_diameter_mm=25.0).warnings()) == []


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ({"middle_m": 3.5}, r"within column, which is from 0 to 4 \(m\) along z; this one is from 2.75 to 4.25 m"),
        ({"depth_m": 0.7}, r"depth_m is 0.7: expected less than the thickness of column there, 0.7 \(m\)"),
        ({"row_spacing_m": 0.7}, r"2 rows within column, which is 0.7 \(m\) wide there; they take 0.7 m"),
        ({"member": "pier"}, r'member is "pier": expected the name of one member, not a kind'),
        ({"member": "pillar"}, r'blast_zones.member is "pillar": expected the name or kind of a member'),
        ({"throw_kg_m3": 0.4}, r"throw_kg_m3 is 0.4: expected more than what breaks column, 0.465 \(kg/m³\)"),
    ],
)
def test_zones_beside_their_member_are_refused(values, text):
    with pytest.raises(ScenarioError, match=text):
        placed(**values)


def test_a_round_column_has_the_volume_of_a_cylinder():
    column = Member("column", "pier", cylinder(0.5, 4.0, 128), 2400.0)
    zone = placed_zone(ZONE, [column])
    assert zone.volume_m3 == pytest.approx(np.pi * 0.25 * 1.5, rel=1e-3)  # of a polygon of 128 sides
    assert zone.width_m == pytest.approx(1.0)


@pytest.mark.slow
@pytest.mark.parametrize("shards", [6, 40, 200, 1000])
def test_shards_end_at_the_planes_of_a_zone_whatever_their_number(tmp_path, shards):
    model = column_model(column_scenario(tmp_path, ZONE, shards=shards))
    of_column = [shard for shard, member in zip(model.shards, model.member_of_shard, strict=True) if member == 0]
    heights = np.array([shard.bounds[:, 2] for shard in of_column])
    for plane in (0.75, 2.25):
        assert not ((heights[:, 0] < plane - 1e-6) & (heights[:, 1] > plane + 1e-6)).any()
    inside = (heights[:, 0] > 0.75 - 1e-6) & (heights[:, 1] < 2.25 + 1e-6)
    volume = sum(shard.volume for shard, is_in in zip(of_column, inside, strict=True) if is_in)
    assert volume == pytest.approx(0.735)
    # All of the section is connected across both planes.
    across = abs(model.connections.normals[:, 2]) > 0.999
    for plane in (0.75, 2.25):
        at_plane = across & (abs(model.connections.points[:, 2] - plane) < 1e-6)
        assert model.connections.areas[at_plane].sum() == pytest.approx(0.49)


def test_points_of_the_users_own_are_refused_in_a_member_with_zones(tmp_path):
    scenario = column_scenario(tmp_path, ZONE)
    point = FracturePoint(position_m=(0.0, 0.0, 1.0))
    scenario = replace(scenario, fracture=replace(scenario.fracture, points=(point,)))
    with pytest.raises(GeometryError, match=r"column has blast_zones, along which it is cut, and 1 points of fracture"):
        column_model(scenario)


def test_a_zone_that_supports_hold_is_refused(tmp_path):
    scenario = replace(column_scenario(tmp_path, ZONE), supports=(Support(member="column"),))
    with pytest.raises(ScenarioError, match=r'blast_zones "zone": \[\[supports\]\] hold column there'):
        check_actions(scenario, column_model(scenario))


def test_only_what_fires_and_does_anything_changes_the_structure(tmp_path):
    zones = (ZONE, replace(ZONE, name="b", middle_m=3.2, fires=False))
    scenario = column_scenario(tmp_path, *zones)
    (firing,) = zone_firings(scenario, MEMBERS)
    assert firing.time_s == pytest.approx(0.301)  # it moves a millisecond after the detonation
    assert (firing.effect, firing.left, firing.speed_m_s) == ("thrown out", 0.0, 0.0)
    assert zone_firings(replace(scenario, blast=replace(scenario.blast, explosion=False)), MEMBERS) == ()
    weak = replace(scenario, blast_zones=(replace(ZONE, charge_g=7.35),))
    assert zone_firings(weak, MEMBERS) == ()
    thrown = replace(scenario, blast_zones=(replace(ZONE, debris="thrown", cover_factor=0.5),))
    # √(2 × 0.06 × 4e6 × 1 / 2400) = 14.14 m/s, half of it behind the cover
    assert zone_firings(thrown, MEMBERS)[0].speed_m_s == pytest.approx(7.07, abs=0.01)


def layers(diameter_mm=20.0, area_mm2=942.5):
    """3 bars of 20 mm at each of the four sides of the column, 60 mm deep."""
    return [
        BarLayer(members=("column",), along="z", side=side, depth_m=0.06, area_mm2=area_mm2, diameter_mm=diameter_mm)
        for side in ("start", "end", "left", "right")
    ]


def test_the_bars_of_a_zone_are_those_of_its_member():
    """12 of 20 mm: 1.885 MN at yield; over 1.5 m, λ 2.387, curve c has 0.1439 of it. They are 0.29 m from one of the
    axes, or evenly along a side."""
    zone = placed_zone(ZONE, MEMBERS, layers())
    assert (zone.bars.count, zone.bars.diameter_m) == pytest.approx((12.0, 0.02), rel=1e-3)
    assert zone.cage_n == pytest.approx((1.885e6, 0.1439 * 1.885e6), rel=2e-3)
    assert zone.bars.distances_m == pytest.approx([np.sqrt((0.29**2 + 0.7**2 / 12.0) / 2.0)] * 2)


def test_bars_of_several_diameters_keep_both_forces():
    """6 of 25 mm and 6 of 16 mm: the sums of their areas and of their second moments; curve c within 2 %.

    Over 1.5 m they have λ 1.910 and 2.984, χ 0.2122 and 0.0960.
    """
    sizes = zip(layers(), (25.0, 16.0, 25.0, 16.0), strict=True)
    two = [replace(layer, diameter_mm=d, area_mm2=3 * np.pi * d * d / 4.0) for layer, d in sizes]
    zone = placed_zone(ZONE, MEMBERS, two)
    assert zone.cage_n[0] == pytest.approx(6 * (245.4e3 + 100.5e3), rel=1e-3)
    assert zone.cage_n[1] == pytest.approx(6 * (0.2122 * 245.4e3 + 0.0960 * 100.5e3), rel=0.02)
    straight_n = 6 * (186.9e3 * (0.9 / 1.5) ** 2 + 101.6e3 * (0.5 / 1.5) ** 2)
    assert zone.straight_cage_n == pytest.approx(straight_n, rel=1e-3)


def test_bars_of_the_zone_agree_with_those_of_its_member_or_are_refused():
    assert placed_zone(replace(ZONE, bars=12, bar_diameter_mm=20.0), MEMBERS, layers()).bars.count == pytest.approx(
        12.0, rel=1e-3
    )
    with pytest.raises(ScenarioError, match=r"bars is 8: .* gives column there: 12 bars of 20 mm"):
        placed_zone(replace(ZONE, bars=8, bar_diameter_mm=25.0), MEMBERS, layers())


def test_bars_that_end_in_the_zone_or_run_another_way_do_not_stay():
    ending = [replace(layer, to_m=1.5) for layer in layers()]
    level = [BarLayer(members=("column",), along="x", side="left", depth_m=0.06, area_mm2=900.0)]
    links = [BarLayer(members=("column",), along="x", spread_mm2_m2=1000.0)]
    assert placed_zone(ZONE, MEMBERS, [*ending, *level, *links]).bars is None


def test_bars_stand_between_the_shards_at_both_planes(tmp_path):
    """Four groups of two bars, at the corners of the rectangle with their second moments."""
    scenario = column_scenario(tmp_path, replace(ZONE, bars=8, bar_diameter_mm=25.0), shards=200)
    model = column_model(scenario)
    (event,) = schedule(zone_firings(scenario, model.members), model_structure(model))
    bars = event.bars
    assert (bars.count, bars.diameter_m, bars.yield_pa) == pytest.approx((2.0, 0.025, 500e6))
    np.testing.assert_allclose(bars.points_m[:, 0, 2], 0.75)
    np.testing.assert_allclose(bars.points_m[:, 1, 2], 2.25)
    # Evenly along a square with half a side of 0.35 - 0.05 - 0.0125 m: two thirds of its square.
    np.testing.assert_allclose(abs(bars.points_m[..., :2]), 0.2875 * np.sqrt(2.0 / 3.0))
    for plane, (below, above) in enumerate(((0.0, 0.75), (2.25, 4.0))):
        for shard in bars.bodies[:, plane]:
            low, high = model.shards[shard].bounds[:, 2]
            assert below - 0.01 <= low and high <= above + 0.01
    assert not np.isin(bars.bodies, event.bodies).any()


def test_no_bars_stand_at_the_end_of_a_member(tmp_path):
    zone = replace(ZONE, middle_m=0.75, bars=8, bar_diameter_mm=25.0)
    scenario = column_scenario(tmp_path, zone)
    scenario = replace(scenario, connections=replace(scenario.connections, foundation=False))
    model = column_model(scenario)
    (event,) = schedule(zone_firings(scenario, model.members), model_structure(model))
    assert event.bars is None


@pytest.mark.parametrize(
    ("mass_t", "explosive_kg", "expected_g_t"),
    [
        (17_000.0, 150.0, 8.8),  # Rahmede viaduct, 2023
        (14_500.0, 45.0, 3.1),  # Eisern viaduct, 2023
        (3_000.0, 250.0, 83.0),  # motorway bridge of the 1960s, whose deck was blasted too
        (56_000.0, 600.0, 10.7),  # cooling towers of Gundremmingen, 2025
        (37_700.0, 275.0, 7.3),  # towers of Andorra
        (6_000.0, 75.0, 12.5),  # preheaters there, of steel
        (4_620.0, 82.6, 17.9),  # Cleveland Inner Belt, of steel, 2014
    ],
)
def test_recorded_jobs_are_within_what_is_possible(mass_t, explosive_kg, expected_g_t):
    """Explosive by the mass of the structure; all but the one with its deck are within 3 to 18 g/t."""
    one = Member("structure", "pier", box([1.0, 1.0, 1.0], [0.0, 0.0, 0.5]), 1e3 * mass_t)
    rate = grams_per_tonne(explosive_kg, [one])
    assert rate == pytest.approx(expected_g_t, abs=0.4)
    (least, most), (lowest, highest) = RECORDED_G_T, POSSIBLE_G_T
    assert lowest < rate < highest
    assert (least <= rate <= most) == (mass_t != 3_000.0)
