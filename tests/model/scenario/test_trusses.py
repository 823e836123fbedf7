# SPDX-License-Identifier: GPL-3.0-or-later
"""Truss spans by sizes: their bars and nodes, counted by hand, and their mass."""

import math

import pytest

from bridge_demolition_addon.engineering.steelwork.catalogue import section_named
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.bridge.steelwork import steelwork_members
from bridge_demolition_addon.model.scenario import Steelwork, TrussSpan

pytestmark = pytest.mark.slow


def span(**keys):
    sections = dict.fromkeys(("top_chord", "bottom_chord", "posts", "diagonals", "cross_beams", "bracing"), "HEB 200")
    sizes = {"position_m": (0.0, 0.0, 6.0), "length_m": 32.0, "panels": 8, "height_m": 4.0, "spacing_m": 6.0}
    return TrussSpan(**{**sections, **sizes, **keys})


def by_kind(truss):
    kinds = [member.kind for member in Steelwork(trusses=(truss,)).all_members]
    return {kind: kinds.count(kind) for kind in dict.fromkeys(kinds)}


@pytest.mark.parametrize("kind", ["pratt", "warren"])
def test_a_through_truss_has_the_bars_of_one_drawn_by_hand(kind):
    assert by_kind(span(kind=kind)) == {
        "bottom chord": 16,
        "top chord": 12,
        "post": 14,
        "end post": 4,
        "diagonal": 12,
        "cross beam": 16,
        "bracing": 14,
    }


def test_a_deck_truss_has_upright_ends():
    assert by_kind(span(deck="top")) == {
        "bottom chord": 16,
        "top chord": 16,
        "post": 18,
        "diagonal": 16,
        "cross beam": 18,
        "bracing": 16,
    }


def test_diagonals_of_a_pratt_truss_fall_towards_the_middle():
    names = [member.name for member in Steelwork(trusses=(span(),)).all_members if member.kind == "diagonal"]
    left = [name.split()[1] for name in names if name.endswith("left")]
    assert left == ["U1-L2", "U2-L3", "U3-L4", "L4-U5", "L5-U6", "L6-U7"]


def test_its_mass_is_that_of_its_bars_and_of_its_deck():
    steelwork = Steelwork(trusses=(span(deck_kg_m=5000.0),))
    places = {node.name: node.position_m for node in steelwork.all_nodes}
    length = math.fsum(math.dist(*(places[name] for name in member.nodes)) for member in steelwork.all_members)
    by_hand = 7850.0 * section_named("HEB 200").area_m2 * length + 5000.0 * 32.0
    assert math.fsum(member.mass_kg for member in steelwork_members(steelwork)) == pytest.approx(by_hand)


def test_what_is_no_truss_is_refused():
    with pytest.raises(ScenarioError, match="panels is 7: expected an even number"):
        span(panels=7)
    with pytest.raises(ScenarioError, match="posts: section"):
        span(posts="HEB 1")
