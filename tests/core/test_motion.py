"""Motion against free fall and right triangles."""

import numpy as np
import pytest

from bridge_demolition_addon.core.motion import first_hit, throw, travel

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
