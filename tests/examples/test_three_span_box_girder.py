# SPDX-License-Identifier: GPL-3.0-or-later
"""The box girder of three spans stands by itself, and the ball breaks into the middle span."""

from support.example_claims import assert_claims
from support.example_runs import example, run_example

NAME = "three_span_box_girder"


def test_it_stands_until_the_ball_breaks_into_the_deck_that_it_hits(tmp_path):
    assert_claims(NAME, run_example(example(NAME, 2.3), tmp_path))
