# SPDX-License-Identifier: GPL-3.0-or-later
"""Spans, progress and rest of boxes that come down as told."""

import numpy as np
import pytest
from support.moving_boxes import moving_boxes

from bridge_demolition_addon.model.results.collapse import Rested, collapse_progress, rest_of, spans_of
from bridge_demolition_addon.model.run_folder.summary import RunSummary

DECK = {"body_members": np.array(["deck"] * 4), "body_member_kinds": np.array(["deck"] * 3 + ["pier"])}


def two_spans():
    """Three shards of a deck over two spans of 10 m and 5 m, and a pier; the second span falls by 6 m."""
    first = [(-0.5, 0, 6), (9, 0, 6), (11, 0, 6), (10, 0, 3)]
    last = [(-0.5, 0, 6), (9, 0, 6), (12, 0, 0), (10, 0, 3)]
    return moving_boxes([0, 1], [(1, 1, 1)] * 4, [first, last], masses_kg=[100, 300, 200, 400], **DECK)


def test_spans_are_told_apart_by_where_their_shards_were():
    first, second = spans_of(two_spans(), (10.0, 5.0))
    assert (first.name, first.bodies.tolist(), first.drop_m) == ("span 1", [0, 1], 0.0)
    assert (second.name, second.bodies.tolist(), second.drop_m) == ("span 2", [2], 6.0)


def test_one_span_is_the_deck_and_without_a_deck_everything_is():
    (deck,) = spans_of(two_spans(), (15.0,))
    assert (deck.name, deck.bodies.tolist()) == ("deck", [0, 1, 2])
    # By mass: 200 of 600 kg come down by 6 m.
    assert deck.drop_m == pytest.approx(2.0)
    assert deck.lowest_m.tolist() == [6.0, 0.0]
    (whole,) = spans_of(moving_boxes([0], [(1, 1, 1)] * 2, np.zeros((1, 2, 3))), (10.0, 5.0))
    assert (whole.name, whole.bodies.tolist()) == ("whole structure", [0, 1])


def test_progress_is_the_height_lost():
    # 600 kg at 6 m and 400 kg at 3 m are 4.8 m up; then 200 kg lie on the ground.
    assert collapse_progress(two_spans()) == pytest.approx([0.0, 1.2 / 4.8])


def moving_until(last_step):
    velocities = np.zeros((6, 2, 3))
    velocities[2 : last_step + 1, 1, 2] = -3.0
    velocities[:, 0, 0] = 0.05  # creeps
    return moving_boxes(np.arange(6) / 2, [(1, 1, 1)] * 2, np.zeros((6, 2, 3)), velocities_m_s=velocities)


def test_rest_is_after_the_last_motion():
    rest = rest_of(moving_until(3))
    assert (rest.first_motion_s, rest.at_rest_s, rest.moving_at_end) == (1.0, 2.0, 0)


def test_rest_is_when_the_run_found_it_by_energy():
    """So console, panel, summary, report and study say one time."""
    assert rest_of(moving_until(3), Rested(1.5)).at_rest_s == 1.5
    assert rest_of(moving_until(3), Rested(None)).at_rest_s is None
    earlier = RunSummary.of({"title": "of an earlier version"})
    assert rest_of(moving_until(3), earlier.rested).at_rest_s == 2.0


def test_what_moves_at_the_end_is_not_at_rest():
    rest = rest_of(moving_until(5))
    assert (rest.first_motion_s, rest.at_rest_s, rest.moving_at_end) == (1.0, None, 1)


def test_what_never_moves_never_comes_to_rest():
    rest = rest_of(moving_until(1))
    assert (rest.first_motion_s, rest.at_rest_s, rest.moving_at_end) == (None, None, 0)
