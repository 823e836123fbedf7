"""The rounds of an optimisation: candidates are tried, the best of them run again, and the chosen one confirmed.

In runs of one number all candidates have the same inputs by chance, so that they differ by their values, not by luck
(common random numbers). Choosing the best of noisy results chooses luck as well: so the choice among finalists, and the
result that is stated, each rest on runs with new numbers.
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
    """Proposes candidates, and receives their results in the same order."""

    def propose(self) -> np.ndarray:
        """Return the next candidate: numbers (d,) from 0 to 1."""

    def record_result(self, number: int, value: float, shortfall: float) -> None:
        """Take the result of a candidate, by its number from 0."""


@dataclass(frozen=True, slots=True)
class CandidateRun:
    """A run of a candidate, each by its number: the candidate's from 0, the run's from 1."""

    candidate: int
    number: int


@dataclass(frozen=True, slots=True)
class CandidateResult:
    """Result of some runs of a candidate."""

    value: float  # of the objective; infinite where not enough runs finished
    successes: int  # runs that met all criteria
    runs: int

    @property
    def share(self) -> float:
        """Part of the runs that met all criteria."""
        return self.successes / self.runs


@dataclass(slots=True, eq=False)
class Candidate:
    """Values that were tried, and the outputs of their runs by number; empty for a run that did not finish."""

    shares: np.ndarray  # (d,), as proposed
    outputs: dict[int, Mapping[str, Any]] = field(default_factory=dict)


class Rounds:
    """Says which runs are to be made, and which candidates do best."""

    def __init__(self, settings: OptimiseSettings, proposals: Proposals):
        self.candidates: list[Candidate] = []  # all that were proposed so far
        self.finalists: list[int] = []  # the best of them, once all were tried; the first is the best
        self.chosen: int | None = None  # the best of these, once all were run again
        self._settings, self._proposals, self._recorded = settings, proposals, 0

    @property
    def done(self) -> int:
        """Number of runs that have ended."""
        return sum(len(candidate.outputs) for candidate in self.candidates)

    @property
    def is_finished(self) -> bool:
        """Whether all runs have ended."""
        return self.chosen is not None and self._has_all(self.chosen, CONFIRMATION)

    def open(self) -> Iterator[CandidateRun]:
        """Yield the runs that may be made now and have not ended, in their order."""
        self._go_on()
        for number in range(self._recorded, len(self.candidates)):
            yield from self._missing(number, SEARCH)
        for number in self.finalists:
            yield from self._missing(number, FINAL)
        if self.chosen is not None:
            yield from self._missing(self.chosen, CONFIRMATION)

    def take(self, run: CandidateRun, outputs: Mapping[str, Any]) -> None:
        """Take the outputs of a run, empty where it did not finish."""
        self.candidates[run.candidate].outputs[run.number] = outputs

    def result(self, number: int, of_round: str) -> CandidateResult:
        """Return the result of a candidate in a round in which it ran."""
        outputs = self.candidates[number].outputs
        return result_of([outputs[run] for run in self.run_numbers(of_round)], self._settings)

    def run_numbers(self, of_round: str) -> range:
        """Return the numbers of the runs of a round: no other round has them."""
        settings = self._settings
        counts = {SEARCH: settings.runs_each, FINAL: settings.finalist_runs, CONFIRMATION: settings.confirmation_runs}
        names = list(counts)
        begin = 1 + sum(counts[name] for name in names[: names.index(of_round)])
        return range(begin, begin + counts[of_round])

    def round_of(self, number: int) -> str:
        """Return the round of a run, by its number."""
        return next(name for name in (SEARCH, FINAL, CONFIRMATION) if number in self.run_numbers(name))

    def _go_on(self) -> None:
        """Record complete candidates in their order, and propose others: proposals depend on nothing else."""
        settings = self._settings
        while True:
            while len(self.candidates) < min(settings.candidates, self._recorded + settings.at_once):
                self.candidates.append(Candidate(self._proposals.propose()))
            if self._recorded == settings.candidates or not self._has_all(self._recorded, SEARCH):
                break
            result = self.result(self._recorded, SEARCH)
            self._proposals.record_result(self._recorded, result.value, settings.probability - result.share)
            self._recorded += 1
        if self._recorded == settings.candidates and not self.finalists:
            self.finalists = self._best_that_differ()
        is_run_again = self.finalists and all(self._has_all(finalist, FINAL) for finalist in self.finalists)
        if self.chosen is None and is_run_again:
            self.chosen = self._in_order(self.finalists, FINAL)[0]

    def _best_that_differ(self) -> list[int]:
        first: dict[tuple[float, ...], int] = {}
        for number in self._in_order(range(len(self.candidates)), SEARCH):
            first.setdefault(tuple(self.candidates[number].shares), number)
        return list(first.values())[: self._settings.finalists]

    def _in_order(self, numbers: Sequence[int], of_round: str) -> list[int]:
        """Order candidates that succeed often enough by their objective, then the others by how often they do."""
        results = {number: self.result(number, of_round) for number in numbers}

        def rank(number: int) -> tuple[float, float, int]:
            return max(self._settings.probability - results[number].share, 0.0), results[number].value, number

        return sorted(numbers, key=rank)

    def _missing(self, number: int, of_round: str) -> Iterator[CandidateRun]:
        outputs = self.candidates[number].outputs
        return (CandidateRun(number, run) for run in self.run_numbers(of_round) if run not in outputs)

    def _has_all(self, number: int, of_round: str) -> bool:
        outputs = self.candidates[number].outputs
        return all(run in outputs for run in self.run_numbers(of_round))


def result_of(outputs: Sequence[Mapping[str, Any]], settings: OptimiseSettings) -> CandidateResult:
    """Return the result of runs by their outputs."""
    value = quantile_of(objective_values(outputs, settings.output), settings.quantile)
    return CandidateResult(value, sum(bool(run.get(SUCCESS)) for run in outputs), len(outputs))


def objective_values(outputs: Sequence[Mapping[str, Any]], name: str) -> np.ndarray:
    """Return the values (n,) of an output, infinite where it is not known."""
    values = [run.get(name) for run in outputs]
    return np.array([np.inf if value is None else value for value in values], float)


def quantile_of(values: np.ndarray, quantile: float) -> float:
    """Return a quantile of the distribution of values (n,), the eighth of R. J. Hyndman and Y. Fan.

    Its median is about the true one whatever the distribution: Sample quantiles in statistical packages, The American
    Statistician 50 (1996), 361-365. Values may be infinite.
    """
    ordered, count = np.sort(values), len(values)
    rank = min(max((count + 1.0 / 3.0) * quantile + 1.0 / 3.0, 1.0), float(count))
    below = int(rank)
    value, share = float(ordered[below - 1]), rank - below
    if share < 1e-12 or not np.isfinite(ordered[below]):
        return value if share < 1e-12 else np.inf
    return value + share * (float(ordered[below]) - value)
