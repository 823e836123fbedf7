"""Search files: TOML read strictly into a `Search`, with the scenario in which it changes a quantity."""

from __future__ import annotations

from dataclasses import dataclass, replace
from os import PathLike
from typing import ClassVar

from ...errors import ScenarioError
from ...texts import Quantity, Text, Unit
from ..scenario import Scenario
from ..study.criteria import check_criteria
from ..study.file import ANSWER_FILE, SEARCH_FILE, SEED, TRIALS_FILE, Ensemble, read_ensemble_file, variations_of
from ..study.keys import ScenarioKey, changed, keys_named
from ..study.sampled_runs import SampledRun, sampled_run
from ..study.shown_names import words_and_unit
from .settings import LevelScale, SearchSettings


@dataclass(frozen=True, slots=True, eq=False)
class Search(Ensemble):
    """A search: a scenario, the quantity that is changed in it, and the criteria of success."""

    kind: ClassVar[str] = "search"
    file_name: ClassVar[str] = SEARCH_FILE
    table_file: ClassVar[str] = TRIALS_FILE
    result_file: ClassVar[str] = ANSWER_FILE

    settings: SearchSettings
    keys: tuple[ScenarioKey, ...]  # where the quantity is; several where all tables of a list get it

    @property
    def scale(self) -> LevelScale:
        """Scale of the search."""
        return LevelScale(self.settings)

    @property
    def unit(self) -> str:
        """Unit of the quantity, empty for a plain number."""
        return "" if self.settings.factor else self.keys[0].unit

    def amount(self, number: str, *, shown: bool = True) -> str:
        """Return a value of the quantity with its unit, if it has one."""
        return Quantity(number, self.unit, shown=shown) if self.unit else number

    @property
    def shown_quantity(self) -> str:
        """The quantity as people read it, with its unit in brackets, or the word factor."""
        words, unit = words_and_unit(self.settings.key)
        if self.settings.factor:
            return Text("{} (factor)", words)
        unit = unit or self.unit
        return Text("{0} ({1})", words, Unit(unit)) if unit else words

    def run_at(self, number: int, value: float) -> SampledRun:
        """Return a run, from 1 on, at a value of the quantity."""
        chosen = values_of(self.keys, value, factor=self.settings.factor)
        run = sampled_run(self, number, chosen)
        return replace(run, inputs={**run.inputs, self.settings.key: value})


def values_of(keys: tuple[ScenarioKey, ...], value: float, *, factor: bool) -> dict[ScenarioKey, float]:
    """Return the values of keys for a value of the quantity, or for a factor on their values; whole ones rounded."""
    values = {key: value * key.value if factor else value for key in keys}
    return {key: round(own) if type(key.value) is int else own for key, own in values.items()}


def read_search(path: str | PathLike[str]) -> Search:
    """Read a search file, and the scenario that goes with it; all keys are in ``docs/search_file.md``."""
    return read_ensemble_file(path, SearchSettings, search_of, "a search")


def search_of(settings: SearchSettings, scenario: Scenario) -> Search:
    """Return the search in a scenario."""
    check_criteria(settings.criteria, scenario)
    variations = variations_of(settings.vary, scenario)
    keys = keys_named(scenario, settings.key)
    for key in keys:
        if key.name == SEED:
            raise ScenarioError(f"search.key is {SEED}: expected a quantity of the bridge or its demolition")
        if key.name in [variation.key.name for variation in variations]:
            raise ScenarioError(f"{key.name} is searched along and sampled as well: leave out its table [[vary]]")
        if settings.factor and not key.has_number:
            raise ScenarioError(f"search.factor is true: {key.name} has no number in the scenario to multiply")
    for name in ("lowest", "highest"):
        value = getattr(settings, name)
        try:
            changed(scenario, values_of(keys, value, factor=settings.factor))
        except ScenarioError as error:
            raise ScenarioError(f"search.{name} is {value:g}, which the scenario cannot have: {error}") from error
    return Search(settings, scenario, variations, keys)
