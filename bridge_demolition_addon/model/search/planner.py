"""Planner of a search: the outcomes of its runs decide where the next are."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...engineering.search.neyer import NeyerTest
from ...engineering.search.probit import LevelOutcomes
from ..study.outcome import SUCCESS
from ..study.planner import Planner
from ..study.runs_table import RunOutcome, RunRow
from ..study.sampled_runs import SampledRun
from .conclusions import reason_to_stop
from .file import Search


class SearchPlanner(Planner[Search]):
    """Plans the runs of a search, some of which are under way while the next is chosen.

    A run counts once all earlier ones have ended.
    """

    def __init__(self, search: Search):
        super().__init__(search)
        self.ended_as: str | None = None  # None as long as the search goes on
        self._successes: list[bool] = []
        self._levels: list[float] = []
        self._ended: dict[int, RunRow] = {}
        scale = search.scale
        test = NeyerTest(*scale.ends, scale.spread, scale.rounded, search.settings.at_once - 1)
        self._chosen = test.played(self._successes.__getitem__)

    @property
    def total(self) -> int:
        return self.ensemble.settings.trials

    @property
    def is_finished(self) -> bool:
        return self.ended_as is not None

    def next_runs(self) -> Iterator[SampledRun]:
        search = self.ensemble
        while not self.is_finished and len(self._levels) < min(self.total, self.done + search.settings.at_once):
            self._levels.append(next(self._chosen))
            yield search.run_at(len(self._levels), search.scale.tried(self._levels[-1]))

    def take(self, run: SampledRun, outcome: RunOutcome) -> None:
        self._ended[run.number] = RunRow(run.number, outcome.status, run.inputs, outcome.outputs, outcome.reason)
        while not self.is_finished and (row := self._ended.pop(self.done + 1, None)):
            self._rows[row.number] = row
            self._successes.append(bool(row.outputs.get(SUCCESS)))
            runs = LevelOutcomes(np.array(self._levels[: self.done]), np.array(self._successes, bool))
            self.ended_as = reason_to_stop(self.ensemble, runs)
