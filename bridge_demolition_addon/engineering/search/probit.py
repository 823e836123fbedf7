"""The probability of success along one quantity as a normal distribution, from runs that succeeded or did not.

P(success at x) = Φ((x - μ) / σ). Runs overlap where a success is lower than a failure; only then is σ above 0 by
maximum likelihood (M. J. Silvapulle, 1981, Journal of the Royal Statistical Society B 43, 310-313). Limits by the
likelihood ratio hold with few runs, unlike limits by the curvature of the likelihood (B. T. Neyer, 1992, Sensitivity
testing and analysis, 16th International Pyrotechnics Seminar).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray
from ..statistics.normal import log_probability, normal_quantile, probability

_ITERATIONS = 100
_SAME = 1e-12
_STEEPEST = 1e6
"""Slope, by the range of the runs, that is as good as a jump."""


@dataclass(frozen=True, slots=True)
class SuccessCurve:
    """Curve of the probability of success; a spread of 0 where runs do not overlap: success from the median on."""

    median: float  # μ
    spread: float  # σ

    def quantile(self, probability: float) -> float:
        """Return the level at which success has a probability."""
        return self.median + self.spread * normal_quantile(probability)


@dataclass(frozen=True, slots=True, eq=False)
class LevelOutcomes:
    """Levels (n,) of runs, and whether each succeeded (n,)."""

    levels: FloatArray
    successes: BoolArray

    def __len__(self) -> int:
        return len(self.levels)

    @property
    def lowest_success(self) -> float:
        """∞ where there is none."""
        return float(self.levels[self.successes].min(initial=np.inf))

    @property
    def highest_failure(self) -> float:
        """-∞ where there is none."""
        return float(self.levels[~self.successes].max(initial=-np.inf))

    @property
    def overlap(self) -> bool:
        """Whether a success is lower than a failure, and successes are higher on the whole: σ is known then."""
        if not self.lowest_success < self.highest_failure:
            return False
        return bool(self.levels[self.successes].mean() > self.levels[~self.successes].mean())


def fitted(runs: LevelOutcomes) -> SuccessCurve | None:
    """Return the likeliest distribution; None where runs are all of one kind, or succeed the less the higher."""
    if runs.successes.all() or not runs.successes.any():
        return None
    if runs.overlap:
        return _likeliest(runs)
    if runs.lowest_success > runs.highest_failure:
        return SuccessCurve((runs.lowest_success + runs.highest_failure) / 2.0, 0.0)
    if runs.lowest_success == runs.highest_failure:
        return SuccessCurve(runs.lowest_success, 0.0)
    return None


def _likeliest(runs: LevelOutcomes) -> SuccessCurve:
    """By Newton's method: the logarithm of the likelihood is concave in 1 / σ and -μ / σ."""
    middle, unit = runs.levels.mean(), np.ptp(runs.levels)
    x = (runs.levels - middle) / unit
    signs = np.where(runs.successes, 1.0, -1.0)
    intercept, slope = 0.0, 1.0
    value = log_probability(signs * (intercept + slope * x)).sum()
    for _ in range(_ITERATIONS):
        argument = signs * (intercept + slope * x)
        mills = _mills(argument, log_probability(argument))
        first = signs * mills
        second = mills * (argument + mills)
        gradient = np.array((first.sum(), (first * x).sum()))
        a, b, c = second.sum(), (second * x).sum(), (second * x * x).sum()
        determinant = a * c - b * b
        step = np.array((c * gradient[0] - b * gradient[1], a * gradient[1] - b * gradient[0])) / determinant
        share = 1.0
        while True:
            tried = intercept + share * step[0], slope + share * step[1]
            better = log_probability(signs * (tried[0] + tried[1] * x)).sum()
            if better >= value or share < _SAME:
                break
            share /= 2.0
        (intercept, slope), gain, value = tried, better - value, max(better, value)
        if gain <= _SAME:
            break
    return SuccessCurve(middle - intercept / slope * unit, unit / slope)


