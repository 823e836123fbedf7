# SPDX-License-Identifier: GPL-3.0-or-later
"""Limits by rank: published numbers of runs, scipy's own test of a quantile, and what 2 000 ensembles cover."""

import re

import numpy as np
import pytest
from scipy.stats import beta, lognorm, quantile_test
from support.checkout import ROOT

from bridge_demolition_addon.engineering.statistics.binomial import upper_limit
from bridge_demolition_addon.engineering.statistics.order_limits import (
    achieved_confidence,
    coverage,
    least_runs,
    limits_by_runs,
    most_support,
    nth_largest,
)

ENSEMBLES = 2000
TOLERANCE = 3.3
"""Standard deviations of a share: a right method is outside by chance once in a thousand tests."""


def tolerance(share):
    """How far the share of 2 000 ensembles may lie from its expectation."""
    return TOLERANCE * np.sqrt(share * (1.0 - share) / ENSEMBLES)


@pytest.mark.parametrize(
    "quantile, confidence, runs",
    # Wilks (1941, 1942), with the first to the fifth largest as limit; 59, 93, 124, 153 and 181 stand in the safety
    # analysis of nuclear plants.
    [
        (0.90, 0.90, (22, 38, 52, 65, 78)),
        (0.90, 0.95, (29, 46, 61, 76, 89)),
        (0.95, 0.90, (45, 77, 105, 132, 158)),
        (0.95, 0.95, (59, 93, 124, 153, 181)),
        (0.97, 0.95, (99, 157, 208, 257, 303)),
        (0.99, 0.95, (299, 473, 628, 773, 913)),
        (0.99, 0.99, (459, 662, 838, 1001, 1157)),
        (0.999, 0.95, (2995, 4742, 6294, 7752, 9151)),
    ],
)
def test_least_runs_are_those_of_the_tables(quantile, confidence, runs):
    assert tuple(least_runs(quantile, confidence, rank) for rank in range(1, 6)) == runs


def test_the_table_in_the_docs_has_the_least_runs():
    text = (ROOT / "docs" / "studies.md").read_text(encoding="utf-8").replace("*", "")
    rows = re.findall(r"^\| (0\.\d+) \| (0\.\d+) \| (\d+) \| (\d+) \| (\d+) \| (\d+) \| (\d+) \|$", text, re.M)
    assert len(rows) == 8
    for quantile, confidence, *runs in rows:
        expected = [least_runs(float(quantile), float(confidence), rank) for rank in range(1, 6)]
        assert list(map(int, runs)) == expected


@pytest.mark.parametrize("outputs, runs", [(1, 59), (2, 93), (3, 124), (4, 153)])
def test_several_largest_values_at_once_need_the_runs_of_guba_makai_and_pal(outputs, runs):
    assert least_runs(0.95, 0.95, outputs) == runs


@pytest.mark.parametrize("dimensions, runs", [(1, 59), (2, 93), (4, 153)])
def test_shapes_need_the_runs_of_campi_and_garatti(dimensions, runs):
    assert least_runs(0.95, 0.95, dimensions) == runs


@pytest.mark.parametrize(
    "quantile, runs, rank_from_below",
    [
        *((0.95, runs, rank) for runs, rank in ((100, 99), (200, 196), (300, 292), (500, 484), (1000, 962))),
        *((0.99, runs, rank) for runs, rank in ((300, 300), (500, 499), (1000, 996))),
    ],
)
def test_ranks_are_those_of_the_tables(quantile, runs, rank_from_below):
    assert runs + 1 - most_support(runs, quantile, 0.95) == rank_from_below


@pytest.mark.parametrize("runs", [59, 93, 150, 480])
def test_limits_are_the_upper_ends_of_scipys_intervals_of_a_quantile(runs):
    values = np.random.default_rng(runs).lognormal(size=runs)
    interval = quantile_test(values, p=0.95, alternative="less").confidence_interval(0.95)
    assert nth_largest(values, most_support(runs, 0.95, 0.95)) == interval.high


def test_too_few_runs_allow_no_rank():
    assert (most_support(58, 0.95, 0.95), most_support(59, 0.95, 0.95)) == (0, 1)


