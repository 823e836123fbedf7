"""A straight line through measured points by least squares, and the band that new points lie in.

N. R. Draper and H. Smith (1998), Applied Regression Analysis, 3rd edition, sections 1.2 to 1.4 and 3.1.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import FloatArray
from .student import student_quantile


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
