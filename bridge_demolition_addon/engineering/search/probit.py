"""The probability of success along one quantity as a normal distribution, from runs that succeeded or did not.

P(success at x) = Φ((x - μ) / σ). Runs overlap where a success is lower than a failure; only then is σ above 0 by
maximum likelihood (M. J. Silvapulle, 1981, Journal of the Royal Statistical Society B 43, 310-313). Limits are those of
the likelihood ratio, which hold with few runs, unlike those by the curvature of the likelihood (B. T. Neyer, 1992,
Sensitivity testing and analysis, 16th International Pyrotechnics Seminar).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy  # loads its parts, which take long, as they are asked for

from ..arrays import BoolArray, FloatArray

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
        return self.median + self.spread * float(scipy.special.ndtri(probability))


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
    value = scipy.special.log_ndtr(signs * (intercept + slope * x)).sum()
    for _ in range(_ITERATIONS):
        argument = signs * (intercept + slope * x)
        mills = np.exp(-0.5 * argument * argument - 0.5 * np.log(2.0 * np.pi) - scipy.special.log_ndtr(argument))
        first = signs * mills
        second = mills * (argument + mills)
        gradient = np.array((first.sum(), (first * x).sum()))
        a, b, c = second.sum(), (second * x).sum(), (second * x * x).sum()
        determinant = a * c - b * b
        step = np.array((c * gradient[0] - b * gradient[1], a * gradient[1] - b * gradient[0])) / determinant
        share = 1.0
        while True:
            tried = intercept + share * step[0], slope + share * step[1]
            better = scipy.special.log_ndtr(signs * (tried[0] + tried[1] * x)).sum()
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
    return float(scipy.special.log_ndtr(signs * (runs.levels - normal.median) / normal.spread).sum())


def profile_likelihood(runs: LevelOutcomes, position: float, probability: float) -> float:
    """Largest logarithm of the likelihood of all distributions with this probability of success at a level."""
    signs = np.where(runs.successes, 1.0, -1.0)
    offsets, base = runs.levels - position, float(scipy.special.ndtri(probability))
    unit = max(np.ptp(runs.levels), abs(offsets).max(), 1e-300)

    def loss(slope: float) -> float:
        return -float(scipy.special.log_ndtr(signs * (base + slope * offsets / unit)).sum())

    # Concave in the slope, from 0, as good anywhere, to a jump.
    high = 1.0
    while high < _STEEPEST and loss(2.0 * high) < loss(high):
        high *= 2.0
    least = scipy.optimize.minimize_scalar(
        loss, bounds=(0.0, 4.0 * high), method="bounded", options={"xatol": 1e-7 * high}
    )
    return -min(float(least.fun), loss(0.0), loss(_STEEPEST))


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
    least = most - float(scipy.special.fdtri(2, len(runs) - 2, confidence))

    def above(position: float) -> float:
        return profile_likelihood(runs, position, probability) - least

    inside = normal.quantile(probability)
    step = max(normal.spread, np.ptp(runs.levels) / len(runs), 1e-12)
    for _ in range(60):
        outside = inside + side * step
        if above(outside) < 0.0:
            return float(scipy.optimize.brentq(above, inside, outside, xtol=1e-6 * step))
        if step > 1e3 * max(np.ptp(runs.levels), normal.spread):
            break
        step *= 2.0
    return side * np.inf


def chance(normal: SuccessCurve, positions: FloatArray) -> FloatArray:
    """Probability of success (k,) at levels (k,)."""
    if normal.spread == 0.0:
        return np.where(positions >= normal.median, 1.0, 0.0)
    chances: FloatArray = scipy.special.ndtr((positions - normal.median) / normal.spread)
    return chances
