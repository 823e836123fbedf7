# SPDX-License-Identifier: GPL-3.0-or-later
"""What still moves when a run ends is said with every distance."""

from dataclasses import replace

import numpy as np
from support.run_folders import flying_shards

from bridge_demolition_addon.model.results.moving import moving_summary, moving_text, still_moving_note


def with_last_speeds(*speeds):
    results = flying_shards()
    velocities = np.zeros_like(results.frames.velocities_m_s)
    shards = results.inventory.of_kind("shard")
    velocities[-1, shards[: len(speeds)], 0] = speeds
    return replace(results, frames=replace(results.frames, velocities_m_s=velocities))


def test_shards_faster_than_a_tenth_of_a_metre_a_second_still_move():
    results = with_last_speeds(0.09, 3.2)
    moving, count = moving_summary(results), len(results.inventory.of_kind("shard"))
    assert (moving.shards, moving.of_shards, round(moving.fastest_m_s, 3)) == (1, count, 3.2)
    text = moving_text(moving)
    assert text.startswith(f"1 of {count} shards still moves at the end, at up to 3.2 m/s") and "not final" in text
    assert still_moving_note(results) == f"not final: 1 of {count} shards still moved"


def test_nothing_is_said_where_all_rest():
    results = with_last_speeds(0.09)
    assert moving_summary(results) is None and still_moving_note(results) == ""
    assert moving_text(None) == ""
