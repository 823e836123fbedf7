# SPDX-License-Identifier: GPL-3.0-or-later
"""Bars of members from files, against moments, areas and ratios by hand."""

import re
from dataclasses import replace

import numpy as np
import pytest
from support.bridges_of_meshes import HEIGHT_M, OWN_WEIGHT, WIDTH_M, block, scenario_of, slab

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.bridge.preparation import prepared_members
from bridge_demolition_addon.model.reinforcement.concrete_members import plain_concrete_text
from bridge_demolition_addon.model.reinforcement.design import bar_schedule
from bridge_demolition_addon.model.reinforcement.schedule import schedule_facts
from bridge_demolition_addon.model.scenario import BarLayer, ConnectionBetween, ConnectionSettings
from bridge_demolition_addon.model.structure.model import build_model

pytestmark = pytest.mark.slow

F_YD = 500.0 / 1.15
WEIGHT = 2400.0 * STANDARD_GRAVITY_M_S2 / 1000.0  # kN/m³


def schedule_of(plan):
    return bar_schedule(plan, prepared_members(plan).members)


def rows(schedule, member, side, along):
    return [
        row
        for row in schedule.bars
        if member in row.members and not row.layer.is_spread and (row.layer.side, row.layer.along) == (side, along)
    ]


def moment(row):
    """M_Ed that a row is for, kN·m."""
    return float(re.search(r"M_Ed = (\d+)", row.reason).group(1))


def test_a_slab_on_two_supports_has_the_bars_of_its_moment(tmp_path):
    """12 m of 0.4 m on supports at 0.5 and 11.5 m, with 15 kN/m² more on its 4 m.

    M_Ed = 1.35 w (11² / 8 - 0.5² / 2), d = 400 - 45 - 10 = 345 mm or less for thicker bars, A_s = M_Ed / (0.9 d f_yd).
    """
    rule = replace(OWN_WEIGHT, permanent_kn_m2=15.0)
    schedule = schedule_of(scenario_of(slab(12.0, 0.4, supports_m=(0.5, 11.5)), tmp_path, rule))
    (bottom,) = rows(schedule, "deck", "bottom", "x")
    by_hand = 1.35 * (0.4 * WIDTH_M * WEIGHT + 15.0 * WIDTH_M) * (11.0**2 / 8.0 - 0.5**2 / 2.0)
    assert moment(bottom) == pytest.approx(by_hand, rel=1e-3)
    depth_mm = 400.0 - 1000.0 * bottom.layer.depth_m
    assert 1e6 * bottom.required_m2 == pytest.approx(1e6 * by_hand / (0.9 * depth_mm * F_YD), rel=0.05)
    assert bottom.required_m2 <= bottom.area_m2 <= 1.1 * bottom.required_m2
    assert bottom.layer.own_axes
    (across,) = rows(schedule, "deck", "bottom", "y")
    assert across.required_m2 / 12.0 == pytest.approx(0.2 * bottom.required_m2 / WIDTH_M)


@pytest.mark.parametrize("kind", ["abutment", "wall", "pier cap"])
def test_a_continuous_deck_has_bars_over_its_middle_support(kind, tmp_path):
    """Two spans of 9.5 m with 15 kN/m² more: w L² / 8 over the support, less half of w 0.5² / 2 of the overhangs."""
    rule = replace(OWN_WEIGHT, permanent_kn_m2=15.0)
    schedule = schedule_of(scenario_of(slab(20.0, 0.5, supports_m=(0.5, 10.0, 19.5), kind=kind), tmp_path, rule))
    top = rows(schedule, "deck", "top", "x")
    w = 1.35 * WIDTH_M * (0.5 * WEIGHT + 15.0)
    assert moment(top[0]) == pytest.approx(w * (9.5**2 / 8.0 - 0.5**2 / 4.0), rel=0.01)
    depth_mm = 500.0 - 1000.0 * top[0].layer.depth_m
    area = sum(row.required_m2 for row in top)
    assert 1e6 * area == pytest.approx(1e6 * w * 9.5**2 / 8.0 / (0.9 * depth_mm * F_YD), rel=0.1)
    (bottom,) = rows(schedule, "deck", "bottom", "x")
    assert moment(bottom) == pytest.approx(w * 9.0 / 128.0 * 9.5**2, rel=0.03)  # 9/128 w L², figure of any handbook


