# SPDX-License-Identifier: GPL-3.0-or-later
"""The box girder of three spans stands by itself until a ball hits its middle span, in which it leaves a dent."""

import pytest
from support.example_claims import assert_begins
from support.example_runs import begun

pytestmark = pytest.mark.long

NAME = "three_span_box_girder"


def test_it_stands_until_the_ball_hits_it(session_folder):
    run = begun(NAME, session_folder)
    assert run.summary["impact"] and run.scenario.bridge.spans_m / 3.0 < run.scenario.ball.target_m[0]
    assert_begins(NAME, run)
