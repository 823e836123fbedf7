# SPDX-License-Identifier: GPL-3.0-or-later
"""Bars by a rule: what decks, caps, columns and walls get, against moments, forces and sums by hand."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from support.bridges_by_rule import CAPS, LM1, OWN_WEIGHT, PIERS, bridge, layer, links, scenario, scheduled
from support.checkout import ROOT

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.bridge.preparation import prepared_members
from bridge_demolition_addon.model.materials import ReinforcedSection
from bridge_demolition_addon.model.reinforcement import design
from bridge_demolition_addon.model.reinforcement.design import all_layers, bar_schedule
from bridge_demolition_addon.model.reinforcement.schedule import schedule_facts
from bridge_demolition_addon.model.scenario import (
    Abutments,
    BarLayer,
    BoxGirder,
    BridgeReinforcement,
    ConnectionBetween,
    Deck,
    Girders,
    Piers,
    RatiosOfMember,
)
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.structure.facts import connection_facts
from bridge_demolition_addon.model.structure.member_layers import layers_of_members
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.texts import Quantity

pytestmark = pytest.mark.slow

F_CD, F_YD = 35e6 / 1.5, 500e6 / 1.15
G = 2.4 * STANDARD_GRAVITY_M_S2  # kN/m³


def design_moments(rows, height_m, width_m):
    """Moments of a section with layers at their design strength, top pressed and bottom pressed, kN·m."""
    depths = [height_m - row.layer.depth_m if row.layer.side == "bottom" else row.layer.depth_m for row in rows]
    areas = [row.layer.area_m2 for row in rows]
    section = ReinforcedSection(height_m, width_m, F_CD, depths, areas, [F_YD] * len(rows))
    return [moment / 1e3 for moment in section.moments_nm()]


def test_a_slab_carries_its_weight_and_load_model_1_by_plane_sections():
    """13 m × 3.7 m × 0.6 m: 1.35 G L²/8 + 1.5 (28.75 L²/8 + 300 × 12.4² / 26) kN·m. Bars are for their number rounded
    up, so a few per cent more; those at the top add some."""
    schedule = scheduled(bridge())
    by_hand = 1.35 * G * 0.6 * 3.7 * 169 / 8 + 1.5 * (28.75 * 169 / 8 + 300 * 12.4**2 / 26)
    bottom = layer(schedule, "deck", "bottom", "x")
    resisted, _ = design_moments(bottom, 0.6, 3.7)
    # The design takes the worst of positions a 64th of the span apart, which is up to 0.2 % less.
    assert 0.998 * by_hand <= resisted <= 1.05 * by_hand
    assert float(bottom[0].reason.split()[2]) == pytest.approx(by_hand, rel=2e-3)


def test_a_slab_for_its_own_weight_alone():
    bottom = layer(scheduled(bridge(OWN_WEIGHT)), "deck", "bottom", "x")
    resisted, _ = design_moments(bottom, 0.6, 3.7)
    by_hand = 1.35 * G * 0.6 * 3.7 * 169 / 8
    assert by_hand <= resisted <= 1.05 * by_hand


def test_two_continuous_spans_carry_the_moment_over_the_pier():
    """-w L²/8 of both spans with 1.35 × weight, and 1.5 × 4 kN/m² on both."""
    rule = BridgeReinforcement(traffic_kn_m2=4.0)
    schedule = scheduled(bridge(rule, spans=(13.0, 13.0)))
    by_hand = (1.35 * G * 0.6 + 1.5 * 4.0) * 3.7 * 169 / 8
    top = layer(schedule, "deck", "top", "x")
    _, resisted = design_moments(top, 0.6, 3.7)
    assert 0.998 * by_hand <= resisted <= 1.05 * by_hand
    # In a span 9/128 w L² of the weight and 0.0957 q L² of the load on it alone.
    in_span = (1.35 * G * 0.6 * 9 / 128 + 1.5 * 4.0 * 0.0957) * 3.7 * 169
    resisted, _ = design_moments(layer(schedule, "deck", "bottom", "x"), 0.6, 3.7)
    assert 0.99 * in_span <= resisted <= 1.1 * in_span  # both are not at the same point: the sum is less than that


def test_bars_over_a_pier_end_where_the_others_are_enough():
    """w = 1.35 × weight on both spans: M(x) = 3/8 w L x - w x² / 2. Bars at the top carry it wherever it pulls there,
    and in the middle of the spans half of them are left."""
    schedule = scheduled(bridge(OWN_WEIGHT, spans=(13.0, 13.0)))
    w = 1.35 * G * 0.6 * 3.7
    for x in np.linspace(0.0, 13.0, 131):
        moment = 3 / 8 * w * 13.0 * x - w * x**2 / 2
        _, resisted = design_moments(layer(schedule, "deck", "top", "x", at_m=x), 0.6, 3.7)
        assert resisted >= -0.998 * moment
    through, over = layer(schedule, "deck", "top", "x", at_m=13.0)
    assert layer(schedule, "deck", "top", "x", at_m=6.5) == [through]
    assert through.choice.number - over.choice.number in (0, 1)
    begin, end = over.layer.ends_m
    assert begin + end == pytest.approx(26.0)  # even about the pier
    assert over.length_m == pytest.approx(end - begin)


def test_decks_of_their_own_have_no_moment_over_piers():
    deck = Deck(width_m=3.7, thickness_m=0.6, per_span=True, joint_gap_m=0.04)
    schedule = scheduled(bridge(OWN_WEIGHT, spans=(13.0, 13.0), deck=deck))
    (bottom,) = layer(schedule, "span 1 deck", "bottom", "x")
    assert bottom.members == ("span 1 deck", "span 2 deck")
    single = layer(scheduled(bridge(OWN_WEIGHT)), "deck", "bottom", "x")
    assert bottom.required_m2 == pytest.approx(single[0].required_m2, rel=0.01)  # ends 2 cm short of the axis


def test_bars_across_a_slab_are_a_fifth_of_its_main_ones():
    schedule = scheduled(bridge())
    (main,), (across,) = layer(schedule, "deck", "bottom", "x"), layer(schedule, "deck", "bottom", "y")
    assert across.required_m2 / 13.0 == pytest.approx(0.2 * main.required_m2 / 3.7, rel=1e-6)
    assert across.layer.depth_m > main.layer.depth_m + 0.5 * main.choice.diameter_m


def test_cover_is_kept():
    (main,) = layer(scheduled(bridge()), "deck", "bottom", "x")
    assert main.layer.depth_m == pytest.approx(0.045 + 0.5 * main.choice.diameter_m)


def test_steel_of_a_slab_by_sums_by_hand():
    """Areas of the schedule by the lengths of their bars and 7850 kg/m³, over 13 × 3.7 × 0.6 m³."""
    schedule = scheduled(bridge(OWN_WEIGHT))
    rows = [row for row in schedule.bars if row.kind == "deck"]
    kg = sum(row.layer.area_mm2 * 1e-6 * {"x": 13.0, "y": 3.7}[row.layer.along] for row in rows) * 7850.0
    plan = scenario(bridge(OWN_WEIGHT))
    masses = {kind: (steel, concrete) for kind, steel, concrete in schedule.masses(prepared_members(plan).members)}
    assert masses["deck"] == pytest.approx((kg, 13.0 * 3.7 * 0.6))
    assert 30.0 < kg / masses["deck"][1] < 80.0


def test_links_of_a_beam_weigh_what_their_loops_do():
    row = links(scheduled(bridge()), "pier 1 cap")
    loop = row.legs * (0.6 - 0.09) + 2 * (1.2 - 0.09)
    sets = 3.7 / row.spacing_m
    assert row.mass_kg / len(row.members) == pytest.approx(
        sets * loop * math.pi * row.diameter_m**2 / 4 * 7850.0, rel=1e-6
    )
    assert row.link_area_mm2_per_m == pytest.approx(1e6 * row.legs * math.pi * row.diameter_m**2 / 4 / row.spacing_m)
    assert scheduled(bridge()).link_area_mm2_per_m("pier 1 cap") == row.link_area_mm2_per_m


def test_shear_of_a_slab_by_hand():
    """At d: 1.35 G (L/2 - d) + 1.5 (27 + 2.5 × 0.7) (L - d)² / 2L + 1.5 × 300 (2 (L - d) - 1.2) / L."""
    schedule = scheduled(bridge())
    (main,), row = layer(schedule, "deck", "bottom", "x"), links(schedule, "deck")
    d, length = 0.6 - main.layer.depth_m, 13.0
    by_hand = 1.35 * G * 0.6 * 3.7 * (length / 2 - d) + 1.5 * 28.75 * (length - d) ** 2 / (2 * length)
    by_hand += 1.5 * 300 * (2 * (length - d) - 1.2) / length
    # At most one and a half of the 64 parts of a span before the section, on the safe side.
    assert by_hand <= row.shear_n / 1e3 <= 1.05 * by_hand
    # EN 1992-1-1, 6.2a, of the whole width.
    rho = main.layer.area_m2 / (3.7 * d)
    concrete = 0.12 * (1 + math.sqrt(0.2 / d)) * (100 * rho * 35) ** (1 / 3) * 3.7 * d * 1e3
    assert row.concrete_n / 1e3 == pytest.approx(concrete, rel=1e-6)
    assert row.shear_n > row.concrete_n


def test_a_thick_slab_needs_no_links():
    schedule = scheduled(bridge(OWN_WEIGHT))
    assert not [row for row in schedule.links if row.kind == "deck"]


GIRDERS = bridge(
    LM1,
    spans=(16.0,),
    deck=Deck(width_m=8.5, thickness_m=0.25),
    girders=Girders(number=4, width_m=0.5, depth_m=1.0),
    pier_caps=replace(CAPS, width_m=8.5),
)


def test_girders_carry_their_share():
    """Four girders 2.125 m apart under 8.5 m: the inner one, by the lever rule, has the weight of its strip; traffic is
    at least an even share of all lanes, and at most all of a lane and the half of another."""
    schedule = scheduled(GIRDERS)
    (bottom,) = layer(schedule, "girder 1", "bottom", "x")
    assert bottom.members == tuple(f"girder {number}" for number in (1, 2, 3, 4))
    height, flange = 1.25, min(0.5 + 2 * min(0.2 * 0.8125 + 0.1 * 16.0, 0.8125), 8.5)
    resisted, _ = design_moments([bottom], height, flange)
    dead = G * (0.5 * 1.0 + 2.125 * 0.25) * 16.0**2 / 8
    tandem = 15.4**2 / 32.0  # of a load of 1 on both axles
    least = 1.35 * dead + 1.5 / 4 * (500 * tandem + (27 + 2.5 * 5.5) * 32)
    most = 1.35 * dead + 1.5 * (400 * tandem + 27 * 32)
    assert least < resisted < most


def test_all_girders_together_have_the_whole_weight():
    """1.35 × weight on the T-sections of own weight alone: outer and inner ones the same with even overhangs."""
    schedule = scheduled(replace(GIRDERS, reinforcement=OWN_WEIGHT))
    (bottom,) = layer(schedule, "girder 1", "bottom", "x")
    resisted, _ = design_moments([bottom], 1.25, 0.5 + 2 * 0.8125)
    by_hand = 1.35 * G * (0.5 * 1.0 + 2.125 * 0.25) * 16.0**2 / 8
    assert by_hand <= resisted <= 1.25 * by_hand  # few bars of 20 mm, so one more is much


def test_a_slab_on_girders_spans_across_the_road():
    """Continuous over girders 2.125 m apart: more bars across than the fifth that they have along."""
    schedule = scheduled(GIRDERS)
    (across,), (along,) = layer(schedule, "deck", "bottom", "y"), layer(schedule, "deck", "bottom", "x")
    assert across.reason.startswith("M_Ed")
    assert across.layer.depth_m < along.layer.depth_m
    assert along.required_m2 / 8.5 == pytest.approx(0.2 * across.required_m2 / 16.0)


BOX = bridge(
    BridgeReinforcement(designed_for="HL-93"),
    spans=(12.0, 16.0, 12.0),
    deck=Deck(width_m=9.0, thickness_m=0.25, overhang_m=0.5),
    box_girder=BoxGirder(width_m=5.0, depth_m=1.3, web_thickness_m=0.4, bottom_thickness_m=0.25),
    piers=Piers(kind="wall", column_length_m=0.9, column_width_m=5.0, height_m=6.0),
    pier_caps=None,
    abutments=Abutments(length_m=1.6, width_m=9.0),
    skew_deg=15.0,
)


def test_a_box_girder_has_bars_where_its_concrete_is():
    plan = scenario(BOX)
    members = prepared_members(plan).members
    layers = all_layers(plan, members)
    for group in layers_of_members(layers, members):  # refuses bars outside of a member
        if members[group.member].kind == "deck":
            assert all(width > 0.0 for width in group.widths_m)
    depths = sorted(row.layer.depth_m for row in layer(scheduled(BOX), "deck", "top", "y"))
    assert depths[0] == pytest.approx(0.045, abs=0.02) and depths[1] == pytest.approx(0.25 - 0.045, abs=0.02)


def test_bars_of_a_box_lie_on_each_other():
    """None goes through another: axes of bars that cross are at least both radii apart."""
    rows = [row for row in scheduled(BOX).bars if row.kind == "deck"]
    heights = [1.55 - row.layer.depth_m if row.layer.side == "top" else row.layer.depth_m for row in rows]
    for one, height in zip(rows, heights, strict=True):
        for other, at in zip(rows, heights, strict=True):
            if one.layer.along != other.layer.along:
                radii = 0.5 * (one.choice.diameter_m + other.choice.diameter_m)
                assert abs(height - at) >= radii - 1e-9


def test_a_box_girder_carries_its_weight_over_the_piers():
    """Three spans of 12, 16 and 12 m, w: the three-moment equation gives M = -w (12³ + 16³) / (4 (2 × 28 + 16))."""
    schedule = scheduled(replace(BOX, reinforcement=OWN_WEIGHT, skew_deg=0.0, deck=replace(BOX.deck, overhang_m=0.0)))
    area = 9.0 * 0.25 + 2 * 0.4 * 1.05 + 5.0 * 0.25
    by_hand = 1.35 * G * area * (12.0**3 + 16.0**3) / (4 * (2 * 28.0 + 16.0))
    top = [row for row in layer(schedule, "deck", "top", "x", at_m=12.0) if row.layer.depth_m < 0.1]
    _, resisted = design_moments(top, 1.55, 5.0)
    assert 0.998 * by_hand <= resisted <= 1.1 * by_hand


def test_columns_have_bars_at_all_sides_and_links():
    schedule = scheduled(bridge())
    rows = [layer(schedule, "pier 1 column 1", side, "z") for side in ("start", "end", "right", "left")]
    total = sum(row.layer.area_m2 for (row,) in rows)
    assert total >= 0.002 * 0.7 * 0.7  # EN 1992-1-1, 9.5.2 (2)
    assert rows[0][0].layer.area_m2 == rows[1][0].layer.area_m2
    assert links(schedule, "pier 1 column 1").spacing_m == pytest.approx(0.4)  # 20 Ø = 0.4 m


ROUND = Piers(kind="round columns", columns=2, column_length_m=0.9, column_width_m=0.9, height_m=6.0)


def test_a_round_column_has_a_ring_of_bars_as_stiff_as_its_layers():
    """Four layers, each spread over its chord of the circle, have the second moment of the bars one by one."""
    rule = BridgeReinforcement(designed_for="LM1")
    schedule = scheduled(bridge(rule, piers=ROUND))
    rows = [row for side in ("start", "end", "right", "left") for row in layer(schedule, "pier 1 column 1", side, "z")]
    choice, area = rows[0].choice, rows[0].layer.area_m2
    radius = 0.45 - rule.cover_m - 0.010 - choice.diameter_m / 2
    angles = 2 * math.pi / (4 * choice.number) * (np.arange(4 * choice.number) + 0.3)
    one_by_one = choice.area_m2 / choice.number * float(np.sum((radius * np.sin(angles)) ** 2))
    # The polygon that stands for the circle has its area: π D² / 4 = 16 a² tan(π / 16).
    half_flats = math.sqrt(math.pi * 0.9**2 / 4 / (16 * math.tan(math.pi / 16)))
    distance = half_flats - rows[0].layer.depth_m
    chord = np.linspace(-1, 1, 2001) * math.sqrt(0.45**2 - distance**2)
    assert 2 * area * distance**2 + 2 * area * np.mean(chord**2) == pytest.approx(one_by_one, rel=2e-3)
    assert {row.layer.area_mm2 for row in rows} == {rows[0].layer.area_mm2} and 4 * choice.number >= 8
    assert links(schedule, "pier 1 column 1").legs == 2


def test_a_slender_round_column_has_bars_as_a_fibre_section_needs():
    """N and M of the design against the resistance of the circle by strips and its bars one by one, to 10 %: a square
    of the same area stands for it in the design."""
    schedule = scheduled(bridge(piers=replace(ROUND, columns=1, column_length_m=0.6, column_width_m=0.6, height_m=11)))
    (row,) = layer(schedule, "pier 1", "start", "z")
    axial, moment = (1e3 * float(number) for number in re.findall(r"= (\d+) kN", row.reason))
    assert [value.unit for value in row.reason.values if isinstance(value, Quantity)] == ["kN", "kN·m"]  # for reports
    radius = 0.3 - BridgeReinforcement(designed_for="LM1").cover_m - 0.010 - row.choice.diameter_m / 2
    number = max(8, 4 * row.choice.number)
    place = radius * np.cos(2 * math.pi / number * (np.arange(number) + 0.5))
    strips = np.linspace(-0.3, 0.3, 1200)
    widths = 2 * np.sqrt(np.maximum(0.09 - strips**2, 0.0)) * 0.6 / 1200

    def resisted(neutral):
        pressed = strips > 0.3 - 0.8 * neutral
        stress = np.clip(200e9 * 0.0035 * (place - 0.3 + neutral) / neutral, -F_YD, F_YD)
        force = stress * row.required_m2 * 4 / number
        return F_CD * widths[pressed].sum() + force.sum(), F_CD * (widths * strips)[pressed].sum() + force @ place

    neutral = min(np.linspace(0.02, 2.0, 4000), key=lambda depth: abs(resisted(depth)[0] - axial))
    assert resisted(neutral)[1] == pytest.approx(moment, rel=0.1)


def test_a_slender_column_has_more_bars_than_a_stocky_one():
    slim = replace(PIERS, columns=1, column_length_m=0.5, column_width_m=0.8, height_m=12.0)
    stocky = scheduled(bridge(piers=replace(slim, height_m=3.0)))
    slender = scheduled(bridge(piers=slim))
    (few,), (many,) = (layer(schedule, "pier 1", "start", "z") for schedule in (stocky, slender))
    assert few.reason == "least area"
    assert many.reason.startswith("N_Ed") and many.required_m2 > 2 * few.required_m2


def test_a_cap_carries_its_cantilever():
    """One column of 0.8 m under a cap of 3.7 m, all loads spread over it: p a²/2 at the face, a = 1.45 m. p is 1.35 ×
    (half the deck + cap) + 1.5 × traffic at the support, 28.75 × 6.5 + 300 (1 + 11.8 / 13) kN."""
    schedule = scheduled(bridge(piers=replace(PIERS, columns=1, column_width_m=0.8)))
    weight = G * (0.6 * 3.7 * 6.5 + 1.2 * 3.7 * 0.6)
    traffic = 28.75 * 6.5 + 300.0 * (1 + 11.8 / 13.0)
    by_hand = (1.35 * weight + 1.5 * traffic) / 3.7 * 1.45**2 / 2
    (top,) = layer(schedule, "pier 1 cap", "top", "y")
    _, resisted = design_moments([top], 0.6, 1.2)
    # The moment is taken at the first of 64 points beside the face.
    assert 0.95 * by_hand <= resisted <= 1.3 * by_hand
    moment = float(top.reason.split()[2]) if top.reason.startswith("M_Ed") else math.nan
    assert moment == pytest.approx(by_hand, rel=0.05)


def test_walls_have_what_9_6_asks_for():
    schedule = scheduled(BOX)
    (upright,), (level,) = (layer(schedule, "abutment 1", "start", along) for along in ("z", "y"))
    assert upright.required_m2 == pytest.approx(0.001 * 1.6 * 9.0)  # half of 0.2 % at each face
    assert level.required_m2 == pytest.approx(0.0005 * 1.6 * 6.0)  # half of 0.1 % of the height
    assert upright.members == ("abutment 1", "abutment 2")


def test_ratios_are_areas_over_sections():
    ratios = (
        RatiosOfMember(member="deck", bottom_percent=1.0, top_percent=0.25, across_bottom_percent=0.2),
        RatiosOfMember(member="pier", upright_percent=1.2, links_percent=0.1),
    )
    schedule = scheduled(bridge(BridgeReinforcement(ratios=ratios)))
    areas = {(side, along): layer(schedule, "deck", side, along)[0].layer.area_mm2 for side, along in
             (("bottom", "x"), ("top", "x"), ("bottom", "y"))}  # fmt: skip
    assert areas == pytest.approx(
        {("bottom", "x"): 22_200.0, ("top", "x"): 5_550.0, ("bottom", "y"): 0.002 * 13_000 * 600}
    )
    upright = sum(layer(schedule, "pier 1 column 1", side, "z")[0].layer.area_mm2 for side in
                  ("start", "end", "right", "left"))  # fmt: skip
    assert upright == pytest.approx(0.012 * 490_000)
    assert links(schedule, "pier 1 column 1").link_area_mm2_per_m == pytest.approx(0.001 * 700 * 1000)
    assert not any("pier 1 cap" in row.members for row in schedule.bars)


def test_a_ratio_of_a_member_replaces_that_of_its_kind():
    pier = RatiosOfMember(member="pier", upright_percent=1.0)
    column = RatiosOfMember(member="pier 2 column 1", upright_percent=2.0)
    schedule = scheduled(bridge(BridgeReinforcement(ratios=(pier, column))))
    (one,), (two,) = (layer(schedule, f"pier {number} column 1", "start", "z") for number in (1, 2))
    assert two.layer.area_mm2 == pytest.approx(2.0 * one.layer.area_mm2)


def test_layers_by_hand_replace_the_rule_of_their_members():
    by_hand = BarLayer(members=("deck",), depth_m=0.05, area_mm2=9_000.0)
    plan = scenario(bridge(), reinforcement=(by_hand,))
    members = prepared_members(plan).members
    schedule = bar_schedule(plan, members)
    assert not any("deck" in row.members for row in schedule.rows)
    assert "[[reinforcement]] replaces the rule for deck" in schedule.notes
    layers = all_layers(plan, members)
    assert [given for given in layers if "deck" in given.members] == [by_hand]
    assert any("pier 1 cap" in given.members for given in layers)


def test_the_model_has_the_bars_of_the_schedule():
    """Shards are crossed by the same bars as with the layers written out by hand."""
    plan = scenario(bridge())
    layers = all_layers(plan, prepared_members(plan).members)
    ruled = build_model(plan)
    written = build_model(replace(plan, bridge=replace(plan.bridge, reinforcement=None), reinforcement=layers))
    np.testing.assert_allclose(ruled.bars.yield_n, written.bars.yield_n)
    np.testing.assert_allclose(ruled.bars.offsets_m, written.bars.offsets_m)
    assert ruled.bars.yield_n.max() > 0.0


def test_steel_of_the_run_is_the_grade():
    plan = scenario(bridge(replace(LM1, steel="B500C")))
    assert (plan.steel.yield_pa, plan.steel.hardening, plan.steel.rupture_strain) == (500e6, 1.15, 0.075)
    rows = bar_schedule(plan, prepared_members(plan).members).bars
    assert {row.layer.yield_n_mm2 for row in rows} == {500.0}
    weak = scenario(bridge(replace(LM1, steel="Grade 60")))
    assert {row.layer.yield_n_mm2 for row in bar_schedule(weak, prepared_members(weak).members).bars} == {420.0}


def test_members_of_steel_have_no_bars():
    rule = ConnectionBetween(members=("girder", "girder"), material="steel")
    plan = scenario(GIRDERS)
    plan = replace(plan, connections=replace(plan.connections, between=(rule,)))
    schedule = bar_schedule(plan, prepared_members(plan).members)
    assert not any(row.kind == "girder" for row in schedule.rows)
    assert any(note.startswith("not of concrete, and without bars: girder 1") for note in schedule.notes)


@pytest.mark.parametrize("width_m", [2.6, 3.7, 6.0, 12.0])
@pytest.mark.parametrize("designed_for", ["LM1", "HL-93", "own weight"])
def test_decks_of_all_widths(width_m, designed_for):
    """From one narrow lane to four: 0.2 to 2 % of steel along, and never less than its own weight needs."""
    deck = Deck(width_m=width_m, thickness_m=0.7)
    rule = BridgeReinforcement(designed_for=designed_for)
    schedule = scheduled(bridge(rule, deck=deck, pier_caps=replace(CAPS, width_m=width_m, height_m=1.0)))
    (bottom,) = layer(schedule, "deck", "bottom", "x")
    resisted, _ = design_moments([bottom], 0.7, width_m)
    assert resisted >= 1.35 * G * 0.7 * width_m * 169 / 8
    assert 0.002 < bottom.ratio < 0.02
    assert all(0.0 < row.utilisation <= 1.0 + 1e-9 for row in schedule.rows)


def refused(of_bridge, text):
    plan = scenario(of_bridge)
    with pytest.raises(ScenarioError, match=text):
        bar_schedule(plan, prepared_members(plan).members)


def test_what_no_depth_carries_is_refused():
    """1.35 × 0.25 m × 24 kN/m³ × 30²/8 = 894 kN·m/m on d = 0.195 m: more than b d² f_cd / 2 = 444 kN·m/m."""
    thin = Deck(width_m=3.7, thickness_m=0.25)
    refused(
        bridge(OWN_WEIGHT, spans=(30.0,), deck=thin),
        r'designed_for is "own weight": deck cannot carry its design moment of 3306 kN·m without bars in compression: '
        r"with 0.25 m of height and d = 0.\d+ m no depth of the neutral axis carries it.*bridge.deck.thickness_m",
    )


def test_too_deep_a_neutral_axis_is_refused():
    refused(bridge(deck=Deck(width_m=3.7, thickness_m=0.47)), r"x/d is 0\.\d\d, where EN 1992-1-1 has at most 0.45")


def test_crushed_struts_are_refused():
    caps = replace(CAPS, width_m=3.0, height_m=1.2)
    webs = BoxGirder(width_m=3.0, depth_m=1.5, web_thickness_m=0.06, bottom_thickness_m=0.3)
    box = bridge(
        BridgeReinforcement(axles_kn=(1500.0,)),
        deck=Deck(width_m=3.0, thickness_m=0.6),
        box_girder=webs,
        pier_caps=caps,
    )
    refused(box, r"cannot carry its design shear of \d+ kN with any links: its struts carry V_Rd,max = \d+ kN at 45°")


def test_a_column_that_is_crushed_is_refused():
    thin = replace(PIERS, columns=1, column_length_m=0.25, column_width_m=0.25, height_m=10.0)
    refused(
        bridge(piers=thin),
        r"pier 1 cannot carry its design load of \d+ kN with \d+ kN·m: it would need more than 8% of its section of "
        r"0.25 × 0.25 m in bars",
    )


def test_bars_outside_of_the_concrete_are_refused():
    refused(
        bridge(replace(OWN_WEIGHT, cover_m=0.3)),
        r"bridge.reinforcement.cover_m is 0.3: expected less: the bars of deck, 0.6 m thick, would be 0.31",
    )
    ratios = BridgeReinforcement(ratios=(RatiosOfMember(member="deck", bottom_percent=1.0),), cover_m=0.29)
    refused(bridge(ratios), r"cover_m is 0.29: expected less: the bars of deck")


def test_unknown_members_of_ratios_are_refused():
    refused(bridge(BridgeReinforcement(ratios=(RatiosOfMember(member="girder", bottom_percent=1.0),))), "ratios.member")


def test_concrete_is_needed():
    plan = scenario(bridge())
    plan = replace(plan, connections=replace(plan.connections, material="steel"))
    with pytest.raises(ScenarioError, match=r'connections.material is "steel": expected concrete'):
        bar_schedule(plan, prepared_members(plan).members)


def test_the_page_shows_what_is_printed():
    """Rows of the schedule in docs/reinforcement.md, of the example that it names."""
    plan = read_scenario(ROOT / "examples" / "two_spans_13m_ball.toml")
    connections = replace(plan.connections, ductile_elongation_m=0.05)
    kg_m3 = {}
    for designed_for in ("LM1", "HL-93", "own weight"):
        rule = BridgeReinforcement(designed_for=designed_for)
        ruled = replace(plan, connections=connections, bridge=replace(plan.bridge, reinforcement=rule))
        members = prepared_members(ruled).members
        schedule = bar_schedule(ruled, members)
        kg_m3[designed_for] = next(steel / concrete for kind, steel, concrete in schedule.masses(members))
        if designed_for == "LM1":
            lines = [f"  {name:<24}{value}" for name, value in schedule_facts(ruled, members, schedule)]
    page = (ROOT / "docs" / "reinforcement.md").read_text(encoding="utf-8")
    shown = page.partition('`designed_for = "LM1"`:\n\n```\n')[2].partition("```")[0].splitlines()
    assert len(shown) == 5 and set(shown) <= set(lines)
    assert [round(value) for value in kg_m3.values()] == [137, 92, 53]
    assert "have 92 kg/m³, for their own weight alone 53." in " ".join(page.split())


def test_bars_are_designed_once_for_a_model_and_what_is_said_of_it(monkeypatch):
    """It takes most of a second for a bridge: sections, facts and tools take them from the model."""
    calls = []

    def counted(*given):
        calls.append(given)
        return bar_schedule(*given)

    monkeypatch.setattr(design, "bar_schedule", counted)
    written = read_scenario(ROOT / "examples" / "two_spans_13m_ball.toml")
    small = replace(written, fracture=replace(written.fracture, shards=12))
    model = checked_model(small)
    assert list(connection_facts(small, model))
    assert len(calls) == 1
    assert model.layers == all_layers(small, model.members)
