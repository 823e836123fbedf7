# SPDX-License-Identifier: GPL-3.0-or-later
"""The time left against the time that was left, of work whose course is known, and of falls with an exact answer."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.timing.time_left import Pace, clock, speeds_to_come

TOTAL = 120
GRAVITY = 9.81


def pace_of(took_s, work=None):
    pace = Pace()
    for seconds, amount in zip(took_s, np.ones(len(took_s)) if work is None else work, strict=True):
        pace.note(seconds, amount)
    return pace


def worst_factor(step_s, from_share=0.25, to_share=0.95):
    """The largest factor between what is said and what was left, over a part of the course."""
    factors = []
    for done in range(int(from_share * TOTAL), int(to_share * TOTAL)):
        said, left = pace_of(step_s[:done]).left_s(TOTAL - done), sum(step_s[done:])
        factors.append(max(said / left, left / said))
    return max(factors)


def test_nothing_is_said_before_a_step_is_done():
    assert Pace().left_s(TOTAL) is None


@pytest.mark.parametrize("done", [1, 2, 7, 119, 120])
def test_equal_steps_take_what_is_said(done):
    assert pace_of(np.full(done, 0.5)).left_s(TOTAL - done) == pytest.approx(0.5 * (TOTAL - done))


def test_steps_of_unequal_work_take_what_is_said():
    work = np.arange(1.0, 11.0)
    assert pace_of(0.2 * work[:6], work[:6]).left_s(work[6:].sum()) == pytest.approx(0.2 * work[6:].sum())


def test_a_first_step_that_takes_long_is_soon_forgotten():
    """Blender makes the world in the first frame: here as long as thirty others."""
    steps = np.full(TOTAL, 0.1)
    steps[0] = 3.0
    assert worst_factor(steps) < 1.5


def test_a_run_that_gets_half_as_dear_again_is_judged_within_a_factor_of_one_and_a_half():
    """As where a bridge falls onto the ground: each frame has more contacts than the one before."""
    assert worst_factor(np.linspace(0.1, 0.15, TOTAL)) < 1.5


def test_a_stone_that_is_thrown_is_as_fast_as_its_energy_says():
    """v² = v₀² + 2 g h when it is down, as fast as at first when it is back at its height, sideways alone on top."""
    heights, velocities = np.array([0.0, 20.0]), np.array([[0.0, 0.0, 0.0], [6.0, 0.0, 8.0]])
    top = 8.0 / GRAVITY
    down = (8.0 + np.sqrt(64.0 + 2.0 * GRAVITY * 20.0)) / GRAVITY
    speeds = speeds_to_come(heights, velocities, GRAVITY, [0.0, top, 2.0 * top, down])
    assert speeds == pytest.approx([10.0, 6.0, 10.0, np.sqrt(100.0 + 2.0 * GRAVITY * 20.0)])


def test_what_is_down_slows_down():
    speeds = speeds_to_come(
        np.array([0.0, 5.0]), np.array([[3.0, 0.0, 0.0], [0.0, 0.0, 0.0]]), GRAVITY, [0.0, 1.0, 9.0]
    )
    assert speeds[0] == pytest.approx(3.0)
    assert 0.0 < speeds[1] < 0.5
    assert speeds[2] < 1e-3


def test_what_rests_is_taken_to_stay():
    assert speeds_to_come(np.array([0.0, 5.0]), np.zeros((2, 3)), GRAVITY, [0.0, 1.0]) == pytest.approx([0.0, 0.0])


def test_many_frames_cost_no_more_times_than_few_and_come_to_the_same():
    heights, velocities = np.array([0.0, 20.0]), np.array([[0.0, 0.0, 0.0], [6.0, 0.0, 8.0]])
    dense = np.linspace(0.0, 2.0, 2001)
    few = speeds_to_come(heights, velocities, GRAVITY, dense[::40])
    assert speeds_to_come(heights, velocities, GRAVITY, dense)[::40] == pytest.approx(few, rel=0.01)


def test_words_are_minutes_and_seconds():
    assert [clock(seconds) for seconds in (0.2, 59.6, 65.4, 3600.0)] == ["0:00", "1:00", "1:05", "60:00"]
