# SPDX-License-Identifier: GPL-3.0-or-later
"""What stands on blast zones, by hand: a column under a block, one that hangs, a cantilever."""

import json
from dataclasses import replace

import numpy as np
import pytest
from support.drilled_columns import LOAD_N, ZONE, column_members, column_model, column_scenario

from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.model.bridge.member import Member
from bridge_demolition_addon.model.results.stability import Stability, ZoneLoad
from bridge_demolition_addon.model.scenario import Support
from bridge_demolition_addon.model.sequence.checked_model import ModelWorksite
from bridge_demolition_addon.model.stages.stability import stability_of
from bridge_demolition_addon.model.structure.blast_zones import placed_zone, zone_totals
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.model.structure.zone_loads import load_facts, zone_falls

G = 9.80665
WEIGHT_N_M = 0.49 * 2400.0 * G
"""Of the column."""


def texts(scenario, model, zones):
    """What `bda check` says of the first zone."""
    site = ModelWorksite(scenario, model, zones)
    return [text for _, text in scenario.blast_zones[0].facts(site)]


@pytest.mark.parametrize("shards", [6, 40])
@pytest.mark.parametrize(("middle_m", "above_m"), [(1.5, 1.75), (0.75, 2.5), (3.25, 0.0)])
def test_a_zone_carries_what_is_above_it(tmp_path, middle_m, above_m, shards):
    """500 kN of block, and what there is of the column, also where the zone ends with it."""
    scenario = column_scenario(tmp_path, replace(ZONE, middle_m=middle_m, bars=8, bar_diameter_mm=25.0), shards=shards)
    model = column_model(scenario)
    stability = stability_of(scenario, model, with_factor=False)
    (load,) = stability.zones
    assert load.pressed_n == pytest.approx(LOAD_N + WEIGHT_N_M * above_m, rel=1e-4)
    assert load.shear_n == pytest.approx(0.0, abs=50.0) and load.bending_nm == pytest.approx(0.0, abs=2e3)
    assert Stability.of_json(json.loads(json.dumps(stability.to_json()))) == stability
    (fall,) = zone_falls([placed_zone(scenario.blast_zones[0], model.members)], scenario).values()
    assert (fall.falls_m, fall.above_m, fall.below_m) == pytest.approx((1.5, above_m, 2.5 - above_m))
    assert fall.can_stand and fall.lands_m_s == pytest.approx(np.sqrt(2.0 * G * 1.5))


def test_check_says_what_its_bars_hold_and_that_it_can_land_and_stand(tmp_path):
    """521 kN on 8 bars of 25 mm over 1.5 m, which may be counted on for 417 kN, 538 kN if straight."""
    scenario = column_scenario(tmp_path, replace(ZONE, bars=8, bar_diameter_mm=25.0))
    model = column_model(scenario)
    told = texts(scenario, model, stability_of(scenario, model, with_factor=False).zones)
    assert "pressed with 0.52 MN at rest, 1.25 times what bars may be counted on for: they fold" in told
    # 520.2 kN · 1.5 m / (8.575 and 17.15 MN - 0.52 MN); 0.35 m less half of 0.52 / (17.5 · 0.7) m; R = 1.7846 m to its
    # head is 0.0346 m more than 1.75 m, and (1.75² - 0.35²) / R² = 0.923 is left: 4 · 0.0346 (R / 0.7 / 0.923)² m
    assert told[-3:] == [
        "what is above falls by 1.50 m (lands with 5.4 m/s), can land upright on its stub of 0.75 m and stand: a "
        "second zone of the member lets it fold",
        "by energy 0.05 to 0.10 m of its 1.75 m are crushed (8.6 to 17.1 MN crush its end), and it stands on what is "
        "left if its head is within 0.33 m of its foot",
        "where it lands on an edge and nothing holds its head it can tip over: that takes a fall of 1.06 m",
    ]
    assert "what it carries at rest is not known by statics" in texts(scenario, model, ())
    whole, level = (
        replace(placed_zone(ZONE, column_members()), zone=replace(ZONE, along=along, side="right")) for along in "zx"
    )
    totals = [dict(zone_totals([placed], column_members())) for placed in (whole, level)]
    assert ["look at" in total and "what lands" in total["look at"] for total in totals] == [True, False]
    misfire = replace(scenario, blast_zones=(replace(ZONE, fires=False),))
    assert texts(misfire, model, (ZoneLoad("zone", 521e3, 0.0, 0.0),))[-1] == "pressed with 0.52 MN at rest"


