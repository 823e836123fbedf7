"""The box girder of three spans stands by itself, and the ball breaks into the middle span."""

import numpy as np
import pytest
from example_runs import example, run_example


@pytest.fixture(scope="module")
def girder(tmp_path_factory):
    """The hit is at 1.93 s, and what it breaks breaks at once."""
    return run_example(example("three_span_box_girder", 2.3), tmp_path_factory.mktemp("girder"))


def test_it_stands_until_the_ball_hits(girder):
    before = girder.at(girder.summary["impact"]["time_s"]) - 1
    # Faces between the abutments and the girder, whose moments one force compares with newtons.
    assert (~girder.results.frames.intact[before]).sum() <= 0.01 * girder.summary["connections"]["count"]
    assert girder.moved_m(girder.shards, before).max() < 0.005  # Bullet's own sag, with 100 iterations


def test_the_ball_breaks_into_the_deck_that_it_hits(girder):
    (ball,) = girder.results.inventory.of_kind("ball")
    top_m = 6.0 + 1.3 + 0.25
    # At rest on a whole deck, its middle would be its radius of 0.715 m above the top.
    assert girder.results.frames.positions_m[-1, ball, 2] < top_m
    assert girder.summary["connections"]["broken"] > 100
    deck = girder.of_members("deck")
    moved = deck[girder.moved_m(deck) > 0.3]
    assert len(moved) >= 5
    # The middle span is from 12 m to 28 m, and the ball falls at 20 m.
    assert abs(np.median(girder.results.frames.positions_m[0, moved, 0]) - 20.0) < 4.0


def test_first_span_piers_and_abutments_stay(girder):
    deck = girder.of_members("deck")
    first = deck[girder.results.frames.positions_m[0, deck, 0] < 11.0]
    assert girder.moved_m(first).max() < 0.02
    assert girder.moved_m(girder.of_members("pier")).max() < 0.02
    assert girder.moved_m(girder.of_members("abutment")).max() == 0.0


def test_forces_are_highest_where_the_ball_hits(girder):
    step = girder.at(girder.summary["impact"]["time_s"])
    deck = girder.of_members("deck")
    hit = deck[girder.results.frames.loads.body_peak_sums_n[step, deck].argmax()]
    assert np.linalg.norm(girder.results.frames.positions_m[0, hit, :2] - girder.scenario.ball.target_m) < 4.0
