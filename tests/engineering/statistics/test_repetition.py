# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a limit would lie in another study: all orders of few runs, scipy for many, and studies made twice."""

from itertools import combinations

import numpy as np
import pytest
from scipy.stats import nhypergeom

from bridge_demolition_addon.engineering.statistics.order_limits import chances_above, nth_largest, repeated_limit

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("runs, rank", [(1, 1), (3, 1), (4, 2), (5, 5)])
def test_chances_are_shares_of_all_orders(runs, rank):
    above, orders = np.zeros(runs), 0
    for known in combinations(range(2 * runs), runs):
        new = sorted(set(range(2 * runs)) - set(known))
        above += new[-rank] > np.array(known[::-1])
        orders += 1
    assert chances_above(rank, runs) == pytest.approx(above / orders, abs=1e-14)


@pytest.mark.parametrize("runs, rank", [(93, 2), (1000, 38), (10_000, 400), (100_000, 4000)])
def test_chances_are_those_of_scipy(runs, rank):
    first = np.arange(min(runs, 200))
    expected = nhypergeom.cdf(first, 2 * runs, runs, rank)
    # scipy takes differences of logarithms of factorials, and keeps twelve digits.
    assert chances_above(rank, runs)[first] == pytest.approx(expected, abs=2e-12)


def test_a_new_largest_run_is_the_largest_of_both_studies_in_every_second_case():
    assert chances_above(1, 59)[0] == pytest.approx(0.5, abs=1e-14)


def test_no_rank_is_too_far_down_for_numbers():
    chances = chances_above(50_000, 1_000_000)
    assert chances[0] == 0.0 and chances[-1] == pytest.approx(1.0, abs=1e-9)
    # A rank lies above itself as often as below.
    assert chances[49_999] == pytest.approx(0.5, abs=0.002)


def test_the_range_holds_the_limit_of_a_study_made_again():
    generator = np.random.default_rng(4)
    known, new = generator.lognormal(size=(2, 2000, 181))
    ranges = np.array([repeated_limit(values, 5, 0.9) for values in known])
    limits = np.array([nth_largest(values, 5) for values in new])
    chances = chances_above(5, 181)
    above, below = chances[chances >= 0.9].min(), 1.0 - chances[chances <= 0.1].max()
    spread = 3.3 * np.sqrt(0.1 * 0.9 / 2000)
    assert np.mean(limits > ranges[:, 0]) == pytest.approx(above, abs=spread)
    assert np.mean(limits <= ranges[:, 1]) == pytest.approx(below, abs=spread)
    assert np.mean(limits > known.max(axis=1)) == pytest.approx(ranges[0, 2], abs=spread)


def test_a_largest_run_may_be_exceeded_without_end():
    lowest, highest, beyond = repeated_limit(np.arange(59.0), 1, 0.95)
    # Of both studies' runs the largest four are all known ones in 6 % of all orders, the largest five in 3 %.
    assert (lowest, highest, beyond) == (54.0, np.inf, 0.5)