def log_likelihood(runs: LevelOutcomes, normal: SuccessCurve) -> float:
    """Logarithm of the probability of these outcomes."""
    if normal.spread == 0.0:
        return 0.0 if runs.highest_failure <= normal.median <= runs.lowest_success else -np.inf
    signs = np.where(runs.successes, 1.0, -1.0)
    return float(log_probability(signs * (runs.levels - normal.median) / normal.spread).sum())


def profile_likelihood(runs: LevelOutcomes, position: float, chance: float) -> float:
    """Largest logarithm of the likelihood over the distributions with this probability of success at a level."""
    signs = np.where(runs.successes, 1.0, -1.0)
    offsets, base = runs.levels - position, normal_quantile(chance)
    offsets = offsets / max(np.ptp(runs.levels), abs(offsets).max(), 1e-300)

    # Concave in the slope, from 0, as good anywhere, to a jump.
    low, slope, high, most = 0.0, 0.0, _STEEPEST, -np.inf
    for _ in range(_ITERATIONS):
        arguments = signs * (base + slope * offsets)
        logarithms = log_probability(arguments)
        most = max(most, float(logarithms.sum()))
        mills = _mills(arguments, logarithms)
        rise = float((signs * offsets * mills).sum())
        low, high = (slope, high) if rise > 0.0 else (low, slope)
        step = rise / max(float((offsets * offsets * mills * (arguments + mills)).sum()), 1e-300)
        if high == 0.0 or abs(rise * step) <= _SAME:
            break
        slope = slope + step if low < slope + step < high else 0.5 * (low + high)
    return most


def crossing(function: Callable[[float], float], above: float, below: float, width: float) -> float:
    """Return where a function crosses 0, between arguments where it is above and below 0, within a width.

    By regula falsi with halved ends (M. Dowell, P. Jarratt, 1971, BIT 11, 168-174).
    """
    (one, of_one), (other, of_other) = (above, function(above)), (below, function(below))
    for _ in range(_ITERATIONS):
        middle = other - of_other * (other - one) / (of_other - of_one)
        value = function(middle)
        if value * of_other < 0.0:
            one, of_one = other, of_other
        else:
            of_one *= 0.5
        other, of_other = middle, value
        if value == 0.0 or abs(other - one) <= width:
            break
    return other


def limit(runs: LevelOutcomes, probability: float, confidence: float, side: int) -> float:
    """Return the upper (`side` 1) or lower (-1) limit of the level where success has a probability; ± ∞ without.

    Twice the logarithm of the ratio of likelihoods is compared with the F distribution with 2 and n - 2 degrees of
    freedom instead of χ², its limit for many runs: with few, the design follows the answers, and σ is estimated too
    small.
    """
    normal = fitted(runs)
    if normal is None or len(runs) < 4:
        return side * np.inf
    most = log_likelihood(runs, normal)
    freedom = len(runs) - 2
    # Half of twice the quantile of F, which has a closed form with 2 degrees of freedom.
    least = most - 0.5 * freedom * (float((1.0 - confidence) ** (-2.0 / freedom)) - 1.0)

    def above(position: float) -> float:
        return profile_likelihood(runs, position, probability) - least

    inside = normal.quantile(probability)
    step = max(normal.spread, np.ptp(runs.levels) / len(runs), 1e-12)
    for _ in range(60):
        outside = inside + side * step
        if above(outside) < 0.0:
            return crossing(above, inside, outside, 1e-6 * step)
        if step > 1e3 * max(np.ptp(runs.levels), normal.spread):
            break
        step *= 2.0
    return side * np.inf


def chance(normal: SuccessCurve, positions: FloatArray) -> FloatArray:
    """Probability of success (k,) at levels (k,)."""
    if normal.spread == 0.0:
        return np.where(positions >= normal.median, 1.0, 0.0)
    return probability((positions - normal.median) / normal.spread)


def _mills(values: FloatArray, logarithms: FloatArray) -> FloatArray:
    """φ / Φ (n,) at values (n,), the inverse of Mills' ratio, by the logarithms (n,) of Φ."""
    return np.exp(-0.5 * values * values - 0.5 * math.log(2.0 * math.pi) - logarithms)
