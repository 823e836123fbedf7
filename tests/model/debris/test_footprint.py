# SPDX-License-Identifier: GPL-3.0-or-later
"""Footprints of shapes whose areas are known, and distances from them."""

import numpy as np
import pytest
from support.moving_boxes import moving_boxes, turned_about_z

from bridge_demolition_addon.engineering.geometry.plan_areas import distances_outside, outlines, united
from bridge_demolition_addon.model.debris.footprint import footprint, swept_footprint

# Areas are cut to a hundred-millionth of a metre.
ROUNDING = 1e-6


def standing(*boxes):
    """Boxes at rest, each by size and place."""
    sizes, positions = zip(*boxes, strict=True)
    return moving_boxes([0.0], sizes, [positions])


def test_a_box_covers_its_base():
    area = footprint(standing(((4, 3, 2), (10, 20, 5))), [0], 0)
    assert area.area() == pytest.approx(12.0, abs=ROUNDING)
    assert area.bounds() == pytest.approx((8.0, 18.5, 12.0, 21.5), abs=ROUNDING)


def test_what_overlaps_counts_once_and_what_lies_apart_twice():
    results = standing(((2, 2, 1), (0, 0, 0)), ((2, 2, 1), (1, 0, 5)), ((1, 1, 1), (10, 0, 0)))
    # Two squares of 2 m that share half, and one of 1 m apart.
    assert footprint(results, [0, 1, 2], 0).area() == pytest.approx(6.0 + 1.0, abs=ROUNDING)
    assert len(outlines(footprint(results, [0, 1, 2], 0))) == 2


def test_a_box_on_edge_covers_more():
    # Turned by 45° about y, a cube of 1 m is √2 m long in plan.
    turn = np.array([[[[1, 0, 1], [0, 2**0.5, 0], [-1, 0, 1]]]]) / 2**0.5
    results = moving_boxes([0.0], [(1, 1, 1)], [[(0, 0, 0)]], rotations=turn)
    assert footprint(results, [0], 0).area() == pytest.approx(2**0.5, abs=ROUNDING)


def test_a_hole_is_not_covered():
    ring = [
        ((10, 1, 1), (0, 4.5, 0)),
        ((10, 1, 1), (0, -4.5, 0)),
        ((1, 10, 1), (4.5, 0, 0)),
        ((1, 10, 1), (-4.5, 0, 0)),
    ]
    area = footprint(standing(*ring), range(4), 0)
    assert area.area() == pytest.approx(100.0 - 64.0, abs=ROUNDING)
    signed = [np.sum(r[:, 0] * np.roll(r[:, 1], -1) - np.roll(r[:, 0], -1) * r[:, 1]) / 2 for r in outlines(area)]
    assert sorted(signed) == pytest.approx([-64.0, 100.0], abs=ROUNDING)
    inside_hole, inside_ring, beyond = distances_outside(area, np.array([[0.0, 1.0], [4.5, 4.5], [8.0, 9.0]]))
    # The hole's nearest side is 3 m away; beyond the corner it is 3, 4 and 5.
    assert (inside_hole, inside_ring, beyond) == pytest.approx((3.0, 0.0, 5.0), abs=ROUNDING)


def test_what_a_box_sweeps_is_all_between_its_places():
    results = moving_boxes([0, 1, 2], [(1, 2, 1)], [[(0, 0, 0)], [(10, 0, 0)], [(10, 5, 0)]])
    # 11 m by 2 m along x, then 1 m by 5 m more along y.
    assert swept_footprint(results, [0]).area() == pytest.approx(22.0 + 5.0, abs=ROUNDING)


def test_what_does_not_move_sweeps_its_footprint():
    results = standing(((1, 2, 1), (0, 0, 0)))
    assert swept_footprint(results, [0]).area() == pytest.approx(2.0, abs=ROUNDING)


def test_a_turning_box_sweeps_all_its_positions():
    angles = np.radians(np.arange(0.0, 91.0, 1.0))
    positions = np.zeros((len(angles), 1, 3))
    results = moving_boxes(angles, [(2, 1, 1)], positions, rotations=turned_about_z(angles)[:, None])
    swept = swept_footprint(results, [0])
    radius = np.hypot(1.0, 0.5)
    assert 2.0 < swept.area() < np.pi * radius**2
    for step in (0, 30, 45, 90):
        outside = footprint(results, [0], step) - swept
        assert outside.area() == pytest.approx(0.0, abs=ROUNDING)


def test_nothing_covers_nothing():
    results = standing(((1, 1, 1), (0, 0, 0)))
    assert footprint(results, [], 0).area() == swept_footprint(results, []).area() == 0.0
    with pytest.raises(ValueError, match="empty area"):
        distances_outside(footprint(results, [], 0), np.zeros((1, 2)))


def test_a_way_that_bends_and_trembles_is_covered_and_little_more():
    """Along a circle and back with a tremor: each step is covered, and no more than a centimetre around the steps."""
    steps = np.arange(0.0, 3.0, 0.02)
    way = np.column_stack((4.0 * np.sin(steps), 4.0 * np.cos(steps), np.zeros(len(steps))))
    way += np.random.default_rng(1).uniform(-1e-3, 1e-3, way.shape)
    positions = np.concatenate((np.repeat(way[:1], 50, axis=0), way))
    results = moving_boxes(np.arange(len(positions)), [(1, 1, 1)], positions[:, None])
    swept = swept_footprint(results, [0])
    of_steps = united(
        swept_footprint(moving_boxes([0, 1], [(1, 1, 1)], positions[step : step + 2, None]), [0])
        for step in range(len(positions) - 1)
    )
    assert (of_steps - swept).area() == pytest.approx(0.0, abs=ROUNDING)
    corners = np.concatenate(outlines(swept))
    assert distances_outside(of_steps, corners).max() <= 0.01


def test_what_falls_within_what_was_covered_adds_nothing():
    positions = [[(0, 0, 0), (0, 0, 5)], [(0.5, 0.5, 0), (0.5, 0.0, 1)]]
    results = moving_boxes([0, 1], [(4, 4, 1), (1, 1, 1)], np.array(positions))
    alone = moving_boxes([0, 1], [(4, 4, 1)], np.array(positions)[:, :1])
    assert swept_footprint(results, [0, 1]).area() == pytest.approx(swept_footprint(alone, [0]).area(), abs=ROUNDING)
