# SPDX-License-Identifier: GPL-3.0-or-later
"""Distributions that inputs are drawn from, against scipy's."""

import math

import numpy as np
import pytest
from scipy import special, stats

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.study.distributions import (
    FARTHEST_DEVIATION,
    LEAST_PROBABILITY,
    Choice,
    Lognormal,
    Normal,
    Triangular,
    Uniform,
)

PROBABILITIES = [LEAST_PROBABILITY, 1e-9, *np.linspace(0.0005, 0.9995, 1000), 1.0 - 1e-9, 1.0 - LEAST_PROBABILITY]

DEVIATION_OF_30_PERCENT = math.sqrt(math.log(1.0 + 0.3**2))


@pytest.mark.parametrize(
    "own, of_scipy",
    [
        (Uniform(-2.0, 3.0), stats.uniform(-2.0, 5.0)),
        (Triangular(1.0, 2.0, 5.0), stats.triang(0.25, 1.0, 4.0)),
        (Triangular(1.0, 1.0, 5.0), stats.triang(0.0, 1.0, 4.0)),
        (Triangular(1.0, 5.0, 5.0), stats.triang(1.0, 1.0, 4.0)),
        (Normal(2400.0, 96.0), stats.norm(2400.0, 96.0)),
        (Normal(3.0, 1.0, highest=3.5), stats.truncnorm(-np.inf, 0.5, 3.0, 1.0)),
        (Normal(3.0, 1.0, 2.0, 3.5), stats.truncnorm(-1.0, 0.5, 3.0, 1.0)),
        (Normal(0.0, 1.0, 4.0, 4.5), stats.truncnorm(4.0, 4.5)),
        (Lognormal(30.0, 0.3), stats.lognorm(DEVIATION_OF_30_PERCENT, scale=30.0)),
    ],
)
def test_quantiles_are_those_of_scipy(own, of_scipy):
    found = [own.quantile(float(probability)) for probability in PROBABILITIES]
    np.testing.assert_allclose(found, of_scipy.ppf(PROBABILITIES), rtol=1e-13, atol=1e-13 * of_scipy.std())
    assert found == sorted(found)


def test_a_lognormal_distribution_has_its_median_and_its_coefficient_of_variation():
    of_scipy = stats.lognorm(DEVIATION_OF_30_PERCENT, scale=30.0)
    assert of_scipy.std() / of_scipy.mean() == pytest.approx(0.3, rel=1e-12)
    assert Lognormal(30.0, 0.3).quantile(0.5) == 30.0


def test_both_tails_have_as_many_digits():
    # scipy's truncnorm has 10 digits at 1 - 1e-9: each side is the other one in the mirror.
    for left, right in ((Normal(0.0, 1.0, -3.0), Normal(0.0, 1.0, highest=3.0)), (Normal(0.0, 1.0),) * 2):
        for probability in (2.0**-53, 2.0**-30, 2.0**-4):
            assert left.quantile(1.0 - probability) == -right.quantile(probability)


def test_a_lognormal_distribution_is_cut_off_by_scaling_up_the_rest():
    whole, cut = stats.lognorm(DEVIATION_OF_30_PERCENT, scale=30.0), Lognormal(30.0, 0.3, 20.0, 50.0)
    first, last = whole.cdf([20.0, 50.0])
    shares = np.array(PROBABILITIES)
    expected = whole.ppf(first + shares * (last - first))
    np.testing.assert_allclose([cut.quantile(float(share)) for share in shares], expected, rtol=1e-13)


def test_no_draw_of_a_normal_distribution_lies_beyond_its_ends():
    assert pytest.approx(-special.ndtri(2.0**-53), rel=1e-15) == FARTHEST_DEVIATION
    assert Normal(10.0, 2.0).tried == (10.0 - 2.0 * FARTHEST_DEVIATION, 10.0 + 2.0 * FARTHEST_DEVIATION)
    assert Normal(10.0, 2.0, 5.0, 11.0).tried == (5.0, 11.0)


def test_all_values_of_a_choice_are_equally_likely():
    choice = Choice(("TNT", "PETN", "RDX"))
    found = [choice.quantile(float(probability)) for probability in (np.arange(3000) + 0.5) / 3000]
    assert {value: found.count(value) for value in choice.values} == dict.fromkeys(choice.values, 1000)
    assert choice.quantile(1.0 - LEAST_PROBABILITY) == "RDX"


@pytest.mark.parametrize("ends", [(5.0, 6.0), (-8.0, -5.0)])
def test_ends_far_from_the_middle_are_refused(ends):
    with pytest.raises(ScenarioError, match="less than 1e-06 of this distribution"):
        Normal(0.0, 1.0, *ends)
    with pytest.raises(ScenarioError, match="less than 1e-06 of this distribution"):
        Lognormal(1.0, 0.01, 2.0, 3.0)
