# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames of a run: even ones, and shorter ones around detonations."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.timing.timeline import SLOWING, SlowMotion, Timeline, TimeStep

FRAME_S = 1.0 / 24.0


@pytest.mark.parametrize("fps, base, scale", [(24, 1.0, 1.0), (30, 1.001, 1.0), (240, 1.0, 0.05)])
def test_even_frames_are_counted_as_time_steps_count_them(fps, base, scale):
    step = TimeStep(fps, base, 10, scale)
    timeline = Timeline.of(step.frame_s, 3.0)
    assert len(timeline) == step.frames(3.0)
    np.testing.assert_array_equal(timeline.frame_lengths_s, step.frame_s)
    for time in (0.0, step.frame_s, 0.5, 1.0, 17.0 * step.frame_s, 2.99):
        assert timeline.frames_until(time) == step.frames(time)


def test_slow_motion_begins_when_asked_and_time_is_covered():
    timeline = Timeline.of(FRAME_S, 2.0, [SlowMotion(1.0, 0.05, 0.002)])
    lengths, ends = timeline.frame_lengths_s, timeline.ends_s
    first = timeline.frames_until(1.0)
    assert ends[first - 1] == pytest.approx(1.0, rel=1e-12)
    assert lengths[first : first + 25] == pytest.approx(0.002)
    assert lengths[first + 25 :] == pytest.approx(FRAME_S)
    assert 2.0 <= ends[-1] < 2.0 + FRAME_S


def test_frames_shorten_gently():
    lengths = Timeline.of(FRAME_S, 3.0, [SlowMotion(1.0, 0.05, 0.002), SlowMotion(2.2, 0.05, 0.001)]).frame_lengths_s
    shorter = lengths[1:] / lengths[:-1]
    # Even division of the time before may take as much again as one step of slowing.
    assert shorter.min() >= SLOWING**2
    assert lengths.max() <= FRAME_S * (1.0 + 1e-12)


def test_slow_motions_that_nearly_meet_are_one():
    lengths = Timeline.of(FRAME_S, 1.0, [SlowMotion(0.5, 0.02, 0.002), SlowMotion(0.55, 0.02, 0.001)]).frame_lengths_s
    short = np.flatnonzero(abs(lengths - 0.001) < 1e-12)
    assert len(short) == 70
    np.testing.assert_array_equal(np.diff(short), 1)


def test_slow_motion_from_the_start_and_after_the_end():
    lengths = Timeline.of(FRAME_S, 0.5, [SlowMotion(0.0, 0.01, 0.001), SlowMotion(9.0, 0.01, 0.001)]).frame_lengths_s
    assert lengths[:10] == pytest.approx(0.001)
    assert lengths[10:] == pytest.approx(FRAME_S)


def test_slow_motion_with_too_little_time_to_slow_down_in():
    timeline = Timeline.of(FRAME_S, 0.5, [SlowMotion(0.02, 0.01, 0.001)])
    first = timeline.frames_until(0.02)
    assert timeline.ends_s[first - 1] == pytest.approx(0.02, rel=1e-12)
    assert (timeline.frame_lengths_s > 0.0).all()
