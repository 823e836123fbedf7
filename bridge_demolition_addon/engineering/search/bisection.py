"""Position where the probability of success passes one half, without a model of how it rises: probabilistic bisection.

Each run votes for the median to be below or above it, and is right with a probability that is taken to be the same
everywhere: R. Waeber, P. I. Frazier and S. G. Henderson (2013), Bisection search with noisy responses, SIAM Journal on
Control and Optimization 51, 2261-2279. Near the median runs are hardly better than a coin, so the interval is wide.
"""

from __future__ import annotations

import numpy as np

from .probit import LevelOutcomes

RIGHT = 0.65
"""Probability with which a run is right about the side of the median: that of one at 0.39 of the spread from it."""


def median_interval(
    runs: LevelOutcomes, lowest: float, highest: float, probability: float
) -> tuple[float, float, float]:
    """Median of the posterior, and the interval about it that has a probability.

    Before the runs the median is as likely everywhere in the range from `lowest` to `highest`, which is widened to hold
    them all.
    """
    inside = runs.levels[np.isfinite(runs.levels)]
    edges = np.unique(np.concatenate(([lowest, highest], inside)))
    middles = (edges[:-1] + edges[1:]) / 2.0
    says_below = runs.successes[:, None]
    is_below = middles[None] < runs.levels[:, None]
    votes = np.where(says_below == is_below, np.log(RIGHT), np.log(1.0 - RIGHT)).sum(axis=0)
    weights = np.exp(votes - votes.max()) * np.diff(edges)
    reached = np.concatenate(([0.0], np.cumsum(weights))) / weights.sum()
    tail = (1.0 - probability) / 2.0
    low, middle, high = np.interp((tail, 0.5, 1.0 - tail), reached, edges)
    return float(middle), float(low), float(high)
