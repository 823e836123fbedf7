# SPDX-License-Identifier: GPL-3.0-or-later
"""Piers that differ by axis, lean or have batter: volumes of prismatoids, reactions by statics, what is refused."""

from dataclasses import replace

import numpy as np
import pytest
from support.meshes import is_closed

from bridge_demolition_addon.cli.check import scenario_facts
from bridge_demolition_addon.engineering.geometry.solids import union
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.bridge import bridge_members
from bridge_demolition_addon.model.scenario import (
    Abutments,
    Alignment,
    Bridge,
    Deck,
    OtherPiers,
    PierCaps,
    Piers,
)
from bridge_demolition_addon.model.scenario.bridge_checks import upright_names
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.stages.standing import StandingBridge

pytestmark = pytest.mark.slow

PLAIN = Bridge(
    density_kg_m3=2500,
    span_lengths_m=[16, 20, 20, 16],
    deck=Deck(width_m=10, thickness_m=0.9, overhang_m=0.5),
    piers=Piers(columns=2, column_length_m=0.8, column_width_m=1.0, height_m=6),
    abutments=Abutments(length_m=1.0, width_m=10),
)
WALL = OtherPiers(piers=[1], kind="wall", columns=1, column_length_m=0.9, column_width_m=8, batter_percent=5)
SPREAD = OtherPiers(piers=[2], feet_apart_m=1.2)
ROUND = OtherPiers(piers=[3], kind="round columns", columns=3, column_length_m=1.1, column_width_m=1.1)
MIXED = replace(PLAIN, other_piers=(WALL, SPREAD, ROUND))


@pytest.mark.parametrize("skew_deg", [0.0, 25.0])
def test_each_axis_has_its_own_pier(skew_deg):
    members = bridge_members(replace(MIXED, skew_deg=skew_deg))
    volumes = {member.name: member.volume_m3 for member in members}
    assert all(is_closed(member.solid) for member in members)
    # A wall is a prism over its trapezium, 5 % wider on either side at its foot; a leaning column one over its top.
    assert volumes["pier 1"] == pytest.approx(8 * 6 * (0.9 + 0.05 * 6), rel=1e-9)
    assert volumes["pier 2 column 1"] == pytest.approx(6 * 0.8 * 1.0, rel=1e-9)
    assert volumes["pier 3 column 3"] == pytest.approx(6 * np.pi / 4 * 1.1**2, rel=1e-9)
    assert union([member.solid for member in members]).volume == pytest.approx(sum(volumes.values()), rel=1e-9)
    assert upright_names(MIXED) == [
        ["pier 1"],
        ["pier 2 column 1", "pier 2 column 2"],
        ["pier 3 column 1", "pier 3 column 2", "pier 3 column 3"],
    ]


@pytest.mark.parametrize("skew_deg", [0.0, 25.0])
def test_feet_are_as_far_apart_as_they_are_to_be(skew_deg):
    members = {member.name: member for member in bridge_members(replace(MIXED, skew_deg=skew_deg))}
    feet, tops = [], []
    for column in (1, 2):
        corners = np.unique(members[f"pier 2 column {column}"].solid.vertices, axis=0)
        feet.append(corners[corners[:, 2] < 0.01].mean(axis=0))
        tops.append(corners[corners[:, 2] > 5.99].mean(axis=0))
    # Both are measured across the road, as widths are, along whose skewed axis they are further apart.
    assert feet[1][1] - feet[0][1] == pytest.approx(1.2, rel=1e-9)
    assert tops[1][1] - tops[0][1] == pytest.approx(5.0, rel=1e-9)
    for ends in (feet, tops):
        assert (ends[1] - ends[0])[0] / (ends[1] - ends[0])[1] == pytest.approx(np.tan(np.radians(skew_deg)), abs=1e-9)


def test_columns_know_where_they_would_be_upright():
    curved = replace(MIXED, alignment=Alignment(grade_percent=4, crossfall_percent=2.5, radius_m=150))
    for bridge in (MIXED, replace(MIXED, skew_deg=25), curved):
        for member in bridge_members(bridge):
            if member.taper is None:
                continue
            own = member.without_skew(member.solid.vertices)
            # The top of a wall follows a crossfall of 2.5 % and so lies up to 0.1 m higher in the batter.
            assert np.ptp(own[:, :2], axis=0) == pytest.approx(
                (0.9, 8) if member.name == "pier 1" else (0.8, 1), rel=0.02
            )
            np.testing.assert_allclose(member.with_skew(own), member.solid.vertices, atol=1e-12)


