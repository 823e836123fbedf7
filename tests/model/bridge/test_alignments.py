# SPDX-License-Identifier: GPL-3.0-or-later
"""Decks on a grade, on a vertical curve, with crossfall: volumes and heights by hand, what touches, how they stand."""

from dataclasses import replace

import numpy as np
import pytest
from support.meshes import is_closed

from bridge_demolition_addon.engineering.geometry.level_contacts import level_contacts
from bridge_demolition_addon.engineering.geometry.mesh import triangle_areas_and_normals
from bridge_demolition_addon.engineering.geometry.solids import union
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import GeometryError, ScenarioError
from bridge_demolition_addon.model.bridge import bridge_members, deck_top_at
from bridge_demolition_addon.model.bridge.preparation import prepared_members
from bridge_demolition_addon.model.scenario import (
    Abutments,
    Alignment,
    BoxGirder,
    Bridge,
    Deck,
    Girders,
    PierCaps,
    Piers,
)
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.stages.standing import StandingBridge
from bridge_demolition_addon.model.structure.finishes import Finish, finishes

pytestmark = pytest.mark.slow

ROUNDING = 1e-9
SPANS_M, OVERHANG_M = (14.0, 18.5, 12.0), 0.5
AXES_M = (0.0, 14.0, 32.5, 44.5)

DECK = Deck(width_m=10, thickness_m=0.25, overhang_m=OVERHANG_M)
LEVEL = Bridge(
    density_kg_m3=2400,
    span_lengths_m=list(SPANS_M),
    deck=DECK,
    piers=Piers(columns=3, column_length_m=0.8, column_width_m=0.6, height_m=5),
    pier_caps=PierCaps(length_m=1.2, width_m=9, height_m=0.8),
    abutments=Abutments(length_m=1.5, width_m=10),
)
ROUND = Piers(kind="round columns", columns=2, column_length_m=1.1, column_width_m=1.1, height_m=5)
GIRDERS = Girders(number=4, width_m=0.4, depth_m=1.1)
BOX = BoxGirder(width_m=5.5, depth_m=1.6, web_thickness_m=0.35, bottom_thickness_m=0.2, cells=2)
KINDS = {
    "slab": LEVEL,
    "girders": replace(LEVEL, girders=GIRDERS, abutments=None),
    "girders apart": replace(LEVEL, girders=GIRDERS, deck=replace(DECK, per_span=True, joint_gap_m=0.05)),
    "box on round columns": replace(LEVEL, box_girder=BOX, piers=ROUND, pier_caps=None),
    "wall": replace(LEVEL, piers=Piers(kind="wall", column_length_m=0.9, column_width_m=8, height_m=5), pier_caps=None),
}
KINDS |= {f"{name}, skewed": replace(bridge, skew_deg=25) for name, bridge in KINDS.items()}
LINES = {
    "grade": Alignment(grade_percent=4, crossfall_percent=-2.5),
    "crest": Alignment(grade_percent=5, end_grade_percent=-3, curve_from_m=8, curve_to_m=36, crossfall_percent=2),
    "tops": Alignment(tops_m=[6.05, 6.4, 6.1, 5.9]),
}
CASES = [(kind, line) for kind in KINDS for line in LINES]


def on_line(kind, line):
    bridge, rule = KINDS[kind], LINES[line]
    if rule.tops_m is not None:
        lift = deck_top_at(bridge, 0.0, 0.0) - rule.tops_m[0]
        rule = replace(rule, tops_m=[top + lift for top in rule.tops_m])
    return replace(bridge, alignment=rule)


def by_kind(members):
    volumes = {}
    for member in members:
        volumes[member.kind] = volumes.get(member.kind, 0.0) + member.volume_m3
    return volumes


def rises_m(line):
    """How much higher the deck is above each axis than above the first, and its slopes there."""
    if line == "grade":
        return [0.04 * x for x in AXES_M], [0.04] * 4
    if line == "crest":  # from 8 m on it bends by 8 % in 28 m
        rises = [0.05 * x - 0.08 / 56 * min(max(x - 8, 0), 28) ** 2 - 0.08 * max(x - 36, 0) for x in AXES_M]
        return rises, [0.05 - 0.08 * min(max(x - 8, 0), 28) / 28 for x in AXES_M]
    rises = [0.0, 0.35, 0.05, -0.15]
    slopes = [0.35 / 14, -0.3 / 18.5, -0.2 / 12]
    return rises, [slopes[0], (slopes[0] + slopes[1]) / 2, (slopes[1] + slopes[2]) / 2, slopes[2]]


