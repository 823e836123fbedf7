# SPDX-License-Identifier: GPL-3.0-or-later
"""The moment of which a run has a picture."""

import numpy as np
import pytest
from support.moving_boxes import moving_boxes
from support.sample_results import GRAVITY, hanging_chain

from bridge_demolition_addon.model.results.summary import impact_step, key_step

TIMES_S = np.arange(41) * 0.05


def still(**more):
    positions = np.tile([[[0.0, 0.0, 0.5], [2.0, 0.0, 0.5]]], (len(TIMES_S), 1, 1))
    return moving_boxes(TIMES_S, np.ones((2, 3)), positions, **more)


def breaking(*times_s):
    """A run in which one connection breaks at each of the times, and one never."""
    count = len(times_s) + 1
    intact = np.column_stack([time_s - 1e-9 > TIMES_S for time_s in (*times_s, 99.0)])
    return {
        "intact": intact,
        "connection_names": np.array([f"Connection {row}" for row in range(count)]),
        "pairs": np.tile([0, 1], (count, 1)),
    }


def blast(time_s):
    impulses = np.zeros((len(TIMES_S), 2, 3))
    impulses[np.searchsorted(TIMES_S, time_s - 1e-9), 1] = (0.0, 0.0, 5.0)
    return {"blast_impulses_ns": impulses}


def test_the_impact_of_a_ball_comes_first():
    results = hanging_chain()
    assert key_step(results, GRAVITY) == (impact_step(results, GRAVITY), "At the impact of the ball")


def test_a_blast_is_seen_half_a_second_after_its_last_load():
    results = still(**blast(0.4), **breaking(0.45, 0.5, 1.5))
    assert TIMES_S[key_step(results, GRAVITY)[0]] == 0.9
    assert key_step(still(**blast(1.8)), GRAVITY)[0] == len(TIMES_S) - 1


def test_other_runs_are_seen_when_half_of_what_breaks_has_broken():
    assert TIMES_S[key_step(still(**breaking(0.2, 1.0, 1.1, 1.2)), GRAVITY)[0]] == 1.0
    assert TIMES_S[key_step(still(**breaking(0.2, 1.0, 1.1)), GRAVITY)[0]] == 1.0


def test_where_nothing_breaks_it_is_the_largest_force():
    sums = np.zeros((len(TIMES_S), 2))
    sums[0], sums[7, 1], sums[9, 1] = np.nan, 3.0, 2.0
    assert key_step(still(body_peak_sums_n=sums, **breaking()), GRAVITY)[0] == 7
    assert key_step(still(), GRAVITY)[0] == 0


@pytest.mark.parametrize(
    ("results", "reason"),
    [
        (still(**blast(0.4)), "Shortly after the blast"),
        (still(**breaking(0.2)), "When half of the connections that broke had broken"),
        (still(), "At the largest force"),
    ],
)
def test_the_moment_is_named(results, reason):
    assert key_step(results, GRAVITY)[1] == reason
