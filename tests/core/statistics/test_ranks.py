# SPDX-License-Identifier: GPL-3.0-or-later
"""Rank correlation against scipy."""

import math

import numpy as np
import pytest
from scipy.stats import rankdata, spearmanr

from bridge_demolition_addon.core.statistics.ranks import rank_correlation, ranks_of

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
