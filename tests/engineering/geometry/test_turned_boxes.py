# SPDX-License-Identifier: GPL-3.0-or-later
"""Turned boxes lie in each other where their solids have a volume in common, by the boolean engine."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from bridge_demolition_addon.engineering.geometry.solids import hull
from bridge_demolition_addon.engineering.geometry.turned_boxes import TurnedBoxes, lie_in_each_other

CORNERS = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
COUNT = 200


def boxes(seed):
    rng = np.random.default_rng(seed)
    turns = Rotation.from_euler("xyz", rng.uniform(0.0, 2.0 * np.pi, (COUNT, 3))).as_matrix()
    return TurnedBoxes(rng.uniform(-1.0, 1.0, (COUNT, 3)), turns, rng.uniform(0.05, 1.0, (COUNT, 3)))


def solid(of, row):
    return hull(of.middles_m[row] + (CORNERS * of.halves_m[row]) @ of.axes[row].T)


@pytest.mark.parametrize("seed", range(3))
def test_they_lie_in_each_other_where_they_have_a_volume_in_common(seed):
    first, second = boxes(seed), boxes(seed + 100)
    common = [(solid(first, row) ^ solid(second, row)).volume() > 0.0 for row in range(COUNT)]
    assert 20 < sum(common) < COUNT - 20
    assert lie_in_each_other(first, second).tolist() == common


def test_parallel_boxes_are_apart_by_their_faces():
    """Edges of both are parallel, so that their cross products say nothing."""
    middles = np.array([(0.0, 0.0, 0.0)] * 2)
    first = TurnedBoxes(middles, np.tile(np.eye(3), (2, 1, 1)), np.full((2, 3), 0.5))
    second = TurnedBoxes(middles + np.array([(0.99, 0.0, 0.0), (1.01, 0.0, 0.0)]), first.axes, first.halves_m)
    assert lie_in_each_other(first, second).tolist() == [True, False]


def test_crossed_bars_are_apart_by_a_plane_along_an_edge_of_both():
    """Two thin bars cross at a right angle, each turned by 45° about itself, so that edges are closest."""
    along_x = Rotation.from_euler("x", 45, degrees=True).as_matrix()[None]
    along_y = Rotation.from_euler("y", 45, degrees=True).as_matrix()[None]
    thin_x, thin_y = np.array([(2.0, 0.1, 0.1)]), np.array([(0.1, 2.0, 0.1)])
    for gap_m, meet in ((0.28, True), (0.29, False)):  # 2 × 0.1 √2 is 0.283
        first = TurnedBoxes(np.zeros((1, 3)), along_x, thin_x)
        second = TurnedBoxes(np.array([(0.0, 0.0, gap_m)]), along_y, thin_y)
        assert lie_in_each_other(first, second).tolist() == [meet]
