# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes of members, and by what part of their faces shards resist turning, against sums done by hand."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.elasticity.interfaces import shares_of_length, slips_by_stretching
from bridge_demolition_addon.engineering.elasticity.member_shapes import (
    member_shapes,
    moderate_second_moments,
    principal_moments,
    turning_inertias,
    turning_levers,
)
from bridge_demolition_addon.engineering.geometry.solids import box

BEAM = box((12.0, 0.4, 0.9))


def inertia(sides_m):
    """∫ r rᵀ dA of a rectangle with sides along the axes of the world, one of them 0."""
    area = np.prod([side for side in sides_m if side > 0.0])
    return np.diag(area * np.square(sides_m) / 12.0)


def test_the_shape_of_a_box_is_its_sides_along_its_axes():
    shapes = member_shapes([BEAM])
    assert shapes.extents_m[0] == pytest.approx([0.4, 0.9, 12.0])
    assert abs(shapes.axes[0]) == pytest.approx(np.eye(3)[:, [1, 2, 0]])


def test_a_face_across_a_beam_resists_bending_with_all_of_its_second_moments():
    shapes = member_shapes([BEAM])
    turning = turning_inertias(shapes, inertia((0.0, 0.4, 0.9))[None], np.array([(1.0, 0.0, 0.0)]), np.full(1, 0.4))
    area = 0.4 * 0.9
    assert turning[0, 1, 1] == pytest.approx(area * 0.9**2 / 12.0)
    assert turning[0, 2, 2] == pytest.approx(area * 0.4**2 / 12.0)


def test_the_slope_of_an_inclined_face_does_not_resist_bending():
    """At 45° the face of a beam that is 0.9 m deep is 1.27 m long, and resists with the 0.9 m that it is deep."""
    side, root = 0.9 * np.sqrt(2.0), np.sqrt(0.5)
    along = np.array((root, 0.0, root))
    area = 0.4 * side
    face = area * side**2 / 12.0 * np.outer(along, along) + area * 0.4**2 / 12.0 * np.diag((0.0, 1.0, 0.0))
    normal = np.array([(root, 0.0, -root)])
    turning = turning_inertias(member_shapes([BEAM]), face[None], normal, np.full(1, 0.4))
    assert turning[0, 1, 1] == pytest.approx(area * 0.9**2 / 12.0)


def test_slivers_resist_turning_as_faces_of_a_moderate_slenderness():
    short, long = 0.01 / 12.0, 1.0 / 12.0  # of sides 0.1 m and 1 m, over the area
    turned = np.array([[0.8, -0.6], [0.6, 0.8]])
    moments = turned @ np.diag((short, long)) @ turned.T
    smaller, larger = principal_moments(moderate_second_moments(moments[None]))
    assert (smaller[0], larger[0]) == pytest.approx((short, 16.0 * short))
    stocky = np.diag((short, 9.0 * short))[None]
    assert moderate_second_moments(stocky) == pytest.approx(stocky)


def test_levers_are_as_long_as_given_at_most():
    """Half a metre along a beam, a turn about y shifts up by half a metre, and one about z aside."""
    shapes, normals = member_shapes([BEAM]), np.array([(1.0, 0.0, 0.0)])
    for longest, lever in ((1.0, 0.5), (0.2, 0.2)):
        levers = turning_levers(shapes, np.array([(0.5, 0.0, 0.0)]), normals, np.full(1, longest))
        shift = levers[0] @ np.eye(3)
        # ω × r of r along x: about y it goes down, about z to the left.
        assert shift[:, 1] == pytest.approx([0.0, 0.0, -lever])
        assert shift[:, 2] == pytest.approx([0.0, lever, 0.0])


def test_a_face_of_a_long_interface_turns_by_its_share_of_the_length():
    # Ten faces of 1.6 m along 16 m, members 0.4 m thick together: 1.6 m count. Across, 0.4 m, the interface is short.
    points = np.column_stack((0.8 + 1.6 * np.arange(10), np.zeros(10), np.zeros(10)))
    in_plane = np.broadcast_to(np.array([(1.0, 0.0), (0.0, 1.0), (0.0, 0.0)]), (10, 3, 2))
    sides = np.tile((1.6, 0.4), (10, 1))
    shares = shares_of_length(points, in_plane, sides, 0.4)
    assert shares == pytest.approx(np.tile((0.1, 1.0), (10, 1)))
    thick = shares_of_length(points, in_plane, sides, 2.0)
    assert thick == pytest.approx(np.tile((6.0 / 16.0, 1.0), (10, 1)))
    assert shares_of_length(points[:1], in_plane[:1], sides[:1], 0.4) == pytest.approx(np.ones((1, 2)))
    slips = slips_by_stretching(shares, sides, np.full(10, 30e9), np.full(10, 0.64), np.full(10, 0.5))
    assert slips[:, 0] == pytest.approx(np.full(10, 0.9 * 1.6**2 / (30e9 * 0.64 * 0.5)))
    assert not slips[:, 1].any()
