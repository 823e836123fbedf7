"""Student's t distribution of whole degrees of freedom, with the same bits on every processor.

M. Abramowitz and I. A. Stegun (1964), Handbook of Mathematical Functions, 26.7.3 and 26.7.4: with θ = arctan(t / √ν),
finite series in the cosine of θ.
"""

from __future__ import annotations

import math

from ..arithmetic import arctangent

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
