# SPDX-License-Identifier: GPL-3.0-or-later
"""A cut through a member carries what all its faces carry, however the load is shared among them."""

import numpy as np
import pytest
from reference.overloads import cut_sections as sections_of_cuts

from bridge_demolition_addon.engineering.mechanics.overloads import Overloads
from bridge_demolition_addon.engineering.mechanics.section_cuts import (
    ConnectedFaces,
    ConnectionLoads,
    SectionCuts,
    section_axes,
    worst_around,
)
from bridge_demolition_addon.engineering.mechanics.strength import Strength, rectangular_sections, utilisation

NORMALS = np.tile([1.0, 0.0, 0.0], (3, 1))
IS_SHARD = np.array([False, True, True, True, True])

# A wall (body 0) holds shard 1 by one face of 1 m × 0.4 m. To its right are shards 2, 3 and 4, one above the other,
# with faces of 0.1, 0.7 and 0.2 m of that height.
PAIRS = np.array([(0, 1), (1, 2), (1, 3), (4, 1)])
HEIGHTS = np.array([1.0, 0.1, 0.7, 0.2])
MIDDLES = np.array([0.5, 0.05, 0.45, 0.9])
WIDTH = 0.4
AREAS = WIDTH * HEIGHTS
POINTS = np.column_stack((np.array([0.0, 1.0, 1.0, 1.0]), np.zeros(4), MIDDLES))
DIRECTIONS = np.array([(1.0, 0, 0), (1.0, 0, 0), (1.0, 0, 0), (-1.0, 0, 0)])
SECOND_MOMENTS = np.zeros((4, 2, 2))
SECOND_MOMENTS[:, 0, 0] = WIDTH * HEIGHTS**3 / 12.0
SECOND_MOMENTS[:, 1, 1] = WIDTH**3 * HEIGHTS / 12.0
FACES = ConnectedFaces(PAIRS, POINTS, DIRECTIONS, AREAS, SECOND_MOMENTS)
INTACT = np.ones(4, bool)


def cut_sections(rows, forces, moments, intact=INTACT):
    cuts = SectionCuts.through(FACES, IS_SHARD)
    rows = np.array(rows)
    axes = section_axes(DIRECTIONS[rows])
    return sections_of_cuts(cuts, rows, intact, ConnectionLoads(forces, moments, POINTS), axes)


def test_faces_of_one_side_make_the_whole_section():
    zero = np.zeros((4, 3))
    _, areas, moments = cut_sections([1, 2], zero, zero)
    assert areas == pytest.approx([0.4, 0.4, AREAS[1], AREAS[2]])  # through shard 1: all three; beyond: one each
    whole = np.diag([WIDTH / 12.0, WIDTH**3 / 12.0])
    np.testing.assert_allclose(moments[:2], [whole, whole], atol=1e-15)
    np.testing.assert_allclose(moments[2:], SECOND_MOMENTS[1:3])


@pytest.mark.parametrize("shares", [(0.1, 0.7, 0.2), (1 / 3, 1 / 3, 1 / 3), (1.0, 0.0, 0.0)])
def test_load_is_that_of_the_section_however_it_is_shared(shares):
    # A beam whose right-hand end is pulled with 90 kN along x and pressed down with 60 kN, 2 m from the cut.
    force, lever = np.array([90e3, 0.0, -60e3]), np.array([2.0, 0.0, 0.0])
    middle = np.array([1.0, 0.0, 0.5])
    forces, moments = np.zeros((4, 3)), np.zeros((4, 3))
    for row, share in zip((1, 2, 3), shares, strict=True):
        forces[row] = share * force
        moments[row] = share * (np.cross(lever, force) + np.cross(middle - POINTS[row], force))
    forces[3], moments[3] = -forces[3], -moments[3]  # its first body is the one beyond the cut
    loads, areas, second_moments = cut_sections([1, 2], forces, moments)
    assert loads.axial_n[:2] == pytest.approx(90e3)
    assert loads.shear_n[:2] == pytest.approx(np.tile([0.0, -60e3], (2, 1)))
    assert loads.bending_nm[:2] == pytest.approx(np.tile([120e3, 0.0], (2, 1)))
    strength = Strength.in_n_mm2(compression=1e9, tension=10.0, shear=1e9, torsion=1e9, bending=10.0)
    used = utilisation(loads, rectangular_sections(areas, second_moments), strength)
    # By hand: N/A + M/W with W = b h² / 6.
    assert used[0] == pytest.approx((90e3 / 0.4 + 120e3 / (WIDTH / 6.0)) / 10e6, rel=1e-6)
    judged = Overloads(FACES, IS_SHARD, strength, None)
    of_all, axes = ConnectionLoads(forces, moments, POINTS), section_axes(DIRECTIONS[1:3])
    # Beyond the cut each shard has one face, with its own load: the mean of both cuts counts.
    assert judged.in_cuts(np.array([1, 2]), of_all, axes, INTACT) == pytest.approx((used[:2] + used[2:]) / 2.0)


