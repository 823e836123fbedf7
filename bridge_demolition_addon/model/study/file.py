"""Files of studies, searches and optimisations: TOML read strictly, with its scenario; names of files in their folders.

The scenario lies next to them under its usual name. What is kept of a run lies in a folder of its own below
`RUNS_FOLDER`, named by its cache key.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from os import PathLike, fspath
from pathlib import Path
from typing import Any, ClassVar, TypeVar

from ...errors import Faults, ScenarioError
from ..run_folder.files import SCENARIO_FILE
from ..scenario import BlastZone, MemberCut, Scenario
from ..scenario.file import read_scenario, scenario_text
from ..schema import shown
from ..toml_tables import document_of_file, table_of_document, tables_text
from .criteria import Criterion, check_criteria
from .distributions import Chance, Distribution
from .keys import ScenarioKey, changed, keys_named
from .settings import EnsembleSettings, StudySettings, Vary

STUDY_FILE, SEARCH_FILE, OPTIMISE_FILE = "study.toml", "search.toml", "optimise.toml"
VERSIONS_FILE = "versions.json"

RUNS_FILE, SHEET_FILE, CONCLUSIONS_FILE = "runs.csv", "runs.xlsx", "study.json"
TRIALS_FILE = "trials.csv"
ANSWER_FILE, CURVE_FILE, CURVE_PICTURE = "search.json", "curve.csv", "curve.png"
CANDIDATES_FILE, BEST_FILE, TRADEOFF_PICTURE = "candidates.csv", "optimise.json", "tradeoff.png"

RUNS_FOLDER = "draws"
OUTCOME_FILE, OUTLINES_FILE = "outcome.json", "outlines.npz"

SIMULATED_FILE = "simulated.json"
"""Summary of a run that was simulated to its end, beside its frames: it is only to be evaluated."""

RUN_FOLDER = "run"
"""In the folder of a run, where more than its outcome is kept."""

AGAIN_FOLDER = "again"
"""Folders of runs that were repeated with everything recorded, named by their numbers."""

REPORT_FOLDER = "report"
PLAN_DXF, PLAN_GEOJSON = "study_plan.dxf", "study_plan.geojson"


SEED = f"{Scenario.table}.seed"
"""Key that is sampled for each run, and has no table."""

RENAMED = {"least_reach.toml": "least_charge.toml"}
"""Examples that another one has replaced, beside it: their old paths lead there."""

_CONSOLE = logging.getLogger(__name__)

_Settings = TypeVar("_Settings", bound=EnsembleSettings)
_Ensemble = TypeVar("_Ensemble", bound="Ensemble")


@dataclass(frozen=True, slots=True, eq=False)
class Variation:
    """A key of the scenario, and how it is sampled."""

    key: ScenarioKey
    distribution: Distribution  # of the value or of the factor
    factor: bool  # whether a factor on the scenario's value is sampled

    def value(self, sampled: Any) -> Any:
        """Return the value of the key for a sampled value or factor."""
        return sampled * self.key.value if self.factor else sampled


@dataclass(frozen=True, slots=True, eq=False)
class Ensemble:
    """Many runs of one scenario: a study, a search or an optimisation."""

    kind: ClassVar[str]
    file_name: ClassVar[str]
    table_file: ClassVar[str]
    result_file: ClassVar[str]

    settings: EnsembleSettings
    scenario: Scenario
    variations: tuple[Variation, ...]  # one for each key that varies by chance, `SEED` apart, in the order of the file

    @property
    def criteria(self) -> tuple[Criterion, ...]:
        """Criteria of success."""
        return self.settings.criteria

    @property
    def text(self) -> str:
        """The file in one way of writing, for a folder that has the scenario in ``scenario_as_run.toml``."""
        return tables_text(replace(self.settings, scenario=SCENARIO_FILE))

    @property
    def scenario_text(self) -> str:
        """The scenario file that goes with `text`."""
        return scenario_text(self.scenario)


@dataclass(frozen=True, slots=True, eq=False)
class Study(Ensemble):
    """A study: what varies in a scenario, and which limits its runs are to state."""

    kind: ClassVar[str] = "study"
    file_name: ClassVar[str] = STUDY_FILE
    table_file: ClassVar[str] = RUNS_FILE
    result_file: ClassVar[str] = CONCLUSIONS_FILE

    settings: StudySettings


def read_ensemble_file(
    path: str | PathLike[str],
    settings_class: type[_Settings],
    ensemble_of: Callable[[_Settings, Scenario], _Ensemble],
    description: str,
) -> _Ensemble:
    """Read a file of settings, and the scenario that goes with it."""
    path = _where_it_is(Path(path))
    try:
        faults = Faults()
        document = document_of_file(path, description, faults=faults)
        with faults.noted():
            settings = table_of_document(settings_class, document)
        faults.check()
        return ensemble_of(settings, read_scenario(path.parent / settings.scenario))
    except ScenarioError as error:
        raise error.within(fspath(path)) from error
    except ValueError as error:  # a NUL in a path, for one
        raise ScenarioError(f"{fspath(path)}: {error}") from error


def _where_it_is(path: Path) -> Path:
    """Return a path, or where there is nothing the example that has replaced it there, and say so."""
    renamed = path.with_name(RENAMED.get(path.name, path.name))
    if path.exists() or not renamed.is_file():
        return path
    _CONSOLE.warning("%s is now %s", path, renamed)
    return renamed


def read_study(path: str | PathLike[str]) -> Study:
    """Read a study file, and the scenario that it varies; all keys are in ``docs/study_file.md``."""
    return read_ensemble_file(path, StudySettings, study_of, "a study")


def study_of(settings: StudySettings, scenario: Scenario) -> Study:
    """Return the study of a scenario."""
    check_criteria(settings.criteria, scenario)
    return Study(settings, scenario, variations_of(settings.vary, scenario))


def variations_of(tables: Sequence[Vary], scenario: Scenario) -> tuple[Variation, ...]:
    """Return what varies in a scenario, for each key of every table."""
    variations: dict[str, Variation] = {}
    for number, vary in enumerate(tables, start=1):
        try:
            added = _variations(scenario, vary, variations)
            _check_range(scenario, added)
        except ScenarioError as error:
            raise ScenarioError(f"[[{Vary.table}]] number {number}: {error}") from error
        variations |= {variation.key.name: variation for variation in added}
    misfires = {variation.key.name: variation for variation in _misfires(scenario)}
    return tuple((misfires | variations).values())


def _misfires(scenario: Scenario) -> Iterator[Variation]:
    """Yield the keys of blast zones and cuts that may misfire; what is said not to fire never does."""
    lists: tuple[Sequence[BlastZone | MemberCut], ...] = (scenario.blast_zones, scenario.cuts)
    for planned in lists:
        for number, action in enumerate(planned, start=1):
            if action.fires and action.probability_fires < 1.0:
                (key,) = keys_named(scenario, f"{action.table}.{number}.fires")
                yield Variation(key, Chance(action.probability_fires), factor=False)


def _variations(scenario: Scenario, vary: Vary, earlier: dict[str, Variation]) -> list[Variation]:
    keys = keys_named(scenario, vary.key)
    for key in keys:
        if key.name == SEED:
            raise ScenarioError(f"vary.key is {SEED}, which is always sampled: leave it out")
        if vary.factor and not key.has_number:
            raise ScenarioError(f"vary.factor is true: {key.name} has no number in the scenario to multiply")
        if key.name in earlier:
            raise ScenarioError(f"{key.name} is sampled more than once: expected one table for it")
    return [Variation(key, vary.sampled_from, vary.factor) for key in keys]


def _check_range(scenario: Scenario, variations: list[Variation]) -> None:
    """Check that the scenario may have the ends of a distribution, all keys of a list together, or each choice."""
    for sampled in variations[0].distribution.tried:
        values = {variation.key: variation.value(sampled) for variation in variations}
        try:
            changed(scenario, values)
        except ScenarioError as error:
            raise ScenarioError(
                f"{_impossible(*next(iter(values.items())), str(error))}; set lowest and highest, or take another "
                "distribution"
            ) from error


def _impossible(key: ScenarioKey, value: Any, reason: str) -> str:
    """Return that a value may be sampled which the scenario cannot have, and name key and value once."""
    sampled = f"a run may sample {key.name} = {f'{value:.6g}' if isinstance(value, float) else shown(value)}"
    of_key = f"{key.name} is {shown(value)}: "
    if reason.startswith(of_key):
        return f"{sampled}: {reason.removeprefix(of_key)}"
    return f"{sampled}, which the scenario cannot have: {reason}"
