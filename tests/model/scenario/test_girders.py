# SPDX-License-Identifier: GPL-3.0-or-later
"""Girder bridges by sizes: their bars, nodes and deck, counted by hand, and what is refused."""

import math

import numpy as np
import pytest

from bridge_demolition_addon.engineering.steelwork.catalogue import section_named
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.bridge.steelwork import steelwork_members
from bridge_demolition_addon.model.scenario import GirderSpan, Steelwork

pytestmark = pytest.mark.slow

MAIN, OVER = "PG 1200x12x300x25x400x30", "PG 1200x14x400x40x500x50"


def span(**keys):
    sizes = {
        "position_m": (1.0, 0.0, 8.0),
        "span_lengths_m": (20.0, 24.0),
        "girders": 3,
        "spacing_m": 2.5,
        "section": MAIN,
        "fields": (4, 3),
        "cross_frames": "HEA 300",
        "deck_thickness_m": 0.25,
        "deck_width_m": 8.0,
        "studs_per_m": 6.0,
        "stud_diameter_mm": 19.0,
    }
    return GirderSpan(**{**sizes, **keys})


def test_it_has_the_bars_of_one_drawn_by_hand():
    """7 fields of 3 girders, 8 cross frames in 2 gaps, and bracing in each field of these."""
    members = Steelwork(girders=(span(bracing="L 100x100x10"),)).all_members
    kinds = [member.kind for member in members]
    assert {kind: kinds.count(kind) for kind in dict.fromkeys(kinds)} == {
        "girder": 21,
        "cross frame": 16,
        "bracing": 14,
    }


def test_sections_over_the_pier_have_nodes_where_they_begin_and_level_flanges():
    """6 m about the pier at 21 m: nodes at 18 and 24 m, without cross frames there."""
    steelwork = Steelwork(girders=(span(pier_section=OVER, pier_length_m=6.0),))
    places = {node.name: node.position_m[0] for node in steelwork.all_nodes if node.name.startswith("span G1 ")}
    assert list(places.values()) == pytest.approx([1.0, 6.0, 11.0, 16.0, 18.0, 21.0, 24.0, 29.0, 37.0, 45.0])
    over = [member.name for member in steelwork.all_members if member.section == OVER]
    assert over == [f"span G{girder} {ends}" for girder in (1, 2, 3) for ends in ("4-5", "5-6")]
    assert not [member for member in steelwork.all_members if member.kind == "cross frame" and " 4 " in member.name]
    members = {member.name: member for member in steelwork_members(steelwork)}
    tops = [members[f"span G1 {ends}"].solid.bounds[1, 2] for ends in ("3-4", "4-5", "5-6", "6-7")]
    assert tops == pytest.approx([8.0] * 4, abs=1e-9)
    bottoms = [members[f"span G1 {ends}"].solid.bounds[0, 2] for ends in ("3-4", "4-5")]
    assert bottoms == pytest.approx([6.8] * 2, abs=1e-9)


def test_supports_are_pinned_at_one_line_and_rockers_elsewhere():
    steelwork = Steelwork(girders=(span(pinned_at=2, supports=("east", "pier", "west")),))
    held = [(node.name, node.support, node.held_by) for node in steelwork.all_nodes if node.support]
    assert held[:3] == [
        ("span G1 0", "rocker", "east"),
        ("span G1 4", "pinned", "pier"),
        ("span G1 7", "rocker", "west"),
    ]
    assert len(held) == 9
    assert not [node for node in Steelwork(girders=(span(is_supported=False),)).all_nodes if node.support]


def test_its_mass_is_that_of_its_bars_and_of_its_deck():
    steelwork = Steelwork(girders=(span(),))
    places = {node.name: node.position_m for node in steelwork.all_nodes}
    steel = math.fsum(
        member.steel_section.area_m2 * math.dist(*(places[name] for name in member.nodes))
        for member in steelwork.all_members
    )
    members = steelwork_members(steelwork)
    assert math.fsum(member.mass_kg for member in members[1:]) == pytest.approx(7850.0 * steel)
    assert (members[0].name, members[0].kind) == ("span deck", "deck")
    assert members[0].mass_kg == pytest.approx(2500.0 * 8.0 * 0.25 * 44.0)
    assert members[0].solid.bounds.tolist() == [[1.0, -4.0, 8.0], [45.0, 4.0, 8.25]]


def test_parts_of_the_deck_end_where_pieces_of_all_girders_do():
    members = {member.name: member for member in steelwork_members(Steelwork(girders=(span(),), pieces=3))}
    ends = np.unique([part.bounds[:, 0] for part in members["span deck"].parts])
    for girder in (1, 2, 3):
        bar = members[f"span G{girder} 2-3"].steel.bar
        for cut in bar.begin_m[0] + bar.cuts_m:
            assert abs(ends - cut).min() < 1e-9


def test_a_girder_may_stand_alone_and_without_a_deck():
    keys = dict.fromkeys(("deck_thickness_m", "deck_width_m", "studs_per_m", "stud_diameter_mm"))
    steelwork = Steelwork(girders=(span(girders=1, spacing_m=None, cross_frames=None, section="HEB 600", **keys),))
    assert {member.kind for member in steelwork_members(steelwork)} == {"girder", "node"}
    assert section_named("HEB 600").web.count == 1


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"section": "CHS 168.3x8"}, "section with flanges"),
        ({"section": "PG 1"}, "has 1 sizes"),
        ({"fields": (4, 3, 2)}, "one number, or 2"),
        ({"pinned_at": 4}, "at most 3"),
        ({"supports": ("ground",)}, "3 names"),
        ({"pier_section": OVER}, "pier_length_m is missing"),
        ({"pier_length_m": 4.0}, "pier_section is missing"),
        ({"pier_section": OVER, "pier_length_m": 20.0}, "less than the shortest span"),
        ({"fields": (30,)}, "1.2 m apart, as deep as girders are, or more; some are 0.6667 m apart"),
        ({"pier_section": OVER, "pier_length_m": 10.5}, "some are 0.25 m apart"),
        ({"cross_frames": None}, "cross_frames is missing"),
        ({"spacing_m": None}, "spacing_m is missing"),
        ({"studs_per_m": None}, "studs_per_m is missing"),
        ({"studs_per_m": 0.0}, "none where steelwork.girders.studs_per_m is 0"),
        ({"deck_thickness_m": None}, "none without steelwork.girders.deck_thickness_m"),
        ({"stud_strength_n": 9e4}, "not both"),
        ({"stud_diameter_mm": None, "stud_strength_n": 9e4}, "stud_uplift_n is missing"),
        ({"stud_height_mm": 50.0}, "at least 57"),
    ],
)
def test_what_cannot_be_built_is_refused(keys, message):
    with pytest.raises(ScenarioError, match=message):
        span(**keys)


def test_two_bridges_need_names_of_their_own():
    with pytest.raises(ScenarioError, match='have one name, "span"'):
        Steelwork(girders=(span(), span()))
