"""Planner of an optimisation: the runs of its rounds, and their table."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress

from ...errors import ScenarioError
from ..study.planner import Planner
from ..study.runs_table import DONE, RunOutcome, RunRow
from ..study.sampled_runs import SampledRun
from .conclusions import CANDIDATE, ROUND, Best, best_of
from .file import Optimisation
from .rounds import CandidateRun, Proposals, Rounds
from .settings import CHARGE
from .space import total_charge_kg


class OptimisePlanner(Planner[Optimisation, Best]):
    """Plans the runs of an optimisation.

    Parameters
    ----------
    optimisation
        What is asked.
    proposals
        Where candidates come from.
    """

    def __init__(self, optimisation: Optimisation, proposals: Proposals):
        super().__init__(optimisation)
        self.rounds = Rounds(optimisation.settings, proposals)
        self._begun: set[CandidateRun] = set()
        self._under_way: dict[SampledRun, CandidateRun] = {}
        self._rows: dict[CandidateRun, RunRow] = {}

    @property
    def total(self) -> int:
        settings, finalists = self.ensemble.settings, self.rounds.finalists
        return settings.runs - (settings.finalists - len(finalists)) * settings.finalist_runs * bool(finalists)

    @property
    def is_finished(self) -> bool:
        return self.rounds.is_finished

    @property
    def done(self) -> int:
        return len(self._rows)

    def next_runs(self) -> Iterator[SampledRun]:
        while place := next((place for place in self.rounds.open() if place not in self._begun), None):
            self._begun.add(place)
            run = self.ensemble.run_of(place.number, self.rounds.candidates[place.candidate].shares)
            self._under_way[run] = place
            yield run

    def take(self, run: SampledRun, outcome: RunOutcome) -> None:
        place = self._under_way.pop(run)
        outputs = dict(outcome.outputs) if outcome.status == DONE else {}
        with suppress(ScenarioError):  # a scenario that cannot have these values has no charge
            outputs[CHARGE] = total_charge_kg(run.scenario)
        inputs = {CANDIDATE: place.candidate + 1, ROUND: self.rounds.round_of(place.number), **run.inputs}
        self._rows[place] = RunRow(0, outcome.status, inputs, outputs, outcome.reason)
        self.rounds.take(place, outputs)

    def rows(self) -> list[RunRow]:
        places = sorted(self._rows, key=lambda place: (self._begin_of_round(place), place.candidate, place.number))
        rows = [self._rows[place] for place in places]
        return [
            RunRow(number, row.status, row.inputs, row.outputs, row.reason) for number, row in enumerate(rows, start=1)
        ]

    def result(self) -> Best:
        return best_of(self.ensemble, self.table)

    @property
    def lost(self) -> int:
        return sum(row.status != DONE for row in self._rows.values())

    def _begin_of_round(self, place: CandidateRun) -> int:
        return self.rounds.run_numbers(self.rounds.round_of(place.number))[0]
