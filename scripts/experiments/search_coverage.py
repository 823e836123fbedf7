# SPDX-License-Identifier: GPL-3.0-or-later
"""How often limits of searches hold, over simulated searches whose truth is known, for README.md.

Usage: search_coverage.py [SEARCHES] prints a table: 500 of each kind by default.
"""

from __future__ import annotations

import sys

import numpy as np
from scipy.special import ndtr, ndtri

from bridge_demolition_addon.engineering.search.neyer import NeyerTest, median_interval
from bridge_demolition_addon.engineering.search.probit import LevelOutcomes, fitted, limit

CONFIDENCE, PROBABILITY, GUESS = 0.95, 0.9, 0.1


def main(arguments: list[str]) -> None:
    """Print the table."""
    searches = int(arguments[0]) if arguments else 500
    print("| runs | at once | spread | limit of 90 % holds | median, without a model | error of the median |")
    print("| --- | --- | --- | --- | --- | --- |")
    for trials, at_once in ((20, 1), (40, 1), (40, 4)):
        for spread in (0.02, 0.1, 0.25):
            rng = np.random.default_rng(2026)
            rows = np.array([_searched(rng, trials, at_once, spread) for _ in range(searches)])
            held, without, error = rows.T
            off = np.sqrt(np.nanmean(np.square(error)))
            print(
                f"| {trials} | {at_once} | {spread} | {held.mean():.1%} | {without.mean():.1%} | {off:.3f} |",
                flush=True,
            )


def _searched(rng: np.random.Generator, count: int, at_once: int, spread: float) -> tuple[float, float, float]:
    """Whether the limit holds, and the interval without a model, of one search from 0 to 1; and the median's error."""
    median, levels, outcomes = rng.uniform(0.2, 0.8), [], []

    def outcome(number: int) -> bool:
        while len(outcomes) <= number:
            outcomes.append(rng.random() < ndtr((levels[len(outcomes)] - median) / spread))
        return outcomes[number]

    chosen = NeyerTest(0.0, 1.0, GUESS, pending=at_once - 1).played(outcome)
    for _ in range(count):
        levels.append(next(chosen))
    outcome(count - 1)
    trials = LevelOutcomes(np.array(levels), np.array(outcomes))
    found = fitted(trials)
    _, low, high = median_interval(trials, 0.0, 1.0, CONFIDENCE)
    holds = limit(trials, PROBABILITY, CONFIDENCE, 1) >= median + spread * ndtri(PROBABILITY)
    return float(holds), float(low <= median <= high), found.median - median if found else np.nan


if __name__ == "__main__":
    main(sys.argv[1:])