def test_caps_are_as_long_as_their_own_columns_need():
    capped = replace(MIXED, pier_caps=PierCaps(length_m=1.2, width_m=10, height_m=1.0, end_height_m=0.6))
    volumes = {member.name: member.volume_m3 for member in bridge_members(capped)}
    for pier, half in ((1, 4.0), (2, 3.0), (3, 10 / 3 + 0.55)):
        assert volumes[f"pier {pier} cap"] == pytest.approx(1.2 * (10 - (5 - half) * 0.4), rel=1e-9)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        (
            {"other_piers": (replace(WALL, piers=[4]),)},
            r"other_piers\.piers is a list of length 1: expected numbers up to 3",
        ),
        (
            {"other_piers": (WALL, replace(ROUND, piers=[3, 1]))},
            r"expected each pier once in all \[\[bridge.other_piers",
        ),
        (
            {"other_piers": (replace(WALL, columns=2),)},
            r'other_piers\.columns is 2: expected 1 with bridge.piers.kind "wall"',
        ),
        ({"other_piers": (replace(ROUND, column_width_m=1.0),)}, r"other_piers\.column_width_m is 1.0: expected 1.1"),
        (
            {"other_piers": (replace(ROUND, batter_percent=2),)},
            r"other_piers\.batter_percent is 2.0: expected 0 with round",
        ),
        ({"other_piers": (replace(SPREAD, feet_apart_m=0.9),)}, r"feet_apart_m is 0.9: expected at least 1 \(m\)"),
        ({"other_piers": (replace(SPREAD, feet_apart_m=17.5),)}, r"expected within 12 m of 5 \(m\), their distance at"),
        ({"other_piers": (replace(WALL, feet_apart_m=3),)}, r"feet_apart_m is 3.0: expected none with .*columns = 1"),
        (
            {"piers": replace(PLAIN.piers, height_m=40, batter_percent=20)},
            r"feet 16.8 m long do not fit into a span of 16",
        ),
        (
            {"other_piers": (replace(ROUND, columns=10),)},
            r"other_piers\.column_width_m is 1.1: expected at most 1 \(m\)",
        ),
        ({"other_piers": (replace(WALL, column_length_m=17),)}, r"other_piers\.column_length_m is 17.0: expected less"),
        ({"other_piers": (WALL,), "merge": True}, r"bridge.merge is given: expected none with bridge.other_piers"),
        (
            {
                "other_piers": (WALL,),
                "piers": None,
                "span_lengths_m": [16],
                "abutments": replace(PLAIN.abutments, height_m=5),
            },
            r"bridge.other_piers are given: expected none without bridge.piers",
        ),
    ],
)
def test_what_does_not_fit_is_refused(keys, message):
    with pytest.raises(ScenarioError, match=message):
        replace(PLAIN, **keys)


TEXT = """
[scenario]
title = "Piers of several kinds"
[time]
duration_s = 1
[bridge]
density_kg_m3 = 2500
span_lengths_m = [16, 20, 20, 16]
[bridge.deck]
width_m = 10
thickness_m = 0.9
overhang_m = 0.5
[bridge.piers]
columns = 2
column_length_m = 0.8
column_width_m = 1.0
height_m = 6
[[bridge.other_piers]]
piers = [1]
kind = "wall"
columns = 1
column_length_m = 0.9
column_width_m = 8
batter_percent = 5
[[bridge.other_piers]]
piers = [2]
{second}
[bridge.abutments]
length_m = 1.0
width_m = 10
[bridge.bearings]
[bridge.reinforcement]
designed_for = "LM1"
[connections]
method = "face"
type = "FIXED"
material = "reinforced concrete slab"
stiffness = "elastic"
[fracture]
shards = 240
"""
TAPERED = TEXT.format(second="batter_percent = 3")
RATIOS = """[[bridge.reinforcement.ratios]]
member = "deck"
bottom_percent = 0.8
top_percent = 0.8
across_bottom_percent = 0.4
across_top_percent = 0.4
[[bridge.reinforcement.ratios]]
member = "pier"
upright_percent = 1.0
"""
V_PIER = TEXT.format(second="feet_apart_m = 1.2").replace('designed_for = "LM1"', RATIOS)


@pytest.mark.parametrize("text", [TAPERED, V_PIER], ids=["batter", "V"])
def test_it_stands_and_carries_what_beams_do(text):
    scenario = scenario_from_text(text)
    assert any("stands under its own weight" in line for line in scenario_facts(scenario))
    model = checked_model(scenario)
    count, loads = len(model.connections), np.zeros((6, len(model.shards)))
    rest = StandingBridge(model, scenario.joints).rest(np.ones(count, bool), np.ones(count), loads)
    found = dict.fromkeys(("abutment 1", "pier 1", "pier 2", "pier 3", "abutment 2"), 0.0)
    for bearing in model.bearings.forces(rest.loads):
        found[" ".join(bearing.name.split(" on ")[1].split()[:2])] += bearing.force_n[2]
    # Of a beam in 240 shards, whose short spans shear, as the page of accuracy says.
    assert list(found.values()) == pytest.approx(by_three_moments(), rel=0.05)


def by_three_moments():
    """Reactions of a beam over spans of 16, 20, 20 and 16 m with overhangs of 0.5 m, N: it is symmetrical.

    Its moments over piers are X, Y and X, and e over abutments: e l + 2 X (l + L) + Y L = w (l³ + L³) / 4, and
    2 X L + 4 Y L = w L³ / 2.
    """
    weight = 2500 * STANDARD_GRAVITY_M_S2 * 10 * 0.9
    short, long, end = 16.0, 20.0, weight * 0.5**2 / 2
    sides = [weight * (short**3 + long**3) / 4 - end * short, weight * long**3 / 2]
    first, middle = np.linalg.solve([[2 * (short + long), long], [2 * long, 4 * long]], sides)
    outer = weight * (short / 2 + 0.5) - (first - end) / short
    inner = weight * (short + long) / 2 + (first - end) / short + (first - middle) / long
    return [outer, inner, weight * long - 2 * (first - middle) / long, inner, outer]


def test_a_leaning_pier_is_not_designed():
    with pytest.raises(ScenarioError, match=r"expected .*ratios.* with feet_apart_m of piers"):
        scenario_from_text(TEXT.format(second="feet_apart_m = 1.2"))
