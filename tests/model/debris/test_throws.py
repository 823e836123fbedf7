# SPDX-License-Identifier: GPL-3.0-or-later
"""Debris of boxes that were moved by hand: throws, reaches, and piles whose heights and volumes are known."""

import numpy as np
import pytest
from support.moving_boxes import moving_boxes

from bridge_demolition_addon.model.debris.throws import debris_of, height_map, percentiles_by_mass


def test_debris_is_what_moved_and_how_far():
    sizes = [(2, 2, 2), (1, 1, 1), (1, 1, 1)]
    first = [(0, 0, 1), (0, 0, 5), (0, 0, 8)]
    last = [(0, 0, 1.05), (3, 4, 0.5), (-0.2, 0, 0.5)]
    debris = debris_of(moving_boxes([0, 1], sizes, [first, last]))
    assert debris.bodies.tolist() == [1, 2]  # the first rose by 5 cm only
    assert debris.throws_m == pytest.approx([5.0, 0.2])
    # The outline is the 2 m base; the thrown box's far corner is at (3.5, 4.5), 2.5 and 3.5 m beyond that of the base.
    assert debris.reaches_m == pytest.approx([np.hypot(2.5, 3.5), 0.0], abs=1e-6)
    assert debris.masses_kg.tolist() == [1000.0, 1000.0]
    assert debris.area.area() == pytest.approx(2.0, abs=1e-6)
    assert debris.highest_m == pytest.approx(1.0)


def test_reaches_do_not_need_every_side_of_a_long_edge():
    """The edge of a deck of many shards is straight but for rounding."""
    count = 60
    first = np.column_stack([np.arange(count), 1e-7 * np.random.default_rng(1).normal(size=count), np.full(count, 5.0)])
    last = first.copy()
    last[20] = (20.0, 4.0, 0.5)
    debris = debris_of(moving_boxes([0, 1], np.ones((count, 3)), [first, last]))
    assert debris.reaches_m == pytest.approx([4.0], abs=2e-5)


def test_without_debris_there_is_none():
    debris = debris_of(moving_boxes([0, 1], [(1, 1, 1)], np.zeros((2, 1, 3))))
    assert len(debris.bodies) == len(debris.throws_m) == 0
    assert debris.area.area() == 0.0
    assert np.isnan(debris.highest_m)
    assert np.isnan(percentiles_by_mass(debris.throws_m, debris.masses_kg)).all()


def test_percentiles_count_mass_and_not_pieces():
    throws, masses = np.array([5.0, 1.0, 2.0]), np.array([1.0, 90.0, 9.0])
    assert percentiles_by_mass(throws, masses, (50, 90, 91, 99, 100)).tolist() == [1.0, 1.0, 2.0, 2.0, 5.0]
    assert percentiles_by_mass(throws, np.ones(3), (33, 34, 67, 100)).tolist() == [1.0, 2.0, 5.0, 5.0]


def test_height_and_volume_of_a_box():
    results = moving_boxes([0.0], [(4, 2, 1)], [[(10, 5, 0.5)]])
    heights = height_map(results, np.array([0]))
    assert (heights.heights_m == 1.0).all()
    assert heights.volume_m3 == pytest.approx(8.0)


def test_height_of_a_ridge():
    """A cube on its edge is a roof: height √2 at the ridge, √2/2 at its sides, and half of it is above them."""
    turn = np.array([[[[1, 0, 1], [0, 2**0.5, 0], [-1, 0, 1]]]]) / 2**0.5
    results = moving_boxes([0.0], [(1, 1, 1)], [[(0, 0, 2**-0.5)]], rotations=turn)
    heights = height_map(results, np.array([0]), cells=400)
    assert np.nanmax(heights.heights_m) == pytest.approx(2**0.5, abs=0.01)
    # Down to the ground: the cube itself, and what is below its two lower faces, a quarter of √2 by √2 each.
    assert heights.volume_m3 == pytest.approx(1.0 + 0.5, rel=0.01)


def test_the_higher_of_two_boxes_is_seen():
    results = moving_boxes([0.0], [(2, 2, 1), (2, 2, 1)], [[(0, 0, 0.5), (1, 0, 2.5)]])
    heights = height_map(results, np.array([0, 1]), cells=300)
    at = {x: heights.heights_m[len(heights.ys_m) // 2, np.abs(heights.xs_m - x).argmin()] for x in (-0.5, 0.5, 1.5)}
    assert at == {-0.5: 1.0, 0.5: 3.0, 1.5: 3.0}


def test_no_bodies_make_no_pile():
    heights = height_map(moving_boxes([0.0], [(1, 1, 1)], [[(0, 0, 0)]]), np.zeros(0, int))
    assert heights.volume_m3 == 0.0
