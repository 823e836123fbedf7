# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids cut across an axis: nothing is lost, and every piece ends at the planes."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.fracture.slabs import slab_between, slabs
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


def test_a_slab_of_a_round_column():
    slab = slab_between(cylinder(0.5, 6.0, 64), 2, 1.0, 2.0)
    # A polygon of 64 sides: 32 sin(2π / 64) r².
    assert slab.volume == pytest.approx(32.0 * np.sin(2.0 * np.pi / 64.0) * 0.25)
    assert slab.bounds[:, 2] == pytest.approx([1.0, 2.0])
