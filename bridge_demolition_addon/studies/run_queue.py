"""The queue of runs: what is done is recognised, the rest goes to an engine, and each outcome to the folder."""

from __future__ import annotations

from collections.abc import Iterator

from ..errors import ScenarioError
from ..model.ensemble.folder import EnsembleFolder
from ..model.study.runs_table import REFUSED, RunOutcome
from ..model.study.sampled_runs import SampledRun
from .engine import Engine, Task


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
