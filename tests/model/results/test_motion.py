# SPDX-License-Identifier: GPL-3.0-or-later
"""Motion against free fall and right triangles."""

import numpy as np
import pytest
from support.moving_boxes import moving_boxes

from bridge_demolition_addon.engineering.geometry.vectors import rotated, rotation_vectors
from bridge_demolition_addon.model.debris.throws import debris_of
from bridge_demolition_addon.model.results.motion import first_hit, relative_to_ground, throw, travel

GRAVITY = np.array([0.0, 0.0, -9.80665])


def free_fall(times, start=(0.0, 0.0, 0.0)):
    return np.asarray(start) + np.asarray(times)[:, None] * GRAVITY


def test_travel_and_throw():
    first = np.array([[1.0, 1.0, 20.0], [0.0, 0.0, 0.0]])
    last = np.array([[4.0, 5.0, 8.0], [0.0, 0.0, -2.0]])
    # 3, 4, 12 and 13 make a right-angled box; the second body falls straight down.
    assert travel(first, last).tolist() == [13, 2]
    assert throw(first, last).tolist() == [5, 0]


def test_no_bodies_travel_nowhere():
    assert travel(np.zeros((0, 3)), np.zeros((0, 3))).shape == throw(np.zeros((0, 3)), np.zeros((0, 3))).shape == (0,)


@pytest.mark.parametrize("start", [(0.0, 0.0, 0.0), (3.0, -2.0, 15.0)])
def test_free_fall_and_a_throw_are_no_hit(start):
    times = np.array([0.0, 0.04, 0.08, 0.2, 0.21])  # steps need not be equal
    assert first_hit(free_fall(times, start), times, GRAVITY) is None


@pytest.mark.parametrize("step", [1, 3, 5])
def test_the_first_step_that_stops_a_fall(step):
    times = np.arange(7) * 0.04
    velocities = free_fall(times)
    velocities[step:] = 0.0
    assert first_hit(velocities, times, GRAVITY) == step


@pytest.mark.parametrize("share, hit", [(0.4, None), (0.6, 2)])
def test_a_brush_counts_from_half_of_what_gravity_does_in_the_step(share, hit):
    times = np.arange(4) * 0.04
    velocities = free_fall(times)
    velocities[2:, 0] += share * 0.04 * 9.80665
    assert first_hit(velocities, times, GRAVITY) == hit


def test_too_short_to_tell():
    assert first_hit(np.zeros((1, 3)), np.zeros(1), GRAVITY) is None
    # Frames in which no time passes are no hits.
    assert first_hit(np.zeros((3, 3)), np.zeros(3), GRAVITY) is None


def about(axis, degrees):
    """A rotation vector."""
    return np.radians(degrees) * np.array(axis, float) / np.linalg.norm(axis)


@pytest.mark.parametrize("degrees", [0.0, 1e-7, 30.0, 90.0, 179.0, -120.0])
@pytest.mark.parametrize("axis", [(0, 0, 1), (1, 2, -3)])
def test_turns_are_found_again(axis, degrees):
    start = rotated(np.eye(3)[None], about((3, 1, 2), 70.0)[None])
    end = rotated(start, about(axis, degrees)[None])
    np.testing.assert_allclose(end @ np.swapaxes(end, 1, 2), np.eye(3)[None], atol=1e-14)
    np.testing.assert_allclose(rotation_vectors(start, end), about(axis, degrees)[None], atol=1e-12)


def test_a_quarter_turn_about_z_takes_x_to_y():
    np.testing.assert_allclose(rotated(np.eye(3), about((0, 0, 1), 90.0)) @ (1, 0, 0), (0, 1, 0), atol=1e-15)


def test_more_than_half_a_turn_seems_to_go_back():
    end = rotated(np.eye(3)[None], about((0, 0, 1), 200.0)[None])
    np.testing.assert_allclose(rotation_vectors(np.eye(3)[None], end), about((0, 0, 1), -160.0)[None], atol=1e-12)


def test_who_stands_on_the_ground_sees_what_moves_with_it_at_rest():
    """The ground goes by 2 m along; one box with it, another stays where it is in space, and a third rises by 1 m."""
    first = np.array([(0, 0, -1), (0, 0, 1), (5, 0, 1), (9, 0, 1)], float)
    last = first + np.array([(2, 0, 0), (2, 0, 0), (0, 0, 0), (2, 0, 1)])
    kinds = ["ground", "shard", "shard", "shard"]
    velocities = np.stack((np.zeros((4, 3)), last - first))
    results = moving_boxes([0.0, 1.0], np.ones((4, 3)), [first, last], kinds=kinds, velocities_m_s=velocities)
    seen = relative_to_ground(results).frames
    assert (seen.positions_m[1] - seen.positions_m[0]).tolist() == [[0, 0, 0], [0, 0, 0], [-2, 0, 0], [0, 0, 1]]
    assert seen.velocities_m_s[1].tolist() == [[0, 0, 0], [0, 0, 0], [-2, 0, 0], [0, 0, 1]]
    assert debris_of(results).throws_m.tolist() == [2.0, 0.0]
    at_rest = moving_boxes([0.0, 1.0], np.ones((4, 3)), [first, first], kinds=kinds)
    assert relative_to_ground(at_rest) is at_rest
