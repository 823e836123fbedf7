"""The rounds of an optimisation: candidates are tried, the best of them run again, and the chosen one confirmed.

All candidates have the same draws, so that they differ by what was chosen, not by luck (common random numbers). Whoever
picks the best of noisy results picks luck as well: so the choice among finalists, and what is said of the one that is
chosen, each rest on draws that were not used before.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from ..study.outcome import SUCCESS
from .settings import OptimiseSettings

SEARCH, FINAL, CONFIRMATION = "search", "final", "confirmation"


class Proposals(Protocol):
    """Proposes candidates, and is told in the same order what becomes of them."""

    def propose(self) -> np.ndarray:
        """Return the next candidate: numbers (d,) from 0 to 1."""

    def told(self, number: int, value: float, shortfall: float) -> None:
        """Take in what a candidate, by its number from 0, came to."""


@dataclass(frozen=True, slots=True)
class Run:
    """A run of a candidate, by its number from 0, with a draw, from 1 on."""

    candidate: int
    draw: int


@dataclass(frozen=True, slots=True)
class Result:
    """What some runs of a candidate came to.

    Attributes
    ----------
    value : float
        The objective; infinite where not enough of them finished.
    successes, runs : int
        How many met all criteria, of how many.
    """

    value: float
    successes: int
    runs: int

    @property
    def share(self) -> float:
        """Part of the runs that met all criteria."""
        return self.successes / self.runs


@dataclass(slots=True, eq=False)
class Candidate:
    """Values that were tried.

    Attributes
    ----------
    shares : (d,) float
        What was proposed.
    outputs : dict
        Outputs of its runs by the numbers of their draws; none of a run that did not finish.
    """

    shares: np.ndarray
    outputs: dict[int, Mapping[str, Any]] = field(default_factory=dict)


class Rounds:
    """Says which runs are to be made, and what they came to.

    Parameters
    ----------
    settings
        How many runs there are, and what is best.
    proposals
        Where candidates come from.

    Attributes
    ----------
    candidates : list of Candidate
        All that were proposed so far.
    finalists : list of int
        The best of them, once all were tried; the first is the best.
    chosen : int or None
        The best of these, once all were run again.
    """

    def __init__(self, settings: OptimiseSettings, proposals: Proposals):
        self.candidates: list[Candidate] = []
        self.finalists: list[int] = []
        self.chosen: int | None = None
        self._settings, self._proposals, self._told = settings, proposals, 0

    @property
    def done(self) -> int:
        """How many runs have ended."""
        return sum(len(each.outputs) for each in self.candidates)

    @property
    def is_finished(self) -> bool:
        """Whether all have."""
        return self.chosen is not None and self._has_all(self.chosen, CONFIRMATION)

    def open(self) -> Iterator[Run]:
        """Give the runs that may be made now and have not ended, those that come first first."""
        self._go_on()
        for number in range(self._told, len(self.candidates)):
            yield from self._missing(number, SEARCH)
        for number in self.finalists:
            yield from self._missing(number, FINAL)
        if self.chosen is not None:
            yield from self._missing(self.chosen, CONFIRMATION)

    def take(self, run: Run, outputs: Mapping[str, Any]) -> None:
        """Take in what a run came to."""
        self.candidates[run.candidate].outputs[run.draw] = outputs

    def result(self, number: int, of_round: str) -> Result:
        """Return what a candidate came to in a round in which it ran."""
        found = [self.candidates[number].outputs[draw] for draw in self.draws(of_round)]
        values = [each.get(self._settings.output) for each in found]
        known = np.array([np.inf if value is None else value for value in values], float)
        successes = sum(bool(each.get(SUCCESS)) for each in found)
        return Result(quantile_of(known, self._settings.quantile), successes, len(found))

    def draws(self, of_round: str) -> range:
        """Return the draws of a round: no other round has them."""
        settings = self._settings
        counts = {SEARCH: settings.runs_each, FINAL: settings.finalist_runs, CONFIRMATION: settings.confirmation_runs}
        begin = 1
        for name, count in counts.items():
            if name == of_round:
                return range(begin, begin + count)
            begin += count
        raise KeyError(of_round)

    def round_of(self, draw: int) -> str:
        """Return the round of a draw."""
        return next(name for name in (SEARCH, FINAL, CONFIRMATION) if draw in self.draws(name))

    def _go_on(self) -> None:
        """Take stock of what is complete, in the order of candidates: what is proposed depends on nothing else."""
        settings = self._settings
        while True:
            while len(self.candidates) < min(settings.candidates, self._told + settings.at_once):
                self.candidates.append(Candidate(self._proposals.propose()))
            if self._told == settings.candidates or not self._has_all(self._told, SEARCH):
                break
            found = self.result(self._told, SEARCH)
            self._proposals.told(self._told, found.value, settings.probability - found.share)
            self._told += 1
        if self._told == settings.candidates and not self.finalists:
            self.finalists = self._best_that_differ()
        if self.chosen is None and self.finalists and all(self._has_all(each, FINAL) for each in self.finalists):
            self.chosen = self._in_order(self.finalists, FINAL)[0]

    def _best_that_differ(self) -> list[int]:
        ordered, seen, found = self._in_order(range(len(self.candidates)), SEARCH), set(), []
        for number in ordered:
            key = tuple(self.candidates[number].shares)
            if key not in seen and len(found) < self._settings.finalists:
                found.append(number)
            seen.add(key)
        return found

    def _in_order(self, numbers: Sequence[int], of_round: str) -> list[int]:
        """Candidates that succeed often enough by their objective, then the others by how often they do."""
        results = {number: self.result(number, of_round) for number in numbers}
        shortfalls = {number: max(self._settings.probability - each.share, 0.0) for number, each in results.items()}
        return sorted(numbers, key=lambda number: (shortfalls[number], results[number].value, number))

    def _missing(self, number: int, of_round: str) -> Iterator[Run]:
        outputs = self.candidates[number].outputs
        return (Run(number, draw) for draw in self.draws(of_round) if draw not in outputs)

    def _has_all(self, number: int, of_round: str) -> bool:
        outputs = self.candidates[number].outputs
        return all(draw in outputs for draw in self.draws(of_round))


def quantile_of(values: np.ndarray, quantile: float) -> float:
    """Return a quantile of what values (n,) were drawn from, the eighth of R. J. Hyndman and Y. Fan.

    Its median is about the true one whatever the distribution: Sample quantiles in statistical packages, The American
    Statistician 50 (1996), 361-365. Infinite values may be among them.
    """
    ordered, count = np.sort(values), len(values)
    place = min(max((count + 1.0 / 3.0) * quantile + 1.0 / 3.0, 1.0), float(count))
    below = int(place)
    value, share = float(ordered[below - 1]), place - below
    if share < 1e-12 or not np.isfinite(ordered[below]):
        return value if share < 1e-12 else np.inf
    return value + share * (float(ordered[below]) - value)
