"""The standard normal distribution; its quantiles have the same bits on every processor."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import reduce

import numpy as np

from ..arithmetic import coefficients, logarithm
from ..arrays import FloatArray

_CENTRE = (
    coefficients(
        "3.3871328727963666080 1.3314166789178437745e2 1.9715909503065514427e3 1.3731693765509461125e4 "
        "4.5921953931549871457e4 6.7265770927008700853e4 3.3430575583588128105e4 2.5090809287301226727e3"
    ),
    coefficients(
        "1.0 4.2313330701600911252e1 6.8718700749205790830e2 5.3941960214247511077e3 "
        "2.1213794301586595867e4 3.9307895800092710610e4 2.8729085735721942674e4 5.2264952788528545610e3"
    ),
)
_SHOULDER = (
    coefficients(
        "1.42343711074968357734 4.63033784615654529590 5.76949722146069140550 3.64784832476320460504 "
        "1.27045825245236838258 2.41780725177450611770e-1 2.27238449892691845833e-2 7.74545014278341407640e-4"
    ),
    coefficients(
        "1.0 2.05319162663775882187 1.67638483018380384940 6.89767334985100004550e-1 "
        "1.48103976427480074590e-1 1.51986665636164571966e-2 5.47593808499534494600e-4 1.05075007164441684324e-9"
    ),
)
_TAIL = (
    coefficients(
        "6.65790464350110377720 5.46378491116411436990 1.78482653991729133580 2.96560571828504891230e-1 "
        "2.65321895265761230930e-2 1.24266094738807843860e-3 2.71155556874348757815e-5 2.01033439929228813265e-7"
    ),
    coefficients(
        "1.0 5.99832206555887937690e-1 1.36929880922735805310e-1 1.48753612908506148525e-2 "
        "7.86869131145613259100e-4 1.84631831751005468180e-5 1.42151175831644588870e-7 2.04426310338993978564e-15"
    ),
)

_BELOW_ALL = -38.5
"""Value that the quantile of the smallest number above 0, -38.47, does not reach."""

_FAR = -30.0
"""Value from which on downwards terms of an asymptotic series are enough."""


def normal_quantile(probability: float) -> float:
    """Return the value that a standard normal variable stays below with a probability, above 0 and below 1.

    M. J. Wichura (1988), Algorithm AS 241: The percentage points of the normal distribution, Applied Statistics 37,
    477-484, PPND16: within about 1e-16, relative.
    """
    from_middle = probability - 0.5
    if abs(from_middle) <= 0.425:
        return from_middle * _ratio(_CENTRE, 0.180625 - from_middle * from_middle)
    depth = math.sqrt(-float(logarithm(min(probability, 1.0 - probability))))
    size = _ratio(_SHOULDER, depth - 1.6) if depth <= 5.0 else _ratio(_TAIL, depth - 5.0)
    return math.copysign(size, from_middle)


def normal_probability(value: float) -> float:
    """Return the probability that a standard normal variable is below a value: the inverse of `normal_quantile`.

    By halving, until no number lies between.
    """
    if value < _BELOW_ALL:
        return 0.0
    if value > 0.0:
        return 1.0 - normal_probability(-value)
    low, high = 0.0, 0.5
    while low < (middle := 0.5 * (low + high)) < high:
        low, high = (low, middle) if normal_quantile(middle) > value else (middle, high)
    return low if value < 0.0 else 0.5


def probability(values: FloatArray) -> FloatArray:
    """Return the probabilities (n,) that a standard normal variable is below values (n,), by the library of C."""
    return np.array([0.5 * math.erfc(-value / math.sqrt(2.0)) for value in values.tolist()])


def log_probability(values: FloatArray) -> FloatArray:
    """Return their logarithms (n,), also where they are too small for a number.

    Far down by Mills' ratio (M. Abramowitz, I. A. Stegun, 1964, Handbook of Mathematical Functions, 26.2.12).
    """
    scaled = logarithm(np.array([_scaled_probability(value) for value in values.tolist()]))
    return np.where(values > _FAR, scaled, scaled - 0.5 * values * values)


def _scaled_probability(value: float) -> float:
    """Return the probability of less, far down times exp(value² / 2)."""
    if value > 0.0:
        return 1.0 - 0.5 * math.erfc(value / math.sqrt(2.0))
    if value > _FAR:
        return 0.5 * math.erfc(-value / math.sqrt(2.0))
    part = 1.0 / (value * value)
    series = -part * (1.0 - part * (3.0 - part * (15.0 - part * 105.0)))
    return (1.0 + series) / (-value * math.sqrt(2.0 * math.pi))


def _ratio(polynomials: tuple[Sequence[float], Sequence[float]], x: float) -> float:
    """Return the ratio of two polynomials, by Horner."""
    upper, lower = (reduce(lambda value, part: part + x * value, reversed(parts), 0.0) for parts in polynomials)
    return upper / lower
