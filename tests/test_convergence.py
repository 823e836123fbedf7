# SPDX-License-Identifier: GPL-3.0-or-later
"""What pages and `bda check` say of other numbers of shards and sub-steps, and of inputs, is what the runs gave."""

import statistics
import sys

import numpy as np
import pytest
from support.checkout import EXAMPLES, ROOT

sys.path.insert(0, str(ROOT / "scripts" / "experiments"))

import convergence
import reinforced_deck
import sensitivity

from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.structure.facts import DEBRIS_M, SAG_M, convergence_facts

PAGE = ROOT / "scripts" / "experiments" / "README.md"
WALKS = {"drilled": 4, "ball": 3}
"""Demolitions whose sensitivity was measured, and the walks of each."""


def of_setting(*setting):
    return [row for row in convergence.rows() if convergence.case_of(row)[:3] == setting]


def median(rows, key):
    return statistics.median(float(row[key]) for row in rows)


def test_the_page_has_the_tables_of_all_runs():
    text = PAGE.read_text(encoding="utf-8")
    assert [line for line in convergence.tables() if line not in text] == []
    assert {setting: len(of_setting(*setting)) for setting in convergence.SEEDS} == convergence.SEEDS


def test_how_it_comes_down_does_not_hang_on_shards_sub_steps_or_iterations():
    times_s = [float(row["collapse_s"]) for row in convergence.rows()]
    assert all(float(row["fallen_share"]) > 0.9 for row in convergence.rows())
    assert max(times_s) - min(times_s) <= 0.1


def test_energy_that_the_solver_makes_grows_with_shards_and_with_long_sub_steps():
    by_shards = [median(of_setting(shards, 0.02, 20), "made_share") for shards in (50, 100, 200, 400)]
    by_substeps = [median(of_setting(100, way_m, 20), "made_share") for way_m in (0.005, 0.02, 0.04)]
    assert by_shards == sorted(by_shards) and by_substeps == sorted(by_substeps)


def test_short_sub_steps_halve_the_energy_made_with_400_shards_and_debris_goes_no_farther_than_that_of_200():
    """The same cuts with sub-steps of 5 mm and of 20. The farthest of 200 shards is 7.9 m, of 400 it was 9.7."""
    fine, usual = ({row["seed"]: row for row in of_setting(400, way_m, 20)} for way_m in (0.005, 0.02))
    farthest_m = max(float(row["reach_m"]) for row in of_setting(200, 0.02, 20))
    for seed, row in fine.items():
        assert float(row["made_share"]) < 0.6 * float(usual[seed]["made_share"])
        assert float(row["reach_m"]) < min(farthest_m, float(usual[seed]["reach_m"]))


def test_what_bda_check_says_is_the_median_of_the_runs():
    found = {shards: round(median(of_setting(shards, 0.02, 20), "reach_m"), 1) for shards in DEBRIS_M}
    assert found == DEBRIS_M
    decks = [row for row in reinforced_deck.rows() if (row["ball_kg"], row["bars"]) == ("10000", "1")]
    own = [row for row in decks if (float(row["finer"]), float(row["rupture_m"])) == (1.0, 0.0)]
    sags = {shards: [row for row in own if row["shards"] == str(shards)] for shards in SAG_M}
    assert {shards: round(median(rows, "sag_m"), 3) for shards, rows in sags.items()} == SAG_M


def test_bda_check_says_it_of_charges_and_balls_alone():
    drilled = read_scenario(EXAMPLES / "drilled" / "two_spans.toml")
    ball = read_scenario(EXAMPLES / "two_spans_13m_ball.toml")
    assert [fact for fact, _ in convergence_facts(drilled, 200)][:1] == ["debris distance"]
    assert dict(convergence_facts(drilled, 200))[""].startswith("here 100 shards a span")
    assert [fact for fact, _ in convergence_facts(ball, 200)][:1] == ["dent of a ball"]
    assert list(convergence_facts(read_scenario(EXAMPLES / "stages" / "excavator_on_the_deck.toml"), 200)) == []


def test_a_deck_under_the_ball_is_down_or_dented():
    """As the page counts them. Nothing is between: those that stand went down by 0.3 m at most, others by 5 or more."""
    sags_m = {down: [float(row["sag_m"]) for row in sensitivity.rows("ball") if row["down"] == down] for down in "01"}
    assert max(sags_m["0"]) < 0.3 and min(sags_m["1"]) > 5.0
    rows = sensitivity.rows("ball")
    by_traffic = [(row["in.bridge.reinforcement.traffic_kn_m2"], row["down"]) for row in rows]
    assert [by_traffic.count(pair) for pair in (("12", "0"), ("12", "1"), ("6", "0"), ("6", "1"))] == [12, 0, 4, 11]


def figures(line):
    """What a line of the table says: its input, and the effects and their confidences."""
    words, *cells = (cell.strip() for cell in line.strip("| ").split(" | "))
    return words, np.array([[float(figure) for figure in cell.split(" ± ")] for cell in cells])


@pytest.mark.parametrize("name", WALKS)
def test_the_page_has_the_effects_of_all_inputs(name):
    """The confidence is found with random numbers, which versions of SALib draw otherwise: within 0.3 of its size."""
    own = PAGE.read_text(encoding="utf-8").split(f"<!-- {name} -->")[1].split("<!-- end -->")[0]
    said = dict(figures(line) for line in own.splitlines() if " ± " in line)
    found = [figures(line) for line in sensitivity.table(name)[2:]]
    assert len(found) == len(sensitivity.DEMOLITIONS[name].keys)
    for words, effects in found:
        np.testing.assert_allclose(said[words][:, 0], effects[:, 0], atol=1e-9, err_msg=words)
        np.testing.assert_allclose(said[words][:, 1], effects[:, 1], rtol=0.3, atol=0.15, err_msg=words)


@pytest.mark.parametrize("name", WALKS)
def test_runs_are_walks_that_change_one_input_at_a_time(name):
    demolition, drawn = sensitivity.DEMOLITIONS[name], sensitivity.drawn_of(name)
    steps = len(demolition.keys) + 1
    assert len(drawn) == WALKS[name] * steps
    for walk in drawn.reshape(-1, steps, len(demolition.keys)):
        changed = walk[1:] != walk[:-1]
        assert (changed.sum(axis=1) == 1).all() and changed.any(axis=0).all()
    scenario = sensitivity.scenario_with(demolition, drawn[1])
    assert scenario.connections.strength_factor == drawn[1][0] and scenario.seed == round(drawn[1][-1])
