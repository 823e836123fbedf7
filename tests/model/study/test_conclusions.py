# SPDX-License-Identifier: GPL-3.0-or-later
"""Conclusions of whole studies, from their tables."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from support.study_folders import told_row, told_study

from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.model.study.conclusions import conclusions
from bridge_demolition_addon.model.study.runs_table import RunsTable

pytestmark = pytest.mark.slow

STUDY = told_study()


def table(runs=93, crashed=()):
    return RunsTable(
        tuple(told_row(STUDY, number, "crashed" if number in crashed else "done") for number in range(1, runs + 1))
    )


def test_a_study_says_how_far_and_how_likely():
    said = conclusions(STUDY, table())
    reaches_m = [row.outputs["reach_m"] for row in table().rows]
    assert (said.statuses, said.reach.limit_m) == ({"done": 93}, sorted(reaches_m)[-2])
    met = [[row.outputs[criterion.output] for row in table().rows] for criterion in STUDY.criteria]
    assert [criterion.count for criterion in said.criteria] == np.sum(met, axis=1).tolist()
    assert [criterion.what for criterion in said.criteria][:2] == [
        "met the criterion mid span down",
        "met the criterion road stays free",
    ]
    assert said.success.count == np.all(met, axis=0).sum() < 93
    assert said.at_once.limits["reach_m"] == max(reaches_m)


def test_a_run_that_crashed_reaches_without_end_and_meets_nothing():
    everything_met = [number for number, row in enumerate(table().rows, start=1) if row.outputs["success"]]
    crashed = everything_met[:2]
    said, before = conclusions(STUDY, table(crashed=crashed)), conclusions(STUDY, table())
    assert said.statuses == {"crashed": 2, "done": 91}
    assert said.as_json()["reach"]["limit_m"] is None
    assert [criterion.count + 2 for criterion in said.criteria] == [criterion.count for criterion in before.criteria]
    assert said.success.count == before.success.count - 2


def test_what_did_not_come_down_is_counted_with_its_limit():
    rows = [*table(crashed=(3,)).rows]
    rows[9] = replace(rows[9], outputs=rows[9].outputs | {"spans.1.lost_share": 0.49, "piers.2.lost_share": 0.05})
    span, pier = conclusions(STUDY, RunsTable(tuple(rows))).standing
    assert (span.what, span.count, pier.what) == ("span 1", 2, "pier 2")  # the run that crashed brought nothing down
    # Clopper and Pearson (1934): with so many or fewer of 93 runs in 5 % of studies.
    few = sum(math.comb(93, k) * span.at_most**k * (1.0 - span.at_most) ** (93 - k) for k in range(3))
    assert few == pytest.approx(0.05, rel=1e-6)


def test_conclusions_are_json():
    bare = told_study(criteria=())
    rows = tuple(told_row(bare, number, "killed" if number == 5 else "done") for number in range(1, 94))
    text = json.dumps(conclusions(bare, RunsTable(rows)).as_json(), allow_nan=False)
    assert json.loads(text)["success"] is None


@pytest.mark.parametrize("runs", [0, 92, 94])
def test_no_conclusion_is_drawn_before_all_runs_are_there(runs):
    with pytest.raises(OutputError, match=f"{runs} of 93 runs are there"):
        conclusions(STUDY, table(runs))
