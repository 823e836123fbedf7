"""Planners: which runs are needed next, and what follows from those that have ended."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from typing import Any, Generic, Protocol, TypeVar

from .conclusions import Conclusions, conclusions
from .file import Ensemble, Study
from .runs_table import DONE, RunOutcome, RunRow, RunsTable
from .sampled_runs import SampledRun, sampled_run


class EnsembleResult(Protocol):
    """What a study, a search or an optimisation states: numbers, which ``report/wording`` puts into sentences."""

    def as_json(self) -> dict[str, Any]:
        """Return it as the file of results has it."""


_Ensemble = TypeVar("_Ensemble", bound=Ensemble)
_Result = TypeVar("_Result", bound=EnsembleResult)


class Planner(ABC, Generic[_Ensemble, _Result]):
    """Plans the runs of an ensemble.

    Which runs these are follows from the ensemble and its outcomes alone: not from the order in which runs end, nor
    from how many processors there are.
    """

    def __init__(self, ensemble: _Ensemble):
        self.ensemble = ensemble

    @property
    @abstractmethod
    def total(self) -> int:
        """How many runs there are, at most."""

    @property
    @abstractmethod
    def is_finished(self) -> bool:
        """Whether all runs that are needed have ended."""

    @abstractmethod
    def next_runs(self) -> Iterator[SampledRun]:
        """Give runs that may begin now, each of them once; outcomes may be taken meanwhile."""

    @abstractmethod
    def take(self, run: SampledRun, outcome: RunOutcome) -> None:
        """Take the outcome of a run."""

    @abstractmethod
    def rows(self) -> list[RunRow]:
        """Return the rows of all runs that count so far, in the order of the table."""

    @abstractmethod
    def result(self) -> _Result:
        """Return what the runs state; all of them have to be there."""

    @property
    def table(self) -> RunsTable:
        """The table of all runs that count so far."""
        return RunsTable(tuple(self.rows()))

    @property
    def done(self) -> int:
        """How many runs count so far, whether they finished or not."""
        return len(self.rows())

    @property
    def lost(self) -> int:
        """How many of these did not finish."""
        return sum(row.status != DONE for row in self.rows())


class StudyPlanner(Planner[Study, Conclusions]):
    """Plans the runs of a study, one after another."""

    def __init__(self, study: Study):
        super().__init__(study)
        self._begun = 0
        self._rows: dict[int, RunRow] = {}

    @property
    def total(self) -> int:
        return self.ensemble.settings.runs

    @property
    def is_finished(self) -> bool:
        return len(self._rows) == self.total

    @property
    def done(self) -> int:
        return len(self._rows)

    def next_runs(self) -> Iterator[SampledRun]:
        while self._begun < self.total:
            self._begun += 1
            yield sampled_run(self.ensemble, self._begun)

    def take(self, run: SampledRun, outcome: RunOutcome) -> None:
        self._rows[run.number] = RunRow(run.number, outcome.status, run.inputs, outcome.outputs, outcome.reason)

    def rows(self) -> list[RunRow]:
        return [self._rows[number] for number in sorted(self._rows)]

    def result(self) -> Conclusions:
        return conclusions(self.ensemble, self.table)
