# SPDX-License-Identifier: GPL-3.0-or-later
"""Where shards that fall would land, against a throw worked out by hand."""

from dataclasses import replace

import numpy as np
import pytest
from support.sample_results import hanging_chain

from bridge_demolition_addon.model.debris.footprint import falling, landed

LOWER = 2
"""Its centre ends 2 m above the ground and it is 4 m high, so that the tests lift it."""


def flying(centre_m, velocity_m_s):
    """The hanging chain, whose lower shard of 4 m height is somewhere at the end and moves."""
    results = hanging_chain()
    positions_m, velocities = results.frames.positions_m.copy(), results.frames.velocities_m_s.copy()
    positions_m[-1, LOWER], velocities[-1, LOWER] = centre_m, velocity_m_s
    return replace(results, frames=replace(results.frames, positions_m=positions_m, velocities_m_s=velocities))


def test_a_shard_that_falls_lands_as_a_thrown_stone_does():
    """By 14.7099 m at first 4.903325 m/s: 1.3028 s, the positive root of x² + x - 3 = 0, by 9.80665 m/s²."""
    results, count = landed(flying((3.0, 4.0, 2.0 + 14.709975), (2.0, -1.0, -4.903325)))
    assert count == 1
    time_s = (13.0**0.5 - 1.0) / 2.0
    expected = (3.0 + 2.0 * time_s, 4.0 - time_s, 2.0)
    np.testing.assert_allclose(results.frames.positions_m[-1, LOWER], expected, atol=1e-9)


def test_what_is_slow_or_has_landed_stays_where_it_is():
    for slow in (flying((3.0, 4.0, 12.0), (5.0, 0.0, -1.9)), flying((3.0, 4.0, 2.05), (5.0, 0.0, -9.0))):
        results, count = landed(slow)
        assert count == 0
        np.testing.assert_array_equal(results.frames.positions_m, slow.frames.positions_m)


def test_its_height_is_that_of_its_lowest_corner():
    bodies, heights_m = falling(flying((3.0, 4.0, 12.0), (0.0, 0.0, -3.0)))
    assert bodies.tolist() == [LOWER]
    assert heights_m == pytest.approx([10.0])


def test_the_run_itself_is_not_changed():
    before = flying((3.0, 4.0, 12.0), (0.0, 0.0, -3.0))
    kept = before.frames.positions_m.copy()
    landed(before)
    np.testing.assert_array_equal(before.frames.positions_m, kept)