def test_traffic_is_that_of_the_width_of_the_deck(tmp_path):
    """Load model 1 on a deck of 4 m: one lane of 3 m with 9 kN/m², two axles of 300 kN, and 2.5 kN/m² on 1 m.

    In the middle of 11 m: 600 kN at 1.2 m give 600 (11 / 4 - 0.6 / 2) at the middle axle position, 29.5 kN/m the rest.
    """
    rule = replace(OWN_WEIGHT, designed_for="LM1")
    schedule = schedule_of(scenario_of(slab(12.0, 0.8, supports_m=(0.5, 11.5)), tmp_path, rule))
    (bottom,) = rows(schedule, "deck", "bottom", "x")
    permanent = 1.35 * 0.8 * WIDTH_M * WEIGHT * (11.0**2 / 8.0 - 0.5**2 / 2.0)
    uniform = 1.5 * (9.0 * 3.0 + 2.5 * 1.0) * 11.0**2 / 8.0
    axles = 1.5 * 300.0 * (11.0 / 4.0 + (11.0 / 2.0 - 1.2) / 2.0)
    assert moment(bottom) == pytest.approx(permanent + uniform + axles, rel=0.01)


def test_columns_carry_their_part_of_the_deck(tmp_path):
    """Two columns of 0.6 m under the middle of two spans of 9.5 m: 1.35 (10 / 8 w L / 2 and their own weight)."""
    parts = slab(20.0, 0.5, supports_m=(0.5, 19.5))
    for number, across in ((1, -1.0), (2, 1.0)):
        parts[f"column {number}"] = ("pier", block((0.6, 0.6, HEIGHT_M), (9.7, across - 0.3, 0.0)))
    schedule = schedule_of(scenario_of(parts, tmp_path))
    found = rows(schedule, "column 1", "start", "z")
    w = 0.5 * WIDTH_M * WEIGHT
    force = 1.35 * (1.25 * w * 9.5 / 2.0 + 0.6 * 0.6 * HEIGHT_M * WEIGHT)
    sides = [row for side in ("start", "end", "right", "left") for row in rows(schedule, "column 1", side, "z")]
    assert len(found) == 1 and len(sides) == 4
    assert sum(row.area_m2 for row in sides) >= max(0.1 * 1000.0 * force / (F_YD * 1e6), 0.002 * 0.36)
    assert [links.members for links in schedule.links if "column 1" in links.members]
    heavier = replace(OWN_WEIGHT, permanent_kn_m2=300.0)
    (loaded,) = rows(schedule_of(scenario_of(parts, tmp_path, heavier)), "column 1", "start", "z")
    axial = float(re.search(r"N_Ed = (\d+)", loaded.reason).group(1))
    assert axial == pytest.approx(force + 1.35 * 300.0 * WIDTH_M * 1.25 * 9.5 / 2.0, rel=0.01)


def test_walls_have_least_bars_both_ways(tmp_path):
    """9.6: 0.2 % upright, 0.1 % level."""
    schedule = schedule_of(scenario_of(slab(12.0, 0.6, supports_m=(0.5, 11.5)), tmp_path))
    ratios = {row.layer.along: row.ratio for row in schedule.bars if "support 1" in row.members}
    assert ratios == pytest.approx({"x": 0.001, "y": 0.001, "z": 0.002})


def test_what_no_bars_carry_has_as_many_as_fit_and_a_note(tmp_path):
    rule = replace(OWN_WEIGHT, permanent_kn_m2=200.0)
    schedule = schedule_of(scenario_of(slab(12.0, 0.4, supports_m=(0.5, 11.5)), tmp_path, rule))
    assert any("deck: with as many bars as there is room for" in note for note in schedule.notes)
    (bottom,) = rows(schedule, "deck", "bottom", "x")
    assert bottom.ratio > 0.01


def test_layers_by_hand_come_before_the_rule_and_other_materials_have_none(tmp_path):
    layer = BarLayer(members=("deck",), depth_m=0.05, area_mm2=4000.0)
    parts = slab(12.0, 0.6, supports_m=(0.5, 11.5))
    between = (ConnectionBetween(members=("support 2", "support 2"), material="masonry"),)
    connections = ConnectionSettings(method="face", material="reinforced concrete slab", type="FIXED", between=between)
    plan = scenario_of(parts, tmp_path, reinforcement=(layer,), connections=connections)
    schedule = schedule_of(plan)
    named = {name for row in schedule.rows for name in row.members}
    assert named == {"support 1"}
    assert plain_concrete_text(plan) == ""


