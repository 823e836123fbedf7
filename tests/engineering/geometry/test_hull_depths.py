# SPDX-License-Identifier: GPL-3.0-or-later
"""How deep hulls lie in each other, by the boolean engine and by hand."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from bridge_demolition_addon.engineering.geometry.hulls import ConvexBody, convex_body, depth_m
from bridge_demolition_addon.engineering.geometry.solids import hull

pytestmark = pytest.mark.slow

CUBE_M = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
COUNT = 200


def placed(points_m, turn_deg=(0.0, 0.0, 0.0), position_m=(0.0, 0.0, 0.0)) -> ConvexBody:
    turn = Rotation.from_euler("xyz", turn_deg, degrees=True).as_matrix()
    return convex_body(points_m).placed(turn, np.array(position_m))


def test_a_cube_has_to_go_as_far_as_it_lies_in_the_other():
    for gap_m in (-0.3, -0.02, 0.0, 0.4):
        assert depth_m(placed(CUBE_M), placed(CUBE_M, position_m=(0.1, 1.0 + gap_m, 0.0))) == pytest.approx(-gap_m)


def test_a_corner_lies_in_a_face_by_half_the_diagonal():
    tip = placed(CUBE_M, turn_deg=(0.0, 0.0, 45.0), position_m=(1.2, 0.0, 0.0))
    assert depth_m(placed(CUBE_M), tip) == pytest.approx(0.5 + math.sqrt(0.5) - 1.2)
    assert depth_m(tip, placed(CUBE_M)) == depth_m(placed(CUBE_M), tip)


@pytest.mark.parametrize("seed", range(3))
def test_random_bodies_lie_in_each_other_where_they_have_a_volume_in_common(seed):
    rng = np.random.default_rng(seed)
    common, deep = [], []
    for _ in range(COUNT):
        points = [rng.uniform(-1.0, 1.0, (12, 3)), rng.uniform(-1.0, 1.0, (12, 3)) + rng.uniform(-1.2, 1.2, 3)]
        common.append((hull(points[0]) ^ hull(points[1])).volume() > 0.0)
        deep.append(depth_m(*map(convex_body, points)) > 0.0)
    assert deep == common
    assert 20 < sum(common) < COUNT - 20


@pytest.mark.parametrize(("gap_m", "deep"), [(0.28, True), (0.29, False)])
def test_bars_that_cross_are_apart_by_a_plane_along_an_edge_of_both(gap_m, deep):
    """Each is turned by 45° about itself, so that its edge is half its diagonal, 0.1 √2, from its axis."""
    thin_m = CUBE_M * (4.0, 0.2, 0.2)
    along_x = placed(thin_m, turn_deg=(45.0, 0.0, 0.0))
    along_y = placed(thin_m[:, [1, 0, 2]], turn_deg=(0.0, 45.0, 0.0), position_m=(0.0, 0.0, gap_m))
    assert depth_m(along_x, along_y) == pytest.approx(0.2 * math.sqrt(2.0) - gap_m)
    assert (depth_m(along_x, along_y) > 0.0) is deep
