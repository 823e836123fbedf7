# SPDX-License-Identifier: GPL-3.0-or-later
"""Bridges of every kind: volumes and masses by hand, no overlap, one body, and what contradicts itself."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.meshes import is_closed

from bridge_demolition_addon.cli.check import scenario_facts
from bridge_demolition_addon.engineering.fracture.shards import fracture
from bridge_demolition_addon.engineering.geometry.mesh import volumes_and_centres
from bridge_demolition_addon.engineering.geometry.overlap import hulls, overlaps
from bridge_demolition_addon.engineering.geometry.solids import bodies, contains, to_manifold, union
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.bridge import bridge_members, deck_top, deck_underside
from bridge_demolition_addon.model.scenario import (
    Abutments,
    Ball,
    BoxGirder,
    Bridge,
    ConnectionSettings,
    Deck,
    FractureSettings,
    Girders,
    PierCaps,
    Piers,
    Scenario,
    TimeSettings,
    Voids,
)
from bridge_demolition_addon.model.structure.model import build_model

pytestmark = pytest.mark.slow

# Sums and differences of some ten metres in double precision.
ROUNDING = 1e-12
# What the project promises for the sum of the shards' volumes.
VOLUME = 1e-9

DECK = Deck(width_m=10, thickness_m=0.25, overhang_m=0.5)
PIERS = Piers(columns=3, column_length_m=0.8, column_width_m=0.6, height_m=5)
ROUND = {"column_length_m": 1.1, "column_width_m": 1.1, "height_m": 5}
CAPS = PierCaps(length_m=1.2, width_m=9, height_m=0.8)
ABUTMENTS = Abutments(length_m=1.5, width_m=10)
GIRDERS = Girders(number=4, width_m=0.4, depth_m=1.1)
BOX = BoxGirder(width_m=5.5, depth_m=1.6, web_thickness_m=0.35, bottom_thickness_m=0.2)
SLAB = Bridge(density_kg_m3=2400, span_lengths_m=[14, 18.5, 12], deck=DECK, piers=PIERS, pier_caps=CAPS)
LENGTH = 14 + 18.5 + 12 + 1

BRIDGES = {
    "slab": SLAB,
    "girders": replace(SLAB, girders=GIRDERS),
    "girders, closer": replace(SLAB, girders=replace(GIRDERS, spacing_m=2.0)),
    "girders on columns": replace(SLAB, girders=GIRDERS, piers=replace(PIERS, columns=4), pier_caps=None),
    "box": replace(SLAB, box_girder=BOX),
    "box of three cells": replace(SLAB, box_girder=replace(BOX, cells=3)),
    "walls": replace(SLAB, piers=Piers(kind="wall", column_length_m=0.9, column_width_m=8, height_m=5), pier_caps=None),
    "round columns": replace(SLAB, piers=Piers(kind="round columns", columns=3, **ROUND)),
    "hammerheads": replace(SLAB, piers=replace(PIERS, columns=1), pier_caps=replace(CAPS, end_height_m=0.3)),
    "decks that touch": replace(SLAB, deck=replace(DECK, per_span=True)),
    "decks apart": replace(SLAB, deck=replace(DECK, per_span=True, joint_gap_m=0.05), girders=GIRDERS),
    "abutments": replace(SLAB, abutments=ABUTMENTS),
    "abutments alone": replace(
        SLAB, span_lengths_m=[14], abutments=replace(ABUTMENTS, height_m=6), piers=None, pier_caps=None, box_girder=BOX
    ),
}
BRIDGES |= {f"{name}, skewed": replace(bridge, skew_deg=33) for name, bridge in BRIDGES.items()}
BRIDGES["slab, skewed the other way"] = replace(SLAB, skew_deg=-33)


def volumes_of(bridge):
    """Volume of all members of each kind, m³."""
    volumes = {}
    for member in bridge_members(bridge):
        volumes[member.kind] = volumes.get(member.kind, 0.0) + member.volume_m3
    return volumes


def by_hand(name):
    """The same from the sizes that the bridges above are made of."""
    box_area = 5.5 * 1.6 - (5.5 - 2 * 0.35) * (1.6 - 0.2)
    columns, caps = 4 * 3 * 0.8 * 0.6 * 5, 4 * 1.2 * 9 * 0.8
    slab = {"deck": LENGTH * 10 * 0.25, "pier": columns, "pier cap": caps}
    girders = slab | {"girder": 4 * 0.4 * 1.1 * LENGTH}
    return {
        "slab": slab,
        "girders": girders,
        "girders, closer": girders,
        "girders on columns": {"deck": slab["deck"], "girder": girders["girder"], "pier": columns * 4 / 3},
        "box": slab | {"deck": LENGTH * (10 * 0.25 + box_area)},
        "box of three cells": slab
        | {"deck": LENGTH * (10 * 0.25 + 5.5 * 1.6 - 3 * ((5.5 - 4 * 0.35) / 3) * (1.6 - 0.2))},
        "walls": {"deck": slab["deck"], "pier": 4 * 0.9 * 8 * 5},
        "round columns": slab | {"pier": 4 * 3 * math.pi * 1.1**2 / 4 * 5},
        # From the face of the one column, 0.3 m from the middle, to the end at 4.5 m the underside rises by 0.5 m.
        "hammerheads": slab | {"pier": columns / 3, "pier cap": caps - 4 * 1.2 * (4.5 - 0.3) * 0.5},
        "decks that touch": slab,
        "decks apart": {
            "deck": (LENGTH - 0.1) * 2.5,
            "girder": (LENGTH - 0.1) * 4 * 0.44,
            "pier": columns,
            "pier cap": caps,
        },
        "abutments": {"deck": slab["deck"], "pier": columns / 2, "pier cap": caps / 2, "abutment": 2 * 1.5 * 10 * 5.8},
        "abutments alone": {"deck": 15 * (10 * 0.25 + box_area), "abutment": 2 * 1.5 * 10 * 6},
    }[name]


@pytest.mark.parametrize("name", BRIDGES)
def test_volumes_of_every_kind_by_hand(name):
    # Skew moves corners along the road only, and turns columns: volumes are those of the square bridge.
    assert volumes_of(BRIDGES[name]) == pytest.approx(by_hand(name.split(", skewed")[0]), rel=ROUNDING)


def test_voids_weigh_nothing():
    bridge = replace(SLAB, deck=replace(DECK, thickness_m=0.9), voids=Voids(number=7, diameter_m=0.6))
    masses = {member.kind: member.mass_kg for member in bridge_members(bridge)}
    assert masses["deck"] == pytest.approx(2400 * LENGTH * (10 * 0.9 - 7 * math.pi * 0.6**2 / 4), rel=ROUNDING)
    heavier = replace(bridge, deck=replace(bridge.deck, density_kg_m3=2500.0))
    assert bridge_members(heavier)[0].mass_kg == pytest.approx(masses["deck"] * 25 / 24, rel=ROUNDING)
    with pytest.raises(ScenarioError, match=r"voids.diameter_m is 0.95: expected less than .*thickness_m, 0.9 \(m\)"):
        replace(bridge, voids=Voids(number=7, diameter_m=0.95))
    with pytest.raises(ScenarioError, match=r"number is 17: .*17 tubes of 0.6 m take 10.2 m"):
        replace(bridge, voids=Voids(number=17, diameter_m=0.6))
    with pytest.raises(ScenarioError, match="given together"):
        replace(bridge, girders=GIRDERS)


@pytest.mark.parametrize("name", BRIDGES)
def test_members_are_closed_touch_and_do_not_overlap(name):
    members = bridge_members(BRIDGES[name])
    assert all(is_closed(member.solid) for member in members)
    assert len({member.name for member in members}) == len(members)
    whole = sum(member.volume_m3 for member in members)
    assert union([member.solid for member in members]).volume == pytest.approx(whole, rel=VOLUME)


@pytest.mark.parametrize("name", BRIDGES)
def test_one_solid_of_all_members_has_their_volume_and_is_one_body(name):
    apart, merged = bridge_members(BRIDGES[name]), bridge_members(replace(BRIDGES[name], merge=True))
    assert [(member.name, member.kind) for member in merged] == [("bridge", "bridge")]
    assert merged[0].mass_kg == pytest.approx(sum(member.mass_kg for member in apart), rel=ROUNDING)
    assert len(bodies(to_manifold(merged[0].solid))) == 1


@pytest.mark.parametrize("name", ["box", "hammerheads, skewed", "girders on columns, skewed", "decks apart"])
def test_shards_of_a_bridge_of_any_kind_add_up_and_hold_together(name):
    model = build_model(scenario_of(BRIDGES[name]))
    assert model.masses_kg.sum() == pytest.approx(sum(member.mass_kg for member in model.members), rel=VOLUME)
    # Every shard hangs together with every other, over the ground as well.
    label = np.arange(len(model.shards) + 1)
    for _ in range(len(label)):
        for first, second in model.connections.pairs:
            label[[first, second]] = label[[first, second]].min()
        if not label.any():
            break
    assert (label == label[0]).all()


def test_a_merged_bridge_is_cut_as_a_whole():
    model = build_model(scenario_of(replace(BRIDGES["girders, skewed"], merge=True)))
    assert len(model.shards) == 120 and set(model.member_of_shard.tolist()) == {0}
    assert model.masses_kg.sum() == pytest.approx(2400 * sum(by_hand("girders").values()), rel=VOLUME)


def test_the_cells_of_a_box_girder_are_empty_from_end_to_end():
    deck = bridge_members(BRIDGES["box of three cells"])[0].solid
    floor, ceiling = 5.8 + 0.2, 5.8 + 1.6
    inside = [(x, y, (floor + ceiling) / 2) for x in (-0.49, 20.0, 44.9) for y in (-1.7, 0.0, 1.7)]
    webs = [(20.0, y, 7.0) for y in (-2.6, -0.86, 0.86, 2.6)]
    slabs = [(20.0, 0.0, z) for z in (5.81, 5.99, 7.41, 7.64)]
    assert not contains(deck, inside).any()
    assert contains(deck, webs + slabs).all()
    assert fracture(deck, 150, seed=4).volumes.sum() == pytest.approx(by_hand("box of three cells")["deck"], rel=VOLUME)


@pytest.mark.parametrize("name", ["box", "box of three cells, skewed", "girders"])
@pytest.mark.parametrize("merge", [False, True])
def test_shards_of_members_with_corners_are_convex(name, merge):
    bridge = replace(BRIDGES[name], merge=merge)
    member = bridge_members(bridge)[0]
    if merge or bridge.box_girder:
        assert sum(part.volume for part in member.parts) == pytest.approx(member.volume_m3, rel=ROUNDING)
    model = build_model(scenario_of(bridge))
    assert len(model.shards) == 120
    # So their hulls, which collide in Blender, have nothing in common either.
    assert len(overlaps(hulls(model.shards))) == 0
    # With fewer shards than parts the solid is cut as it is.
    if merge:
        assert len(build_model(scenario_of(bridge, shards=3)).shards) == 3


def test_heights_with_girders_and_box():
    assert deck_underside(BRIDGES["girders"]) == pytest.approx(5.8, abs=ROUNDING)
    assert deck_top(BRIDGES["girders"]) == pytest.approx(5.8 + 1.1 + 0.25, abs=ROUNDING)
    assert deck_top(BRIDGES["box"]) == pytest.approx(5.8 + 1.6 + 0.25, abs=ROUNDING)
    assert deck_top(BRIDGES["abutments alone"]) == pytest.approx(6 + 1.6 + 0.25, abs=ROUNDING)


def test_names_of_members_with_abutments_and_decks_of_their_own():
    bridge = replace(BRIDGES["decks apart"], abutments=ABUTMENTS, span_lengths_m=[14, 12])
    assert [member.name for member in bridge_members(bridge)] == [
        "span 1 deck",
        *(f"span 1 girder {number}" for number in (1, 2, 3, 4)),
        "span 2 deck",
        *(f"span 2 girder {number}" for number in (1, 2, 3, 4)),
        "abutment 1",
        "abutment 2",
        "pier 1 cap",
        "pier 1 column 1",
        "pier 1 column 2",
        "pier 1 column 3",
    ]


def test_decks_of_two_spans_are_as_far_apart_as_asked():
    solids = {member.name: member.solid for member in bridge_members(BRIDGES["decks apart"])}
    # The pier axis between spans of 14 and 18.5 m is at 14 m.
    assert solids["span 1 deck"].bounds[1, 0] == pytest.approx(14 - 0.025, abs=ROUNDING)
    assert solids["span 2 deck"].bounds[0, 0] == pytest.approx(14 + 0.025, abs=ROUNDING)


def test_decks_that_touch_are_connected_with_their_whole_section():
    model = build_model(scenario_of(BRIDGES["decks that touch, skewed"], shards=19))
    names = [model.members[member].name for member in model.member_of_shard]
    met = [sorted((names[i], names[j])) == ["span 1 deck", "span 2 deck"] for i, j in model.connections.pairs]
    # A section along the skew is longer by 1 / cos.
    assert model.connections.areas[met].sum() == pytest.approx(10 * 0.25 / math.cos(math.radians(33)), rel=1e-7)


def test_skew_shears_deck_caps_and_abutments_and_turns_columns():
    bridge = replace(BRIDGES["abutments"], skew_deg=30)
    tangent = 1 / math.sqrt(3)
    solids = {member.name: member.solid for member in bridge_members(bridge)}
    deck, abutment = solids["deck"].vertices, solids["abutment 1"].vertices
    left = deck[deck[:, 1] > 0]
    assert sorted(set(left[:, 0].round(9))) == pytest.approx([-0.5 + 5 * tangent, 45 + 5 * tangent], abs=1e-8)
    assert abutment[abutment[:, 1] > 0][:, 0].max() == pytest.approx(0.75 + 5 * tangent, abs=ROUNDING)
    column = solids["pier 1 column 3"]  # stands 3 m left of the middle, on the axis at 14 m
    np.testing.assert_allclose(volumes_and_centres([column])[1][0], [14 + 3 * tangent, 3, 2.5], atol=1e-9)
    corners = np.unique(column.vertices[:, :2].round(9), axis=0)
    sides = sorted(np.linalg.norm(corners[None] - corners[:, None], axis=2)[0])
    assert sides == pytest.approx([0, 0.6, 0.8, 1.0], abs=1e-8)  # still a rectangle
    # Its sides across the road run along the pier's axis, which leans by 30°.
    edge = max((b - a for a in corners for b in corners if abs(np.linalg.norm(b - a) - 0.6) < 1e-6), key=lambda e: e[1])
    assert math.degrees(math.atan2(edge[0], edge[1])) == pytest.approx(30, abs=1e-6)


def test_outline_of_a_skewed_deck():
    deck = bridge_members(replace(SLAB, skew_deg=45))[0].solid.vertices
    corners = np.unique(deck[:, :2].round(9), axis=0)
    np.testing.assert_allclose(corners, [(-5.5, -5), (4.5, 5), (40, -5), (50, 5)], atol=1e-9)


def test_densities_of_single_kinds():
    bridge = replace(
        BRIDGES["girders"], deck=replace(DECK, density_kg_m3=2500), girders=replace(GIRDERS, density_kg_m3=7850)
    )
    expected = by_hand("girders")
    masses = {kind: 0.0 for kind in expected}
    for member in bridge_members(bridge):
        masses[member.kind] += member.mass_kg
    density = {"deck": 2500, "girder": 7850, "pier": 2400, "pier cap": 2400}
    assert masses == pytest.approx({kind: expected[kind] * density[kind] for kind in expected}, rel=ROUNDING)
    model = build_model(scenario_of(bridge))
    of_member = np.bincount(model.member_of_shard, model.masses_kg)
    np.testing.assert_allclose(of_member, [member.mass_kg for member in model.members], rtol=VOLUME)
    assert model.density_kg_m3 == pytest.approx(sum(masses.values()) / sum(expected.values()), rel=ROUNDING)


def test_the_total_mass_counts_densities_of_single_kinds():
    steel = replace(GIRDERS, density_kg_m3=7850)
    bridge = replace(BRIDGES["girders"], girders=steel, density_kg_m3=None, mass_kg=1_500_000)
    members = bridge_members(bridge)
    assert sum(member.mass_kg for member in members) == pytest.approx(1_500_000, rel=ROUNDING)
    expected = by_hand("girders")
    rest = (1_500_000 - expected["girder"] * 7850) / (expected["deck"] + expected["pier"] + expected["pier cap"])
    assert {round(member.density_kg_m3, 6) for member in members} == {7850, round(rest, 6)}
    with pytest.raises(ScenarioError, match=r"bridge.mass_kg is 100000.0: expected more than 628628 \(kg\)"):
        bridge_members(replace(bridge, mass_kg=100_000))


def test_no_density_is_left_to_find_where_all_members_have_one():
    bridge = replace(
        SLAB,
        density_kg_m3=None,
        mass_kg=1e6,
        deck=replace(DECK, density_kg_m3=2400),
        piers=replace(PIERS, density_kg_m3=2400),
        pier_caps=replace(CAPS, density_kg_m3=2400),
    )
    with pytest.raises(ScenarioError, match="every member has a density of its own"):
        bridge_members(bridge)


@pytest.mark.slow
def test_check_reports_masses_of_every_kind():
    bridge = replace(BRIDGES["girders"], girders=replace(GIRDERS, density_kg_m3=7850))
    lines = [line.split() for line in scenario_facts(scenario_of(bridge))]
    # 0.4 x 1.1 x 45.5 m of steel.
    assert ["girder", "1", "20.020", "m³", "157.157", "t,", "7850", "kg/m³"] in lines
    assert ["deck", "113.750", "m³", "273.000", "t,", "2400", "kg/m³"] in lines


@pytest.mark.parametrize(
    "values, text",
    [
        ({"girders": GIRDERS, "box_girder": BOX}, "bridge.girders and bridge.box_girder are given together"),
        ({"piers": None}, "bridge.piers is missing: expected a table"),
        ({"abutments": replace(ABUTMENTS, height_m=5)}, "bridge.abutments.height_m is 5.0: expected none with piers"),
        ({"abutments": ABUTMENTS, "span_lengths_m": [14]}, "bridge.piers is given: expected none"),
        (
            {"abutments": ABUTMENTS, "span_lengths_m": [14], "piers": None, "pier_caps": None},
            "bridge.abutments.height_m is missing: expected a number (m) with one span",
        ),
        (
            {"abutments": replace(ABUTMENTS, length_m=23)},
            "bridge.abutments.length_m is 23.0: expected less, so that the abutments do not overlap the next support",
        ),
        ({"girders": replace(GIRDERS, width_m=2.6)}, "bridge.girders.width_m is 2.6: expected at most their spacing"),
        (
            {"girders": replace(GIRDERS, spacing_m=3.5)},
            "bridge.girders.number is 4: expected girders that fit under bridge.deck.width_m, 10.0 (m), found 10.9",
        ),
        (
            {"girders": GIRDERS, "pier_caps": None},
            "bridge.piers.columns is 3: expected as many as bridge.girders.number, 4, or bridge.pier_caps",
        ),
        ({"box_girder": replace(BOX, width_m=10.1)}, "bridge.box_girder.width_m is 10.1: expected at most"),
        ({"span_lengths_m": [14, 1.1]}, "bridge.pier_caps.length_m is 1.2: expected less than the shortest span, 1.1"),
        (
            {"pier_caps": None, "skew_deg": 60, "span_lengths_m": [14, 1.5]},
            "bridge.piers.column_length_m is 0.8: expected less than 0.75 (m), turned",
        ),
        ({"skew_deg": 80}, "bridge.skew_deg is 80: expected a number from -75.0 to 75.0 (°)"),
        ({"deck": replace(DECK, per_span=True, joint_gap_m=1.2)}, "bridge.deck.joint_gap_m is 1.2: expected less than"),
        (
            {"merge": True, "deck": replace(DECK, density_kg_m3=2500)},
            "bridge.deck.density_kg_m3 is 2500.0: expected none where bridge.merge is true",
        ),
    ],
)
def test_bridges_that_contradict_themselves_are_refused(values, text):
    with pytest.raises(ScenarioError) as refusal:
        replace(SLAB, **values)
    assert text in str(refusal.value)
    assert len(str(refusal.value).splitlines()) == 1


@pytest.mark.parametrize(
    "table, values, text",
    [
        (DECK, {"thickness_m": 0}, "bridge.deck.thickness_m is 0: expected a number from 0.001 to 10000.0 (m)"),
        (DECK, {"joint_gap_m": 0.1}, "bridge.deck.joint_gap_m is 0.1: expected 0 where bridge.deck.per_span is false"),
        (BOX, {"web_thickness_m": 2.75}, "bridge.box_girder.web_thickness_m is 2.75: expected 2 webs that leave room"),
        (BOX, {"web_thickness_m": 0.0}, "bridge.box_girder.web_thickness_m is 0.0: expected a number from 0.001"),
        (BOX, {"bottom_thickness_m": 1.6}, "bridge.box_girder.bottom_thickness_m is 1.6: expected less than"),
        (PIERS, {"kind": "wall"}, 'bridge.piers.columns is 3: expected 1 with bridge.piers.kind "wall"'),
    ],
)
def test_parts_that_contradict_themselves_are_refused(table, values, text):
    with pytest.raises(ScenarioError) as refusal:
        replace(table, **values)
    assert text in str(refusal.value)


def scenario_of(bridge, shards=120, **values):
    return Scenario(
        title="any kind",
        time=TimeSettings(duration_s=1),
        bridge=bridge,
        fracture=FractureSettings(shards=shards),
        connections=ConnectionSettings(method="face", breaking_force_n=1e6),
        **values,
    )


def test_the_ball_has_to_aim_at_the_skewed_deck():
    # At 4 m to the left the deck begins 4 m further along the road, and so it ends.
    bridge = replace(SLAB, skew_deg=45)
    for along in (3.6, 48.9):
        scenario_of(bridge, ball=Ball(mass_kg=1e3, diameter_m=1, target_m=[along, 4], drop_height_m=1))
    for along in (3.4, 49.1):
        with pytest.raises(ScenarioError, match=r"expected a position on the deck, from 3.5 to 49 \(m\)"):
            scenario_of(bridge, ball=Ball(mass_kg=1e3, diameter_m=1, target_m=[along, 4], drop_height_m=1))
