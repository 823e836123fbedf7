"""A study, a search or an optimisation at work, for the command line and the sidebar alike."""

from __future__ import annotations

import time
from collections import Counter
from pathlib import Path

from ..model.ensemble.folder import EnsembleFolder
from ..model.optimise.conclusions import Best
from ..model.optimise.file import Optimisation
from ..model.optimise.planner import OptimisePlanner
from ..model.search.conclusions import Answer
from ..model.search.file import Search
from ..model.search.planner import SearchPlanner
from ..model.study.file import Ensemble, Study
from ..model.study.files import CURVE_PICTURE, TRADEOFF_PICTURE
from ..model.study.planner import EnsembleResult, Planner, StudyPlanner
from .engine import Engine
from .proposals import OptunaProposals, check_optuna
from .run_queue import RunQueue

_MOST_LOOKED_UP = 25
"""Cached runs that are looked up in one step at most, so that a step stays short."""


class EnsembleSession:
    """Makes the runs of an ensemble, in steps. It goes on where its folder stands.

    Parameters
    ----------
    ensemble
        A study, a search or an optimisation.
    path
        Its folder.
    engine
        Makes the runs. The session closes it.

    Attributes
    ----------
    planner : Planner
        Says which runs are needed.
    folder : EnsembleFolder
        Keeps them.
    is_paused : bool
        Whether no further run begins.
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
    def total(self) -> int:
        """How many runs there are, at most."""
        return self.planner.total

    @property
    def done(self) -> int:
        """How many runs count so far, whether they finished or not."""
        return self.planner.done

    @property
    def lost(self) -> int:
        """How many of these did not finish."""
        return self.planner.lost

    @property
    def is_finished(self) -> bool:
        """Whether all runs that are needed have ended."""
        return self.planner.is_finished

    @property
    def reasons(self) -> dict[int, str]:
        """Why runs did not finish, by their numbers in the table."""
        return {row.number: row.reason for row in self.planner.rows() if row.reason}

    @property
    def statuses(self) -> dict[str, int]:
        """How many runs have ended in each way."""
        return dict(Counter(row.status for row in self.planner.rows()))

    @property
    def remaining_s(self) -> float:
        """Wall time that is left if runs go on as so far, pauses apart; 0 as long as that is not known."""
        return self._worked_s / self._collected * (self.total - self.done) if self._collected else 0.0

    def step(self, timeout_s: float) -> None:
        """Begin as many runs as there is room for, and take those that have ended; wait for one up to a time.

        Raises
        ------
        DemolitionError, OSError
            Runs cannot be made at all, or their outcomes not be kept.
        """
        self._count_time()
        looked_up = 0 if self.is_paused else self._begin_runs()
        for run, outcome in self._queue.collect(timeout_s if looked_up < _MOST_LOOKED_UP else 0.0):
            self.planner.take(run, outcome)
            self._collected += 1

    def stop(self) -> list[Path]:
        """End all runs under way, write the tables of those that count, and let others write to the folder.

        Returns
        -------
        list of Path
            The tables; none where the session had ended.
        """
        if self._has_ended:
            return []
        self._has_ended = True
        try:
            self._queue.cancel()  # before the folder is free for others
            return self.folder.write_tables(self.planner.table)
        finally:
            self.folder.release()

    def finish(self) -> tuple[EnsembleResult, list[Path]]:
        """Write what all runs state, with pictures, and end the session.

        Returns
        -------
        EnsembleResult
            Conclusions, an answer or the best candidate.
        list of Path
            All files that were written.
        """
        result = self.planner.result()
        paths = self.folder.write_result(result) + save_pictures(result, self.folder.path)
        return result, self.stop() + paths

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
        from ..charts.search_curve import save_search_curve  # loading matplotlib takes a second

        save_search_curve(folder / CURVE_PICTURE, result)
        return [folder / CURVE_PICTURE]
    if isinstance(result, Best) and any(candidate.charge_kg > 0.0 for candidate in result.tried):
        from ..charts.tradeoff import save_tradeoff

        save_tradeoff(folder / TRADEOFF_PICTURE, result)
        return [folder / TRADEOFF_PICTURE]
    return []
