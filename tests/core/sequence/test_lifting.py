"""The way of a lifted ball."""

import numpy as np

from bridge_demolition_addon.core.sequence.lifting import lift_path


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
