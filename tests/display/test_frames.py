# SPDX-License-Identifier: GPL-3.0-or-later
"""Moments of the chain whose every number is known by hand."""

from support.sample_results import FRAME_S, GRAVITY, hanging_chain

from bridge_demolition_addon.display.frames import moments


def test_moments_of_the_chain():
    # The ball is let go in frame 3 and stopped in frame 6; by frame 6 the shards have come apart. See sample_results.
    found = moments(hanging_chain(), GRAVITY, {"A": 0.0, "B": 1.5 * FRAME_S, "late": 9.0}, 3.0 * FRAME_S)
    assert found == [(2, "A"), (3, "Release"), (4, "B"), (5, "At rest"), (6, "First break"), (6, "Hit")]


def test_what_did_not_happen_is_not_marked():
    names = [name for _, name in moments(hanging_chain(), GRAVITY, {}, None)]
    assert names == ["Release", "First break", "Hit"]