@pytest.mark.parametrize(
    ("pressed_n", "text"),
    [
        (200e3, "they hold it"),
        (260e3, "they hold it if they are straight"),
        (400e3, "they hold it at rest, but fold as it comes upon them at once, up to twice"),
        (420e3, "they fold"),
        (-900e3, "they hold it"),
        (-1.9e6, "they hold it at rest, but tear or stretch as it comes upon them at once, up to twice"),
        (-2.1e6, "they tear or stretch"),
    ],
)
def test_bars_are_judged_by_their_least_and_their_largest_resistance(pressed_n, text):
    """8 bars of 25 mm over 1.5 m: 417 kN, or 538 kN if straight, and 1963 kN in tension; at once with up to twice."""
    placed = placed_zone(replace(ZONE, bars=8, bar_diameter_mm=25.0), column_members())
    facts = list(load_facts(placed, ZoneLoad("zone", pressed_n, 0.0, 0.0)))
    assert facts[0][1].endswith(f"counted on for: {text}")
    assert ("look at" in dict(facts)) == ("hold it" in text and "at rest" not in text)
    assert "no bars are left" in next(load_facts(placed_zone(ZONE, column_members()), ZoneLoad("zone", 1.0, 0, 0)))[1]


@pytest.mark.parametrize(
    ("pressed_n", "text"),
    [
        (
            9e6,
            "by energy it can be crushed from end to end: 8.6 to 17.1 MN crush its end, by what explosive leaves of ",
        ),
        (
            6e6,
            "by energy it can be crushed from end to end: 8.6 to 17.1 MN crush its end, by what explosive leaves of ",
        ),
        (-1e5, None),
    ],
)
def test_what_can_be_crushed_from_end_to_end_is_not_said_to_stand(tmp_path, pressed_n, text):
    """6 MN fall 1.5 m: 9 MN·m against 2.575 MN, the force that crushes less that of 6 MN, take 3.5 m of 2.5 m."""
    scenario = column_scenario(tmp_path, ZONE)
    loads = {"zone": ZoneLoad("zone", pressed_n, 0.0, 0.0)}
    (fall,) = zone_falls([placed_zone(ZONE, column_members())], scenario, loads).values()
    assert [found.startswith(text) for found in fall.landing_texts()] == [True] * bool(text)
    assert fall.can_stand == (text is None) == ("can land upright" in fall.text)


def falls_of_two(tmp_path, height_m, loads):
    zones = [
        replace(ZONE, name=name, middle_m=middle_m, height_m=height_m, holes_a_row=2, spacing_m=0.2)
        for name, middle_m in (("foot", 0.1 + height_m / 2.0), ("middle", 2.5), ("misfire", 3.5))
    ]
    zones[2] = replace(zones[2], fires=False)
    members = column_members()
    return zone_falls([placed_zone(zone, members) for zone in zones], column_scenario(tmp_path), loads)