@pytest.mark.parametrize(("kind", "line"), CASES)
def test_volumes_by_the_height_at_each_axis(kind, line):
    """Deck, girders and caps move by the plumb line and keep their volumes; what stands is higher by the rise there."""
    level, found = KINDS[kind], by_kind(bridge_members(on_line(kind, line)))
    wanted = by_kind(bridge_members(level))
    first, *inner, last = rises_m(line)[0]
    of_axes = inner if level.abutments else [first, *inner, last]
    each_m2 = wanted["pier"] / (5.0 * len(of_axes))
    wanted["pier"] += each_m2 * sum(of_axes)
    if level.abutments:
        wanted["abutment"] += 1.5 * 10 * (first + last)
    assert found == pytest.approx(wanted, rel=ROUNDING)


@pytest.mark.parametrize(("kind", "line"), CASES)
def test_members_are_closed_and_lie_on_each_other_without_overlap(kind, line):
    level, members = bridge_members(KINDS[kind]), bridge_members(on_line(kind, line))
    assert all(is_closed(member.solid) for member in members)
    whole = sum(member.volume_m3 for member in members)
    assert union([member.solid for member in members]).volume == pytest.approx(whole, rel=ROUNDING)
    for member in members:
        if member.parts:
            assert sum(part.volume for part in member.parts) == pytest.approx(member.volume_m3, rel=ROUNDING)
    # What lies on what, and on which area in plan, is as on a level road.
    assert contact_areas(members) == pytest.approx(contact_areas(level), rel=1e-6)


def contact_areas(members):
    areas = {}
    for above in members:
        for below in members:
            contacts = level_contacts(above.solid, below.solid) if above is not below else []
            if contacts:
                areas[above.name, below.name] = sum(contact.area_m2 for contact in contacts)
    return areas


@pytest.mark.parametrize("line", LINES)
def test_tops_above_axes_and_across_by_hand(line):
    bridge = on_line("slab, skewed", line)
    tangent = np.tan(np.radians(25))
    for axis, rise, slope in zip(AXES_M, *rises_m(line), strict=True):
        assert deck_top_at(bridge, axis, 0.0) == pytest.approx(6.05 + rise, abs=1e-9)
        # A skewed axis is further along the road on its left, where that is higher by its slope as well.
        left = deck_top_at(bridge, axis + 4 * tangent, 4.0)
        fall = 0.01 * bridge.alignment.crossfall_percent
        assert left == pytest.approx(6.05 + rise + 4 * fall + 4 * tangent * slope, abs=1e-9)


def test_a_deck_between_axes_follows_its_vertical_curve():
    bridge = on_line("slab", "crest")
    for along in (2.0, 9.0, 12.0, 20.0, 25.0, 30.0, 35.0, 40.0):
        height = 0.05 * along - 0.08 / 56 * min(max(along - 8, 0), 28) ** 2 - 0.08 * max(along - 36, 0)
        # Straight over 1.5 m at supports and between bends: off the parabola by less than 5 mm.
        assert deck_top_at(bridge, along, 0.0) == pytest.approx(6.05 + height, abs=0.005)


def test_members_know_where_they_would_be_on_a_level_road():
    level = {member.name: member for member in bridge_members(KINDS["girders, skewed"])}
    for member in bridge_members(on_line("girders, skewed", "crest")):
        if member.line:
            found, other = member.without_skew(member.solid.vertices), level[member.name]
            np.testing.assert_allclose(member.with_skew(found), member.solid.vertices, atol=1e-12)
            wanted = other.without_skew(other.solid.vertices)
            np.testing.assert_allclose(found.min(axis=0), wanted.min(axis=0), atol=1e-9)
            np.testing.assert_allclose(found.max(axis=0), wanted.max(axis=0), atol=1e-9)


