# SPDX-License-Identifier: GPL-3.0-or-later
"""Paths of a jackhammer's chisel and of a lifted ball, and which jackhammers are refused."""

from dataclasses import replace

import numpy as np
import pytest
from support.scenarios import I235

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario import Jackhammer
from bridge_demolition_addon.model.scenario.ball import lift_path
from bridge_demolition_addon.model.scenario.file import scenario_from_text, scenario_text

HAMMER = Jackhammer(
    start_time_s=1.0,
    end_time_s=4.0,
    path_m=[[2, 0], [2, 1], [4, 1]],
    speed_m_s=2.0,
    blows_per_second=2.0,
    stroke_m=0.5,
    depth_m=0.2,
)


def test_chisel_goes_up_and_down_along_its_path():
    times = np.array((0.0, 1.0, 1.25, 1.5, 2.0, 2.25, 2.5, 4.0, 4.5, 5.0, 9.0))
    positions = HAMMER.tip_positions(5.0, times)
    clear, low, high = 5.0 - 0.2 + 0.5, 4.8, 6.3
    expected_z = (clear, clear, low, clear, clear, low, clear, clear, (clear + high) / 2, high, high)
    np.testing.assert_allclose(positions[:, 2], expected_z, atol=1e-12)
    ends = [(2, 0), (2, 0), (2, 0.5), (2, 1), (3, 1), (3.5, 1), (4, 1), (4, 1), (4, 1), (4, 1), (4, 1)]
    np.testing.assert_allclose(positions[:, :2], ends, atol=1e-12)


def test_chisel_on_one_point_stays_there():
    positions = replace(HAMMER, path_m=[(3, 1)]).tip_positions(5.0, np.linspace(0, 9, 50))
    assert (positions[:, :2] == (3, 1)).all()


def test_largest_speed():
    times = np.linspace(1.0, 4.0, 30001)
    speeds = np.diff(HAMMER.tip_positions(0.0, times)[:, 2]) / np.diff(times)
    assert HAMMER.largest_speed_m_s == pytest.approx(abs(speeds).max(), rel=1e-4)


def test_jackhammers_are_written_without_loss():
    scenario = replace(I235, jackhammers=[HAMMER, replace(HAMMER, path_m=[(0.1 + 0.2, 0)])])
    assert scenario_from_text(scenario_text(scenario)) == scenario


@pytest.mark.parametrize(
    "values, text",
    [
        ({"end_time_s": 1.0}, r"jackhammers.end_time_s is 1.0: expected more than jackhammers.start_time_s, 1.0"),
        ({"end_time_s": 5.0}, r"jackhammers.end_time_s is 5.0: expected less than time.duration_s, 5.0 \(s\), by a "),
        ({"stroke_m": 0.2}, r"jackhammers.stroke_m is 0.2: expected more than jackhammers.depth_m, 0.2 \(m\), so that"),
        (
            {"blows_per_second": 20},
            r"blows_per_second is 20.0: expected at most 6 \(1/s\), one in 4 frames, or a "
            r"time.frames_per_second of at least 80",
        ),
        (
            {"path_m": []},
            r"jackhammers.path_m is a list of length 0: expected a list of one or more lists of 2 numbers",
        ),
        ({"path_m": [[1, 2], [1]]}, r"jackhammers.path_m.2 is a list of length 1: expected a list of one or more"),
        (
            {"path_m": [[1, 2], [1, "2"]]},
            r"jackhammers.path_m.2.2 is \"2\": expected a list of one or more lists",
        ),
        ({"path_m": [[1, 2], [1, 9]]}, r"jackhammers.path_m.2.2 is 9.0: expected a position on the deck"),
    ],
)
def test_wrong_jackhammers_are_refused(values, text):
    with pytest.raises(ScenarioError, match=text):
        replace(I235, jackhammers=[replace(HAMMER, **values)])


def test_ball_goes_up_and_then_level_with_limited_speed():
    start, end, steps = np.array((1.0, 2.0, 0.7)), np.array((5.0, -1.0, 10.7)), 60
    path = lift_path(start, end, np.linspace(0, 1, steps + 1))
    np.testing.assert_allclose(path[[0, -1]], [start, end], atol=1e-12)
    level = path[:, 2] < end[2] - 1e-9
    np.testing.assert_array_equal(path[level, :2], np.broadcast_to(start[:2], (level.sum(), 2)))
    lengths = np.linalg.norm(np.diff(path, axis=0), axis=1)
    # 10 m up and 5 m across; steps are chords, shorter than the way only where it turns.
    mean = 15.0 / steps
    assert lengths.max() <= 1.5 * mean * (1.0 + 1e-9)
    assert max(lengths[0], lengths[-1]) < 0.1 * mean


def test_ball_that_need_not_move_stays():
    assert not np.ptp(lift_path((1, 2, 3), (1, 2, 3), np.linspace(0, 1, 5)), axis=0).any()