def test_two_zones_of_a_member_let_it_fold_where_a_piece_tips_after_both_falls(tmp_path):
    """What is above the upper zone falls by both heights: it lands with √(2 g 1.2 m), and tips on an edge from

    4 (√(1.2² + 0.35²) - 1.2) (1.2² + 0.35²) / 0.7² / (1 - 0.7² / 2 / (1.2² + 0.35²))² = 0.895 m, were it without mass.
    """
    loads = {name: ZoneLoad(name, 521e3, 0.0, 0.0) for name in ("foot", "middle")}
    falls = falls_of_two(tmp_path, 0.6, loads)
    assert set(falls) == {"foot", "middle"}
    assert (falls["foot"].above_m, falls["foot"].below_m) == pytest.approx((1.5, 0.1))
    assert (falls["middle"].above_m, falls["middle"].below_m) == pytest.approx((1.2, 1.5))
    assert [fall.lands_m_s for fall in falls.values()] == pytest.approx([np.sqrt(1.2 * G), np.sqrt(2.4 * G)])
    assert falls["middle"].shaft.tips_from_m == pytest.approx(0.895, rel=0.02)
    assert [fall.tips for fall in falls.values()] == [False, True]
    assert not any(fall.can_stand for fall in falls.values())
    assert falls["foot"].text.endswith("1.20 m by 2 zones of the member, between which it can fold")
    # 0.521 MN fall by 0.6 m on 17.15 MN, or by 1.2 m on 8.575 MN
    assert next(falls["foot"].landing_texts()).startswith("by energy 0.02 to 0.08 m of its 1.50 m are crushed")


def test_pieces_that_do_not_tip_can_stand_on_each_other(tmp_path):
    loads = {name: ZoneLoad(name, 521e3, 0.0, 0.0) for name in ("foot", "middle")}
    falls = falls_of_two(tmp_path, 0.4, loads)
    assert falls["middle"].text == (
        "what is above falls by 0.40 m (lands with up to 4.0 m/s), 0.80 m by 2 zones of the member: its pieces can "
        "land on each other and stand, as none tips over after its fall"
    )
    crushed = falls_of_two(tmp_path, 0.4, {**loads, "foot": ZoneLoad("foot", 8.0e6, 0.0, 0.0)})
    assert crushed["foot"].is_crushed and not any(fall.can_stand for fall in crushed.values())
    unknown = falls_of_two(tmp_path, 0.4, {"foot": loads["foot"]})
    assert not any(fall.can_stand for fall in unknown.values()) and not list(unknown["middle"].landing_texts())


def test_a_zone_of_a_column_that_hangs_is_pulled(tmp_path):
    """2.25 m of it hang below the zone, and the zone itself."""
    scenario = replace(column_scenario(tmp_path, replace(ZONE, middle_m=4.0)), supports=(Support(member="block"),))
    members = [
        Member("column", "pier", box([0.7, 0.7, 4.0], [0.0, 0.0, 3.0]), 2400.0),
        Member("block", "deck", box([4.0, 4.0, 1.0], [0.0, 0.0, 5.5]), 2400.0),
    ]
    (load,) = stability_of(scenario, build_model(scenario, members), with_factor=False).zones
    assert load.pressed_n == pytest.approx(-WEIGHT_N_M * 3.75, rel=1e-4)


def test_a_level_zone_bends(tmp_path):
    """A cantilever of 5 m out of a block that is held: w x² / 2 and w x at the plane of the zone nearer to it."""
    zone = replace(ZONE, member="beam", along="x", side="left", middle_m=2.5, height_m=1.5)
    scenario = replace(column_scenario(tmp_path, zone), supports=(Support(member="block"),))
    members = [
        Member("block", "pier", box([1.0, 2.0, 2.0], [0.0, 0.0, 5.0]), 2400.0),
        Member("beam", "deck", box([5.0, 0.7, 0.7], [3.0, 0.0, 5.0]), 2400.0),
    ]
    model = build_model(scenario, members)
    (load,) = stability_of(scenario, model, with_factor=False).zones
    beyond_m = 5.5 - 1.75
    assert load.bending_nm == pytest.approx(WEIGHT_N_M * beyond_m**2 / 2.0, rel=1e-3)
    assert load.shear_n == pytest.approx(WEIGHT_N_M * beyond_m, rel=1e-3)
    assert load.pressed_n == pytest.approx(0.0, abs=100.0)
    assert "carries 0.08 MN·m, and 0.04 MN across it, at rest" in texts(scenario, model, (load,))