def test_what_a_road_cannot_do_is_refused_with_numbers():
    with pytest.raises(ScenarioError, match=r"tops_m.1 is 6: expected 6.05 \(m\)"):
        replace(LEVEL, alignment=Alignment(tops_m=[6, 6, 6, 6]))
    with pytest.raises(ScenarioError, match="expected 4 numbers, one for each support"):
        replace(LEVEL, alignment=Alignment(tops_m=[6.05, 6]))
    with pytest.raises(ScenarioError, match=r"slope of -20\.7 % in span 1: expected at most 15 %"):
        replace(LEVEL, alignment=Alignment(tops_m=[6.05, 3.15, 6, 6]))
    with pytest.raises(ScenarioError, match=r"curve_from_m is 50\.0: .* from 50 to 44.5 \(m\)"):
        replace(LEVEL, alignment=Alignment(end_grade_percent=2, curve_from_m=50))
    with pytest.raises(ScenarioError, match="curve_to_m is 9"):
        Alignment(curve_to_m=9)
    with pytest.raises(ScenarioError, match="grade_percent is 1"):
        Alignment(tops_m=[6.05, 6, 6, 6], grade_percent=1)
    with pytest.raises(ScenarioError, match=r"alignment and bridge\.merge are given together"):
        replace(LEVEL, alignment=Alignment(grade_percent=1), merge=True)
    with pytest.raises(GeometryError, match=r"ground is at 0.00 m under abutment 2, whose top is at -0.88 m"):
        bridge_members(replace(LEVEL, alignment=Alignment(grade_percent=-15)))


def test_a_deck_that_sags_into_the_ground_between_its_axes_is_refused():
    low = replace(
        LEVEL, span_lengths_m=[60], piers=None, pier_caps=None, abutments=replace(LEVEL.abutments, height_m=1)
    )
    sag = Alignment(grade_percent=-10, end_grade_percent=10)
    with pytest.raises(
        GeometryError, match=r"underside of deck is at -0.50 m, below the ground at 0, around x = 28.28 m"
    ):
        prepared_members(
            replace(
                scenario_from_text(STANDING.format(skew_deg=0, girders="", thickness_m=1)),
                bridge=replace(low, alignment=sag),
            )
        )


CURVES = {
    "left, level": Alignment(radius_m=80),
    "left, on a ramp": Alignment(radius_m=60, grade_percent=5, crossfall_percent=-4),
    "right, on a crest": Alignment(radius_m=-70, grade_percent=4, end_grade_percent=-4, crossfall_percent=3),
}
CURVED = [(kind, line) for kind in KINDS if "skewed" not in kind for line in CURVES]


@pytest.mark.parametrize(("kind", "line"), CURVED)
def test_volumes_on_a_curve_by_pappus(kind, line):
    """A section of a ring has its area times the way of its centroid; straight pieces leave out 0.03 % of that."""
    level, rule = KINDS[kind], CURVES[line]
    members = bridge_members(replace(level, alignment=rule))
    plain = {member.name: member for member in bridge_members(level)}
    for member in members:
        if member.kind in ("deck", "girder"):
            across = plain[member.name].solid.vertices[:, 1].mean()
            wanted = plain[member.name].volume_m3 * (1 - across / rule.radius_m)
            assert member.volume_m3 == pytest.approx(wanted, rel=1e-3)
            assert member.volume_m3 < wanted
        elif member.kind == "pier cap":
            assert member.volume_m3 == pytest.approx(plain[member.name].volume_m3, rel=ROUNDING)


@pytest.mark.parametrize(("kind", "line"), CURVED)
def test_members_on_a_curve_are_closed_and_touch_without_overlap(kind, line):
    level, members = bridge_members(KINDS[kind]), bridge_members(replace(KINDS[kind], alignment=CURVES[line]))
    assert all(is_closed(member.solid) for member in members)
    whole = sum(member.volume_m3 for member in members)
    assert union([member.solid for member in members]).volume == pytest.approx(whole, rel=ROUNDING)
    for member in members:
        if member.parts:
            assert sum(part.volume for part in member.parts) == pytest.approx(member.volume_m3, rel=ROUNDING)
    found, wanted = contact_areas(members), contact_areas(level)
    assert found.keys() == wanted.keys()
    for pair, area_m2 in wanted.items():
        way = 1.0
        if "girder" in pair[1]:  # under its slab, on all its length
            girder = next(member for member in level if member.name == pair[1])
            way = 1 - girder.solid.vertices[:, 1].mean() / CURVES[line].radius_m
        # Ends of decks at joints and over abutments are radial, which the sides of supports are not.
        is_end = "abutment" in pair[1] or (kind == "girders" and pair[1] in ("pier 1 cap", "pier 4 cap"))
        rel = 0.03 if "apart" in kind or is_end else 1e-3
        assert found[pair] == pytest.approx(way * area_m2, rel=rel)


