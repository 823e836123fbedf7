# SPDX-License-Identifier: GPL-3.0-or-later
"""Neyer's test of sensitivity: its published example, and searches whose truth is known."""

import numpy as np
import pytest
from scipy.special import ndtr, ndtri
from support.long_cases import long_but

from bridge_demolition_addon.engineering.search.neyer import NeyerTest, median_interval, most_informative
from bridge_demolition_addon.engineering.search.probit import LevelOutcomes, SuccessCurve, fitted, limit

SEARCHES = 60
"""Repetitions. `scripts/experiments/search_coverage.py` makes 500 of each kind, for docs/search.md."""


def test_levels_are_those_of_the_published_example():
    # B. T. Neyer (1994), Technometrics 36, 61-70: guesses 0.6 to 1.4 and 0.1, levels to two digits, 20 outcomes. His
    # estimates in the end, 5.3922 and 1.0412, follow from all twenty levels.
    outcomes = np.array([bool(int(digit)) for digit in "00000100000010101111"])
    levels = NeyerTest(0.6, 1.4, 0.1, lambda level: round(level, 2)).levels(outcomes, 20)
    assert levels[:10] == pytest.approx([1.0, 1.2, 1.4, 1.8, 2.6, 4.2, 3.4, 3.8, 4.0, 4.1])
    found = fitted(LevelOutcomes(levels, outcomes))
    assert (found.median, found.spread) == (pytest.approx(5.3922, abs=1e-4), pytest.approx(1.0412, abs=1e-4))


def test_the_best_place_for_a_trial_of_many_is_where_one_in_eight_or_seven_of_eight_succeed():
    # H. Chernoff (1979): for equally many trials on either side, at ± 1.138 σ.
    either = np.repeat((-1.138, 1.138), 500)
    assert abs(most_informative(either, SuccessCurve(0.0, 1.0))) == pytest.approx(1.138, abs=1e-3)


def search(median, spread, rng, trials, pending=0):
    """Runs of a search from 0 to 1 whose outcomes follow a known curve."""
    levels, outcomes = [], []

    def outcome(number):
        while len(outcomes) <= number:
            outcomes.append(rng.random() < ndtr((levels[len(outcomes)] - median) / spread))
        return outcomes[number]

    chosen = NeyerTest(0.0, 1.0, 0.1, pending=pending).played(outcome)
    for _ in range(trials):
        levels.append(next(chosen))
    outcome(trials - 1)
    return LevelOutcomes(np.array(levels), np.array(outcomes))


@pytest.mark.slow
@pytest.mark.parametrize("pending", [0, 3])
@pytest.mark.parametrize("spread", long_but([0.1], [0.03, 0.1]))
def test_limits_hold_as_often_as_they_say(pending, spread):
    rng = np.random.default_rng(2026)
    held = {"median": 0, "quantile": 0, "without a model": 0}
    errors = []
    for _ in range(SEARCHES):
        median = rng.uniform(0.2, 0.8)
        trials = search(median, spread, rng, 30, pending)
        held["median"] += limit(trials, 0.5, 0.95, -1) <= median <= limit(trials, 0.5, 0.95, 1)
        held["quantile"] += limit(trials, 0.9, 0.95, 1) >= median + spread * ndtri(0.9)
        _, low, high = median_interval(trials, 0.0, 1.0, 0.95)
        held["without a model"] += low <= median <= high
        errors.append(fitted(trials).median - median)
    # Of 60, 95 % are 57; fewer than 51 come in one of a thousand such tests (binomial). Both limits of the median hold
    # together in 90 %: fewer than 46 come in one of a thousand.
    assert held["quantile"] >= 51 and held["without a model"] >= 51 and held["median"] >= 46
    # Thirty trials on the best places have this standard error of the median (Fisher's information); few have more.
    least = spread / np.sqrt(30 * 0.607)
    assert np.sqrt(np.mean(np.square(errors))) < 2.5 * least


def test_a_search_is_closer_than_as_many_halvings():
    # A halving goes wrong for good as soon as one outcome does.
    rng = np.random.default_rng(7)
    of_searches, of_halvings = [], []
    for _ in range(SEARCHES):
        median = rng.uniform(0.2, 0.8)
        of_searches.append(fitted(search(median, 0.1, rng, 20)).median - median)
        low, high = 0.0, 1.0
        for _ in range(20):
            middle = (low + high) / 2.0
            low, high = (low, middle) if rng.random() < ndtr((middle - median) / 0.1) else (middle, high)
        of_halvings.append((low + high) / 2.0 - median)
    assert np.std(of_searches) < 0.8 * np.std(of_halvings)


def test_the_next_level_depends_on_outcomes_that_are_there():
    outcomes = [False, True, False, True, True, False, True]
    test = NeyerTest(0.0, 1.0, 0.1, pending=3)
    levels = test.levels(outcomes, 11)
    for known in range(len(outcomes)):
        assert (test.levels(outcomes[:known], known + 4) == levels[: known + 4]).all()
    assert (test.levels([], 4) == levels[:4]).all() and len(set(levels[:4])) == 4


def test_trials_that_do_not_overlap_have_a_median_and_no_spread():
    trials = LevelOutcomes(np.array([1.0, 2.0, 3.0, 4.0]), np.array([False, False, True, True]))
    assert fitted(trials) == SuccessCurve(2.5, 0.0)
    assert limit(trials, 0.9, 0.95, 1) >= 3.0
    assert fitted(LevelOutcomes(np.array([1.0, 2.0]), np.array([True, True]))) is None
    assert fitted(LevelOutcomes(np.array([1.0, 2.0, 3.0]), np.array([True, True, False]))) is None


def test_the_likeliest_curve_is_that_of_a_library():
    from scipy.optimize import minimize
    from scipy.special import log_ndtr

    rng = np.random.default_rng(3)
    levels = rng.normal(5.0, 2.0, 80)
    trials = LevelOutcomes(levels, rng.random(80) < ndtr((levels - 5.5) / 1.5))
    signs = np.where(trials.successes, 1.0, -1.0)
    found = fitted(trials)
    library = minimize(lambda at: -log_ndtr(signs * (levels - at[0]) / np.exp(at[1])).sum(), [5.0, 0.0], tol=1e-10)
    assert (found.median, found.spread) == pytest.approx((library.x[0], np.exp(library.x[1])), rel=1e-4)
