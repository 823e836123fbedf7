# SPDX-License-Identifier: GPL-3.0-or-later
"""What is said of a study: numbers that tables have, words that are true, and too few runs refused."""

import json
import math

import numpy as np
import pytest
from scipy.stats import binomtest

from bridge_demolition_addon.engineering.units import rounded_down, rounded_up
from bridge_demolition_addon.model.study.conclusions import (
    DoubtfulThrows,
    as_json,
    debris_limit,
    proportion,
    simultaneous_limits,
)
from bridge_demolition_addon.model.study.settings import StudySettings
from bridge_demolition_addon.report.wording.numbers import listed, ordinal
from bridge_demolition_addon.report.wording.study import (
    doubtful_sentence,
    harm_sentence,
    limit_sentence,
    planned_limit_text,
    repeat_sentence,
    shape_sentence,
    success_sentence,
    verified_sentence,
)

pytestmark = pytest.mark.slow

REACHES_M = np.random.default_rng(1).permutation(np.arange(93) / 4.0 + 0.01)
"""From 0.01 m to 23.01 m; the second largest is 22.76 m."""

INPUTS = ["the charges' masses", "the fracture seed"]


def test_the_limit_is_said_as_a_report_has_to():
    limit = debris_limit(REACHES_M, 0.95, 0.95, 2)
    assert limit_sentence(limit, INPUTS, 5.0, 10.0) == (
        "In 93 independent runs, in which the charges' masses and the fracture seed were sampled from the "
        "distributions of this study, debris of 5 kg or more stayed within 22.8 m of the bridge's plan in all but 1. "
        "With 95 % confidence at least 95 % of such runs stay within it. This says how the model scatters; it "
        "does not cover what the model leaves out, such as pieces smaller than a shard, for which the buffer of 10 m "
        "is added, 32.8 m in all."
    )
    assert (limit.limit_m, limit.exceedances, limit.unfinished) == (22.76, 1, 0)
    assert (round(limit.achieved_confidence, 4), round(limit.coverage, 4)) == (0.9500, 0.9500)


def test_the_limit_is_told_without_doubtful_throws():
    assert doubtful_sentence(DoubtfulThrows(throws=5, runs=2, judged=93, limit_m=18.51)) == (
        "5 throws in 2 of 93 runs are doubtful: neither the height of fall nor a ball explains them, so the solver has "
        "made the energy. Without them the limit is 18.6 m."
    )


def test_without_a_mass_or_a_buffer_none_is_named():
    sentence = limit_sentence(debris_limit(REACHES_M[:59], 0.95, 0.95, 1), ["the fracture seed"], 0.0, None)
    assert "in which the fracture seed was sampled from" in sentence
    assert ", debris stayed within " in sentence and " in all of them. " in sentence
    assert sentence.endswith("for which a buffer has to be added.")


def test_a_run_that_did_not_finish_reaches_without_end():
    reaches_m = REACHES_M.copy()
    reaches_m[7] = np.inf
    limit = debris_limit(reaches_m, 0.95, 0.95, 2)
    farthest_m = np.delete(REACHES_M, 7).max()
    assert (limit.unfinished, limit.exceedances, limit.limit_m) == (1, 1, farthest_m)
    assert "in all but 1, which did not finish." in limit_sentence(limit, INPUTS, 0.0, None)


@pytest.mark.parametrize(
    "unfinished, words", [(1, "all but 2, 1 of which did not finish."), (2, "all but 2, none of which finished.")]
)
def test_it_is_said_how_many_of_the_farthest_did_not_finish(unfinished, words):
    reaches_m = np.arange(124.0)
    reaches_m[:unfinished] = np.inf
    assert words in limit_sentence(debris_limit(reaches_m, 0.95, 0.95, 3), INPUTS, 0.0, None)


def test_too_many_unfinished_runs_leave_no_limit():
    reaches_m = REACHES_M.copy()
    reaches_m[[3, 50]] = np.inf
    limit = debris_limit(reaches_m, 0.95, 0.95, 2)
    sentence = limit_sentence(limit, INPUTS, 0.0, None)
    assert sentence.startswith("These runs set no limit: 2 of 93 did not finish") and " stay within " not in sentence
    assert as_json(limit)["limit_m"] is None


@pytest.mark.parametrize(
    "runs, rank, needed",
    [(58, 1, "59 runs, has 58."), (92, 2, "93 runs (or 59 with study.rank = 1), has 92."), (1, 5, "181 runs (or 59 ")],
)
def test_too_few_runs_set_no_limit_and_the_number_that_is_needed_is_named(runs, rank, needed):
    limit = debris_limit(np.arange(float(runs)), 0.95, 0.95, rank)
    assert not limit.has_enough_runs and not limit.is_known and limit.achieved_confidence < 0.95
    assert as_json(limit)["limit_m"] is None and as_json(limit)["runs_needed"] == int(needed.split()[0])
    assert f"Too few runs for a limit yet: it needs {needed}" in limit_sentence(limit, INPUTS, 0.0, None)
    enough = debris_limit(np.arange(float(limit.runs_needed)), 0.95, 0.95, rank)
    assert enough.is_known and enough.achieved_confidence >= 0.95