def test_axes_on_a_curve_are_radial_and_as_far_along_it_as_spans_are_long():
    bridge = replace(KINDS["slab"], alignment=CURVES["right, on a crest"])
    feet = [
        member.solid.vertices[member.solid.vertices[:, 2] < 1e-9].mean(axis=0)
        for member in bridge_members(bridge)
        if member.kind == "abutment" or (member.kind == "pier" and "column 2" in member.name)
    ]
    for (x, y, _), axis in zip(feet, (0.0, 44.5, 14.0, 32.5), strict=True):
        assert [x, y] == pytest.approx([70 * np.sin(axis / 70), -70 * (1 - np.cos(axis / 70))], abs=1e-6)
    for member in bridge_members(bridge):
        if member.line:
            own = member.without_skew(member.solid.vertices)
            np.testing.assert_allclose(member.with_skew(own), member.solid.vertices, atol=1e-10)
    # Columns look along the road: turned back they are as on a straight one.
    column = next(member for member in bridge_members(bridge) if member.name == "pier 2 column 1")
    assert np.ptp(column.without_skew(column.solid.vertices), axis=0)[:2] == pytest.approx([0.8, 0.6], abs=1e-9)


def test_a_radius_that_does_not_fit_is_refused_with_numbers():
    with pytest.raises(ScenarioError, match=r"radius_m is 9.0: expected more than 10 \(m\) or less than -10"):
        replace(LEVEL, alignment=Alignment(radius_m=9))
    with pytest.raises(ScenarioError, match=r"radius_m is -13.0: expected at least 14.16 \(m\), so that .* 180°"):
        replace(LEVEL, alignment=Alignment(radius_m=-13))
    with pytest.raises(ScenarioError, match=r"skew_deg is 5: expected 0 with bridge\.alignment\.radius_m"):
        replace(LEVEL, alignment=Alignment(radius_m=60), skew_deg=5)


STANDING = """
[scenario]
title = "on a crest"
[time]
duration_s = 1
[bridge]
density_kg_m3 = 2500
span_lengths_m = [15, 20, 15]
skew_deg = {skew_deg}
[bridge.alignment]
grade_percent = 5
end_grade_percent = -3
crossfall_percent = 2.5
[bridge.deck]
width_m = 6
thickness_m = {thickness_m}
{girders}
[bridge.piers]
kind = "wall"
column_length_m = 0.8
column_width_m = 6
height_m = 6
[bridge.abutments]
length_m = 0.8
width_m = 6
[bridge.bearings]
[connections]
method = "face"
type = "FIXED"
material = "reinforced concrete slab"
stiffness = "elastic"
strength_factor = 50
[fracture]
shards = 260
"""


@pytest.mark.parametrize(("skew_deg", "girders"), [(0, False), (20, False), (0, True)])
def test_it_stands_with_the_reactions_of_a_continuous_beam(skew_deg, girders):
    """Spans of 15, 20 and 15 m, by the equation of three moments: M = w (l³ + L³) / (4 (2 l + 3 L)) over the piers."""
    table = "[bridge.girders]\nnumber = 2\nwidth_m = 0.8\ndepth_m = 1.0" if girders else ""
    text = STANDING.format(skew_deg=skew_deg, girders=table, thickness_m=0.3 if girders else 1)
    of_axes = dict.fromkeys(("abutment 1", "abutment 2", "pier 1", "pier 2"), 0.0)
    for bearing in bearing_forces(text):
        of_axes[bearing.name.split(" on ")[1]] += bearing.force_n[2]
    section_m2 = 6 * 0.3 + 2 * 0.8 * 1.0 if girders else 6.0
    weight = 2500 * STANDARD_GRAVITY_M_S2 * section_m2
    hogging = weight * (15**3 + 20**3) / (4 * (2 * 15 + 3 * 20))
    end = weight * 7.5 - hogging / 15
    wanted = {"abutment 1": end, "abutment 2": end, "pier 1": 25 * weight - end, "pier 2": 25 * weight - end}
    assert sum(of_axes.values()) == pytest.approx(50 * weight, rel=1e-6)
    # What this fineness of cuts is off by on a level road as well.
    assert of_axes == pytest.approx(wanted, rel=0.04 if skew_deg == 0 else 0.08)


