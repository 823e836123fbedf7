"""Probability that something happens so often in independent runs, with the same bits on every processor.

All limits of this package rest on it: the binomial distribution is the regularised incomplete beta function of whole
numbers, P(at most k of n) = I_(1-p)(n - k, k + 1). C. Loader (2000), Fast and Accurate Computation of Binomial
Probabilities: `_probability_of`, its Stirling errors and deviances. Limits for a proportion: C. J. Clopper and E. S.
Pearson (1934), The use of confidence or fiducial limits illustrated in the case of the binomial, Biometrika 26,
404-413.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from ..arithmetic import coefficients, exponential, logarithm, power
from ..arrays import FloatArray

_HALVINGS = 64
"""Leave 5e-20 of the chances between 0 and 1, which is nine digits of one in ten billions."""

_STIRLING_ERRORS = np.array(
    coefficients(
        "0.0 8.10614667953272582196702e-02 4.13406959554092940938221e-02 2.76779256849983391487892e-02 "
        "2.07906721037650931115228e-02 1.66446911898211921631948e-02 1.38761288230707479987457e-02 "
        "1.18967099458917700950557e-02 1.04112652619720964556590e-02 9.25546218271273291772864e-03 "
        "8.33056343336287125646931e-03 7.57367548795184079497202e-03 6.94284010720952986566415e-03 "
        "6.40899418800420706843965e-03 5.95137011275884773562442e-03 5.55473355196280137103868e-03"
    )
)
"""ln(n!) less Stirling's formula, for n up to 15."""

_STIRLING_SERIES = 1.0 / 12.0, -1.0 / 360.0, 1.0 / 1260.0, -1.0 / 1680.0, 1.0 / 1188.0

_NEAR = 0.1
_SERIES_TERMS = 9
"""Of a deviance near its mean: 0.1 to the power of 19 is less than what rounding leaves."""


def binomial_cdf(happened: ArrayLike, runs: ArrayLike, chance: ArrayLike) -> FloatArray:
    """Probability that something with a chance happens at most `happened` times in `runs` independent runs.

    It is within 1e-12 of the exact probability for up to a million runs. Numbers, or arrays of one shape.
    """
    happened, runs, chance = np.broadcast_arrays(
        np.asarray(happened, float), np.asarray(runs, float), np.asarray(chance, float)
    )
    # The smaller end of the distribution is summed, in which terms fall from the first on.
    lower = happened <= runs * chance
    end = _end_sum(np.where(lower, happened, runs - happened - 1.0), runs, np.where(lower, chance, 1.0 - chance))
    return np.where(lower, end, 1.0 - end)[()]


def binomial_cdf_inverse(happened: ArrayLike, runs: ArrayLike, probability: ArrayLike) -> FloatArray:
    """The chance at which `binomial_cdf` has this probability; 1 where it happened in all runs."""
    happened, runs, probability = np.broadcast_arrays(
        np.asarray(happened, float), np.asarray(runs, float), np.asarray(probability, float)
    )
    lowest, highest = np.zeros(happened.shape), np.ones(happened.shape)
    for _ in range(_HALVINGS):
        middle = (lowest + highest) / 2.0
        likely = binomial_cdf(happened, runs, middle) > probability
        lowest, highest = np.where(likely, middle, lowest), np.where(likely, highest, middle)
    return highest[()]


def upper_limit(happened: ArrayLike, runs: int, confidence: float) -> FloatArray:
    """Largest probability of what happened in this many independent runs, with a one-sided confidence."""
    return binomial_cdf_inverse(happened, runs, 1.0 - confidence)


def lower_limit(happened: ArrayLike, runs: int, confidence: float) -> FloatArray:
    """Smallest probability of what happened in this many independent runs, with a one-sided confidence."""
    return 1.0 - upper_limit(runs - np.asarray(happened), runs, confidence)


def _end_sum(happened: FloatArray, runs: FloatArray, chance: FloatArray) -> FloatArray:
    """Probability of 0 to `happened`, where that is not above the mean; 0 below 0."""
    there = happened >= 0.0
    last = np.where(there, happened, 0.0)
    term = np.where(there, _probability_of(last, runs, chance), 0.0)
    odds = np.divide(1.0 - chance, chance, out=np.zeros(chance.shape), where=chance > 0.0)
    total = term
    while (term > np.finfo(float).eps / 16.0 * total).any():
        # From k to k - 1; where k is 0 nothing follows.
        term = term * (last / (runs - last + 1.0) * odds)
        total = total + term
        last = np.maximum(last - 1.0, 0.0)
    return total


def _probability_of(happened: FloatArray, runs: FloatArray, chance: FloatArray) -> FloatArray:
    """Probability of exactly this number."""
    missed, rest = runs - happened, 1.0 - chance
    inside = (happened > 0.0) & (missed > 0.0) & (chance > 0.0) & (rest > 0.0)
    k, m, n = np.where(inside, happened, 1.0), np.where(inside, missed, 1.0), np.where(inside, runs, 2.0)
    p, q = np.where(inside, chance, 0.5), np.where(inside, rest, 0.5)
    corrections = _stirling_error(n) - _stirling_error(k) - _stirling_error(m)
    deviances = _deviance(k, n * p) + _deviance(m, n * q)
    between = exponential(corrections - deviances) * np.sqrt(n / (2.0 * math.pi * k * m))
    at_ends = np.where(happened == 0.0, power(rest, runs), np.where(missed == 0.0, power(chance, runs), 0.0))
    return np.where(inside, between, at_ends)


def _stirling_error(n: FloatArray) -> FloatArray:
    """ln(n!) less Stirling's formula, (n + 1/2) ln n - n + ln(2π) / 2."""
    known = n < len(_STIRLING_ERRORS)
    inverse = 1.0 / np.where(known, 1.0, n)
    square, series = inverse * inverse, np.zeros(n.shape)
    for coefficient in reversed(_STIRLING_SERIES):
        series = coefficient + square * series
    return np.where(known, _STIRLING_ERRORS[np.where(known, n, 0.0).astype(int)], series * inverse)


def _deviance(x: FloatArray, mean: FloatArray) -> FloatArray:
    """x ln(x / mean) + mean - x, without loss of digits near the mean."""
    difference = x - mean
    ratio = difference / (x + mean)
    square, series = ratio * ratio, np.zeros(x.shape)
    for number in range(_SERIES_TERMS, 0, -1):
        series = square * (1.0 / (2.0 * number + 1.0) + series)
    near = difference * ratio + 2.0 * x * ratio * series
    return np.where(np.abs(ratio) < _NEAR, near, x * logarithm(x / mean) - difference)
