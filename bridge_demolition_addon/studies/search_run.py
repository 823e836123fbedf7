"""A search that runs: its trials go to an engine, and their outcomes decide where the next are."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from ..engineering.search.neyer import NeyerTest
from ..engineering.search.probit import Trials
from ..errors import ScenarioError
from ..model.scenario.file import scenario_text
from ..model.search.conclusions import Answer, answer_of, reason_to_stop
from ..model.search.file import Search
from ..model.search.files import ANSWER_FILE, TRIALS_FILE
from ..model.study.draws import Draw
from ..model.study.outcome import SUCCESS
from ..model.study.runs_table import REFUSED, Row, RunsTable, write_runs
from ..system.disk import write_whole_text
from .draw_process import End
from .engine import Engine, Task
from .folder import StudyFolder


class SearchRun:
    """Makes the trials of a search, in steps.

    Which trials are made, and where, follows from the search and its outcomes alone: not from the order in which they
    end, nor from how many processors there are.

    Parameters
    ----------
    search
        What is asked.
    folder
        Its folder.
    engine
        Runs the trials.

    Attributes
    ----------
    reason : str or None
        Why it has ended; None as long as it has not.
    """

    def __init__(self, search: Search, folder: StudyFolder, engine: Engine):
        self.reason: str | None = None
        self._search, self._folder, self._engine = search, folder, engine
        scale = search.scale
        pending = search.settings.at_once - 1
        self._test = NeyerTest(*scale.ends, scale.spread, scale.rounded, pending)
        self._levels = np.zeros(0)
        self._outcomes: list[bool] = []
        self._begun = 0
        self._rows: dict[int, Row] = {}
        self._reasons: dict[int, str] = {}
        self._at_work: dict[str, list[Draw]] = {}
        self._study_text = search.study.text

    @property
    def total(self) -> int:
        """How many trials there are at most."""
        return self._search.settings.trials

    @property
    def done(self) -> int:
        """How many have ended of which all earlier ones have ended, too."""
        return len(self._outcomes)

    @property
    def lost(self) -> int:
        """How many of these did not finish, and count as no success."""
        return sum(number <= self.done for number in self._reasons)

    @property
    def reasons(self) -> dict[int, str]:
        """Why trials did not finish, by their numbers."""
        return {number: self._reasons[number] for number in sorted(self._reasons) if number <= self.done}

    @property
    def trials(self) -> Trials:
        """All trials that count, by their levels."""
        return Trials(self._levels[: self.done], np.array(self._outcomes, bool))

    @property
    def values(self) -> np.ndarray:
        """Values (n,) of the quantity in them."""
        return np.array([self._search.scale.tried(float(each)) for each in self.trials.levels])

    def step(self, timeout_s: float) -> None:
        """Begin as many trials as may be begun, and take in those that have ended, waiting for one at most so long.

        Raises
        ------
        DemolitionError, OSError
            Trials cannot be run at all, or what becomes of them not be kept.
        """
        self._count()
        while self._may_begin:
            self._begin(self._begun + 1)
            self._begun += 1
            self._count()
        if self.reason is None:
            for task, end in self._engine.collect(timeout_s if self._at_work else 0.0):
                self._take_in(task, end)
            self._count()

    def write_trials(self) -> None:
        """Write the table of all trials that count."""
        rows = tuple(self._rows[number] for number in range(1, self.done + 1))
        write_runs(RunsTable(rows), self._folder.path / TRIALS_FILE)

    def write_answer(self) -> Answer:
        """Write what the trials say, and return it."""
        answer, settings = answer_of(self._search, self.trials), self._search.settings
        asked = {"key": settings.key, "unit": self._search.unit, "success": settings.success}
        asked |= {"probability": settings.probability, "confidence": settings.confidence, "ended_as": self.reason}
        text = json.dumps({**asked, **answer.as_json(), "versions": dict(self._engine.versions)}, indent=2)
        write_whole_text(self._folder.path / ANSWER_FILE, text + "\n")
        return answer

    @property
    def _may_begin(self) -> bool:
        most = min(self.total, self.done + self._search.settings.at_once)
        return self.reason is None and self._begun < most and len(self._at_work) < self._engine.capacity

    def _count(self) -> None:
        """Take trials into account in their order, until one is not there or the search ends."""
        while self.reason is None and self.done + 1 in self._rows:
            row = self._rows[self.done + 1]
            self._outcomes.append(bool(row.outputs.get(SUCCESS)))
            self.reason = reason_to_stop(self._search, self.trials)

    def _begin(self, number: int) -> None:
        """Have a trial made, unless it is there."""
        if number > len(self._levels):
            self._levels = self._test.levels(self._outcomes, number)
        value = self._search.scale.tried(float(self._levels[number - 1]))
        try:
            trial = self._search.trial(number, value)
        except ScenarioError as error:
            self._note(number, {self._search.settings.key: value}, End(REFUSED, str(error)))
            return
        address = trial.address(self._engine.versions)
        if address in self._at_work:
            self._at_work[address].append(trial)
        elif end := self._folder.end_of(address):
            self._note(number, trial.inputs, end)
        else:
            self._at_work[address] = [trial]
            request = {"scenario": scenario_text(trial.scenario), "study": self._study_text}
            self._engine.submit(Task(address, request, self._folder.work_folder(address)))

    def _take_in(self, task: Task, end: End) -> None:
        trials = self._at_work.pop(task.address)
        self._folder.keep(task.address, trials[0].inputs, end)
        for each in trials:
            self._note(each.number, each.inputs, end)

    def _note(self, number: int, inputs: Mapping[str, Any], end: End) -> None:
        self._rows[number] = Row(number, end.status, inputs, end.outputs)
        if end.reason:
            self._reasons[number] = end.reason
