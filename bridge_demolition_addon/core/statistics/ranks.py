"""Rank correlation: whether one quantity rises or falls with another, whatever the form of the curve.

References
----------
C. Spearman (1904), The proof and measurement of association between two things, American Journal of Psychology 15,
72-101.
"""

from __future__ import annotations

import numpy as np


def ranks_of(values: np.ndarray) -> np.ndarray:
    """Ranks (n,) of values (n,) from 1, the smallest; equal ones share the mean of theirs. Infinity is a value."""
    _, places, counts = np.unique(values, return_inverse=True, return_counts=True)
    last = np.cumsum(counts)
    return (last - (counts - 1) / 2.0)[places]


def rank_correlation(first: np.ndarray, second: np.ndarray) -> float:
    """Rank correlation of pairs (n,): 1 where both rise together, -1 where one falls; nan where one never changes."""
    one, other = (ranks - ranks.mean() for ranks in (ranks_of(first), ranks_of(second)))
    size = np.sqrt(np.square(one).sum() * np.square(other).sum())
    return float((one * other).sum() / size) if size > 0.0 else float("nan")