def test_the_spread_of_the_limit_is_said():
    sentence = repeat_sentence(debris_limit(REACHES_M, 0.95, 0.95, 2))
    # Both of the two farthest of 186 runs are new ones: 1/2 · 92/185.
    assert sentence.endswith("; in 24.87 % of such studies it would lie beyond every distance seen here.")
    # The 7th largest, 21.51 m: of the eight farthest at most one is new in about 9 of 256 orders, of seven in 8 of 128.
    assert "its limit would lie above 21.5 m, with 95 % confidence; " in sentence
    both = repeat_sentence(debris_limit(np.arange(1000.0), 0.95, 0.95, 38))
    assert "with 95 % confidence each" in both and " and not above " in both


@pytest.mark.parametrize("happened", [0, 5, 93])
def test_criteria_have_limits_of_their_own(happened):
    met = np.arange(93) < happened
    share = proportion("brought the span down", met, 0.95)
    least = binomtest(happened, 93, alternative="greater").proportion_ci(0.95, method="exact").low
    most = binomtest(happened, 93, alternative="less").proportion_ci(0.95, method="exact").high
    assert (share.at_least, share.at_most) == (pytest.approx(least, abs=1e-10), pytest.approx(most, abs=1e-10))
    counted = {0: "None of 93", 5: "5 of 93", 93: "All 93"}[happened]
    assert success_sentence(share).startswith(f"{counted} runs brought the span down. With 95 % confidence at least")


def test_what_sentences_promise_is_rounded_to_the_side_of_safety():
    never = proportion("left the zone", np.zeros(59, bool), 0.95)
    assert never.at_most == pytest.approx(0.0495, abs=5e-5)
    assert "at most 4.96 % of such runs do" in harm_sentence(never)
    always = proportion("came down", np.ones(59, bool), 0.95)
    assert "at least 95.04 % of such runs do" in success_sentence(always)
    assert [rounded_up(value, "0.1") for value in (0.3, 0.1 + 0.2, 22.71, -1.0)] == ["0.3", "0.3", "22.8", "-1.0"]
    assert [rounded_down(value, "0.01") for value in (0.29, 0.2999)] == ["0.29", "0.29"]


def test_several_outputs_are_limited_at_once_by_the_ranks_that_runs_allow():
    outputs = {"reach_m": np.arange(93.0), "largest_force_N": np.arange(93.0) * 10.0}
    both = simultaneous_limits(outputs, 0.95, 0.95)
    assert (both.limits, both.ranks) == (
        {"reach_m": 92.0, "largest_force_N": 920.0},
        {"reach_m": 1, "largest_force_N": 1},
    )
    more = simultaneous_limits({name: np.resize(values, 124) for name, values in outputs.items()}, 0.95, 0.95)
    assert more.ranks == {"reach_m": 2, "largest_force_N": 1}
    assert simultaneous_limits({name: values[:92] for name, values in outputs.items()}, 0.95, 0.95) is None
    assert simultaneous_limits({}, 0.95, 0.95) is None


def test_fresh_runs_verify_a_zone_or_do_not():
    none = verified_sentence(proportion("left it", np.zeros(59, bool), 0.95), 0.95)
    assert none.startswith(
        "None of 59 runs left it. With 95 % confidence at most 4.96 % of such runs do. So it holds 95 % of such runs. "
        "This is so where the zone was fixed before these runs;"
    )
    one = verified_sentence(proportion("left it", np.arange(59) == 4, 0.95), 0.95)
    assert "does not show that it holds 95 %" in one
    assert "it takes 59 runs without one that leaves it, or 93 runs with one" in one


def test_a_zone_made_of_runs_is_called_no_limit():
    sentence = shape_sentence(4, 0.95, 0.95)
    assert "153 runs" in sentence and "--verify" in sentence


def test_statements_are_json():
    limit = as_json(debris_limit(REACHES_M, 0.95, 0.95, 2))
    assert limit["again_below_m"] is None and limit["limit_m"] == 22.76
    at_once = as_json(simultaneous_limits({"reach_m": np.append(REACHES_M[:58], math.inf)}, 0.95, 0.95))
    assert at_once["limits"] == {"reach_m": None}
    json.dumps([limit, at_once], allow_nan=False)


def test_lists_and_ranks_in_words():
    assert [listed(["a"]), listed(["a", "b"]), listed(["a", "b", "c"])] == ["a", "a and b", "a, b and c"]
    assert listed([str(number) for number in range(7)]) == "7 quantities"
    ranks = [ordinal(rank) for rank in (1, 2, 3, 4, 11, 21, 112)]
    words = ["2nd", "3rd", "4th", "11th", "21st", "112th"]
    assert ranks == ["largest", *(f"{word} largest" for word in words)]


def test_which_limit_the_runs_will_give_is_said_beforehand():
    # S. S. Wilks (1941): the largest of n is above the quantile p with confidence 1 - pⁿ, 1 - 0.95^20 = 0.6415, and the
    # second of them with 1 - pⁿ - n (1 - p) pⁿ⁻¹. So 59 and 93 runs are the least for 95 % with 95 % confidence.
    few = planned_limit_text(StudySettings(scenario="bridge.toml", runs=20))
    assert few.startswith("20 runs give no limit: 93 are needed for the 2nd largest debris distance to be one for 95 %")
    assert "or 59 with study.rank = 1. The largest of 20 holds for 95 % with 64.15 % confidence." in few
    assert "the limit for 95 % of all, with 95 % confidence" in planned_limit_text(StudySettings(scenario="a.toml"))
    assert "58 runs give no limit: 59" in planned_limit_text(StudySettings(scenario="a.toml", runs=58, rank=1))
