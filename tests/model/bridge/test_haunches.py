# SPDX-License-Identifier: GPL-3.0-or-later
"""Haunches: volumes by integrals, what touches, reactions of beams of variable depth, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest
from support.meshes import is_closed
from test_alignments import contact_areas

from bridge_demolition_addon.engineering.geometry.overlap import hulls, overlaps
from bridge_demolition_addon.engineering.geometry.solids import union
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.bridge import bridge_members
from bridge_demolition_addon.model.scenario import (
    Abutments,
    Alignment,
    BoxGirder,
    Bridge,
    Deck,
    Girders,
    Haunches,
    PierCaps,
    Piers,
    Voids,
)
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.stages.standing import StandingBridge

pytestmark = pytest.mark.slow

SPANS_M, OVERHANG_M, HALF_M = (16.0, 22.0, 16.0), 0.5, 0.75
AXES_M = (0.0, 16.0, 38.0, 54.0)
LENGTH_M = 55.0
PLAIN = Bridge(
    density_kg_m3=2400,
    span_lengths_m=list(SPANS_M),
    deck=Deck(width_m=10, thickness_m=0.8, overhang_m=OVERHANG_M),
    piers=Piers(columns=4, column_length_m=0.8, column_width_m=0.6, height_m=5),
    abutments=Abutments(length_m=2 * HALF_M, width_m=10),
)
ON_GIRDERS = replace(PLAIN, girders=Girders(number=4, width_m=0.5, depth_m=1.0))
IN_A_BOX = replace(
    PLAIN,
    box_girder=BoxGirder(width_m=6, depth_m=1.6, web_thickness_m=0.35, bottom_thickness_m=0.2, cells=2),
    piers=replace(PLAIN.piers, columns=2),
    pier_caps=PierCaps(length_m=1.2, width_m=6, height_m=0.8),
)
BRIDGES = {"slab": PLAIN, "girders": ON_GIRDERS, "box": IN_A_BOX}
BRIDGES |= {f"{name}, skewed": replace(bridge, skew_deg=20) for name, bridge in BRIDGES.items()}
BRIDGES["girders, on a crest"] = replace(ON_GIRDERS, alignment=Alignment(grade_percent=4, end_grade_percent=-3))
RULES = {
    "straight": Haunches(length_m=5, depth_m=0.6),
    "parabola": Haunches(length_m=8, depth_m=0.6, shape="parabola"),
    "at one end and a pier": Haunches(length_m=6, depth_m=0.5, supports=(1, 2)),
}
CASES = [(name, rule) for name in BRIDGES for rule in RULES]


def area_m2(rule):
    """Area in elevation of all haunches: even over a support, then to nothing over what is left of their length."""
    one = {"straight": 1 / 2, "parabola": 1 / 3}[rule.shape] * (rule.length_m - HALF_M) + HALF_M
    numbers = rule.supports or (2, 3)
    sides = sum(1 if number in (1, 4) else 2 for number in numbers)
    overhangs = OVERHANG_M * len({1, 4} & set(numbers))
    return rule.depth_m * (sides * one + overhangs)


@pytest.mark.parametrize(("name", "rule"), CASES)
def test_volumes_by_integrals(name, rule):
    plain, haunches = BRIDGES[name], RULES[rule]
    before, after = (
        {member.name: member.volume_m3 for member in bridge_members(bridge)}
        for bridge in (plain, replace(plain, haunches=haunches))
    )
    more = {member: after[member] - before[member] for member in before}
    by_elevation = {"slab": 10.0, "girders": 0.5, "box": (6 * 1.6 - (6 - 3 * 0.35) * 1.4) / 1.6}[name.split(",")[0]]
    deepened = [member for member in before if ("girder" if "girders" in name else "deck") in member]
    for member in deepened:
        # A parabola of eight straight pieces has 1/128 more than the area between it and the level.
        assert more[member] == pytest.approx(by_elevation * area_m2(haunches), rel=0.01 if rule == "parabola" else 1e-9)
        assert after[member] == pytest.approx(before[member] + by_elevation * area_m2(haunches), rel=1e-3)
    section_m2 = {"pier": 0.8 * 0.6, "abutment": 2 * HALF_M * 10}
    for member in before:
        kind, number = member.split()[0], int(member.split()[1]) if " " in member else 0
        if kind not in section_m2 or member.endswith("cap"):
            continue
        support = {"abutment": 3 * number - 2, "pier": number + 1}[kind]
        lower = haunches.depth_m if support in (haunches.supports or (2, 3)) else 0.0
        assert more[member] == pytest.approx(-section_m2[kind] * lower, abs=1e-9)


@pytest.mark.parametrize(("name", "rule"), CASES)
def test_members_are_closed_and_lie_on_each_other_without_overlap(name, rule):
    plain, members = bridge_members(BRIDGES[name]), bridge_members(replace(BRIDGES[name], haunches=RULES[rule]))
    assert all(is_closed(member.solid) for member in members)
    whole = sum(member.volume_m3 for member in members)
    assert union([member.solid for member in members]).volume == pytest.approx(whole, rel=1e-9)
    for member in members:
        if member.parts:
            assert sum(part.volume for part in member.parts) == pytest.approx(member.volume_m3, rel=1e-9)
    assert contact_areas(members) == pytest.approx(contact_areas(plain), rel=1e-6)


def test_a_deck_knows_where_it_would_be_without_haunches():
    for bridge in (PLAIN, ON_GIRDERS, IN_A_BOX):
        plain = {member.name: member.solid.bounds for member in bridge_members(bridge)}
        for member in bridge_members(replace(bridge, haunches=RULES["parabola"])):
            if member.line:
                own = member.without_skew(member.solid.vertices)
                np.testing.assert_allclose([own.min(axis=0), own.max(axis=0)], plain[member.name], atol=1e-9)
                np.testing.assert_allclose(member.with_skew(own), member.solid.vertices, atol=1e-12)


@pytest.mark.parametrize(
    ("bridge", "keys", "message"),
    [
        (PLAIN, {"depth_m": 4.95}, r"depth_m is 4.95: expected less than bridge\.piers\.height_m, of which 4.9 \(m\)"),
        (PLAIN, {"length_m": 12}, r"length_m is 12.0: expected at most 11 \(m\), so that 2 fit into span 2 of 22 m"),
        (PLAIN, {"length_m": 15.5, "supports": (2,)}, r"length_m is 15.5: expected at most 15.25 \(m\), so that 1 fit"),
        (PLAIN, {"length_m": 0.7}, r"length_m is 0.7: expected more than half .* longest support, 0.75 \(m\)"),
        (PLAIN, {"supports": (2, 5)}, r"different numbers up to 4"),
        (replace(PLAIN, voids=Voids(number=5, diameter_m=0.5)), {}, "haunches and bridge.voids are given together"),
        (PLAIN, {"supports": (1,), "depth_m": 5}, r"less than the height of abutments, of which 4.9 \(m\)"),
    ],
)
def test_haunches_without_room_are_refused_with_numbers(bridge, keys, message):
    with pytest.raises(ScenarioError, match=message):
        replace(bridge, haunches=Haunches(**({"length_m": 5, "depth_m": 0.6} | keys)))


def reactions_n(weights_n_m, stiffness_nm2, n=8000):
    """Reactions of a continuous beam of variable depth, its inner ones redundant, by integrals of M m / EI."""
    dx = LENGTH_M / n
    x = (np.arange(n) + 0.5) * dx - OVERHANG_M
    loads, bending = weights_n_m(x) * dx, stiffness_nm2(x)
    span, inner = AXES_M[-1], AXES_M[1:-1]
    last = (loads * x).sum() / span
    first = loads.sum() - last
    behind = np.concatenate(([0.0], np.cumsum(loads)[:-1]))
    moved = np.concatenate(([0.0], np.cumsum(loads * x)[:-1]))
    moments = first * np.maximum(x, 0) + last * np.maximum(x - span, 0) - (behind * x - moved)
    units = [-np.where(x < at, (span - at) * np.maximum(x, 0), at * np.maximum(span - x, 0)) / span for at in inner]
    matrix = [[(one * other / bending).sum() for other in units] for one in units]
    of_inner = np.linalg.solve(matrix, [-(moments * unit / bending).sum() for unit in units])
    first -= sum(force * (span - at) / span for force, at in zip(of_inner, inner, strict=True))
    last -= sum(force * at / span for force, at in zip(of_inner, inner, strict=True))
    return [first, *of_inner, last]


def depth_m(x, rule):
    away = np.min([abs(x - AXES_M[number - 1]) for number in (rule.supports or (2, 3))], axis=0)
    share = np.clip((rule.length_m - np.maximum(away, HALF_M)) / (rule.length_m - HALF_M), 0, None)
    return rule.depth_m * (share**2 if rule.shape == "parabola" else share)


TEXT = """
[scenario]
title = "haunched"
[time]
duration_s = 1
[bridge]
density_kg_m3 = 2400
span_lengths_m = [16, 22, 16]
[bridge.haunches]
length_m = {length_m}
depth_m = {depth_m}
shape = "{shape}"
[bridge.deck]
width_m = 10
thickness_m = {thickness_m}
overhang_m = 0.5
{girders}
[bridge.piers]
{columns}
height_m = 5
[bridge.abutments]
length_m = 1.5
width_m = 10
[bridge.bearings]
[connections]
method = "face"
type = "FIXED"
material = "reinforced concrete slab"
stiffness = "elastic"
strength_factor = 50
[fracture]
shards = 300
"""
WALL = 'kind = "wall"\ncolumn_length_m = 0.8\ncolumn_width_m = 10'
BOX_GIRDER = "[bridge.box_girder]\nwidth_m = 6\ndepth_m = 1.6\nweb_thickness_m = 0.35\nbottom_thickness_m = 0.2"
COLUMNS = "columns = 4\ncolumn_length_m = 0.8\ncolumn_width_m = 0.6"


@pytest.mark.parametrize("on_girders", [False, True])
@pytest.mark.parametrize("shape", ["straight", "parabola"])
def test_reactions_are_those_of_a_beam_of_variable_depth(on_girders, shape):
    rule, slab_m = RULES[shape], 0.25 if on_girders else 0.8
    girders = "[bridge.girders]\nnumber = 4\nwidth_m = 0.5\ndepth_m = 1.0" if on_girders else ""
    keys = {"length_m": rule.length_m, "depth_m": rule.depth_m, "shape": shape, "thickness_m": slab_m}
    text = TEXT.format(girders=girders, columns=COLUMNS if on_girders else WALL, **keys)
    scenario = scenario_from_text(text)
    model = checked_model(scenario)
    count = len(model.connections)
    loads = np.zeros((6, len(model.shards)))
    standing = StandingBridge(model, scenario.joints).rest(np.ones(count, bool), np.ones(count), loads)
    found = dict.fromkeys(("abutment 1", "pier 1", "pier 2", "abutment 2"), 0.0)
    for bearing in model.bearings.forces(standing.loads):
        below = bearing.name.split(" on ")[1].split(" column")[0]
        found[below] += bearing.force_n[2]

    def section_m2(x):
        return 10 * slab_m + 4 * 0.5 * (1.0 + depth_m(x, rule)) if on_girders else 10 * (slab_m + depth_m(x, rule))

    def about_m4(x):
        if not on_girders:
            return 10 * (slab_m + depth_m(x, rule)) ** 3 / 12
        deep, slab_m2 = 1.0 + depth_m(x, rule), 10 * slab_m
        web_m2 = 2.0 * deep
        apart = slab_m2 * web_m2 / (slab_m2 + web_m2) * ((deep + slab_m) / 2) ** 2
        return web_m2 * deep**2 / 12 + slab_m2 * slab_m**2 / 12 + apart

    wanted = reactions_n(lambda x: 2400 * STANDARD_GRAVITY_M_S2 * section_m2(x), about_m4)
    # Twice what constant depth has in so many shards, by bda check: shards have one depth each.
    assert list(found.values()) == pytest.approx(wanted, rel=0.04)


@pytest.mark.parametrize("name", ["girders on a curved ramp", "box"])
def test_hulls_of_shards_have_hardly_anything_in_common(name):
    """Bullet takes shards for their hulls: what warps by a millimetre, and bends within 2 cm, is left of an overlap."""
    keys = {"length_m": 5, "depth_m": 0.8, "shape": "parabola", "thickness_m": 0.25, "columns": COLUMNS}
    text = TEXT.format(girders="[bridge.girders]\nnumber = 4\nwidth_m = 0.5\ndepth_m = 1.0", **keys)
    text = text.replace("[bridge.deck]", "[bridge.alignment]\nradius_m = -70\ngrade_percent = 4\n[bridge.deck]")
    if name == "box":
        text = TEXT.format(girders=BOX_GIRDER, **(keys | {"columns": COLUMNS.replace("4", "2")}))
    model = checked_model(scenario_from_text(text))
    assert len(overlaps(model.shards)) == 0
    found = overlaps(hulls(model.shards))
    smaller = np.array([min(model.shards[shard].volume for shard in pair) for pair in found.pairs])
    assert (found.volumes < 0.03 * smaller).all()
