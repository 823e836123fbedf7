"""Planners: which runs are needed next."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from typing import Any, Generic, TypeVar

from .file import Ensemble, Study
from .runs_table import DONE, RunOutcome, RunRow, RunsTable
from .sampled_runs import SampledRun, sampled_run

_Ensemble = TypeVar("_Ensemble", bound=Ensemble)


class Planner(ABC, Generic[_Ensemble]):
    """Plans the runs of an ensemble.

    Which runs these are follows from the ensemble and its outcomes alone: not from the order in which runs end, nor
    from how many processors there are.
    """

    def __init__(self, ensemble: _Ensemble):
        self.ensemble = ensemble
        self._rows: dict[Any, RunRow] = {}

    @property
    @abstractmethod
    def total(self) -> int:
        """Largest number of runs."""

    @property
    @abstractmethod
    def is_finished(self) -> bool:
        """Whether all runs that are needed have ended."""

    @abstractmethod
    def next_runs(self) -> Iterator[SampledRun]:
        """Yield runs that may begin now, each of them once; outcomes may be taken meanwhile."""

    @abstractmethod
    def take(self, run: SampledRun, outcome: RunOutcome) -> None:
        """Take the outcome of a run."""

    def rows(self) -> list[RunRow]:
        """Return the rows of the runs that count so far, in the order of the table."""
        return [self._rows[number] for number in sorted(self._rows)]

    @property
    def table(self) -> RunsTable:
        """The table of the runs that count so far."""
        return RunsTable(tuple(self.rows()))

    @property
    def done(self) -> int:
        """Number of runs that count so far, whether they finished or not."""
        return len(self._rows)

    @property
    def lost(self) -> int:
        """Number of those that did not finish."""
        return sum(row.status != DONE for row in self._rows.values())


class StudyPlanner(Planner[Study]):
    """Plans the runs of a study, one after another."""

    def __init__(self, study: Study):
        super().__init__(study)
        self._begun = 0

    @property
    def total(self) -> int:
        return self.ensemble.settings.runs

    @property
    def is_finished(self) -> bool:
        return self.done == self.total

    def next_runs(self) -> Iterator[SampledRun]:
        while self._begun < self.total:
            self._begun += 1
            yield sampled_run(self.ensemble, self._begun)

    def take(self, run: SampledRun, outcome: RunOutcome) -> None:
        self._rows[run.number] = RunRow(run.number, outcome.status, run.inputs, outcome.outputs, outcome.reason)