def test_bars_follow_the_deck_and_resist_what_they_do_on_a_level_road():
    """By hand: 5000 mm² of B500B at 60 mm from either side of a slab, wherever that is."""
    text = (
        STANDING.format(skew_deg=20, girders="", thickness_m=1)
        + """
[[reinforcement]]
members = ["deck"]
along = "x"
side = "bottom"
depth_m = 0.06
area_mm2 = 5000
yield_n_mm2 = 500
[[reinforcement]]
members = ["deck"]
along = "y"
side = "top"
depth_m = 0.06
area_mm2 = 20000
yield_n_mm2 = 500
"""
    )
    scenario = scenario_from_text(text)
    model = checked_model(scenario)
    deck = next(member for member in model.members if member.kind == "deck")
    bars = model.bar_rows
    positions = bars.moments_nm / bars.pulls_n[:, None]
    own = deck.without_skew(positions)
    for layer, depth_m, axis in ((0, -0.44, 0), (1, 0.44, 1)):
        of_layer = (bars.layers == layer) & (bars.pulls_n > 1.0)
        assert of_layer.sum() > 20
        np.testing.assert_allclose(own[of_layer, 2], 6.5 + depth_m, atol=3e-3)  # over a bend, in the mean
        along = (bars.directions[of_layer] * deck.line.directions(own[of_layer], axis)).sum(axis=1)
        np.testing.assert_allclose(abs(along), 1.0, atol=1e-5)


def test_a_tendon_by_eccentricities_follows_the_deck():
    text = (
        STANDING.format(skew_deg=20, girders="", thickness_m=1)
        + """
[[tendons]]
name = "T"
member = "deck"
eccentricities_m = [0.0, 0.3, 0.0]
area_mm2 = 3000
prestress_n_mm2 = 1000
"""
    )
    scenario = scenario_from_text(text)
    model = checked_model(scenario)
    deck = next(member for member in model.members if member.kind == "deck")
    own = deck.without_skew(model.tendons.paths_m[0])
    below = 0.3 * 4 * own[:, 0] / 50 * (1 - own[:, 0] / 50)
    np.testing.assert_allclose(own[:, 2], 6.5 - below, atol=1e-9)


@pytest.mark.parametrize("skew_deg", [0, 25])
def test_shards_of_slab_and_girders_lie_on_each_other_wholly(skew_deg):
    """A skewed deck on a crest is warped: corners of slab and girders are at the same positions all the same."""
    table = "[bridge.girders]\nnumber = 2\nwidth_m = 0.8\ndepth_m = 1.0"
    model = checked_model(scenario_from_text(STANDING.format(skew_deg=skew_deg, girders=table, thickness_m=0.3)))
    kinds = np.array([model.members[member].kind for member in model.member_of_shard] + ["ground"])
    meet = (np.sort(kinds[model.connections.pairs], axis=1) == ("deck", "girder")).all(axis=1)
    # In plan, which faces on up to 5 % are longer than by 0.13 %.
    assert model.connections.areas[meet].sum() == pytest.approx(2 * 0.8 * 50, rel=1.5e-3)


def bearing_forces(text):
    scenario = scenario_from_text(text)
    model = checked_model(scenario)
    count = len(model.connections)
    loads = np.zeros((6, len(model.shards)))
    standing = StandingBridge(model, scenario.joints).rest(np.ones(count, bool), np.ones(count), loads)
    return model.bearings.forces(standing.loads)


