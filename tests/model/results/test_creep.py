# SPDX-License-Identifier: GPL-3.0-or-later
"""What creeps at the end of a run is told from what rests, swings, falls or was thrown."""

import numpy as np
import pytest
from support.sample_results import changed, hanging_chain

from bridge_demolition_addon.model.results.moving import creep_of, creep_summary, creep_text

TIMES_S = np.array([0.0, 0.5, 1.0, 1.5, 2.0])
WAY = np.array([0.6, 0.0, -0.8])


def moved(*lower_m, speed_m_s=0.02, upper_m=(0.0,) * 5, times_s=TIMES_S):
    """The chain over two seconds, its lower shard so far along a way in each frame, and its upper one."""
    chain = hanging_chain()
    positions = np.tile(chain.frames.positions_m[0], (5, 1, 1))
    for body, distances in ((1, upper_m), (2, lower_m)):
        positions[:, body] += np.array(distances)[:, None] * WAY
    velocities = np.zeros_like(positions)
    velocities[-1, 2, 2] = -speed_m_s
    return changed(chain, times_s=times_s, places_m=positions, velocities_m_s=velocities)


def test_a_slow_shard_that_goes_on_creeps():
    creep = creep_of(moved(0.0, 0.0, 0.01, 0.02, 0.05))
    assert creep.bodies.tolist() == [2]
    # From 10 to 50 mm in the last second.
    assert creep.speeds_m_s == pytest.approx([0.04]) and creep.moved_m == pytest.approx([0.05])


def test_the_fastest_is_named_first_with_its_member_and_the_mass_of_all():
    summary = creep_summary(moved(0.0, 0.01, 0.02, 0.03, 0.04, upper_m=(0.0, 0.02, 0.04, 0.06, 0.08)))
    assert (summary.shards, summary.mass_kg) == (2, 500.0)
    assert [shard.body for shard in summary.fastest] == ["upper", "lower"]
    assert summary.fastest[0].speed_m_s == pytest.approx(0.04)
    text = creep_text(summary)
    named = "(upper of upper column, 80 mm from where it was)"
    assert text.startswith(f"2 shards creep at the end, by up to 40 mm/s {named}")
    one = creep_text(creep_summary(moved(0.0, 0.0, 0.01, 0.02, 0.05)))
    assert one.startswith("1 shard creeps at the end") and "it neither rests nor falls" in one
    assert creep_text(None) == ""


@pytest.mark.parametrize(
    "results",
    [
        moved(0.0, 0.0, 0.0, 0.0, 0.0),
        moved(0.0, 0.1, 0.2, 0.2, 0.2),  # came to rest
        moved(0.0, 0.0, 0.01, 0.02, 0.01),  # swings
        moved(0.0, 0.0, 0.01, 0.012, 0.014),  # by 4 mm/s, less than what rests by contact may slip
        moved(0.0, 0.0, 0.01, 0.03, 0.08, speed_m_s=0.2),  # falls
        moved(0.0, 0.0, 0.01, 0.02, 0.05, times_s=TIMES_S / 4.0),  # half a second is too short to tell
    ],
)
def test_what_rests_swings_or_falls_does_not_creep(results):
    assert not len(creep_of(results)) and creep_summary(results) is None
