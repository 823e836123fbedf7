# SPDX-License-Identifier: GPL-3.0-or-later
"""Where solids lie on each other: areas, middles and axes of boxes by hand."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.geometry.level_contacts import level_contacts
from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh
from bridge_demolition_addon.engineering.geometry.solids import box, union

DECK = box((26.0, 3.0, 0.7), (12.5, 0.0, 1.35))  # its underside at 1 m


def test_a_deck_lies_on_a_cap_where_both_are():
    """A cap 1.2 m long and 4 m wide around x = 25.2 m: of it, 0.9 by 3 m are under the deck, which ends at 25.5 m."""
    (contact,) = level_contacts(DECK, box((1.2, 4.0, 1.0), (25.2, 0.0, 0.5)))
    assert contact.area_m2 == pytest.approx(0.9 * 3.0)
    assert contact.middle_m == pytest.approx([25.05, 0.0], abs=1e-6)
    assert contact.axis_chords(0.0) == pytest.approx(np.array([[-1.5, 1.5]]))
    assert contact.at(np.array([0.0, 1.0]), np.array([0.0, 0.2])) == pytest.approx(
        np.array([[25.05, 0.0, 1.0], [25.25, 1.0, 1.0]]), abs=1e-6
    )


def test_blocks_on_a_cap_are_areas_of_their_own():
    blocks = [box((0.4, 0.6, 0.1), (10.0, y, 0.95)) for y in (1.0, -1.0)]
    contacts = level_contacts(DECK, union([box((1.2, 4.0, 0.9), (10.0, 0.0, 0.45)), *blocks]))
    assert [contact.middle_m.tolist() for contact in contacts] == [
        pytest.approx([10.0, -1.0]),
        pytest.approx([10.0, 1.0]),
    ]
    assert [contact.area_m2 for contact in contacts] == pytest.approx([0.24, 0.24])


def test_the_axis_of_a_skewed_cap_follows_it():
    """Each metre across, the cap lies half a metre further along: so do the middles of the area."""
    straight = box((1.2, 4.0, 1.0), (10.0, 0.0, 0.5))
    sheared = straight.vertices + 0.5 * straight.vertices[:, 1:2] * (1.0, 0.0, 0.0)
    (contact,) = level_contacts(DECK, TriangleMesh(sheared, straight.triangles))
    assert contact.skew == pytest.approx(0.5)
    assert contact.axis_chords(0.0) == pytest.approx(1.5 * np.sqrt(1.25) * np.array([[-1.0, 1.0]]))


def test_an_area_with_a_gap_has_an_axis_in_parts():
    cap = union([box((0.3, 4.0, 1.0), (9.5, 0.0, 0.5)), box((1.3, 0.5, 1.0), (10.0, 1.25, 0.5))])
    cap = union([cap, box((1.3, 0.5, 1.0), (10.0, -1.25, 0.5))])
    (contact,) = level_contacts(DECK, cap)
    across = 10.3 - contact.middle_m[0]
    assert contact.axis_chords(across) == pytest.approx(np.array([[-1.5, -1.0], [1.0, 1.5]]))


def test_heights_follow_an_inclined_underside():
    lower, upper = (box((4.0, 2.0, 1.0), (0.0, 0.0, z)) for z in (0.5, 1.5))
    lower, upper = (
        TriangleMesh(solid.vertices + 0.1 * solid.vertices[:, :1] * (0.0, 0.0, 1.0), solid.triangles)
        for solid in (lower, upper)
    )
    (contact,) = level_contacts(upper, lower)
    assert contact.at(np.zeros(1), np.array([1.0]))[0] == pytest.approx([1.0, 0.0, 1.1], abs=1e-6)
    normal, offset_m = contact.plane
    assert normal == pytest.approx(np.array([-0.1, 0.0, 1.0]) / np.sqrt(1.01))
    assert offset_m == pytest.approx(1.0 / np.sqrt(1.01))


@pytest.mark.parametrize("centre_m", [(10.0, 0.0, 0.4), (26.2, 0.0, 0.5), (10.0, 0.0, 1.35)])
def test_what_is_apart_beside_or_above_carries_nothing(centre_m):
    assert level_contacts(DECK, box((1.2, 3.0, 1.0), centre_m)) == []


def test_it_lies_on_what_is_below_alone():
    assert level_contacts(box((1.2, 3.0, 1.0), (10.0, 0.0, 0.5)), DECK) == []
