# SPDX-License-Identifier: GPL-3.0-or-later
"""The exclusion zone around boxes: areas that a buffer has by formula."""

import math

import numpy as np
import pytest
from support.moving_boxes import moving_boxes

from bridge_demolition_addon.model.debris.zones import exclusion_zone
from bridge_demolition_addon.model.scenario import Exclusion

# A circle of 64 corners has sin(2π/64) / (2π/64) of its area: 0.2 % less.
CIRCLE = 0.002


def test_a_bridge_that_stands_has_its_plan_and_the_buffer():
    zone = exclusion_zone(moving_boxes([0.0], [(20, 8, 1)], [[(10, 0, 5)]]), Exclusion(buffer_m=6))
    assert zone.plan.area() == zone.debris.area() == pytest.approx(160.0)
    corners = math.pi * 6**2
    assert zone.whole.area() == pytest.approx(160.0 + 2 * 28 * 6 + corners, abs=CIRCLE * corners)
    assert zone.bounds_m == pytest.approx((-6, -10, 26, 10), abs=1e-6)
    assert zone.largest_distance_m == pytest.approx(6.0, rel=1e-6)


def test_drop_and_buffer_add_up():
    results = moving_boxes([0.0], [(20, 8, 1)], [[(10, 0, 5)]])
    both = exclusion_zone(results, Exclusion(designed_drop_m=2, buffer_m=4))
    assert both.drop.area() == pytest.approx(160.0 + 2 * 28 * 2 + math.pi * 4, rel=CIRCLE)
    assert both.bounds_m == pytest.approx((-6, -10, 26, 10), abs=1e-6)


def test_debris_counts_on_its_way_too():
    """A box that is thrown 30 m out and comes back: only the way tells."""
    positions = np.zeros((3, 1, 3))
    positions[1, 0, 0] = 30.0
    zone = exclusion_zone(moving_boxes([0, 1, 2], [(2, 2, 2)], positions), Exclusion(buffer_m=0))
    assert zone.debris.area() == pytest.approx(32.0 * 2.0)
    assert zone.whole.area() == pytest.approx(64.0)
    assert zone.largest_distance_m == pytest.approx(30.0)


def test_the_ball_counts_as_debris_but_not_as_bridge():
    positions = np.zeros((2, 2, 3))
    positions[1, 1, 1] = 12.0
    results = moving_boxes([0, 1], [(4, 4, 1), (1, 1, 1)], positions, kinds=["shard", "ball"])
    zone = exclusion_zone(results, Exclusion(buffer_m=0))
    assert zone.plan.area() == pytest.approx(16.0)
    assert zone.bounds_m == pytest.approx((-2, -2, 2, 12.5), abs=1e-6)
