# SPDX-License-Identifier: GPL-3.0-or-later
"""The binomial distribution against scipy, and where scipy loses digits against sums of sixty digits."""

import hashlib
from decimal import Decimal, localcontext

import numpy as np
import pytest
from scipy.stats import beta, binom

from bridge_demolition_addon.engineering.statistics.binomial import binomial_cdf, binomial_cdf_inverse

pytestmark = pytest.mark.slow

RANDOM = np.random.default_rng(1)


def drawn(most_trials, count=500):
    """Trials, how often it happened around the mean of each, and chances, small ones more often."""
    trials = RANDOM.integers(1, most_trials + 1, count)
    chances = RANDOM.random(count) ** 3
    spread = np.sqrt(trials * chances * (1.0 - chances))
    happened = np.clip(np.rint(trials * chances + 3.0 * spread * RANDOM.normal(size=count)), 0, trials)
    return happened.astype(int), trials, chances


def exactly_at_most(happened, trials, chance):
    """The same to sixty digits, term by term."""
    with localcontext() as context:
        context.prec = 60
        chance = Decimal(chance)
        odds = chance / (1 - chance)
        total = term = (1 - chance) ** trials
        for count in range(1, happened + 1):
            term *= odds * (trials - count + 1) / count
            total += term
        return total


@pytest.mark.parametrize("most_trials", [1, 2, 5, 20, 100, 1000, 10_000])
def test_probabilities_are_those_of_scipy(most_trials):
    happened, trials, chances = drawn(most_trials)
    # scipy itself keeps 4e-13 at ten thousand trials.
    np.testing.assert_allclose(
        binomial_cdf(happened, trials, chances), binom.cdf(happened, trials, chances), atol=1e-12
    )


@pytest.mark.parametrize(
    "happened, trials, chance",
    [(0, 59, 0.05), (500, 10_000, 0.05), (9_990, 10_000, 0.999), (5_000, 100_000, 0.05), (49_800, 1_000_000, 0.05)],
)
def test_probabilities_are_exact_to_twelve_digits(happened, trials, chance):
    exact = exactly_at_most(happened, trials, chance)
    assert abs(Decimal(float(binomial_cdf(happened, trials, chance))) - exact) < Decimal("1e-12") * exact


@pytest.mark.parametrize("trials", [1, 7, 93])
def test_certain_and_impossible_things(trials):
    counts = np.arange(trials + 1)
    assert binomial_cdf(counts, trials, 0.0).tolist() == [1.0] * (trials + 1)
    assert binomial_cdf(counts, trials, 1.0).tolist() == [0.0] * trials + [1.0]


@pytest.mark.parametrize("trials", [1, 2, 59, 1000])
@pytest.mark.parametrize("probability", [0.01, 0.05, 0.5, 0.95])
def test_chances_are_those_of_scipy(trials, probability):
    counts = np.arange(trials + 1)
    exact = np.append(beta.ppf(1.0 - probability, counts[:-1] + 1, trials - counts[:-1]), 1.0)
    # scipy's inverse is good to some 1e-14; halving ends at 5e-20.
    np.testing.assert_allclose(binomial_cdf_inverse(counts, trials, probability), exact, rtol=1e-11)


def test_bits_are_the_same_on_every_machine():
    happened, trials = np.arange(93), 93
    results = [
        binomial_cdf(happened, trials, 0.05),
        binomial_cdf(happened * 500, 93_000, 0.3),
        binomial_cdf_inverse(happened, 93, 0.05),
    ]
    digest = hashlib.sha256(b"".join(result.astype("<f8").tobytes() for result in results)).hexdigest()
    assert digest[:16] == "fd9ab02172620500"
