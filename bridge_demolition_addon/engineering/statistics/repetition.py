"""Scatter of a limit by rank: where it would lie if all runs were made again, with other inputs.

Two sets of independent runs of one distribution mix evenly. How many of the second lie below a run of the first depends
on its rank alone, whatever the distribution is: H. A. David and H. N. Nagaraja (2003), Order Statistics, 3rd edition,
section 7.3, prediction of order statistics.
"""

from __future__ import annotations

import numpy as np

from ..arithmetic import exponential, logarithm
from ..arrays import FloatArray


def chances_above(rank: int, runs: int) -> FloatArray:
    """Return how likely the value of a rank, in as many new runs, is above each known value (runs,), the largest first.

    The rank counts from the largest, which is 1. The chances increase.
    """
    # From the largest down, the new value of that rank comes after `rank` - 1 new ones and `before` known ones.
    before = np.arange(1.0, runs)
    none_before = (runs - np.arange(rank)) / (2.0 * runs - np.arange(rank))
    # Every order of known and new values is as likely as any other: the ratio of chances with one more before it.
    ratios = (rank - 1.0 + before) / before * (runs + 1.0 - before) / (2.0 * runs + 1.0 - rank - before)
    # By logarithms: of a thousandth rank no known value before it is too rare for a number.
    sizes = logarithm(none_before).sum() + np.concatenate([[0.0], np.cumsum(logarithm(ratios))])
    return np.minimum(np.cumsum(exponential(sizes)), 1.0)


def repeated_limit(values: FloatArray, rank: int, confidence: float) -> tuple[float, float, float]:
    """Return the range in which the limit by a rank, from the largest, of as many new runs would lie.

    These are the largest known value that a new limit exceeds with the confidence, or minus infinity; the smallest that
    it does not exceed with the confidence, or infinity; and how likely it exceeds all known values.
    """
    falling = np.sort(values)[::-1]
    chances = chances_above(rank, len(values))
    exceeded, not_exceeded = falling[chances >= confidence], falling[chances <= 1.0 - confidence]
    lowest = float(exceeded[0]) if len(exceeded) else -np.inf
    highest = float(not_exceeded[-1]) if len(not_exceeded) else np.inf
    return lowest, highest, float(chances[0])
