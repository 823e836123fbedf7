# SPDX-License-Identifier: GPL-3.0-or-later
"""The normal distribution against scipy."""

import math

import numpy as np
import pytest
from scipy import special

from bridge_demolition_addon.engineering.statistics.normal import (
    log_probability,
    normal_probability,
    normal_quantile,
    probability,
)


def test_normal_quantiles_are_those_of_scipy_to_their_last_digits():
    probabilities = np.concatenate(
        [
            [2.0**-53, 1e-9],
            np.linspace(0.0005, 0.9995, 1000),
            [1.0 - 1e-9, 1.0 - 2.0**-53],
            10.0 ** -np.arange(1.0, 300.0, 0.7),
        ]
    )
    found = [normal_quantile(float(probability)) for probability in probabilities]
    np.testing.assert_allclose(found, special.ndtri(probabilities), rtol=2e-15)


@pytest.mark.slow
def test_normal_probabilities_are_those_of_scipy():
    # The inverse of what has 16 digits: at -37 a digit of the value is 1e-13 of the probability.
    values = np.linspace(-37.0, 8.0, 100)
    np.testing.assert_allclose([normal_probability(float(value)) for value in values], special.ndtr(values), rtol=1e-12)
    assert normal_probability(0.0) == 0.5
    assert (normal_probability(-math.inf), normal_probability(math.inf)) == (0.0, 1.0)


def test_below_the_quantile_of_the_smallest_number_there_is_no_probability():
    assert normal_quantile(5e-324) > -38.5
    assert normal_probability(-38.4) > 0.0 == normal_probability(-38.6)


def test_logarithms_of_probabilities_are_those_of_scipy_far_into_the_tail():
    edges = math.sqrt(2.0) * np.array([0.46875, 4.0])
    beside = np.concatenate([np.nextafter(edges, 0.0), edges, np.nextafter(edges, 9.0)])
    values = np.concatenate([np.linspace(-40.0, 40.0, 20_001), [-1e6, -1e3, 0.0, 1e3, 1e6], beside, -beside])
    np.testing.assert_allclose(log_probability(values), special.log_ndtr(values), rtol=1e-14, atol=3e-16)
    np.testing.assert_allclose(probability(values), special.ndtr(values), rtol=1e-12, atol=1e-300)
