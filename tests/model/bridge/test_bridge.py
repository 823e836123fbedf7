# SPDX-License-Identifier: GPL-3.0-or-later
"""Members of bridges whose sizes and places are worked out by hand."""

from dataclasses import replace

import numpy as np
import pytest
from support.meshes import is_closed

from bridge_demolition_addon.engineering.geometry.solids import bodies, to_manifold, union
from bridge_demolition_addon.model.bridge import bridge_density, bridge_members, deck_top, deck_underside
from bridge_demolition_addon.model.bridge.layout import pier_axes
from bridge_demolition_addon.model.scenario import Bridge, Deck, PierCaps, Piers

DECK = Deck(width_m=8.5, thickness_m=0.25, overhang_m=0.5)
PIERS = Piers(columns=2, column_length_m=0.7, column_width_m=0.6, height_m=4.9)
CAPS = PierCaps(length_m=0.8, width_m=8.0, height_m=0.4)
BRIDGE = Bridge(mass_kg=107_000, span_lengths_m=[13], deck=DECK, piers=PIERS, pier_caps=CAPS)
TWO_SPANS = replace(BRIDGE, span_lengths_m=[13, 10.5])
WITHOUT_CAPS = replace(TWO_SPANS, pier_caps=None)

# Coordinates of some ten metres in double precision.
ROUNDING_M = 1e-12


def bounds_of(bridge):
    return {member.name: member.solid.bounds for member in bridge_members(bridge)}


def test_piers_stand_at_the_ends_of_the_spans():
    assert pier_axes(BRIDGE).tolist() == [0.0, 13.0]
    assert pier_axes(replace(BRIDGE, span_lengths_m=[20, 30, 20.5])).tolist() == [0.0, 20.0, 50.0, 70.5]


def test_heights_of_the_deck():
    assert deck_underside(BRIDGE) == pytest.approx(5.3, abs=ROUNDING_M)
    assert deck_top(BRIDGE) == pytest.approx(5.55, abs=ROUNDING_M)
    assert deck_underside(WITHOUT_CAPS) == 4.9
    assert deck_top(WITHOUT_CAPS) == pytest.approx(5.15, abs=ROUNDING_M)


def test_members_and_their_volumes():
    members = bridge_members(BRIDGE)
    assert [(member.name, member.kind) for member in members] == [
        ("deck", "deck"),
        ("pier 1 cap", "pier cap"),
        ("pier 1 column 1", "pier"),
        ("pier 1 column 2", "pier"),
        ("pier 2 cap", "pier cap"),
        ("pier 2 column 1", "pier"),
        ("pier 2 column 2", "pier"),
    ]
    volumes = [14 * 8.5 * 0.25] + 2 * [0.8 * 8 * 0.4, 0.7 * 0.6 * 4.9, 0.7 * 0.6 * 4.9]
    assert [member.volume_m3 for member in members] == pytest.approx(volumes, rel=1e-12)
    assert all(is_closed(member.solid) for member in members)


def test_places_of_the_members():
    bounds = bounds_of(BRIDGE)
    positions = {
        "deck": [[-0.5, -4.25, 5.3], [13.5, 4.25, 5.55]],
        "pier 2 cap": [[12.6, -4.0, 4.9], [13.4, 4.0, 5.3]],
        # Two columns share the cap's 8 m: their middles are 2 m to either side.
        "pier 1 column 1": [[-0.35, -2.3, 0.0], [0.35, -1.7, 4.9]],
        "pier 1 column 2": [[-0.35, 1.7, 0.0], [0.35, 2.3, 4.9]],
    }
    for name, position in positions.items():
        np.testing.assert_allclose(bounds[name], position, atol=ROUNDING_M, err_msg=name)


def test_without_caps_columns_share_the_width_of_the_deck():
    bounds = bounds_of(WITHOUT_CAPS)
    assert list(bounds) == ["deck"] + [f"pier {pier} column {column}" for pier in (1, 2, 3) for column in (1, 2)]
    np.testing.assert_allclose(bounds["deck"], [[-0.5, -4.25, 4.9], [24.0, 4.25, 5.15]], atol=ROUNDING_M)
    np.testing.assert_allclose(bounds["pier 2 column 2"].mean(axis=0), [13.0, 2.125, 2.45], atol=ROUNDING_M)


def test_a_single_column_stands_in_the_middle_and_has_the_name_of_its_pier():
    bounds = bounds_of(replace(WITHOUT_CAPS, piers=replace(PIERS, columns=1)))
    assert list(bounds) == ["deck", "pier 1", "pier 2", "pier 3"]
    np.testing.assert_allclose(bounds["pier 3"].mean(axis=0), [23.5, 0.0, 2.45], atol=ROUNDING_M)


@pytest.mark.parametrize("bridge", [BRIDGE, TWO_SPANS, WITHOUT_CAPS])
def test_members_touch_without_overlap(bridge):
    members = bridge_members(bridge)
    whole = union([member.solid for member in members])
    # What two members had in common would be missing from the union.
    assert whole.volume == pytest.approx(sum(member.volume_m3 for member in members), rel=1e-9)
    # Members that stood apart would remain bodies of their own.
    assert len(bodies(to_manifold(whole))) == 1


def test_density_is_the_given_one_or_follows_from_the_mass():
    members = bridge_members(BRIDGE)
    # Deck 29.75, two caps 5.12 and four columns 8.232 m³.
    assert bridge_density(BRIDGE, members) == pytest.approx(107_000 / 43.102, rel=1e-12)
    given = replace(BRIDGE, mass_kg=None, density_kg_m3=2500)
    assert bridge_density(given, bridge_members(given)) == 2500.0
