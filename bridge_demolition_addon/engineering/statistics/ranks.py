"""Rank correlation: whether one quantity rises or falls with another, whatever the form of the curve.

C. Spearman (1904), The proof and measurement of association between two things, American Journal of Psychology 15,
72-101.
"""

from __future__ import annotations

import math

import numpy as np

from ..arrays import FloatArray


def ranks_of(values: FloatArray) -> FloatArray:
    """Ranks (n,) of values (n,) from 1, the smallest; equal ones share the mean of theirs. Infinity is a value."""
    _, positions, counts = np.unique(values, return_inverse=True, return_counts=True)
    last = np.cumsum(counts)
    return (last - (counts - 1) / 2.0)[positions]


def rank_correlation(first: FloatArray, second: FloatArray) -> float:
    """Rank correlation of pairs (n,): 1 where both rise together, -1 where one falls; nan where one never changes."""
    one, other = (ranks - ranks.mean() for ranks in (ranks_of(first), ranks_of(second)))
    size = np.sqrt(np.square(one).sum() * np.square(other).sum())
    return float((one * other).sum() / size) if size > 0.0 else float("nan")


def correlation_by_chance(pairs: int) -> float:
    """Return the size that rank correlations of at least 2 pairs stay below by chance in 19 cases of 20.

    Of quantities that have nothing to do with each other they scatter by 1 / √(n - 1) (Kendall and Gibbons 1990, Rank
    Correlation Methods, 5th edition), and nearly as a normal variable.
    """
    return min(1.0, _TWO_SIDED_95 / math.sqrt(pairs - 1.0))


_TWO_SIDED_95 = 1.959964
