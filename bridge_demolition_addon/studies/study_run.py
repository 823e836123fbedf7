"""A study that runs: its draws go to an engine one after another, and what becomes of each goes to the folder."""

from __future__ import annotations

import json
import time
from collections import Counter
from collections.abc import Mapping
from typing import Any

from ..errors import ScenarioError
from ..model.scenario.file import scenario_text
from ..model.study.conclusions import Conclusions, conclusions
from ..model.study.draws import Draw, draw_of, inputs_of
from ..model.study.file import Study
from ..model.study.files import CONCLUSIONS_FILE, RUNS_FILE, SHEET_FILE
from ..model.study.runs_sheet import write_sheet
from ..model.study.runs_table import REFUSED, Row, RunsTable, write_runs
from ..system.disk import write_whole_text
from .draw_process import End
from .engine import Engine, Task
from .folder import StudyFolder

_LOOKED_UP_AT_A_TIME = 25
"""Draws that are looked up before whoever asks for a step is answered."""


class StudyRun:
    """Goes through all draws of a study, in steps.

    Parameters
    ----------
    study
        What is asked.
    folder
        Its folder.
    engine
        Runs the draws.

    Attributes
    ----------
    is_paused : bool
        Whether no further draw is begun.
    played : int
        Draws that were run since this was made; all others were there.
    """

    def __init__(self, study: Study, folder: StudyFolder, engine: Engine):
        self.is_paused = False
        self.played = 0
        self._study, self._folder, self._engine = study, folder, engine
        self._next = 1
        self._rows: dict[int, Row] = {}
        self._reasons: dict[int, str] = {}
        self._at_work: dict[str, list[Draw]] = {}
        self._text = study.text
        self._worked_s = 0.0
        self._looked_s = time.monotonic()

    @property
    def total(self) -> int:
        """How many draws there are."""
        return self._study.settings.runs

    @property
    def done(self) -> int:
        """How many have ended, however."""
        return len(self._rows)

    @property
    def is_finished(self) -> bool:
        """Whether all have ended."""
        return self.done == self.total

    @property
    def statuses(self) -> dict[str, int]:
        """How many have ended in each way."""
        return dict(Counter(row.status for row in self._rows.values()))

    @property
    def reasons(self) -> dict[int, str]:
        """Why draws are not done, by their numbers."""
        return dict(sorted(self._reasons.items()))

    @property
    def remaining_s(self) -> float:
        """Wall time that is left, if draws go on as so far, pauses apart; 0 as long as that is not known."""
        return self._worked_s / self.played * (self.total - self.done) if self.played else 0.0

    def step(self, timeout_s: float) -> None:
        """Begin as many draws as there is room for, and take in those that have ended, waiting for one at most so long.

        Raises
        ------
        DemolitionError, OSError
            Draws cannot be run at all, or what becomes of them not be kept.
        """
        self._count_time()
        looked_up = 0
        while self._has_room and looked_up < _LOOKED_UP_AT_A_TIME:
            self._begin(self._next)
            self._next += 1
            looked_up += 1
        wait_s = timeout_s if self._at_work and looked_up < _LOOKED_UP_AT_A_TIME else 0.0
        for task, end in self._engine.collect(wait_s):
            self._take_in(task, end)

    def write_tables(self) -> None:
        """Write the table of all draws that have ended."""
        table = self.table()
        write_runs(table, self._folder.path / RUNS_FILE)
        write_sheet(table, self._folder.path / SHEET_FILE)

    def write_conclusions(self) -> Conclusions:
        """Write what follows from all draws, and return it; there have to be all of them."""
        found = conclusions(self._study, self.table())
        text = json.dumps(found.as_json() | {"versions": dict(self._engine.versions)}, indent=2)
        write_whole_text(self._folder.path / CONCLUSIONS_FILE, text + "\n")
        return found

    def table(self) -> RunsTable:
        """Return the table of all draws that have ended."""
        return RunsTable(tuple(self._rows[number] for number in sorted(self._rows)))

    def _count_time(self) -> None:
        now_s = time.monotonic()
        if not self.is_paused:
            self._worked_s += now_s - self._looked_s
        self._looked_s = now_s

    @property
    def _has_room(self) -> bool:
        return not self.is_paused and self._next <= self.total and len(self._at_work) < self._engine.capacity

    def _begin(self, number: int) -> None:
        """Have a draw run, unless it is there."""
        try:
            draw = draw_of(self._study, number)
        except ScenarioError as error:
            self._note(number, inputs_of(self._study, number), End(REFUSED, str(error)))
            return
        address = draw.address(self._engine.versions)
        if address in self._at_work:  # another one with the same inputs, down to the seed
            self._at_work[address].append(draw)
        elif end := self._folder.end_of(address):
            self._note(number, draw.inputs, end)
        else:
            self._at_work[address] = [draw]
            self._engine.submit(Task(address, self._request(draw), self._folder.work_folder(address)))

    def _request(self, draw: Draw) -> dict[str, Any]:
        return {"scenario": scenario_text(draw.scenario), "study": self._text}

    def _take_in(self, task: Task, end: End) -> None:
        draws = self._at_work.pop(task.address)
        self._folder.keep(task.address, draws[0].inputs, end)
        for draw in draws:
            self._note(draw.number, draw.inputs, end)
        self.played += 1

    def _note(self, number: int, inputs: Mapping[str, Any], end: End) -> None:
        self._rows[number] = Row(number, end.status, inputs, end.outputs)
        if end.reason:
            self._reasons[number] = end.reason
