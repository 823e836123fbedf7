# SPDX-License-Identifier: GPL-3.0-or-later
"""Optimise noisy functions whose optimum is known, and as many candidates by chance: the table in README.md.

Each function is a bowl of 5 m at best and 20 m more for each unit² from there, with a scatter of 1 m from run to run,
in which runs fail where the first quantity is small. Chance gets the same three rounds. It takes two minutes.
"""

import numpy as np
from scipy.special import ndtr

from bridge_demolition_addon.model.optimise.rounds import CONFIRMATION, SEARCH, Rounds
from bridge_demolition_addon.model.optimise.settings import ChosenQuantity, OptimiseSettings
from bridge_demolition_addon.model.study.criteria import Criterion
from bridge_demolition_addon.studies.proposals import OptunaProposals

REPETITIONS = 100
BEST = np.array([0.3, 0.6, 0.45, 0.8, 0.2, 0.7, 0.5, 0.4])


class ByChance:
    """Proposes anything."""

    def __init__(self, size, seed):
        self._rng, self._size = np.random.default_rng(seed), size

    def propose(self):
        return self._rng.random(self._size)

    def record_result(self, number, value, shortfall):
        """It does not learn."""


def above_best_m(shares):
    """Return how much more than the best candidates (d,) reach, in the mean."""
    return 20.0 * float(np.square(shares - BEST[: len(shares)]).sum())


def outputs(shares, seed, draw):
    """Return what a run of a candidate comes to."""
    common = np.random.default_rng([seed, draw])
    own = np.random.default_rng([seed, draw, *(1e9 * shares).astype(int)])
    noise = 0.6 * common.normal() + 0.8 * own.normal()
    success = own.random() < ndtr((shares[0] - 0.175) / 0.05)
    return {"reach_m": 5.0 + above_best_m(shares) + noise, "success": bool(success)}


def played(settings, proposals, seed):
    """Make all runs of an optimisation."""
    rounds = Rounds(settings, proposals)
    while not rounds.is_finished:
        for run in list(rounds.open()):
            rounds.take(run, outputs(rounds.candidates[run.candidate].shares, seed, run.number))
    return rounds


def main():
    """Print the table."""
    print(
        "| numbers that change | candidates | beats random search | excess over optimum "
        "| excess of random search | bias of the search |"
    )
    print("| --- | --- | --- | --- | --- | --- |")
    for size in (2, 3, 5, 8):
        for candidates in (40, 80):
            ranges = tuple(
                ChosenQuantity(key=f"ball.target_m.{number + 1}", lowest=0.0, highest=1.0) for number in range(size)
            )
            criteria = (Criterion(name="down", kind="collapsed"),)
            settings = OptimiseSettings(
                scenario="none", objective="reach", candidates=candidates, quantities=ranges, criteria=criteria
            )
            found, seemed = [], []
            for seed in range(REPETITIONS):
                both = [played(settings, proposals(size, seed), seed) for proposals in (OptunaProposals, ByChance)]
                found.append([above_best_m(rounds.candidates[rounds.chosen].shares) for rounds in both])
                results = [both[0].result(both[0].chosen, name).value for name in (CONFIRMATION, SEARCH)]
                seemed.append(results[0] - results[1])
            ours, chance = np.array(found).T
            print(
                f"| {size} | {candidates} | {(ours < chance).mean():.0%} | {ours.mean():.2f} m | "
                f"{chance.mean():.2f} m | {np.mean(seemed):.2f} m |",
                flush=True,
            )


if __name__ == "__main__":
    main()
