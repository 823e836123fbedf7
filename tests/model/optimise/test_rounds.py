# SPDX-License-Identifier: GPL-3.0-or-later
"""Optimisation of functions whose optimum is known, without Blender: better than chance, and honest about itself."""

from collections.abc import Mapping

import numpy as np
import pytest
from scipy.special import ndtr, ndtri

from bridge_demolition_addon.model.optimise.conclusions import front_of
from bridge_demolition_addon.model.optimise.rounds import (
    CONFIRMATION,
    FINAL,
    SEARCH,
    CandidateResult,
    Rounds,
    quantile_of,
)
from bridge_demolition_addon.model.optimise.settings import ChosenQuantity, OptimiseSettings
from bridge_demolition_addon.model.study.criteria import Criterion
from bridge_demolition_addon.studies.proposals import OptunaProposals

QUANTILE, SEEDS = 0.9, 8
BEST = np.array([0.3, 0.6, 0.45, 0.8, 0.2])


def settings(**changes):
    """Settings of five quantities; what they are called in a scenario does not matter here."""
    quantities = tuple(ChosenQuantity(key=f"ball.target_m.{number}", lowest=0.0, highest=1.0) for number in range(1, 6))
    criteria = (Criterion(name="down", kind="collapsed"),)
    given = {"scenario": "none", "objective": "reach", "quantile": QUANTILE, "finalist_runs": 20, **changes}
    return OptimiseSettings(quantities=quantities, criteria=criteria, **given)


class ByChance:
    """Proposes anything."""

    def __init__(self, size, seed):
        self._rng, self._size = np.random.default_rng(seed), size

    def propose(self):
        return self._rng.random(self._size)

    def record_result(self, number, value, shortfall):
        pass


class NoisyBowl:
    """Reach of 5 m at best and 20 m more for each unit² from there, with a scatter of 1 m; too little of the first
    quantity makes runs fail. Each candidate has noise of its own in each draw, besides what all have in common."""

    def __init__(self, seed):
        self._seed = seed
        self._common = np.random.default_rng([seed, 1]).normal(size=10_000)

    def mean_m(self, shares):
        return 5.0 + 20.0 * np.square(shares - BEST).sum()

    def quantile_m(self, shares):
        return self.mean_m(shares) + ndtri(QUANTILE)

    def chance(self, shares):
        return float(ndtr((shares[0] - 0.175) / 0.05))

    def outputs(self, shares, draw) -> Mapping[str, object]:
        own = np.random.default_rng([self._seed, draw, *(1e9 * shares).astype(int)])
        noise = 0.6 * self._common[draw] + 0.8 * own.normal()
        return {"reach_m": self.mean_m(shares) + noise, "success": own.random() < self.chance(shares)}


def played(rounds, bowl):
    """Make all runs, the last that may be made first."""
    while not rounds.is_finished:
        for run in reversed(list(rounds.open())):
            rounds.take(run, bowl.outputs(rounds.candidates[run.candidate].shares, run.number))
    return rounds


@pytest.mark.long
@pytest.mark.slow
def test_it_finds_better_values_than_as_many_by_chance():
    # Chance gets the same three rounds, finalists and all.
    better, found = 0, []
    for seed in range(SEEDS):
        bowl = NoisyBowl(seed)
        ours = played(Rounds(settings(), OptunaProposals(5, seed)), bowl)
        chance = played(Rounds(settings(), ByChance(5, seed)), bowl)
        assert ours.done == chance.done == settings().runs
        reaches = [bowl.mean_m(planned.candidates[planned.chosen].shares) for planned in (ours, chance)]
        better += reaches[0] < reaches[1]
        found.append(reaches)
        assert bowl.chance(ours.candidates[ours.chosen].shares) > 0.8
    assert better == SEEDS  # by chance one of 256 times
    away = np.mean(found, axis=0) - 5.0
    assert away[0] < 0.4 * away[1]


