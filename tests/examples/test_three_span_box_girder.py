"""The box girder of three spans stands by itself, and the ball breaks through the middle span."""

import numpy as np
import pytest
from example_runs import example, run_example


@pytest.fixture(scope="module")
def girder(tmp_path_factory):
    """The hit is at 1.93 s."""
    return run_example(example("three_span_box_girder", 2.6), tmp_path_factory.mktemp("girder"))


def test_it_stands_until_the_ball_hits(girder):
    before = girder.at(girder.summary["impact"]["time_s"]) - 1
    assert girder.results.intact[before].all()
    assert girder.moved_m(girder.shards, before).max() < 0.02  # Bullet's own sag, with 100 iterations


def test_abutments_never_move(girder):
    assert girder.moved_m(girder.of_members("abutment")).max() == 0.0


def test_nothing_but_the_middle_span_breaks(girder):
    results = girder.results
    broken = ~results.intact[-1]
    assert broken.sum() > 10
    assert (abs(results.points_m[broken, 0] - 20.0) < 10.0).all()
