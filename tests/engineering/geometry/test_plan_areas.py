# SPDX-License-Identifier: GPL-3.0-or-later
"""Areas in plan, against areas and distances of squares."""

import numpy as np
import pytest
from manifold3d import CrossSection

from bridge_demolition_addon.engineering.geometry import plan_areas
from bridge_demolition_addon.engineering.geometry.plan_areas import distances_outside, united, without_gaps

SQUARE = CrossSection.square((1.0, 1.0))


@pytest.mark.parametrize("count", [0, 1, 7, 8, 9, 100])
def test_any_number_of_areas_is_united(count):
    row = [SQUARE.translate((0.5 * number, 0.0)) for number in range(count)]
    shuffled = [row[position] for position in np.random.default_rng(1).permutation(count)]
    assert united(shuffled).area() == pytest.approx(0.5 * (count + 1) if count else 0.0)


def test_many_points_are_measured_as_single_ones(monkeypatch):
    area = SQUARE - SQUARE.scale((0.5, 0.5)).translate((0.25, 0.25)) + SQUARE.translate((3.0, 0.0))
    points = np.random.default_rng(1).uniform(-1.0, 5.0, (200, 2))
    singly = [distances_outside(area, point[None])[0] for point in points]
    monkeypatch.setattr(plan_areas, "PAIRS_PER_BLOCK", 70)
    assert distances_outside(area, points).tolist() == singly
    x, y = abs(points - 0.5).T
    alone = points[:, 0] < 1.75  # nearer to the first square, whose hole is 0.25 from its sides
    expected = np.where(np.maximum(x, y) > 0.5, np.hypot(np.maximum(x - 0.5, 0), np.maximum(y - 0.5, 0)), 0.0)
    in_hole = np.maximum(x, y) < 0.25
    expected[in_hole] = 0.25 - np.maximum(x, y)[in_hole]
    assert np.array(singly)[alone] == pytest.approx(expected[alone])


def test_gaps_are_closed_where_they_are_narrower_and_nothing_is_lost():
    near, far = SQUARE + SQUARE.translate((1.5, 0.0)), SQUARE + SQUARE.translate((2.5, 0.0))
    closed = without_gaps(near, 1.0)
    assert closed.num_contour() == 1
    assert 2.0 < closed.area() <= 2.5 + 1e-6  # rounded where it was closed
    assert (near - closed).area() == pytest.approx(0.0, abs=1e-9)
    assert without_gaps(far, 1.0).area() == pytest.approx(2.0, abs=1e-3)
    assert without_gaps(far, 1.0).num_contour() == 2
    assert without_gaps(CrossSection(), 1.0).is_empty()


@pytest.mark.parametrize("lost", [(np.nan, 1.0), (1.0, np.nan), (np.inf, 0.0), (9.0, -np.inf)])
def test_points_that_are_lost_are_not_near(lost):
    with np.errstate(invalid="ignore"):
        found = distances_outside(SQUARE, np.array([lost, (9.0, 0.0)]))
    assert not np.isfinite(found[0]) and found[1] == 8.0


def test_points_level_with_corners_and_on_sides():
    diamond = CrossSection([np.array([(0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)])])
    points = np.array([(-2.0, 0.0), (0.5, 0.0), (1.0, 0.0), (2.0, 0.0), (-1.0, 1.0), (0.0, 3.0), (0.5, 0.5)])
    assert distances_outside(diamond, points) == pytest.approx([1.0, 0.0, 0.0, 1.0, np.sqrt(0.5), 2.0, 0.0])
    assert distances_outside(diamond, np.zeros((0, 2))).shape == (0,)
