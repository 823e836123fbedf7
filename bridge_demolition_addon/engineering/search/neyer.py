"""Where to try next along one quantity: by halving, and by Neyer's D-optimal test.

B. T. Neyer (1994), A D-optimality-based sensitivity test, Technometrics 36, 61-70. Until both kinds of outcome are
there, the range is searched and left if need be; then it is halved down to the guess of the spread, which shrinks until
runs overlap; from then on each run is where it adds most to the determinant of Fisher's information on the median and
the spread.

Runs whose outcome is not there yet count as information: how much a run gives does not depend on its outcome. So
several at once are a greedy D-optimal batch.

Each run votes for the median to be below or above it, and is right with a probability that is taken to be the same
everywhere: R. Waeber, P. I. Frazier and S. G. Henderson (2013), Bisection search with noisy responses, SIAM Journal on
Control and Optimization 51, 2261-2279. Near the median runs are hardly better than a coin, so the interval is wide.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cache
from itertools import islice

import numpy as np

from ..arrays import FloatArray
from ..statistics.normal import log_probability
from .probit import LevelOutcomes, SuccessCurve, fitted

SHRINKS = 0.8
"""Factor by which the guess of the spread shrinks with each run without overlap."""

_ROUNDING = 1e-9
_FARTHEST = 5.0
_PLACES = 2001


class NeyerTest:
    """The levels of a test, one after another; higher levels succeed more often.

    The median is expected between `lowest` and `highest`, `spread` is a guess. `rounded` makes a level that can be
    tried of one that was chosen; `pending` runs are under way while the next is chosen.
    """

    def __init__(
        self,
        lowest: float,
        highest: float,
        spread: float,
        rounded: Callable[[float], float] = float,
        pending: int = 0,
    ):
        self.lowest, self.highest, self.spread = lowest, highest, spread
        self.rounded, self.pending = rounded, pending

    def levels(self, outcomes: Sequence[bool], count: int) -> FloatArray:
        """Return the levels (count,) of the first runs, when the outcomes of the first n are known.

        Each was chosen when every outcome but the last `pending` before it was known, so that count is at most n +
        pending + 1.
        """
        return np.array(list(islice(self.played(outcomes.__getitem__), count)))

    def played(self, outcome: Callable[[int], bool]) -> Iterator[float]:
        """Give one level after another, and ask for the outcome of a run, from 0 on, as soon as that decides one."""
        levels: list[float] = []
        outcomes: list[bool] = []
        guess = self.spread
        while True:
            if len(levels) > self.pending:
                outcomes.append(bool(outcome(len(outcomes))))
            known = len(outcomes)
            runs = LevelOutcomes(np.array(levels[:known]), np.array(outcomes, bool))
            level, guess = self._next(runs, np.array(levels[known:]), guess)
            levels.append(self.rounded(level))
            yield levels[-1]

    def _next(self, runs: LevelOutcomes, under_way: FloatArray, guess: float) -> tuple[float, float]:
        """The next level, and the guess of the spread after it."""
        if runs.overlap and (likeliest := fitted(runs)):
            low, high = runs.levels.min(), runs.levels.max()
            normal = SuccessCurve(float(np.clip(likeliest.median, low, high)), min(likeliest.spread, high - low))
            return most_informative(np.concatenate((runs.levels, under_way)), normal), guess
        position, width = self._search(runs, guess)
        if position is not None:
            return most_informative(under_way, SuccessCurve(position, width)) if len(under_way) else position, guess
        low, high = runs.levels.min(), runs.levels.max()
        middle = float(np.clip((runs.lowest_success + runs.highest_failure) / 2.0, low, high))
        normal = SuccessCurve(middle, min(guess, high - low))
        return most_informative(np.concatenate((runs.levels, under_way)), normal), SHRINKS * guess

    def _search(self, runs: LevelOutcomes, guess: float) -> tuple[float | None, float]:
        """The level at which to look for both kinds of outcome, and how far it may be off; None once they are a guess
        apart.
        """
        if not len(runs):
            return (self.lowest + self.highest) / 2.0, (self.highest - self.lowest) / 4.0
        low, high = float(runs.levels.min()), float(runs.levels.max())
        if not runs.successes.any():
            position = max((self.highest + high) / 2.0, high + 2.0 * guess, 2.0 * high - low)
            return position, max(guess, (position - high) / 2.0)
        if runs.successes.all():
            position = min((self.lowest + low) / 2.0, low - 2.0 * guess, 2.0 * low - high)
            return position, max(guess, (low - position) / 2.0)
        apart = runs.lowest_success - runs.highest_failure
        if apart > guess * (1.0 + _ROUNDING):
            return (runs.lowest_success + runs.highest_failure) / 2.0, apart / 4.0
        return None, guess


def most_informative(levels: FloatArray, normal: SuccessCurve) -> float:
    """Level that adds most to the determinant of the information that levels (n,) give on a distribution."""
    scores = (levels - normal.median) / normal.spread
    weights = information(scores)
    b11, b12, b22 = weights.sum(), (weights * scores).sum(), (weights * scores * scores).sum()
    positions, added = _places()
    gain = (b11 + added) * (b22 + added * positions * positions) - np.square(b12 + added * positions)
    best = int(np.argmax(gain))
    # The top of the parabola through the best of the positions and its neighbours.
    if 0 < best < _PLACES - 1:
        before, top, after = gain[best - 1 : best + 2]
        bend = before - 2.0 * top + after
        shift = 0.5 * (before - after) / bend if bend < 0.0 else 0.0
        return normal.median + normal.spread * float(positions[best] + shift * (positions[1] - positions[0]))
    return normal.median + normal.spread * float(positions[best])


@cache
def _places() -> tuple[FloatArray, FloatArray]:
    """Positions that are tried, and the information of a run at each."""
    positions = np.linspace(-_FARTHEST, _FARTHEST, _PLACES)
    return positions, information(positions)


def information(scores: FloatArray) -> FloatArray:
    """Information (n,) that runs at scores (x - μ) / σ give on the median, φ² / (Φ (1 - Φ))."""
    gained: FloatArray = np.exp(
        -scores * scores - np.log(2.0 * np.pi) - log_probability(scores) - log_probability(-scores)
    )
    return gained


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
