# SPDX-License-Identifier: GPL-3.0-or-later
"""Two spans of 13 m and 196 t: with bars the ball leaves a dent in one deck; without, charges take down both."""

import pytest
from support.example_claims import assert_begins
from support.example_runs import begun

pytestmark = pytest.mark.long

MASS_KG = 196_000.0
"""Of the report, Figure 21."""


@pytest.fixture(scope="module")
def ball(session_folder):
    return begun("two_spans_13m_ball", session_folder)


@pytest.fixture(scope="module")
def explosives(session_folder):
    return begun("two_spans_13m_explosives", session_folder)


def test_mass_and_spans_are_those_of_the_report(ball):
    assert ball.scenario.bridge.span_lengths_m == (13.0, 13.0)
    # Blender keeps masses as float32.
    assert ball.results.inventory.masses_kg[ball.shards].sum() == pytest.approx(MASS_KG, rel=1e-6)
    assert sum(ball.summary["members_kg"].values()) == pytest.approx(MASS_KG, rel=1e-9)


def test_the_ball_hits_as_hard_as_its_fall_makes_it(ball):
    hit = ball.summary["hits_of_the_ball"][0]
    # v = √(2 g h) with 5 m: 9.90 m/s. Deck and ball are a millimetre off, sub-steps 4 ms: 0.04 m/s.
    assert hit["approach_m_s"] == pytest.approx(9.90, abs=0.1)
    # The largest force of the ball comes in the frame of the hit, or in the next.
    assert ball.summary["impact"]["time_s"] == pytest.approx(0.1 + 1.01, abs=2 / 24)


def test_the_bridge_stands_until_the_ball_hits_it(ball):
    assert_begins("two_spans_13m_ball", ball)


def test_charges_go_off_under_a_bridge_of_the_same_mass(explosives):
    assert explosives.scenario.ball is None
    assert explosives.results.inventory.masses_kg[explosives.shards].sum() == pytest.approx(MASS_KG, rel=1e-6)


def test_charges_push_shards_away(explosives):
    assert_begins("two_spans_13m_explosives", explosives)