def test_a_broken_face_is_in_no_cut():
    zero = np.zeros((4, 3))
    _, areas, _ = cut_sections([1], zero, zero, intact=np.array([True, True, False, True]))
    assert areas[0] == pytest.approx(AREAS[1] + AREAS[3])


def test_what_a_broken_face_carried_is_in_no_cut():
    # An even pull of 2 MPa on all faces; the shards beyond the cut have one face each.
    forces = 2e6 * AREAS[:, None] * DIRECTIONS
    strength = Strength.in_n_mm2(compression=1e9, tension=4.0, shear=1e9, torsion=1e9, bending=1e9)
    judged = Overloads(FACES, IS_SHARD, strength, None)
    of_all, axes = ConnectionLoads(forces, np.zeros((4, 3)), POINTS), section_axes(DIRECTIONS[1:2])
    for intact in (INTACT, np.array([True, True, False, True])):
        assert judged.in_cuts(np.array([1]), of_all, axes, intact) == pytest.approx(0.5, rel=1e-6)
    forces[2] *= 1e3
    assert judged.in_cuts(np.array([1]), of_all, axes, intact) == pytest.approx(0.5, rel=1e-6)


def test_through_what_is_no_shard_goes_one_face():
    zero = np.zeros((4, 3))
    _, areas, _ = cut_sections([0], zero, zero)
    assert areas == pytest.approx([AREAS[0], AREAS[0]])  # the wall; and shard 1, whose other faces look the other way


def test_slanted_faces_count_with_what_they_show():
    pairs = np.array([(0, 1), (0, 2), (0, 3)])
    slanted = np.array([(1.0, 0, 0), (0.6, 0.8, 0), (0.0, 1.0, 0)])
    zero = np.zeros((3, 3))
    cuts = SectionCuts.through(ConnectedFaces(pairs, zero, slanted, np.ones(3), np.zeros((3, 2, 2))), np.ones(4, bool))
    row = np.array([0])
    _, areas, _ = sections_of_cuts(
        cuts, row, np.ones(3, bool), ConnectionLoads(zero, zero, zero), section_axes(slanted[:1])
    )
    assert areas.tolist() == [1.6, 1.0]


def test_no_rows_and_no_connections():
    loads, areas, moments = cut_sections(np.zeros(0, int), np.zeros((4, 3)), np.zeros((4, 3)))
    assert len(areas) == len(moments) == len(loads.axial_n) == 0
    none = np.zeros((0, 3))
    no_faces = ConnectedFaces(np.zeros((0, 2), int), none, none, np.zeros(0), np.zeros((0, 2, 2)))
    empty = SectionCuts.through(no_faces, np.ones(2, bool))
    assert empty.starts.tolist() == [0]


def test_the_worst_around_each_shard_is_found():
    pairs = np.array([(1, 2), (2, 3), (3, 4), (0, 4), (0, 1)])
    is_shard = np.array([False, True, True, True, True])
    # 3-4 is the worst of both its shards; 1-2 of both of its, as 2-3 uses less; ground joints compete over no ground.
    assert worst_around(pairs, np.array([5.0, 4.0, 9.0, 1.0, 2.0]), is_shard).tolist() == [
        True,
        False,
        True,
        False,
        False,
    ]
    assert worst_around(pairs[3:], np.array([1.0, 2.0]), is_shard).tolist() == [True, True]
