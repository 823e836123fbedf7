"""Optimisation files: TOML read strictly into an `Optimisation`, with the scenario in which it changes quantities."""

from __future__ import annotations

from dataclasses import dataclass, replace
from os import PathLike
from typing import ClassVar

from ..scenario import Scenario
from ..study.criteria import check_criteria
from ..study.file import Ensemble, read_ensemble_file, variations_of
from ..study.files import BEST_FILE, OPTIMISE_FILE, TRIALS_FILE
from ..study.sampled_runs import SampledRun, sampled_run
from .settings import OptimiseSettings
from .space import Shares, Space, space_of

_PER_DIMENSION = 5
"""Least number of candidates for each number that may change: with fewer, chance does as well."""


@dataclass(frozen=True, slots=True, eq=False)
class Optimisation(Ensemble):
    """An optimisation: a scenario, what may change in it, and the objective."""

    kind: ClassVar[str] = "optimisation"
    file_name: ClassVar[str] = OPTIMISE_FILE
    table_file: ClassVar[str] = TRIALS_FILE
    result_file: ClassVar[str] = BEST_FILE

    settings: OptimiseSettings
    space: Space

    def run_of(self, number: int, shares: Shares) -> SampledRun:
        """Return a run of a candidate, from 1 on: all candidates have the same inputs by chance in it."""
        run = sampled_run(self, number, self.space.values(shares))
        return replace(run, inputs={**run.inputs, **self.space.shown(shares)})


def read_optimisation(path: str | PathLike[str]) -> Optimisation:
    """Read an optimisation file, and the scenario that goes with it; all keys are in ``docs/optimise_file.md``."""
    return read_ensemble_file(path, OptimiseSettings, optimisation_of, "an optimisation")


def optimisation_of(settings: OptimiseSettings, scenario: Scenario) -> Optimisation:
    """Return the optimisation of a scenario."""
    check_criteria(settings.criteria, scenario)
    _check_objective(settings, scenario)
    variations = variations_of(settings.vary, scenario)
    space = space_of(settings, scenario, [variation.key.name for variation in variations])
    if settings.candidates < _PER_DIMENSION * space.size:
        raise settings.unexpected(
            "candidates", f"at least {_PER_DIMENSION * space.size}, as {space.size} numbers may change"
        )
    return Optimisation(settings, scenario, variations, space)


def _check_objective(settings: OptimiseSettings, scenario: Scenario) -> None:
    can_go_off = (scenario.charges or scenario.blast_zones or scenario.cuts) and scenario.blast.explosion
    if settings.objective in ("charge", "vibration") and not can_go_off:
        raise settings.unexpected("objective", "another one, as the scenario has no charges that go off")
    if settings.neighbour not in (None, *(neighbour.name for neighbour in scenario.neighbours)):
        raise settings.unexpected("neighbour", "the name of one of [[neighbours]] of the scenario")
