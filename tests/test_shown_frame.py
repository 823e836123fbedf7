# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of presets show what comes down where the key frame shows a bridge that stands."""

from dataclasses import replace

import numpy as np
import pytest
from pictures.shown_frame import shown_frame
from support.moving_boxes import moving_boxes

TIMES_S = np.arange(5) * 0.5
FALLEN_M = np.array([0.0, 0.0, 1.0, 3.0, 3.0])
SPEEDS_M_S = np.array([0.0, 0.0, 3.0, 6.0, 0.0])


def falling(share=1.0, **more):
    """Two boxes, of which the second comes down by a share of 3 m: at its fastest in frame 5, as frames begin at 2."""
    places, velocities = np.zeros((5, 2, 3)), np.zeros((5, 2, 3))
    places[:, 1, 2], velocities[:, 1, 2] = -share * FALLEN_M, -share * SPEEDS_M_S
    return moving_boxes(TIMES_S, np.ones((2, 3)), places, velocities_m_s=velocities, **more)


def test_what_stands_at_the_key_frame_is_shown_as_it_comes_down():
    assert shown_frame(falling(), 3) == 5


def test_a_key_frame_in_which_something_has_moved_is_shown():
    assert shown_frame(falling(), 4) == 4


def test_a_deck_that_has_only_begun_to_come_down_is_shown_at_its_fastest():
    begun = falling()
    places = np.array(begun.frames.positions_m)
    places[1, 1, 2] = -0.5
    assert shown_frame(replace(begun, frames=replace(begun.frames, positions_m=places)), 3) == 5


def test_where_nothing_comes_down_the_key_frame_is_shown():
    assert shown_frame(falling(share=0.05), 3) == 3


@pytest.mark.parametrize("load", [{"kinds": ["ball", "shard"]}, {"blast_impulses_ns": np.ones((5, 2, 3))}])
def test_hits_and_blasts_are_shown_themselves(load):
    assert shown_frame(falling(**load), 3) == 3


def test_what_is_taken_away_does_not_count_as_falling():
    places = np.zeros((5, 2, 3))
    places[1:, 1, 2] = -1000.0
    assert shown_frame(moving_boxes(TIMES_S, np.ones((2, 3)), places), 2) == 2
