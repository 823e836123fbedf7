# SPDX-License-Identifier: GPL-3.0-or-later
"""The small chart of a force: ends of its lines, its marks, and what is left of many points."""

import numpy as np
import pytest

from bridge_demolition_addon.display.key_figures import ForceHistory, history_curve

TIMES = np.array([0.0, 1.0, 2.0, 4.0])


def curve(forces, row=0, columns=100, times=TIMES):
    return history_curve(ForceHistory("shard", np.asarray(times, float), np.asarray(forces, float)), row, columns)


def test_time_goes_to_the_right_and_the_peak_is_at_the_top():
    drawn = curve([0.0, 50.0, 200.0, 100.0], row=3)
    points = [(0.0, 0.0), (0.25, 0.25), (0.5, 1.0), (1.0, 0.5)]
    np.testing.assert_allclose(drawn.lines, np.repeat(points, 2, axis=0)[1:-1])
    np.testing.assert_allclose(drawn.peak, points[2])
    np.testing.assert_allclose(drawn.now, points[3])
    assert drawn.now_share == 1.0


def test_what_is_not_known_is_a_gap():
    drawn = curve([1.0, 2.0, np.nan, 4.0], row=2)
    np.testing.assert_allclose(drawn.lines, [(0.0, 0.25), (0.25, 0.5)])
    assert drawn.now is None and drawn.now_share == 0.5
    np.testing.assert_allclose(drawn.peak, (1.0, 1.0))


def test_without_a_force_there_is_no_peak():
    drawn = curve(np.zeros(4), row=1)
    assert drawn.peak is None
    np.testing.assert_allclose(drawn.now, (0.25, 0.0))
    unknown = curve(np.full(4, np.nan), row=1)
    assert unknown.peak is None and unknown.now is None and not len(unknown.lines)


def test_a_run_of_one_frame_has_marks_and_no_line():
    drawn = curve([7.0], times=[0.0])
    assert not len(drawn.lines)
    np.testing.assert_allclose(drawn.now, (0.0, 1.0))


def test_of_many_points_peaks_are_left():
    """A spike of one frame in ten thousand is still there, and no more points than the chart can tell apart."""
    forces = np.ones(10_001)
    forces[[2345, 7000]] = 30.0, 60.0
    drawn = curve(forces, times=np.arange(10_001.0), columns=200)
    assert len(drawn.lines) <= 2 * 201
    tops = drawn.lines[drawn.lines[:, 1] > 0.1]
    np.testing.assert_allclose(np.unique(tops, axis=0), [(0.2345, 0.5), (0.7, 1.0)])
    assert drawn.lines[0, 0] == 0.0 and drawn.lines[-1, 0] == pytest.approx(1.0)
