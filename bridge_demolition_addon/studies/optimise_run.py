"""The runs of an optimisation, made by an engine; what is there already is not made again."""

from __future__ import annotations

import json
from itertools import islice
from typing import Any

from ..errors import ScenarioError
from ..model.optimise.candidates_table import Tried, tried_of, write_candidates
from ..model.optimise.conclusions import Best, as_json, best_of
from ..model.optimise.file import Optimisation
from ..model.optimise.files import BEST_FILE, CANDIDATES_FILE, TRIALS_FILE
from ..model.optimise.rounds import Proposals, Rounds, Run
from ..model.optimise.settings import CHARGE
from ..model.optimise.space import total_charge_kg
from ..model.scenario.file import scenario_text
from ..model.study.draws import Draw
from ..model.study.runs_table import DONE, REFUSED, Row, RunsTable, write_runs
from ..system.disk import write_whole_text
from .draw_process import End
from .engine import Engine, Task
from .folder import StudyFolder

_CANDIDATE, _ROUND = "candidate", "round"


class OptimiseRun:
    """Makes the runs of an optimisation, in steps.

    Which runs are made follows from the optimisation and its outcomes alone: not from the order in which they end, nor
    from how many processors there are.

    Parameters
    ----------
    optimisation
        What is asked.
    folder
        Its folder.
    engine
        Makes the runs.
    proposals
        Where candidates come from.
    """

    def __init__(self, optimisation: Optimisation, folder: StudyFolder, engine: Engine, proposals: Proposals):
        self.rounds = Rounds(optimisation.settings, proposals)
        self._optimisation, self._folder, self._engine = optimisation, folder, engine
        self._rows: dict[Run, tuple[str, dict[str, Any], dict[str, Any]]] = {}
        self._reasons: dict[Run, str] = {}
        self._at_work: dict[str, list[tuple[Run, Draw]]] = {}
        self._begun: set[Run] = set()
        self._study_text = optimisation.study.text

    @property
    def total(self) -> int:
        """How many runs there are at most: fewer where candidates that are alike leave fewer finalists."""
        settings, finalists = self._optimisation.settings, self.rounds.finalists
        return settings.runs - (settings.finalists - len(finalists)) * settings.finalist_runs * bool(finalists)

    @property
    def done(self) -> int:
        """How many have ended."""
        return self.rounds.done

    @property
    def lost(self) -> int:
        """How many of these did not finish, and count as no success."""
        return len(self._reasons)

    @property
    def is_finished(self) -> bool:
        """Whether all have ended."""
        return self.rounds.is_finished

    @property
    def reasons(self) -> dict[int, str]:
        """Why runs did not finish, by their numbers in the table."""
        return {number: self._reasons[run] for number, run in enumerate(self._in_order(), 1) if run in self._reasons}

    def step(self, timeout_s: float) -> None:
        """Begin as many runs as there is room for, and take in those that have ended, waiting for one at most so long.

        Raises
        ------
        DemolitionError, OSError
            Runs cannot be made at all, or what becomes of them not be kept.
        """
        room = self._engine.capacity - len(self._at_work)
        looked_up = True
        while looked_up and room > 0:
            begun = list(islice((run for run in self.rounds.open() if run not in self._begun), room))
            for run in begun:
                self._begin(run)
            looked_up = bool(begun) and all(run in self._rows for run in begun)
            room = self._engine.capacity - len(self._at_work)
        for task, end in self._engine.collect(timeout_s if self._at_work else 0.0):
            self._take_in(task, end)

    def write_trials(self) -> list[Tried]:
        """Write the tables of all runs that have ended and of all candidates, and return the latter."""
        rows = [
            Row(
                number,
                status,
                {_CANDIDATE: run.candidate + 1, _ROUND: self.rounds.round_of(run.draw), **inputs},
                outputs,
            )
            for number, run in enumerate(self._in_order(), start=1)
            for status, inputs, outputs in [self._rows[run]]
        ]
        write_runs(RunsTable(tuple(rows)), self._folder.path / TRIALS_FILE)
        tried = tried_of(self._optimisation, self.rounds)
        write_candidates(tried, self._folder.path / CANDIDATES_FILE)
        return tried

    def write_best(self) -> Best:
        """Write what was found, and return it; all runs have to be there."""
        best = best_of(self._optimisation, self.rounds)
        text = json.dumps({**as_json(self._optimisation, best), "versions": dict(self._engine.versions)}, indent=2)
        write_whole_text(self._folder.path / BEST_FILE, text + "\n")
        return best

    def _in_order(self) -> list[Run]:
        return sorted(
            self._rows, key=lambda run: (self.rounds.draws(self.rounds.round_of(run.draw))[0], run.candidate, run.draw)
        )

    def _begin(self, run: Run) -> None:
        """Have a run made, unless it is there."""
        self._begun.add(run)
        shares = self.rounds.candidates[run.candidate].shares
        try:
            trial = self._optimisation.trial(run.draw, shares)
        except ScenarioError as error:
            self._note(run, None, End(REFUSED, str(error)))
            return
        address = trial.address(self._engine.versions)
        if address in self._at_work:  # of another candidate that is the same, rounded
            self._at_work[address].append((run, trial))
        elif end := self._folder.end_of(address):
            self._note(run, trial, end)
        else:
            self._at_work[address] = [(run, trial)]
            request = {"scenario": scenario_text(trial.scenario), "study": self._study_text}
            self._engine.submit(Task(address, request, self._folder.work_folder(address)))

    def _take_in(self, task: Task, end: End) -> None:
        waiting = self._at_work.pop(task.address)
        self._folder.keep(task.address, waiting[0][1].inputs, end)
        for run, trial in waiting:
            self._note(run, trial, end)

    def _note(self, run: Run, trial: Draw | None, end: End) -> None:
        shares = self.rounds.candidates[run.candidate].shares
        inputs = trial.inputs if trial else self._optimisation.space.shown(shares)
        outputs = dict(end.outputs) if end.status == DONE else {}
        if trial:
            outputs[CHARGE] = total_charge_kg(trial.scenario)
        self._rows[run] = end.status, dict(inputs), outputs
        if end.reason:
            self._reasons[run] = end.reason
        self.rounds.take(run, outputs)
