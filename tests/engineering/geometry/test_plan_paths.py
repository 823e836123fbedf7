# SPDX-License-Identifier: GPL-3.0-or-later
"""Paths of corners in plan are straight between the steps that are found."""

from itertools import pairwise

import numpy as np
import pytest

from bridge_demolition_addon.engineering.geometry.plan_areas import (
    bends_and_moves,
    ends_of_straight_parts,
    path_of_corners,
)
from bridge_demolition_addon.engineering.geometry.vectors import rotated

OFF_M = 0.05


def fall(steps, seed):
    """Corners that fly, tremble a little, and lie still."""
    rng = np.random.default_rng(seed)
    way = np.cumsum(rng.normal(scale=0.3, size=(steps, 1, 2)) * (rng.uniform(size=(steps, 1, 1)) < 0.2), axis=0)
    plans = way + np.linspace(0.0, 3.0, steps)[:, None, None] + rng.normal(scale=1e-3, size=(steps, 9, 2))
    plans[2 * steps // 3 :] = plans[2 * steps // 3]
    return plans


@pytest.mark.parametrize("steps", [1, 2, 3, 80])
@pytest.mark.parametrize("seed", range(5))
def test_corners_stay_beside_the_straight_parts(steps, seed):
    plans = fall(steps, seed)
    ends = ends_of_straight_parts(plans, OFF_M)
    assert ends[0] == 0 and ends[-1] == steps - 1
    for start, end in pairwise(ends):
        part = plans[start : end + 1]
        shares = np.linspace(0.0, 1.0, len(part))[:, None, None]
        of_chord = abs(part - (part[0] + shares * (part[-1] - part[0]))).max()
        assert min(of_chord, abs(part[:-1] - part[0]).max(initial=0.0)) <= OFF_M + 1e-12
    assert steps < 80 or 2 < len(ends) < steps


def test_bends_and_moves_by_hand():
    plans = np.array([(0.0, 0.0), (1.0, 0.0), (2.0, -3.0), (2.0, -3.0)])[:, None]
    bends, moves = bends_and_moves(plans)
    assert moves.tolist() == [1.0, 3.0, 0.0, 0.0]
    assert bends.tolist() == [0.0, 3.0, 3.0, 0.0]


def test_corners_turn_and_move_with_their_body():
    rng = np.random.default_rng(4)
    turns = rotated(np.tile(np.eye(3), (60, 1, 1)), rng.normal(size=(60, 3)))
    positions, corners = rng.normal(scale=50.0, size=(60, 3)), rng.normal(size=(14, 3))
    expected = (corners @ turns.transpose(0, 2, 1) + positions[:, None])[..., :2]
    np.testing.assert_allclose(path_of_corners(turns, positions, corners), expected, rtol=0.0, atol=1e-12)