@pytest.mark.parametrize("radius_m", [40, -60])
@pytest.mark.parametrize("grade_percent", [0, 5])
def test_a_curved_span_twists_its_bearings_as_equilibrium_has_it(radius_m, grade_percent):
    """By symmetry both ends carry half, and about the line between them together the moment of the weight.

    The centroid of a sector of a ring is at 2 (R³ - r³) / (3 (R² - r²)) · sin(φ/2) / (φ/2) from its centre.
    """
    span, overhang, width = 20.0, 0.4, 8.0
    text = STANDING.format(skew_deg=0, girders="overhang_m = 0.4", thickness_m=1)
    text = (
        text.replace("[15, 20, 15]", "[20]")
        .replace("width_m = 6", "width_m = 8")
        .replace("shards = 260", "shards = 150")
    )
    text = text.replace("crossfall_percent = 2.5", f"radius_m = {radius_m}").replace("end_grade_percent = -3", "")
    text = text.replace("grade_percent = 5", f"grade_percent = {grade_percent}")
    begin, end = text.index("[bridge.piers]"), text.index("[bridge.abutments]")
    first, last = bearing_forces(text[:begin] + text[end:].replace("length_m = 0.8", "length_m = 0.8\nheight_m = 6"))
    weight = 2500 * STANDARD_GRAVITY_M_S2 * width * (span + 2 * overhang)
    assert first.force_n[2] + last.force_n[2] == pytest.approx(weight, rel=1e-3)  # what pieces leave out
    assert [first.force_n[2], last.force_n[2]] == pytest.approx([weight / 2] * 2, rel=0.01)
    radius, half = abs(radius_m), (span + 2 * overhang) / (2 * abs(radius_m))
    outer, inner = radius + width / 2, radius - width / 2
    centroid = 2 * (outer**3 - inner**3) / (3 * (outer**2 - inner**2)) * np.sin(half) / half
    beyond = centroid - radius * np.cos(span / (2 * radius))
    chord = last.axis_m[:2] - first.axis_m[:2]
    assert np.linalg.norm(chord) == pytest.approx(2 * radius * np.sin(span / (2 * radius)), rel=1e-3)
    line = last.axis_m - first.axis_m
    along = line / np.linalg.norm(line)
    # A weight beside the line on the outer side pulls that side down: bearings turn it back.
    moments = np.array([-np.sign(radius_m) * (bearing.moment_nm @ along) for bearing in (first, last)])
    assert moments.sum() == pytest.approx(weight * beyond, rel=0.015)  # pieces are chords, inside of the curve
    # How the ends share it depends on how the cut twists.
    assert moments == pytest.approx([weight / 2 * beyond] * 2, rel=0.2)


def test_girders_on_a_curve_are_as_stiff_along_it_as_on_a_straight_road():
    """Reactions of axes are those of the beam of the same spans, within what a curve of 1/80 and cuts change."""
    table = "[bridge.girders]\nnumber = 2\nwidth_m = 0.8\ndepth_m = 1.0"
    text = STANDING.format(skew_deg=0, girders=table, thickness_m=0.3)
    found = []
    for keys in ("", "radius_m = 80"):
        of_axes = dict.fromkeys(("abutment 1", "pier 1", "pier 2", "abutment 2"), 0.0)
        for bearing in bearing_forces(text.replace("crossfall_percent = 2.5", keys)):
            of_axes[bearing.name.split(" on ")[1]] += bearing.force_n[2]
        found.append(list(of_axes.values()))
    assert found[1] == pytest.approx(found[0], rel=0.04)


def test_shards_on_a_curved_ramp_lie_on_each_other_wholly():
    table = "[bridge.girders]\nnumber = 2\nwidth_m = 0.8\ndepth_m = 1.0"
    text = STANDING.format(skew_deg=0, girders=table, thickness_m=0.3)
    model = checked_model(scenario_from_text(text.replace("crossfall_percent = 2.5", "radius_m = 60")))
    kinds = np.array([model.members[member].kind for member in model.member_of_shard] + ["ground"])
    meet = (np.sort(kinds[model.connections.pairs], axis=1) == ("deck", "girder")).all(axis=1)
    assert model.connections.areas[meet].sum() == pytest.approx(2 * 0.8 * 50, rel=2e-3)


def test_the_whole_top_of_a_deck_that_rises_is_a_road():
    text = STANDING.format(skew_deg=0, girders="", thickness_m=1).replace("end_grade_percent = -3\n", "")
    model = checked_model(scenario_from_text(text))
    roads = [
        triangle_areas_and_normals(shard.corners)[0][finish == Finish.ROAD].sum()
        for shard, finish in zip(
            model.shards, finishes(model.shards, model.members, model.member_of_shard), strict=True
        )
    ]
    assert sum(roads) == pytest.approx(6 * 50, rel=2e-3)  # in plan; 5 % make it longer by 0.13 %
