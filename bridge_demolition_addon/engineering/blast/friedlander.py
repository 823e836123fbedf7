"""The Friedlander pulse p(τ) = p₀ (1 - τ/t_d) e^(-b τ/t_d), its impulse over any interval, and the decay b that fits.

The report's equation 1 (Friedlander 1946). τ is the time since the front arrived; the pulse is over at τ = t_d. The
suction that follows, the negative phase, is not modelled.
"""

from math import factorial

import numpy as np
from numpy.typing import ArrayLike

from ..arithmetic import exponential
from ..arrays import FloatArray

LARGEST_SHARE = 0.5
"""Share of p₀ t_d that the impulse of a pulse without decay has, a triangle; no decay gives more."""

_SERIES_BELOW = 0.5
_SERIES_TERMS = 15
"""Enough for the last term to be below rounding where the series is used: 0.5^15 / 15! is 2e-17."""

_SERIES = [
    [1.0 / (factorial(term) * (term + order + 1)) for order in range(3)] for term in reversed(range(_SERIES_TERMS))
]
"""Coefficients of the series of three moments, the last term first."""

_MOST_STEPS = 50


def pressure(peak: FloatArray, duration: FloatArray, decay: FloatArray, time: float | FloatArray) -> FloatArray:
    """Return the overpressure at times since the front arrived; 0 before that and after the positive phase.

    Parameters
    ----------
    peak, duration, decay : (...) float
        Peak overpressure (Pa), positive-phase duration (s) and decay b of the pulses.
    time : (...) float
        Times since the front arrived, s. All four broadcast.
    """
    part = _part_of_phase(time, duration)
    passed = np.clip(part, 0.0, 1.0)
    return np.where(part >= 0.0, peak * (1.0 - passed) * exponential(-decay * passed), 0.0)


def impulse_between(
    peak: FloatArray, duration: FloatArray, decay: FloatArray, start: FloatArray, end: FloatArray
) -> FloatArray:
    """Return the exact integral of the overpressure from `start` to `end`, s since the front arrived, in Pa·s.

    The interval may begin before the front and end after the pulse. It is integrated from its own beginning, so that
    short intervals lose nothing to the difference of two long ones.
    """
    first = np.clip(_part_of_phase(start, duration), 0.0, 1.0)
    length = np.clip(_part_of_phase(end, duration), 0.0, 1.0) - first
    exponent = decay * length
    whole, centre = _moments(exponent, 2)
    mean = (1.0 - first) * whole - length * centre
    return peak * duration * exponential(-decay * first) * length * mean


def whole_impulse(peak: FloatArray, duration: FloatArray, decay: FloatArray) -> FloatArray:
    """Return the impulse of the whole positive phase, p₀ t_d (b - 1 + e^(-b)) / b², in Pa·s."""
    return peak * duration * _share(np.asarray(decay, float))


def fitted(peak: FloatArray, duration: FloatArray, impulse: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return duration and decay of the pulses that have a peak, a duration and an impulse.

    No decay of at least 0 gives more than half of p₀ t_d. Where more is asked for, the pulse gets no decay and a longer
    duration, 2 i / p₀: peak and impulse are what moves and breaks a body, and tests measure them better than where a
    pulse that fades out ends. A negative decay would keep the duration, with a pressure that hardly falls and then
    drops at once.

    Parameters
    ----------
    peak, duration, impulse : (...) float
        Pa, s and Pa·s, of one shape; where the peak is 0 so are the results.
    """
    there = peak > 0.0
    triangle = np.divide(impulse, LARGEST_SHARE * peak, out=np.zeros_like(peak), where=there)
    share = np.full_like(peak, LARGEST_SHARE)
    np.divide(impulse, peak * duration, out=share, where=there & (triangle < duration))
    return np.where(there, np.maximum(duration, triangle), 0.0), decay_of(share)


def decay_of(share: FloatArray) -> FloatArray:
    """Return the decay b ≥ 0 at which the impulse is a share of p₀ t_d, from above 0 to `LARGEST_SHARE`.

    The share falls with b and is convex, and at b = 1/share - 2 it is not below what is asked for. So Newton's steps
    from there go one way, never overshoot, and are done after a handful.
    """
    share = np.asarray(share, float)
    decay = np.maximum(1.0 / share - 2.0, 0.0)
    for _ in range(_MOST_STEPS):
        whole, first, second = _moments(decay, 3)
        step = (whole - first - share) / (first - second)
        decay = np.maximum(decay + step, 0.0)
        if (abs(step) <= 1e-13 * (1.0 + decay)).all():
            break
    return decay


def _share(decay: FloatArray) -> FloatArray:
    mean, first = _moments(decay, 2)
    return mean - first


def _moments(exponent: FloatArray, count: int) -> list[FloatArray]:
    """Return ∫₀¹ uⁿ e^(-y u) du for y ≥ 0 and n from 0 on; a series where the closed form would lose its digits."""
    is_small = exponent < _SERIES_BELOW
    # Both are costly: most steps are so short, or so long, that one of them serves all pulses.
    if is_small.all():
        return list(_series_of_moments(exponent, count))
    if not is_small.any():
        return _closed_moments(exponent, count)
    series = _series_of_moments(np.minimum(exponent, _SERIES_BELOW), count)
    closed = _closed_moments(np.maximum(exponent, _SERIES_BELOW), count)
    return [np.where(is_small, *each) for each in zip(series, closed, strict=True)]


def _series_of_moments(exponent: FloatArray, count: int) -> FloatArray:
    """Return the moments (count, ...) by their series, for small exponents."""
    sums = np.zeros((count, *exponent.shape))
    for coefficients in np.array(_SERIES)[:, :count].reshape(-1, count, *[1] * exponent.ndim):
        np.multiply(exponent, sums, out=sums)
        np.subtract(coefficients, sums, out=sums)
    return sums


def _closed_moments(exponent: FloatArray, count: int) -> list[FloatArray]:
    """Return the moments in closed form, for exponents that are not small."""
    left = exponential(-exponent)
    moments = [(1.0 - left) / exponent]
    for order in range(1, count):
        moments.append((order * moments[-1] - left) / exponent)
    return moments


def _part_of_phase(time: ArrayLike, duration: ArrayLike) -> FloatArray:
    """Return time as part of the positive phase; a pulse without duration is over at once."""
    times, durations = np.broadcast_arrays(np.asarray(time, float), np.asarray(duration, float))
    part: FloatArray = np.divide(times, durations, out=np.full(times.shape, np.inf), where=durations > 0.0)
    return part
