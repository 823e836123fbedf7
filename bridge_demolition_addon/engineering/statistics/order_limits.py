"""Limits by rank: the largest run, or one of the next, as a limit for all runs to come, whatever their distribution.

Runs have to be independent and of one distribution, and their number and the rank have to be fixed before they are
seen.

One count serves three questions, because in each of them this number of runs touches the limit, and the part of the
distribution that lies outside is then at most theirs:

- the k-th largest of one quantity as its limit (Wilks 1941): k runs;
- the largest of each of m quantities as limits of the m at once (Guba, Makai and Pál 2003): m runs;
- the smallest shape with d free dimensions around all runs (Campi and Garatti 2008): d runs.

S. S. Wilks (1941), Determination of sample sizes for setting tolerance limits, Annals of Mathematical Statistics 12,
91-96. A. Guba, M. Makai and L. Pál (2003), Statistical aspects of best estimate method, Reliability Engineering and
System Safety 80, 217-232. M. C. Campi and S. Garatti (2008), The exact feasibility of randomized solutions of uncertain
convex programs, SIAM Journal on Optimization 19, 1211-1230: their bound, which for d dimensions equals the bound of the
d-th largest in one dimension.

Two sets of independent runs of one distribution mix evenly. How many of the second lie below a run of the first depends
on its rank alone, whatever the distribution is: H. A. David and H. N. Nagaraja (2003), Order Statistics, 3rd edition,
section 7.3, prediction of order statistics.
"""

from __future__ import annotations

import numpy as np

from ..arithmetic import exponential, logarithm
from ..arrays import FloatArray, IntArray
from .binomial import binomial_cdf, upper_limit


def achieved_confidence(support_count: int, runs: int, quantile: float) -> float:
    """Return how sure it is that at least a share `quantile` of the runs to come stays within a limit.

    `support_count` runs set the limit: for the k-th largest as limit of one quantity, k.
    """
    return float(1.0 - binomial_cdf(support_count - 1, runs, 1.0 - quantile))


def least_runs(quantile: float, confidence: float, support_count: int = 1) -> int:
    """Return how many runs make `achieved_confidence` no less than a confidence above 0 and below 1."""
    enough = support_count
    while achieved_confidence(support_count, enough, quantile) < confidence:
        enough *= 2
    too_few = enough // 2 if enough > support_count else support_count - 1
    while enough - too_few > 1:
        middle = (too_few + enough) // 2
        if achieved_confidence(support_count, middle, quantile) < confidence:
            too_few = middle
        else:
            enough = middle
    return enough


def most_support(runs: int, quantile: float, confidence: float) -> int:
    """Return the rank to use, from the largest: the highest that the runs allow; 0 where they are too few."""
    return int(most_support_by_runs(np.array([runs]), quantile, confidence)[0])


def most_support_by_runs(runs: IntArray, quantile: float, confidence: float) -> FloatArray:
    """Return `most_support` of each number of runs (n,)."""
    allowed, refused = np.zeros(runs.shape, int), runs + 1
    while (refused - allowed > 1).any():
        middle = np.where(refused - allowed > 1, (allowed + refused) // 2, allowed)
        # At no rank at all everything stays within: a closed search keeps its answer.
        sure = (middle == allowed) | (binomial_cdf(np.maximum(middle - 1, 0), runs, 1.0 - quantile) <= 1.0 - confidence)
        allowed, refused = np.where(sure, middle, allowed), np.where(sure, refused, middle)
    return allowed


def coverage(support_count: int, runs: int, confidence: float) -> float:
    """Return the largest share of the runs to come that stays within the limit with the confidence."""
    return 1.0 - float(upper_limit(support_count - 1, runs, confidence))


def nth_largest(values: FloatArray, rank: int) -> float:
    """Return the value (n,) of a rank from the largest, which is 1; infinite values count as largest."""
    return float(np.partition(values, len(values) - rank)[len(values) - rank])


def limits_by_runs(values: FloatArray, quantile: float, confidence: float, rank: int) -> tuple[IntArray, FloatArray]:
    """Return numbers of runs (m,), and the limit (m,) by these first runs, of values (n,) in the order of the runs.

    The numbers are up to `_MOST_POINTS` of those that allow a limit, all included. `rank` is the highest from the
    largest that is used: with many runs the one fixed beforehand, with few a lower one.
    """
    first = least_runs(quantile, confidence)
    if len(values) < first:
        return np.zeros(0, int), np.zeros(0)
    points = min(_MOST_POINTS, len(values) - first + 1)
    runs = np.unique(np.rint(np.linspace(first, len(values), points)).astype(int))
    ranks = np.minimum(most_support_by_runs(runs, quantile, confidence), rank)
    limits = [nth_largest(values[:count], allowed) for count, allowed in zip(runs, ranks, strict=True)]
    return runs, np.array(limits)


_MOST_POINTS = 400
"""More could not be seen apart in a chart."""


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