def test_the_schedule_is_printed_with_steel_by_concrete(tmp_path):
    plan = scenario_of(slab(12.0, 0.6, supports_m=(0.5, 11.5)), tmp_path)
    members = prepared_members(plan).members
    lines = dict(schedule_facts(plan, members, schedule_of(plan)))
    assert lines["by"] == "own weight; B500B, cover 45 mm"
    assert "kg/m³" in lines["steel of deck"] and "kg/m³" in lines["steel of abutment"]


def test_bars_go_on_into_members_that_meet_without_a_bearing(tmp_path):
    """A column on a footing: its own bars, as they pull across a crack of its section.

    Near the pressed edge they do not yield: `test_starter_bars` has the moment against EN 1992-1-1, 6.1.
    """
    parts = {
        "footing": ("footing", block((2.0, 2.0, 0.8), (0.0, 0.0, 0.0))),
        "column": ("pier", block((0.6, 0.6, 4.0), (0.7, 0.7, 0.8))),
    }
    built = build_model(scenario_of(parts, tmp_path))
    schedule = schedule_of(scenario_of(parts, tmp_path))
    upright = sum(row.area_m2 for row in schedule.bars if "column" in row.members and row.layer.along == "z")
    between = built.member_of_shard[built.connections.pairs]
    rows_ = np.flatnonzero((between[:, 0] != between[:, 1]) & (built.connections.pairs >= 0).all(axis=1))
    assert 0.9 < built.bars.yield_n[rows_].sum() / (500e6 * upright) < 1.0
    assert (built.bars.openings_m[rows_] > 0.0).all()


def test_members_too_thin_for_bars_have_least_bars(tmp_path):
    """A slab of 12 cm, in which bars under 45 mm of concrete would be in the middle: 0.2 % along each axis."""
    schedule = schedule_of(scenario_of(slab(3.0, 0.12, supports_m=(0.3, 2.7)), tmp_path))
    layers = {row.layer.along: row.layer for row in schedule.bars if "deck" in row.members}
    assert {along: layer.spread_mm2_m2 for along, layer in layers.items()} == dict.fromkeys("xyz", 2000.0)
    assert any(note.startswith("deck: least bars, spread over it") for note in schedule.notes)


@pytest.mark.parametrize(
    ("rule", "tables", "message"),
    [
        ({"cover_m": 0.25}, {}, r"geometry_reinforcement.cover_m is 0.25: expected less: the bars of deck"),
        ({"carriageway_m": 9.0}, {}, r"geometry_reinforcement.carriageway_m is 9.0: expected at most .* 4 \(m\)"),
        (
            {},
            {"connections": ConnectionSettings(method="face", material="masonry", type="FIXED")},
            r"geometry_reinforcement is given: expected a member of \[\[geometry\]\] of concrete",
        ),
    ],
)
def test_what_cannot_be_designed_is_refused(rule, tables, message, tmp_path):
    plan = scenario_of(slab(12.0, 0.4, supports_m=(0.5, 11.5)), tmp_path, replace(OWN_WEIGHT, **rule), **tables)
    with pytest.raises(ScenarioError, match=message):
        schedule_of(plan)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({}, r"geometry_reinforcement has designed_for and traffic .* all missing: expected exactly one"),
        ({"designed_for": "LM1", "traffic_kn_m2": 5.0}, "given together: expected exactly one"),
    ],
)
def test_one_of_the_loads_is_given(keys, message):
    with pytest.raises(ScenarioError, match=message):
        replace(OWN_WEIGHT, **{"designed_for": None, **keys})


def test_the_rule_needs_members_and_elastic_connections(tmp_path):
    parts = slab(12.0, 0.4, supports_m=(0.5, 11.5))
    plan = scenario_of(parts, tmp_path)
    with pytest.raises(ScenarioError, match=r"stiffness is \"rigid\": expected \"elastic\" with \[geometry_reinf"):
        replace(plan, connections=replace(plan.connections, stiffness="rigid"), bearings=())
    none = replace(OWN_WEIGHT, designed_for="none")
    bare = replace(plan, geometry_reinforcement=none)
    assert not bare.is_reinforced and plain_concrete_text(bare) == ""
    assert "[geometry_reinforcement] or" in plain_concrete_text(replace(plan, geometry_reinforcement=None))
