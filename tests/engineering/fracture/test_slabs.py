# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids cut by planes: nothing is lost, and every piece ends at the planes."""

import math

import numpy as np
import pytest

from bridge_demolition_addon.engineering.fracture.slabs import cut_out, cut_through, slab_between, slabs
from bridge_demolition_addon.engineering.geometry.solids import box, cylinder, difference
from bridge_demolition_addon.engineering.geometry.turned_boxes import TurnedBox


def test_a_column_between_two_planes():
    low, middle, high = slabs(box([0.7, 0.7, 4.0], [1.0, 2.0, 2.0]), 2, [1.0, 2.5])
    assert [piece.volume for piece in (low, middle, high)] == pytest.approx([0.49, 0.735, 0.735])
    assert middle.bounds[:, 2] == pytest.approx([1.0, 2.5])


def test_planes_at_its_ends_and_beyond_cut_nothing():
    (whole,) = slabs(box([0.7, 0.7, 4.0], [0.0, 0.0, 2.0]), 2, [0.0, 4.0, 9.0])
    assert whole.volume == pytest.approx(1.96)


def test_pieces_that_hang_together_no_more_are_parts_of_their_own():
    """A portal of two legs and a beam, cut below the beam: two legs, and the beam."""
    portal = difference(box([4.0, 1.0, 4.0]), [box([2.0, 2.0, 3.0], [0.0, 0.0, -0.5])])
    pieces = slabs(portal, 2, [0.5])
    assert sorted(piece.volume for piece in pieces) == pytest.approx([2.5, 2.5, 5.0])


DECK = box([12.0, 4.0, 0.5])


def test_a_slanting_plane_halves_a_deck_and_a_thin_slice_stays_with_it():
    slanting = np.array([3.0, 4.0, 0.0])
    behind, before = cut_through(DECK, np.array([1.5, 0.0, 0.0]), slanting)
    # The plane lies across the deck at x = 1.5 m in its middle, and halves what slants: 7.5 m and 4.5 m of 12 m.
    assert (behind.volume, before.volume) == pytest.approx((7.5 * 2.0, 4.5 * 2.0))
    assert behind.vertices.mean(axis=0) @ slanting < 4.5 < before.vertices.mean(axis=0) @ slanting
    for y, pieces in (
        (1.995, 1),
        (2.0, 1),
        (3.0, 1),
        (1.985, 2),
    ):  # its edge is at 2 m
        assert len(cut_through(DECK, np.array([0.0, y, 0.0]), np.array([0.0, -2.0, 0.0]))) == pieces


def test_a_plane_cuts_only_what_it_meets_in_its_box():
    across = np.array([1.0, 0.0, 0.0])
    for low, high, pieces in (
        ([-9.0, -9.0, -9.0], [9.0, 9.0, 9.0], 2),
        ([0.998, -9.0, -9.0], [1.002, 9.0, 9.0], 2),  # the kerf of a saw
        ([2.0, -9.0, -9.0], [3.0, 9.0, 9.0], 1),  # the plane lies beside it
        ([0.0, -9.0, -9.0], [2.0, 9.0, -0.25], 1),  # it ends where the deck begins
    ):
        assert len(cut_through(DECK, np.array([1.0, 0.0, 0.0]), across, TurnedBox(tuple(low), tuple(high)))) == pieces


@pytest.mark.parametrize("skew_deg", [-60.0, -20.0, 0.0, 15.0, 45.0, 90.0])
def test_a_turned_box_takes_what_lies_between_its_sides(skew_deg):
    """A strip of 1 m across a deck of 4 by 0.5 m: a parallelogram of 1 m over the cosine of its skew."""
    strip = TurnedBox((-0.5, -30.0, -9.0), (0.5, 30.0, 9.0), skew_deg)
    *around, inside = cut_out(DECK, strip)
    within = 1.0 / math.cos(math.radians(skew_deg)) if abs(skew_deg) < 90.0 else 12.0 / 4.0
    assert inside.volume == pytest.approx(within * 4.0 * 0.5, rel=1e-12)
    assert sum(piece.volume for piece in (*around, inside)) == pytest.approx(12.0 * 4.0 * 0.5, rel=1e-12)
    left = inside.vertices[inside.vertices[:, 1] > 1.99]
    # Its end towards positive y lies further along the road.
    if abs(skew_deg) < 90.0:
        assert left[:, 0].mean() == pytest.approx(2.0 * math.tan(math.radians(skew_deg)), abs=1e-9)


def test_a_turned_box_has_the_points_that_lie_in_it():
    turned = TurnedBox((9.0, -1.0, 0.0), (11.0, 1.0, 2.0), 45.0)
    points = np.array([[10.0, 1.3, 1.0], [10.9, 0.9, 1.0], [10.0, 0.0, 2.1], [8.7, 0.0, 0.0]])
    assert turned.contains(points).tolist() == [True, False, False, True]


def test_a_slab_of_a_round_column():
    slab = slab_between(cylinder(0.5, 6.0, 64), 2, 1.0, 2.0)
    # A polygon of 64 sides: 32 sin(2π / 64) r².
    assert slab.volume == pytest.approx(32.0 * np.sin(2.0 * np.pi / 64.0) * 0.25)
    assert slab.bounds[:, 2] == pytest.approx([1.0, 2.0])
