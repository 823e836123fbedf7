# SPDX-License-Identifier: GPL-3.0-or-later
"""Limits of a probability against scipy and the numbers that reports print."""

import numpy as np
import pytest
from scipy.stats import binomtest
from support.long_cases import long_but

from bridge_demolition_addon.engineering.statistics.binomial import lower_limit, upper_limit

pytestmark = pytest.mark.slow


@pytest.mark.parametrize(
    "runs, left, limit",
    [(59, 0, "0.0495"), (93, 1, "0.0500"), (124, 2, "0.0499"), (299, 0, "0.00997"), (1000, 0, "0.0030")],
)
def test_limits_are_those_of_the_table_to_its_last_digit(runs, left, limit):
    digits = len(limit) - 2
    assert f"{upper_limit(left, runs, 0.95):.{digits}f}" == limit


@pytest.mark.parametrize("trials", [1, 10, 59, 93, 1000])
@pytest.mark.parametrize("confidence", long_but([0.95], [0.5, 0.9, 0.95, 0.999]))
def test_limits_are_those_of_scipy(trials, confidence):
    for happened in {0, 1, trials // 3, trials - 1, trials}:
        upper = binomtest(happened, trials, alternative="less").proportion_ci(confidence, method="exact").high
        lower = binomtest(happened, trials, alternative="greater").proportion_ci(confidence, method="exact").low
        # scipy looks for its root to about 1e-12.
        assert upper_limit(happened, trials, confidence) == pytest.approx(upper, abs=1e-10)
        assert lower_limit(happened, trials, confidence) == pytest.approx(lower, abs=1e-10)


def test_what_never_happened_has_the_limit_of_a_power():
    runs = np.array([1, 59, 299, 100_000])
    limits = [upper_limit(0, run, 0.95) for run in runs]
    assert limits == pytest.approx(1.0 - 0.05 ** (1.0 / runs), rel=1e-10)


def test_limits_of_many_counts_come_at_once():
    counts = np.array([0, 2, 93])
    assert upper_limit(counts, 93, 0.95).tolist() == [upper_limit(count, 93, 0.95) for count in counts]
