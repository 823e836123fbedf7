"""Planner of an optimisation: the runs of its rounds, and their table."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace

from ...errors import ScenarioError
from ..study.planner import Planner
from ..study.runs_table import DONE, RunOutcome, RunRow
from ..study.sampled_runs import SampledRun
from .conclusions import CANDIDATE, ROUND
from .file import Optimisation, total_charge_kg
from .rounds import CandidateRun, Proposals, Rounds
from .settings import CHARGE


class OptimisePlanner(Planner[Optimisation]):
    """Plans the runs of an optimisation, whose candidates are proposed."""

    def __init__(self, optimisation: Optimisation, proposals: Proposals):
        super().__init__(optimisation)
        self.rounds = Rounds(optimisation.settings, proposals)
        self._begun: set[CandidateRun] = set()
        self._under_way: dict[SampledRun, CandidateRun] = {}

    @property
    def total(self) -> int:
        settings, finalists = self.ensemble.settings, self.rounds.finalists
        return settings.runs - (settings.finalists - len(finalists)) * settings.finalist_runs * bool(finalists)

    @property
    def is_finished(self) -> bool:
        return self.rounds.is_finished

    def next_runs(self) -> Iterator[SampledRun]:
        while next_one := next((one for one in self.rounds.open() if one not in self._begun), None):
            self._begun.add(next_one)
            run = self.ensemble.run_of(next_one.number, self.rounds.candidates[next_one.candidate].shares)
            self._under_way[run] = next_one
            yield run

    def take(self, run: SampledRun, outcome: RunOutcome) -> None:
        candidate_run = self._under_way.pop(run)
        outputs = dict(outcome.outputs) if outcome.status == DONE else {}
        with suppress(ScenarioError):  # a scenario that cannot have these values has no charge
            outputs[CHARGE] = total_charge_kg(run.scenario)
        round_name = self.rounds.round_of(candidate_run.number)
        inputs = {CANDIDATE: candidate_run.candidate + 1, ROUND: round_name, **run.inputs}
        begin = self.rounds.run_numbers(round_name)[0]
        row = RunRow(0, outcome.status, inputs, outputs, outcome.reason)
        self._rows[begin, candidate_run.candidate, candidate_run.number] = row
        self.rounds.take(candidate_run, outputs)

    def rows(self) -> list[RunRow]:
        return [replace(row, number=number) for number, row in enumerate(super().rows(), start=1)]