@pytest.mark.parametrize("touching, runs", [(1, 59), (2, 93), (17, 480)])
def test_share_and_confidence_are_two_sides_of_one_limit(touching, runs):
    share = coverage(touching, runs, 0.95)
    assert share == pytest.approx(1.0 - beta.ppf(0.95, touching, runs - touching + 1), abs=1e-12)
    assert achieved_confidence(touching, runs, share) == pytest.approx(0.95, abs=1e-12)


def test_runs_without_an_end_are_the_largest():
    values = np.array([3.0, np.inf, 1.0, 2.0])
    assert [nth_largest(values, rank) for rank in (1, 2, 4)] == [np.inf, 3.0, 1.0]


def two_humps(generator, size):
    """Most reaches are short; every eighth run throws one shard far."""
    return np.where(generator.random(size) < 0.125, 20.0, 4.0) * generator.lognormal(0.0, 0.2, size)


def quantile_of_two_humps(quantile):
    low, high = 0.0, 100.0
    for _ in range(60):
        middle = (low + high) / 2.0
        below = 0.875 * lognorm.cdf(middle / 4.0, 0.2) + 0.125 * lognorm.cdf(middle / 20.0, 0.2)
        low, high = (middle, high) if below < quantile else (low, middle)
    return high


@pytest.mark.parametrize("rank, runs", [(1, 59), (2, 93), (3, 124)])
def test_limits_of_2000_ensembles_hold_as_often_as_promised(rank, runs):
    draws = two_humps(np.random.default_rng(20 + rank), (ENSEMBLES, runs))
    limits = np.array([nth_largest(draw, rank) for draw in draws])
    promised = achieved_confidence(rank, runs, 0.95)
    assert promised >= 0.95
    assert np.mean(limits >= quantile_of_two_humps(0.95)) == pytest.approx(promised, abs=tolerance(promised))


def test_two_limits_at_once_hold_in_as_many_of_2000_ensembles_as_promised():
    generator = np.random.default_rng(5)
    draws = generator.random((ENSEMBLES, 93, 2))
    # Of two independent evenly spread quantities the limits' product is the share that stays within both.
    shares = draws.max(axis=1).prod(axis=1)
    promised = achieved_confidence(2, 93, 0.95)
    assert np.mean(shares >= 0.95) == pytest.approx(promised, abs=tolerance(promised))


@pytest.mark.parametrize("true_share", [0.002, 0.02, 0.05, 0.3])
def test_upper_limits_of_shares_hold_in_as_many_of_2000_ensembles_as_promised(true_share):
    happened = np.random.default_rng(8).binomial(93, true_share, ENSEMBLES)
    # Clopper and Pearson promise at least the confidence; counts are whole, so it may be more.
    assert np.mean(upper_limit(happened, 93, 0.95) >= true_share) >= 0.95 - tolerance(0.95)


def test_shapes_around_runs_hold_less_than_a_limit_fixed_before():
    # The trap: boxes around 59 runs in two directions, four free sides, as if they had the confidence of one limit.
    generator = np.random.default_rng(3)
    draws = generator.random((ENSEMBLES, 59, 2))
    shares = (draws.max(axis=1) - draws.min(axis=1)).prod(axis=1)
    promised = achieved_confidence(4, 59, 0.95)
    assert promised < 0.35
    assert np.mean(shares >= 0.95) == pytest.approx(promised, abs=tolerance(promised))


def test_a_limit_is_followed_from_the_first_runs_that_allow_one_to_all():
    values = np.random.default_rng(2).permutation(np.arange(1.0, 201.0))
    runs, limits = limits_by_runs(values, 0.95, 0.95, 2)
    assert runs.tolist() == list(range(59, 201))
    expected = [np.sort(values[:count])[-1 if count < 93 else -2] for count in runs]
    assert limits.tolist() == expected


def test_a_long_study_is_followed_at_some_hundred_numbers_of_runs():
    values = np.random.default_rng(2).random(5000)
    runs, limits = limits_by_runs(values, 0.95, 0.95, 200)
    assert (len(runs), runs[0], runs[-1]) == (400, 59, 5000)
    assert limits[-1] == nth_largest(values, 200)


def test_a_study_of_too_few_runs_has_no_limit_to_follow():
    runs, limits = limits_by_runs(np.arange(58.0), 0.95, 0.95, 1)
    assert (len(runs), len(limits)) == (0, 0)
