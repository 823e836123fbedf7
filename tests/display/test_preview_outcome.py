# SPDX-License-Identifier: GPL-3.0-or-later
"""What a preview shows of a recording whose every number can be checked by hand."""

import json
from dataclasses import replace

import numpy as np
import pytest
from support.sample_results import hanging_chain

from bridge_demolition_addon.display.preview_outcome import PreviewOutcome

UPRIGHTS = [np.array([[0.0, 0.0, 16.0], [0.0, 0.0, 20.0]]), np.array([[0.0, 0.0, 12.0], [0.0, 0.0, 16.0]])]
"""A line upwards through the middle of each of the two shards, where they hang."""


@pytest.fixture
def outcome():
    return PreviewOutcome.of(hanging_chain(), UPRIGHTS, duration_s=2.0)


def test_what_falls_is_counted_and_its_edges_go_with_it(outcome):
    """The lower shard, of 200 kg, ends (3, 4, -12) m from where it hung; the upper one has not moved."""
    assert (outcome.shards, outcome.fallen, outcome.standing, outcome.fallen_kg) == (2, 1, 1, 200.0)
    np.testing.assert_allclose(outcome.standing_lines_m, UPRIGHTS[0])
    np.testing.assert_allclose(outcome.fallen_lines_m, UPRIGHTS[1] + (3.0, 4.0, -12.0))
    assert (outcome.time_s, outcome.duration_s) == (pytest.approx(0.16), 2.0)


def test_debris_is_outlined_on_the_ground(outcome):
    """A square of 0.5 m² about (3, 4), as far from the plan of 1 m² about the origin as their corners are apart."""
    side = 0.5**0.5
    assert outcome.area_m2 == pytest.approx(0.5)
    ends = outcome.debris_lines_m[:, :2]
    np.testing.assert_allclose((ends.min(axis=0) + ends.max(axis=0)) / 2.0, (3.0, 4.0), atol=1e-6)
    np.testing.assert_allclose(np.ptp(ends, axis=0), side, atol=1e-6)
    assert np.ptp(outcome.debris_lines_m[:, 2]) == 0.0
    farthest = np.hypot(3.0 + side / 2.0 - 0.5, 4.0 + side / 2.0 - 0.5)
    assert outcome.farthest_m == pytest.approx(farthest)


def test_it_goes_as_text_from_process_to_process(outcome):
    again = PreviewOutcome.of_json(json.loads(json.dumps(outcome.to_json())))
    assert again.to_json() == outcome.to_json()
    np.testing.assert_allclose(again.debris_lines_m, outcome.debris_lines_m, atol=5e-4)
    assert again.standing == outcome.standing


def test_what_still_falls_is_debris_where_it_would_land():
    """The lower shard, 4 m high, sinks 14.71 m above the ground: x² + x = 3 s later it has gone 2 m/s along x."""
    chain = hanging_chain()
    positions_m, velocities = chain.frames.positions_m.copy(), chain.frames.velocities_m_s.copy()
    positions_m[-1, 2], velocities[-1, 2] = (0.0, 0.0, 2.0 + 14.709975), (2.0, 0.0, -4.903325)
    flying = replace(chain, frames=replace(chain.frames, positions_m=positions_m, velocities_m_s=velocities))
    found = PreviewOutcome.of(flying, UPRIGHTS, duration_s=2.0)
    assert (found.falling, found.fallen, found.standing) == (1, 1, 1)
    way_m = 2.0 * (13.0**0.5 - 1.0) / 2.0
    np.testing.assert_allclose(found.fallen_lines_m, [[way_m, 0.0, 0.0], [way_m, 0.0, 4.0]], atol=1e-6)
    middle = (found.debris_lines_m.min(axis=0) + found.debris_lines_m.max(axis=0)) / 2.0
    np.testing.assert_allclose(middle[:2], (way_m, 0.0), atol=1e-6)


def test_nothing_falls_any_more_in_what_has_landed(outcome):
    assert outcome.falling == 0
