"""A straight line through measured points by least squares, and the band that new points lie in.

N. R. Draper and H. Smith (1998), Applied Regression Analysis, 3rd edition, sections 1.2 to 1.4 and 3.1.

Student's t distribution of whole degrees of freedom has the same bits on every processor: M. Abramowitz and
I. A. Stegun (1964), Handbook of Mathematical Functions, 26.7.3 and 26.7.4: with θ = arctan(t / √ν), finite series in
the cosine of θ.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..arithmetic import arctangent
from ..arrays import FloatArray


@dataclass(frozen=True, slots=True)
class FittedLine:
    """A line y = intercept + slope x, and what its points were.

    `scatter` is the standard deviation of the points about it, `middle` and `spread` mean and standard deviation of
    their x.
    """

    intercept: float
    slope: float
    scatter: float
    points: int
    middle: float
    spread: float

    def at(self, x: ArrayLike) -> FloatArray:
        """Return the line's values at x."""
        return self.intercept + self.slope * np.asarray(x, float)

    def half_band(self, x: ArrayLike, confidence: float) -> FloatArray:
        """Return how far above or below the line one new point at x lies at most, with a confidence.

        t s √(1 + 1/n + (x - x̄)² / Σ(x - x̄)²), section 3.1, with n - 2 degrees of freedom.
        """
        away = np.asarray(x, float) - self.middle
        squares = (self.points - 1) * self.spread * self.spread
        t = student_quantile(confidence, self.points - 2)
        band: FloatArray = t * self.scatter * np.sqrt(1.0 + 1.0 / self.points + away * away / squares)
        return band


def fitted_line(x: FloatArray, y: FloatArray) -> FittedLine:
    """Return the line of least squares through three or more points (n,), not all of one x."""
    count = len(x)
    middle, height = float(x.mean()), float(y.mean())
    away = x - middle
    squares = float((away * away).sum())
    slope = float((away * (y - height)).sum()) / squares
    rest = y - height - slope * away
    scatter = np.sqrt((rest * rest).sum() / (count - 2))
    return FittedLine(
        height - slope * middle, slope, float(scatter), count, middle, float(np.sqrt(squares / (count - 1)))
    )


_HALVINGS = 200
"""Leave no number between in any case: the range of numbers is halved until then."""

_FARTHEST = 1e9
"""A value that no quantile of this program reaches: that of 0.9999 with one degree of freedom is 3183."""


def probability_within(value: float, freedom: int) -> float:
    """Return how likely a variable with degrees of freedom, 1 or more, is no larger than a value of 0 or more."""
    root = math.sqrt(freedom + value * value)
    sine, square = value / root, freedom / (freedom + value * value)
    is_odd = freedom % 2 == 1
    term, total = (math.sqrt(square), math.sqrt(square)) if is_odd else (1.0, 1.0)
    for number in range(3 if is_odd else 2, freedom - 1, 2):
        term *= square * (number - 1) / number
        total += term
    if not is_odd:
        return sine * total
    angle = float(arctangent(value / math.sqrt(freedom)))
    return (angle + (sine * total if freedom > 1 else 0.0)) * 2.0 / math.pi


def student_quantile(confidence: float, freedom: int) -> float:
    """Return the size that a variable with degrees of freedom, 1 or more, stays within with a confidence below 1."""
    low, high = 0.0, _FARTHEST
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if probability_within(middle, freedom) < confidence else (low, middle)
    return 0.5 * (low + high)
