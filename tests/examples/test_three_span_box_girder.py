# SPDX-License-Identifier: GPL-3.0-or-later
"""The box girder of three spans stands by itself, and under a ball that dents its middle span."""

from support.example_claims import assert_claims
from support.example_runs import example, run_example

NAME = "three_span_box_girder"


def test_it_stands_and_the_ball_leaves_a_dent(tmp_path):
    assert_claims(NAME, run_example(example(NAME), tmp_path))
