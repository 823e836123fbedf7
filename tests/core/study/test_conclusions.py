# SPDX-License-Identifier: GPL-3.0-or-later
"""Conclusions of whole studies, from their tables."""

import json

import pytest

from bridge_demolition_addon.core.errors import OutputError, ScenarioError
from bridge_demolition_addon.core.study.conclusions import conclusions
from bridge_demolition_addon.core.study.runs_table import Row, RunsTable

ASKED = {"runs": 93, "quantile": 0.95, "confidence": 0.95, "rank": 2}


def table(runs=93, crashed=()):
    """Runs that reach 1 m, 2 m and so on; the first ten bring the span down, and every second leaves the pier."""
    return RunsTable(
        tuple(
            Row(number, "crashed", {"scenario.seed": number}, {})
            if number in crashed
            else Row(
                number,
                "done",
                {"scenario.seed": number},
                {"reach_m": float(number), "span down": number <= 10, "pier stands": number % 2 == 0},
            )
            for number in range(1, runs + 1)
        )
    )


def test_a_study_says_how_far_and_how_likely():
    said = conclusions(table(), **ASKED, criteria=("span down", "pier stands"), at_once=("reach_m",))
    assert (said.statuses, said.reach.limit_m) == ({"done": 93}, 92.0)
    assert [(each.what, each.happened) for each in said.criteria] == [
        ("met the criterion span down", 10),
        ("met the criterion pier stands", 46),
    ]
    assert (said.success.what, said.success.happened) == ("met all criteria", 5)
    assert said.at_once.ranks == {"reach_m": 2}


def test_a_run_that_crashed_reaches_without_end_and_meets_nothing():
    said = conclusions(table(crashed=(2, 3)), **ASKED, criteria=("span down", "pier stands"))
    assert said.statuses == {"crashed": 2, "done": 91}
    assert said.as_json()["reach"]["limit_m"] is None
    assert [each.happened for each in (*said.criteria, said.success)] == [8, 45, 4]


def test_conclusions_are_json():
    text = json.dumps(conclusions(table(crashed=(5,)), **ASKED).as_json(), allow_nan=False)
    assert json.loads(text)["success"] is None


@pytest.mark.parametrize("runs", [0, 92, 94])
def test_no_conclusion_is_drawn_before_all_runs_are_there(runs):
    with pytest.raises(OutputError, match=f"{runs} of 93 runs are there"):
        conclusions(table(runs), **ASKED)


def test_runs_that_are_too_few_conclude_nothing():
    with pytest.raises(ScenarioError, match=r"study\.runs is 20: expected at least 93"):
        conclusions(table(20), **ASKED | {"runs": 20})
