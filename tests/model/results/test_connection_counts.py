# SPDX-License-Identifier: GPL-3.0-or-later
"""Cracked, yielded and torn are counted apart."""

import numpy as np
import pytest
from support.sample_results import hanging_chain

from bridge_demolition_addon.engineering.elasticity.crack_state import CrackAccumulator, CrackState
from bridge_demolition_addon.model.results.arrays import Results
from bridge_demolition_addon.model.results.collapse import ConnectionCounts
from bridge_demolition_addon.model.results.force_history import breaking_by_kind
from bridge_demolition_addon.model.run_folder.summary import RunSummary

CRACKED = {"with_bars": 60, "cracked": 51, "held_at_end": 51, "yielded": 6, "ruptured_in_part": 0, "ruptured": 0}


def test_each_connection_counts_once():
    """Of six one is whole, two are held, one by bars that have yielded, and three are held by nothing."""
    intact = np.array([True, False, False, False, False, False])
    bars = np.array([0.0, 1.0, 2.0, 0.0, 0.0, 0.0])
    counts = ConnectionCounts.of_frame(intact, bars)
    assert (counts.broken, counts.cracked, counts.yielded, counts.torn) == (5, 2, 1, 3)
    assert counts.text == "cracked (bars hold): 2, of these yielded: 1; torn: 3 of 6 connections"


def test_what_was_not_recorded_is_not_guessed():
    intact = np.array([True, False])
    for bars in (None, np.full(2, np.nan)):
        assert ConnectionCounts.of_frame(intact, bars).text == "cracked or torn: 1 of 2 connections"
    assert ConnectionCounts.of_frame(intact, np.zeros(2)).text == "torn: 1 of 2 connections"


@pytest.mark.parametrize(
    ("connections", "reinforcement", "text"),
    [
        ({"cracked": 51, "yielded": 4, "torn": 0}, CRACKED, "cracked (bars hold): 51, of these yielded: 4; torn: 0"),
        ({}, CRACKED, "cracked (bars hold): 51; torn: 0"),  # of an earlier version, whose yielded ones may have torn
        ({}, None, "cracked or torn: 51"),
        ({"cracked": None, "yielded": None, "torn": None}, None, "cracked or torn: 51"),
        ({"cracked": 0, "yielded": 0, "torn": 51}, None, "torn: 51"),
    ],
)
def test_summaries_of_before_say_what_they_know(connections, reinforcement, text):
    summary = {"connections": {"count": 312, "broken": 51, **connections}, "reinforcement": reinforcement}
    assert RunSummary.of(summary).counts.text == f"{text} of 312 connections"


def test_kinds_of_connections_have_their_torn_ones():
    """The chain comes apart in its last frame, at one of two connections."""
    results, rows = hanging_chain(), (5, 2)
    assert all(kind.torn is None for kind in breaking_by_kind(results))
    (broken,) = np.flatnonzero(~results.frames.intact[-1])
    for state, torn in ((0.0, 1), (1.0, 0)):
        bars = np.zeros(rows)
        bars[-1, broken] = state
        kinds = breaking_by_kind(Results.of_arrays(results.arrays() | {"connection_bars": bars}))
        assert sum(kind.broken[-1] for kind in kinds) == 1
        assert sum(kind.torn[-1] for kind in kinds) == torn


def state(rows, yield_shares, ruptured_shares):
    zeros, shares = np.zeros(len(rows)), np.array(yield_shares)
    ruptured = np.array(ruptured_shares)
    return CrackState(np.array(rows), zeros, zeros, zeros, zeros, zeros, shares, shares, ruptured)


def test_bars_hold_yield_and_rupture_over_frames():
    """Of four the first has no bars; what has yielded once has yielded; what has ruptured or is gone does not hold."""
    accumulator = CrackAccumulator(np.array([False, True, True, True]))
    accumulator.add(state([0, 1, 2], [0.0, 0.4, 1.0], [0.0, 0.0, 0.0]))
    accumulator.add(state([0, 1, 2], [0.0, 0.5, 0.3], [0.0, 0.0, 0.0]))
    assert accumulator.finish().rows.tolist() == [1, 2]
    assert accumulator.bars.tolist() == [0.0, 1.0, 2.0, 0.0]
    accumulator.add(state([1, 2, 3], [1.0, 0.2, 0.2], [1.0, 0.5, 0.0]))
    accumulator.finish()
    assert accumulator.bars.tolist() == [0.0, 0.0, 2.0, 1.0]
    accumulator.add(state([3], [0.2], [0.0]))
    accumulator.finish()
    assert accumulator.bars.tolist() == [0.0, 0.0, 0.0, 1.0]