@pytest.mark.slow
def test_what_is_confirmed_is_true_in_the_mean_and_what_was_seen_in_the_search_is_too_good():
    # 200 optimisations by chance, which choose as any other does. The error of a mean of 200 is 0.07 of one.
    errors = {SEARCH: [], FINAL: [], CONFIRMATION: []}
    small = settings(candidates=25, runs_each=3, finalist_runs=3)
    for seed in range(200):
        bowl = NoisyBowl(seed)
        rounds = played(Rounds(small, ByChance(5, seed)), bowl)
        true_m = bowl.quantile_m(rounds.candidates[rounds.chosen].shares)
        for name, error in errors.items():
            error.append(rounds.result(rounds.chosen, name).value - true_m)
    means = {name: np.mean(error) for name, error in errors.items()}
    of_mean = np.std(errors[CONFIRMATION]) / np.sqrt(200)
    assert abs(means[CONFIRMATION]) < 3.0 * of_mean < 0.1
    assert means[SEARCH] < -0.3 and means[FINAL] < -0.1


def test_no_draw_is_in_two_rounds_and_all_candidates_have_the_same():
    asked = settings(candidates=25, runs_each=3, finalists=4, finalist_runs=7, confirmation_runs=30)
    rounds = played(Rounds(asked, ByChance(5, 3)), NoisyBowl(3))
    draws = [rounds.run_numbers(name) for name in (SEARCH, FINAL, CONFIRMATION)]
    assert [list(draw)[:: len(draw) - 1] for draw in draws] == [[1, 3], [4, 10], [11, 40]]
    for number, candidate in enumerate(rounds.candidates):
        wanted = set(draws[0])
        wanted |= set(draws[1]) if number in rounds.finalists else set()
        wanted |= set(draws[2]) if number == rounds.chosen else set()
        assert set(candidate.outputs) == wanted
    assert rounds.round_of(10) == FINAL and rounds.round_of(11) == CONFIRMATION


def test_candidates_do_not_depend_on_the_order_in_which_runs_end():
    bowl, asked = NoisyBowl(5), settings(candidates=30, at_once=4)
    backwards = played(Rounds(asked, OptunaProposals(5, 5)), bowl)
    forwards = Rounds(asked, OptunaProposals(5, 5))
    while not forwards.is_finished:
        run = next(forwards.open())
        forwards.take(run, bowl.outputs(forwards.candidates[run.candidate].shares, run.number))
    assert forwards.chosen == backwards.chosen and forwards.finalists == backwards.finalists
    for one, other in zip(forwards.candidates, backwards.candidates, strict=True):
        assert (one.shares == other.shares).all()


def test_those_that_fail_come_after_all_others_however_small_their_objective():
    class TooFewHold(NoisyBowl):
        def outputs(self, shares, draw):
            return {"reach_m": 0.0, "success": False} if shares[0] < 0.9 else super().outputs(shares, draw)

    rounds = played(Rounds(settings(candidates=60), ByChance(5, 1)), TooFewHold(1))
    assert rounds.candidates[rounds.chosen].shares[0] >= 0.9


def test_runs_that_did_not_finish_are_no_success_and_have_no_end():
    class AllLost(NoisyBowl):
        def outputs(self, shares, draw):
            return {}

    rounds = played(Rounds(settings(), OptunaProposals(5, 1)), AllLost(1))
    assert rounds.result(rounds.chosen, CONFIRMATION) == CandidateResult(np.inf, 0, 59)


def test_the_quantile_is_that_of_numpy_and_its_median_the_true_one():
    draws = np.random.default_rng(9).exponential(size=(4000, 59))
    found = np.array([quantile_of(draw, 0.8) for draw in draws])
    assert found[:50] == pytest.approx(np.quantile(draws[:50], 0.8, axis=1, method="median_unbiased"))
    # Half of all estimates are below the true quantile of an exponential distribution, within 3 standard errors.
    assert (found < -np.log(0.2)).mean() == pytest.approx(0.5, abs=3.0 * 0.5 / np.sqrt(4000))
    assert quantile_of(np.array([1.0, 2.0, np.inf]), 0.9) == np.inf
    assert quantile_of(np.array([1.0, 2.0, 3.0, np.inf]), 0.5) == 2.5


def test_the_front_is_what_no_other_beats():
    charges = np.array([1.0, 2.0, 3.0, 2.0, 0.5, 3.0])
    reaches = np.array([9.0, 5.0, 5.0, 4.0, 1.0, np.inf])
    holds = np.array([True, True, True, True, False, True])
    assert front_of(charges, reaches, holds).tolist() == [True, False, False, True, False, False]
