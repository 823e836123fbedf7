# SPDX-License-Identifier: GPL-3.0-or-later
"""Rank correlation against scipy."""

import math

import numpy as np
import pytest
from scipy.stats import rankdata, spearmanr
from scipy.stats import t as student

from bridge_demolition_addon.engineering.statistics.ranks import correlation_by_chance, rank_correlation, ranks_of

pytestmark = pytest.mark.slow

RANDOM = np.random.default_rng(6)


@pytest.mark.parametrize("kinds", [2, 5, 1000])
def test_ranks_are_those_of_scipy_with_equal_values_too(kinds):
    values = RANDOM.integers(0, kinds, 200).astype(float)
    values[:20] = np.inf
    assert ranks_of(values).tolist() == rankdata(values).tolist()


@pytest.mark.parametrize("strength", [0.0, 0.5, -3.0])
@pytest.mark.parametrize("decimals", [0, 6])
def test_correlations_are_those_of_scipy(strength, decimals):
    first = np.round(RANDOM.normal(size=93), decimals)
    second = np.round(strength * first + RANDOM.normal(size=93), decimals)
    assert rank_correlation(first, second) == pytest.approx(spearmanr(first, second).statistic, abs=1e-13)


def test_the_form_of_a_curve_does_not_matter():
    values = RANDOM.random(50)
    assert rank_correlation(values, np.exp(9.0 * values)) == pytest.approx(1.0, abs=1e-13)
    assert rank_correlation(values, -(values**3)) == pytest.approx(-1.0, abs=1e-13)


def test_what_never_changes_is_not_correlated():
    assert math.isnan(rank_correlation(np.ones(9), RANDOM.random(9)))


@pytest.mark.parametrize("pairs", [20, 93])
def test_what_is_not_connected_stays_within_chance_in_19_cases_of_20(pairs):
    generator = np.random.default_rng(pairs)
    found = [abs(rank_correlation(*generator.random((2, pairs)))) for _ in range(4000)]
    # The normal approximation is off by half a percent at 20 pairs; the rest is the scatter of 4000 cases.
    assert np.mean(np.array(found) <= correlation_by_chance(pairs)) == pytest.approx(0.95, abs=0.005 + 3.3 * 0.00345)


@pytest.mark.parametrize("pairs", [93, 1000])
def test_the_edge_of_chance_is_where_scipy_has_one_case_in_twenty(pairs):
    edge = correlation_by_chance(pairs)
    statistic = edge * math.sqrt((pairs - 2) / (1.0 - edge**2))
    assert 2.0 * student.sf(statistic, pairs - 2) == pytest.approx(0.05, abs=0.001)


def test_two_pairs_show_nothing():
    assert correlation_by_chance(2) == 1.0
