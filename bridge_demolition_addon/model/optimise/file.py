"""Optimisation files: TOML read strictly into an `Optimisation`, with the scenario in which it changes quantities."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from os import PathLike, fspath
from pathlib import Path

from ...errors import ScenarioError
from ..run_folder.files import SCENARIO_FILE
from ..scenario import Scenario
from ..scenario.file import read_scenario, scenario_text
from ..study.criteria import check_criteria
from ..study.draws import Draw, draw_of
from ..study.file import Study, variations_of
from ..study.keys import changed
from ..study.settings import StudySettings
from ..toml_tables import document_of_file, table_of_document, tables_text
from .files import OPTIMISE_FILE
from .settings import OptimiseSettings
from .space import Space, space_of

_PASSED_ON = ("scenario", "seed", "least_mass_kg", "time_limit_s", "memory_limit_mb", "vary", "criteria")
"""Settings that an optimisation has in common with a study."""

_PER_DIMENSION = 5
"""Candidates for each number that may change, at least: with fewer, chance finds as much."""


@dataclass(frozen=True, slots=True, eq=False)
class Optimisation:
    """An optimisation: a scenario, what may change in it, and what is best.

    Attributes
    ----------
    settings : OptimiseSettings
        What the file says.
    study : Study
        What varies from run to run besides, and the scenario.
    space : Space
        What may change.
    """

    settings: OptimiseSettings
    study: Study
    space: Space

    @property
    def text(self) -> str:
        """Return the file in one way of writing, for a folder that has the scenario in ``scenario.toml``."""
        return tables_text(replace(self.settings, scenario=SCENARIO_FILE))

    @property
    def scenario_text(self) -> str:
        """Return the scenario file that goes with `text`."""
        return scenario_text(self.study.scenario)

    @property
    def file_name(self) -> str:
        """Return what the file is called in its folder."""
        return OPTIMISE_FILE

    def trial(self, number: int, shares: Sequence[float]) -> Draw:
        """Return a run of a candidate; all candidates have the same draws, by their numbers from 1 on.

        Raises
        ------
        ScenarioError
            The scenario cannot have these values together.
        """
        draw = draw_of(self.study, number)
        scenario = changed(draw.scenario, self.space.values(shares))
        return replace(draw, inputs={**draw.inputs, **self.space.shown(shares)}, scenario=scenario)


def read_optimisation(path: str | PathLike[str]) -> Optimisation:
    """Read an optimisation file, and the scenario that goes with it.

    Parameters
    ----------
    path : str or path
        A TOML file; all keys are in ``docs/optimise_file.md``.

    Raises
    ------
    ScenarioError
        A file cannot be read or is not TOML; a key is unknown, missing or has a wrong value; or the scenario cannot
        have the values at the ends of a range.
    """
    path = Path(path)
    try:
        settings = table_of_document(OptimiseSettings, document_of_file(path, "an optimisation"))
        return optimisation_of(settings, read_scenario(path.parent / settings.scenario))
    except (ScenarioError, ValueError) as error:  # a NUL in a path, for one
        raise ScenarioError(f"{fspath(path)}: {error}") from error


def optimisation_of(settings: OptimiseSettings, scenario: Scenario) -> Optimisation:
    """Return the optimisation of a scenario.

    Raises
    ------
    ScenarioError
        The scenario lacks what is changed or asked, or there are too few candidates for it.
    """
    check_criteria(settings.criteria, scenario)
    _check_objective(settings, scenario)
    variations = variations_of(settings.vary, scenario)
    space = space_of(settings, scenario, [each.key.name for each in variations])
    if settings.candidates < _PER_DIMENSION * space.size:
        raise settings.unexpected(
            "candidates", f"at least {_PER_DIMENSION * space.size}, as {space.size} numbers may change"
        )
    common = {item.name: getattr(settings, item.name) for item in fields(settings) if item.name in _PASSED_ON}
    study = Study(StudySettings(runs=settings.runs, **common), scenario, variations)
    return Optimisation(settings, study, space)


def _check_objective(settings: OptimiseSettings, scenario: Scenario) -> None:
    if settings.objective in ("charge", "vibration") and not (scenario.charges and scenario.blast.explosion):
        raise settings.unexpected("objective", "another one, as the scenario has no charges that go off")
    if settings.neighbour is not None and settings.neighbour not in [each.name for each in scenario.neighbours]:
        raise settings.unexpected("neighbour", "the name of one of [[neighbours]] of the scenario")
