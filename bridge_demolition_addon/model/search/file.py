"""Search files: TOML read strictly into a `Search`, with the scenario in which it changes a quantity."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from os import PathLike, fspath
from pathlib import Path

from ...errors import ScenarioError
from ..run_folder.files import SCENARIO_FILE
from ..scenario import Scenario
from ..scenario.file import read_scenario, scenario_text
from ..study.criteria import check_criteria
from ..study.draws import Draw, draw_of
from ..study.file import SEED, Study, variations_of
from ..study.keys import ScenarioKey, changed, keys_named
from ..study.settings import StudySettings
from ..toml_tables import document_of_file, table_of_document, tables_text
from .files import SEARCH_FILE
from .scale import Scale
from .settings import SearchSettings

_PASSED_ON = ("scenario", "seed", "time_limit_s", "memory_limit_mb", "vary", "criteria")
"""Settings that a search has in common with a study."""


@dataclass(frozen=True, slots=True, eq=False)
class Search:
    """A search: a scenario, the quantity that is changed in it, and what is a success.

    Attributes
    ----------
    settings : SearchSettings
        What the file says.
    study : Study
        What varies from trial to trial besides the quantity, and the scenario.
    keys : tuple of ScenarioKey
        Where the quantity is; several where all tables of a list get it.
    """

    settings: SearchSettings
    study: Study
    keys: tuple[ScenarioKey, ...]

    @property
    def scale(self) -> Scale:
        """Return the scale on which it goes."""
        return Scale(self.settings)

    @property
    def unit(self) -> str:
        """Return the unit of what is tried, empty for a plain number."""
        return "" if self.settings.factor else self.keys[0].unit

    @property
    def text(self) -> str:
        """Return the search file in one way of writing, for a folder that has the scenario in ``scenario.toml``."""
        return tables_text(replace(self.settings, scenario=SCENARIO_FILE))

    @property
    def scenario_text(self) -> str:
        """Return the scenario file that goes with `text`."""
        return scenario_text(self.study.scenario)

    @property
    def file_name(self) -> str:
        """Return what the file is called in the folder of the search."""
        return SEARCH_FILE

    def trial(self, number: int, value: float) -> Draw:
        """Return a trial, from 1 on, at a value of the quantity.

        Raises
        ------
        ScenarioError
            The scenario cannot have that value with the others of this trial.
        """
        draw = draw_of(self.study, number)
        scenario = changed(draw.scenario, values_of(self.keys, value, factor=self.settings.factor))
        return replace(draw, inputs={**draw.inputs, self.settings.key: value}, scenario=scenario)


def values_of(keys: tuple[ScenarioKey, ...], value: float, *, factor: bool) -> dict[ScenarioKey, float]:
    """Return the values of keys for a value of the quantity, or for a factor on what they have; whole ones rounded."""
    return {key: _of_kind(key, value * key.value if factor else value) for key in keys}


def _of_kind(key: ScenarioKey, value: float) -> float | int:
    return round(value) if type(key.value) is int else value


def read_search(path: str | PathLike[str]) -> Search:
    """Read a search file, and the scenario that goes with it.

    Parameters
    ----------
    path : str or path
        A TOML file; all keys are in ``docs/search.md``.

    Raises
    ------
    ScenarioError
        A file cannot be read or is not TOML; a key is unknown, missing or has a wrong value; or the scenario cannot
        have the values at the ends of the range.
    """
    path = Path(path)
    try:
        settings = table_of_document(SearchSettings, document_of_file(path, "a search"))
        return search_of(settings, read_scenario(path.parent / settings.scenario))
    except (ScenarioError, ValueError) as error:  # a NUL in a path, for one
        raise ScenarioError(f"{fspath(path)}: {error}") from error


def search_of(settings: SearchSettings, scenario: Scenario) -> Search:
    """Return the search in a scenario.

    Raises
    ------
    ScenarioError
        The scenario lacks what is changed or asked, or cannot have the ends of the range.
    """
    check_criteria(settings.criteria, scenario)
    variations = variations_of(settings.vary, scenario)
    keys = keys_named(scenario, settings.key)
    for key in keys:
        if key.name == SEED:
            raise ScenarioError(f"search.key is {SEED}: expected a quantity of the bridge or its demolition")
        if key.name in [each.key.name for each in variations]:
            raise ScenarioError(f"{key.name} is searched along and drawn as well: leave out its table [[vary]]")
        if settings.factor and (isinstance(key.value, bool) or not isinstance(key.value, int | float)):
            raise ScenarioError(f"search.factor is true: {key.name} has no number in the scenario to multiply")
    for name in ("lowest", "highest"):
        value = getattr(settings, name)
        try:
            changed(scenario, values_of(keys, value, factor=settings.factor))
        except ScenarioError as error:
            raise ScenarioError(f"search.{name} is {value:g}, which the scenario cannot have: {error}") from error
    common = {item.name: getattr(settings, item.name) for item in fields(settings) if item.name in _PASSED_ON}
    study = Study(StudySettings(runs=settings.trials, **common), scenario, variations)
    return Search(settings, study, keys)
