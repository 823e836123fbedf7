# SPDX-License-Identifier: GPL-3.0-or-later
"""Verdicts: one sentence, distances rounded up, and never a limit of one run."""

from dataclasses import replace

import pytest
from support.study_folders import told_runs, told_study

from bridge_demolition_addon.model.debris.throws import RUNOUT
from bridge_demolition_addon.report.wording.verdict import run_limit, run_verdict, study_verdict


@pytest.mark.parametrize(
    "lost, said",
    [
        ({"span 1": 0.8, "span 2": 0.5}, "span 1 and span 2 came down,"),
        ({"span 1": 0.8, "span 2": 0.02}, "span 1 came down and span 2 stood,"),
        ({"span 1": 0.3}, "span 1 came down by 30 % of its height,"),
        ({"span 1": 0.012, "span 2": -0.01}, "the bridge stood, with no more than 2 % of a span's height lost,"),
    ],
)
def test_spans_are_down_from_half_of_their_height_on(lost, said):
    verdict = run_verdict(lost, 3.41, "all was at rest from 4.0 s on")
    assert verdict.startswith(f"In this one run {said}")
    assert verdict.endswith("debris stayed within 3.5 m of the bridge's plan, and all was at rest from 4.0 s on.")


def test_a_run_gives_no_limit_without_saying_that_it_is_one_run():
    assert (
        run_limit(0.0) == "no debris got beyond the bridge's plan in this one run; one run gives no limit to plan with"
    )
    assert "7.1 m of the bridge's plan in this one run (not final: 2 of 9" in run_limit(7.01, "not final: 2 of 9")


def test_a_study_says_its_limit_with_buffer_and_confidence():
    limit = told_runs().conclusions.reach
    known = replace(limit, limit_m=10.01)
    verdict = study_verdict(known, 3.0)
    # 10.01 m / 0.55, the shortest runout of the validated columns, is 18.2 m: the factor is not below it.
    assert known.to_keep_m() >= 10.01 / RUNOUT[0]
    assert "10.1 m of the bridge's plan, 21.3 m with the factor of 1.82 for runout and the buffer of 3 m" in verdict
    assert "10.1 m of the bridge's plan, 18.3 m with the factor of 1.82 for runout, in" in study_verdict(known, None)
    as_run = replace(known, runout_factor=1.0)
    assert "within 10.1 m of the bridge's plan, 13.1 m with the buffer of 3 m" in study_verdict(as_run, 3.0)
    assert "at least 95 % of runs like these 93, with 95 % confidence" in verdict
    assert "still moved" in study_verdict(known, None, is_final=False)


def test_too_few_runs_have_no_limit():
    limit = told_runs(told_study(20)).conclusions.reach
    assert study_verdict(limit, 3.0) == f"These 20 runs set no limit yet: it takes {limit.runs_needed}."
