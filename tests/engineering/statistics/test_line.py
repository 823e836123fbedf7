# SPDX-License-Identifier: GPL-3.0-or-later
"""Student's t against its tables, and a line by least squares against values that NIST certifies."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.statistics.line import fitted_line, probability_within, student_quantile

NORRIS = """0.2 0.1 337.4 338.8 118.2 118.1 884.6 888.0 10.1 9.2 226.5 228.1 666.3 668.5 996.3 998.5 448.6 449.1
777.0 778.9 558.2 559.2 0.4 0.3 0.6 0.1 775.5 778.1 666.9 668.8 338.0 339.3 447.5 448.9 11.6 10.8 556.0 557.7
228.1 228.3 995.8 998.0 887.6 888.8 120.2 119.6 0.3 0.3 0.3 0.6 556.8 557.6 339.1 339.3 887.2 888.0 999.0 998.5
779.0 778.9 11.1 10.2 118.3 117.6 229.2 228.9 669.1 668.4 448.9 449.2 0.5 0.2"""
"""NIST, Statistical Reference Datasets, Norris: x and y of 36 observations of ozone monitors, of the public domain."""


def norris():
    return np.array(NORRIS.split(), float).reshape(-1, 2).T


OF_95 = {1: 12.706, 2: 4.303, 3: 3.182, 4: 2.776, 5: 2.571, 10: 2.228, 30: 2.042, 120: 1.980}
OTHERS = [(0.99, 3, 5.841), (0.99, 10, 3.169), (0.80, 7, 1.415), (0.5, 1, 1.0)]


@pytest.mark.parametrize(
    "confidence, freedom, tabulated", [*((0.95, freedom, t) for freedom, t in OF_95.items()), *OTHERS]
)
def test_quantiles_are_those_of_the_table(confidence, freedom, tabulated):
    """M. Abramowitz and I. A. Stegun (1964), table 26.10, to its three digits; of one degree, Cauchy's tangent."""
    assert student_quantile(confidence, freedom) == pytest.approx(tabulated, abs=6e-4)


def test_the_chance_of_one_degree_of_freedom_is_that_of_cauchy_and_of_two_is_closed():
    for value in (0.0, 0.3, 1.0, 7.0, 300.0):
        assert probability_within(value, 1) == pytest.approx(2.0 / np.pi * np.arctan(value), abs=1e-15)
        assert probability_within(value, 2) == pytest.approx(value / np.sqrt(2.0 + value * value), abs=1e-15)


def test_the_line_is_the_certified_one():
    line = fitted_line(*norris())
    assert line.points == 36
    assert line.intercept == pytest.approx(-0.262323073774029, rel=1e-10)
    assert line.slope == pytest.approx(1.00211681802045, rel=1e-12)
    assert line.scatter == pytest.approx(0.884796396144373, rel=1e-11)


def test_the_band_has_the_certified_deviation_of_the_intercept_in_it():
    """At 0 the line itself deviates by 0.232818234301152; a new point by this and by the scatter together."""
    line = fitted_line(*norris())
    deviation = line.half_band(0.0, 0.95) / student_quantile(0.95, 34)
    assert deviation == pytest.approx(np.hypot(0.232818234301152, line.scatter), rel=1e-10)
