# SPDX-License-Identifier: GPL-3.0-or-later
"""The time left against the time that was left, of work whose course is known."""

import numpy as np
import pytest

from bridge_demolition_addon.core.timing.time_left import in_words, remaining_s

TOTAL = 120


def marks(step_s):
    return np.concatenate([[0.0], np.cumsum(step_s)])


def worst_factor(step_s, from_share=0.25, to_share=0.95):
    """The largest factor between what is said and what was left, over a part of the course."""
    when, factors = marks(step_s), []
    for done in range(int(from_share * TOTAL), int(to_share * TOTAL)):
        said, left = remaining_s(when[: done + 1], TOTAL), when[-1] - when[done]
        factors.append(max(said / left, left / said))
    return max(factors)


def test_nothing_is_said_before_a_step_is_done():
    assert remaining_s([3.0], TOTAL) is None


@pytest.mark.parametrize("done", [1, 2, 7, 119, 120])
def test_equal_steps_take_what_is_said(done):
    assert remaining_s(marks(np.full(done, 0.5)), TOTAL) == pytest.approx(0.5 * (TOTAL - done))


def test_a_first_step_that_takes_long_is_soon_forgotten():
    """Blender makes the world in the first frame: here as long as thirty others."""
    steps = np.full(TOTAL, 0.1)
    steps[0] = 3.0
    assert worst_factor(steps) < 1.5


def test_a_run_that_gets_half_as_dear_again_is_judged_within_a_factor_of_one_and_a_half():
    """As where a bridge falls onto the ground: each frame has more contacts than the one before."""
    assert worst_factor(np.linspace(0.1, 0.15, TOTAL)) < 1.5


def test_time_between_the_steps_counts():
    """The clock goes on while Blender draws: steps of 0.1 s and as much for drawing."""
    when = np.arange(11) * 0.2
    assert remaining_s(when, 20) == pytest.approx(10 * 0.2)


def test_words_are_minutes_and_seconds():
    assert [in_words(each) for each in (0.2, 59.6, 65.0, 3600.0)] == [
        "about 0:00 min left",
        "about 1:00 min left",
        "about 1:05 min left",
        "about 60:00 min left",
    ]
