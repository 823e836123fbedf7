# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids cut by planes: nothing is lost, and every piece ends at the planes."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.fracture.slabs import cut_through, slab_between, slabs
from bridge_demolition_addon.engineering.geometry.solids import box, cylinder, difference


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
        assert len(cut_through(DECK, np.array([1.0, 0.0, 0.0]), across, np.array([low, high]))) == pieces


def test_a_slab_of_a_round_column():
    slab = slab_between(cylinder(0.5, 6.0, 64), 2, 1.0, 2.0)
    # A polygon of 64 sides: 32 sin(2π / 64) r².
    assert slab.volume == pytest.approx(32.0 * np.sin(2.0 * np.pi / 64.0) * 0.25)
    assert slab.bounds[:, 2] == pytest.approx([1.0, 2.0])
