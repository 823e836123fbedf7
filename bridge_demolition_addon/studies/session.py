"""A study, a search or an optimisation at work, for the command line and the sidebar alike, and the queue of its runs.

What is done is recognised, the rest goes to an engine, and each outcome to the folder.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Iterator
from functools import partial
from pathlib import Path

from ..errors import ScenarioError
from ..model.ensemble.folder import EnsembleFolder, EnsembleResult, result_of_runs
from ..model.optimise.conclusions import Best
from ..model.optimise.file import Optimisation
from ..model.optimise.planner import OptimisePlanner
from ..model.search.conclusions import Answer
from ..model.search.file import Search
from ..model.search.planner import SearchPlanner
from ..model.study.file import CURVE_PICTURE, TRADEOFF_PICTURE, Ensemble, Study
from ..model.study.planner import Planner, StudyPlanner
from ..model.study.runs_table import REFUSED, RunOutcome
from ..model.study.sampled_runs import SampledRun
from .engine import Engine, Task
from .proposals import OptunaProposals, check_optuna

_LOOK_EVERY_S = 0.2
_MOST_LOOKED_UP = 25
"""Cached runs that are looked up in one step at most, so that a step stays short."""


class EnsembleSession:
    """Makes the runs of an ensemble, in steps, from where its folder stands. It closes the engine that makes the runs.

    While `is_paused`, no further run begins.
    """

    def __init__(self, ensemble: Ensemble, path: Path, engine: Engine):
        self.is_paused = False
        self._has_ended = False
        self._collected = 0
        self._worked_s, self._looked_s = 0.0, time.monotonic()
        try:
            self.planner = planner_of(ensemble)
            libraries = {"optuna": check_optuna()} if isinstance(ensemble, Optimisation) else {}
            self.folder = EnsembleFolder(path, ensemble, {**engine.versions, **libraries})
        except BaseException:
            engine.close()
            raise
        self._queue = RunQueue(self.folder, engine)

    @property
    def reasons(self) -> dict[int, str]:
        """Why runs did not finish, by their numbers in the table."""
        return {row.number: row.reason for row in self.planner.rows() if row.reason}

    @property
    def statuses(self) -> dict[str, int]:
        """Number of runs that ended in each way."""
        return dict(Counter(row.status for row in self.planner.rows()))

    @property
    def remaining_s(self) -> float:
        """Wall time that is left if runs go on as so far, without pauses; 0 as long as that is not known."""
        return self._worked_s / self._collected * (self.planner.total - self.planner.done) if self._collected else 0.0

    def step(self, timeout_s: float) -> None:
        """Begin as many runs as there is room for, and take those that have ended; wait for one up to a time."""
        self._count_time()
        looked_up = 0 if self.is_paused else self._begin_runs()
        for run, outcome in self._queue.collect(timeout_s if looked_up < _MOST_LOOKED_UP else 0.0):
            self.planner.take(run, outcome)
            self._collected += 1

    def stop(self) -> list[Path]:
        """End all runs under way, release the folder, and return the tables; none where the session had ended."""
        if self._has_ended:
            return []
        self._has_ended = True
        try:
            self._queue.cancel()  # before the folder is free for others
            return self.folder.write_tables(self.planner.table)
        finally:
            self.folder.release()

    def result(self) -> EnsembleResult:
        """Return the result of the runs."""
        return result_of_runs(self.planner.ensemble, self.planner.table)

    def finish(self) -> tuple[EnsembleResult, list[Path]]:
        """Write the result of the runs, with pictures; end the session, and return result and files."""
        result = self.result()
        paths = self.folder.write_result(result) + save_pictures(result, self.folder.path)
        return result, self.stop() + paths

    def complete(self) -> EnsembleResult:
        """Make all runs, wait for them, and return their result."""
        try:
            while not self.planner.is_finished:
                self.step(_LOOK_EVERY_S)
            return self.finish()[0]
        finally:
            self.stop()

    def _begin_runs(self) -> int:
        """Begin runs, and return for how many was looked up whether they are done."""
        looked_up, runs = 0, self.planner.next_runs()
        while self._queue.has_room and looked_up < _MOST_LOOKED_UP and (run := next(runs, None)) is not None:
            looked_up += 1
            if outcome := self._queue.submit(run):
                self.planner.take(run, outcome)
        return looked_up

    def _count_time(self) -> None:
        now_s = time.monotonic()
        if not self.is_paused:
            self._worked_s += now_s - self._looked_s
        self._looked_s = now_s


def planner_of(ensemble: Ensemble) -> Planner:
    """Return the planner of a study, a search or an optimisation."""
    match ensemble:
        case Study():
            return StudyPlanner(ensemble)
        case Search():
            return SearchPlanner(ensemble)
        case Optimisation():
            return OptimisePlanner(ensemble, OptunaProposals(ensemble.space.size, ensemble.settings.seed))
    raise TypeError(f"{type(ensemble).__name__} has no planner")


def save_pictures(result: EnsembleResult, folder: Path) -> list[Path]:
    """Draw the curve of a search, or charge against debris distance of an optimisation that has charges."""
    if isinstance(result, Answer):
        from ..charts.ensemble_charts import save_chart, search_curve  # loading matplotlib takes a second

        save_chart(folder / CURVE_PICTURE, partial(search_curve, answer=result))
        return [folder / CURVE_PICTURE]
    if isinstance(result, Best) and any(candidate.charge_kg > 0.0 for candidate in result.tried):
        from ..charts.ensemble_charts import save_chart, tradeoff

        save_chart(folder / TRADEOFF_PICTURE, partial(tradeoff, best=result))
        return [folder / TRADEOFF_PICTURE]
    return []


class RunQueue:
    """Runs of a study, a search or an optimisation that are under way: an engine makes them, a folder keeps them."""

    def __init__(self, folder: EnsembleFolder, engine: Engine):
        self._folder, self._engine = folder, engine
        self._under_way: dict[str, list[SampledRun]] = {}

    @property
    def has_room(self) -> bool:
        """Whether the engine takes another run now."""
        return len(self._under_way) < self._engine.capacity

    @property
    def is_empty(self) -> bool:
        """Whether no run is under way."""
        return not self._under_way

    def submit(self, run: SampledRun) -> RunOutcome | None:
        """Have a run made; return its outcome where that is known already, None where it is under way."""
        try:
            key = run.cache_key(self._engine.versions)
        except ScenarioError as error:
            return RunOutcome(REFUSED, str(error))
        if key in self._under_way:  # another run with the same inputs, down to the seed
            self._under_way[key].append(run)
            return None
        outcome = self._folder.outcome_of(key)
        if outcome is None:
            self._under_way[key] = [run]
            self._engine.submit(Task(key, run.request, self._folder.work_folder(key)))
        return outcome

    def collect(self, timeout_s: float) -> Iterator[tuple[SampledRun, RunOutcome]]:
        """Yield runs that have ended, their outcomes kept; wait for the first one up to a time."""
        for task, outcome in self._engine.collect(0.0 if self.is_empty else timeout_s):
            runs = self._under_way.pop(task.cache_key)
            self._folder.keep(task.cache_key, runs[0].inputs, outcome)
            for run in runs:
                yield run, outcome

    def cancel(self) -> None:
        """End all runs that are under way; what is done is kept."""
        self._engine.close()
        self._under_way.clear()
