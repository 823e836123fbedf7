"""Optimisation files, with their scenario, and all that may change in one as numbers from 0 to 1."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import accumulate
from os import PathLike
from typing import Any, ClassVar, Protocol, TypeVar

from ...engineering.arrays import FloatArray
from ...errors import ScenarioError
from ..scenario import Scenario
from ..schema import Table, shown
from ..search.file import values_of
from ..study.criteria import check_criteria
from ..study.file import BEST_FILE, OPTIMISE_FILE, SEED, TRIALS_FILE, Ensemble, read_ensemble_file, variations_of
from ..study.keys import ScenarioKey, changed, keys_named
from ..study.sampled_runs import SampledRun, sampled_run
from .settings import ChosenOption, ChosenOrder, ChosenPlace, ChosenQuantity, OptimiseSettings

Shares = Sequence[float] | FloatArray
"""Numbers from 0 to 1, one for each of what may change."""

_Table = TypeVar("_Table", bound=Table)


class Dimension(Protocol):
    """A part of what may change: keys of the scenario that `size` numbers from 0 to 1 decide."""

    @property
    def keys(self) -> tuple[ScenarioKey, ...]: ...
    @property
    def size(self) -> int: ...

    def values(self, shares: Shares) -> dict[ScenarioKey, Any]:
        """Return the values for the scenario."""

    def shown(self, shares: Shares) -> dict[str, Any]:
        """Return the values for a table, by names of columns."""


@dataclass(frozen=True, slots=True)
class Along:
    """One quantity."""

    quantity: ChosenQuantity
    keys: tuple[ScenarioKey, ...]
    size: int = 1

    def values(self, shares: Shares) -> dict[ScenarioKey, Any]:
        return values_of(self.keys, self.quantity.value(shares[0]), factor=self.quantity.factor)

    def shown(self, shares: Shares) -> dict[str, Any]:
        return {self.quantity.key: self.quantity.value(shares[0])}


@dataclass(frozen=True, slots=True)
class Dealt:
    """Numbers that are dealt out to their keys in another order: the key with the smallest share gets the first."""

    keys: tuple[ScenarioKey, ...]

    @property
    def size(self) -> int:
        return len(self.keys)

    def values(self, shares: Shares) -> dict[ScenarioKey, Any]:
        order = sorted(range(self.size), key=lambda index: shares[index])
        return {self.keys[index]: key.value for index, key in zip(order, self.keys, strict=True)}

    def shown(self, shares: Shares) -> dict[str, Any]:
        values = self.values(shares)
        return {key.name: values[key] for key in self.keys}


@dataclass(frozen=True, slots=True)
class Chosen:
    """One of several values, the same for all keys."""

    keys: tuple[ScenarioKey, ...]
    options: tuple[Any, ...]
    size: int = 1

    def values(self, shares: Shares) -> dict[ScenarioKey, Any]:
        number = min(int(shares[0] * len(self.options)), len(self.options) - 1)
        return dict.fromkeys(self.keys, self.options[number])

    def shown(self, shares: Shares) -> dict[str, Any]:
        return {key.name: value for key, value in self.values(shares).items()}


@dataclass(frozen=True, slots=True)
class Space:
    """All that may change."""

    dimensions: tuple[Dimension, ...]

    @property
    def size(self) -> int:
        """Number of numbers from 0 to 1 of a candidate."""
        return sum(dimension.size for dimension in self.dimensions)

    @property
    def names(self) -> list[str]:
        """Names of the values in a table."""
        return list(self.shown([0.5] * self.size))

    def values(self, shares: Shares) -> dict[ScenarioKey, Any]:
        """Return the values for the scenario by shares (size,)."""
        return {key: value for part, own in self._parts(shares) for key, value in part.values(own).items()}

    def shown(self, shares: Shares) -> dict[str, Any]:
        """Return the values for a table by shares (size,)."""
        return {name: value for part, own in self._parts(shares) for name, value in part.shown(own).items()}

    def _parts(self, shares: Shares) -> list[tuple[Dimension, Shares]]:
        ends = list(accumulate(dimension.size for dimension in self.dimensions))
        return [(part, shares[end - part.size : end]) for part, end in zip(self.dimensions, ends, strict=True)]


def space_of(settings: OptimiseSettings, scenario: Scenario, sampled: Sequence[str]) -> Space:
    """Return what may change in a scenario, without the keys that are sampled, by their names."""
    dimensions: list[Dimension] = []
    named: set[str] = set(sampled)

    def add(tables: Sequence[_Table], make: Callable[[_Table, Scenario], list[Dimension]]) -> None:
        for number, table in enumerate(tables, start=1):
            try:
                made = make(table, scenario)
                for dimension in made:
                    _check_new(dimension.keys, named, sampled)
                    _check_ends(scenario, dimension)
                dimensions.extend(made)
            except ScenarioError as error:
                raise ScenarioError(f"[[{table.table}]] number {number}: {error}") from error

    add(settings.quantities, _along)
    add(settings.places, _in_box)
    add(settings.orders, _dealt)
    add(settings.choices, _chosen)
    return Space(tuple(dimensions))


def _along(quantity: ChosenQuantity, scenario: Scenario) -> list[Dimension]:
    keys = keys_named(scenario, quantity.key)
    for key in keys:
        if not key.has_number and (quantity.factor or key.value is not None):
            raise ScenarioError(f"{key.name} has no number in the scenario: expected a key that has one")
    return [Along(quantity, keys)]


def _in_box(position: ChosenPlace, scenario: Scenario) -> list[Dimension]:
    axes: list[Dimension] = []
    coordinates = _coordinates(position, scenario)
    if coordinates != len(position.lowest_corner_m):
        raise position.unexpected("lowest_corner_m", f"{coordinates} numbers, as {position.key} has")
    for axis, (low, high) in enumerate(zip(position.lowest_corner_m, position.highest_corner_m, strict=True), start=1):
        keys = keys_named(scenario, f"{position.key}.{axis}")
        if low < high:
            axes.append(Along(ChosenQuantity(key=f"{position.key}.{axis}", lowest=low, highest=high), keys))
        elif any(key.value != low for key in keys):
            raise ScenarioError(
                f"{position.key}.{axis} is {keys[0].value:g} in the scenario and {low:g} in both corners: expected "
                f"{keys[0].value:g} there, or two numbers that differ"
            )
    return axes


def _coordinates(position: ChosenPlace, scenario: Scenario) -> int:
    """Return the number of coordinates of a position in the scenario."""
    keys = keys_named(scenario, f"{position.key}.1")
    if len(keys) > 1:
        raise position.unexpected("key", f"one of them, such as {keys[0].name.removesuffix('.1')}")
    value: Any = scenario
    for step in keys[0].steps[:-1]:
        value = value[step] if isinstance(step, int) else getattr(value, step)
    return len(value)


def _dealt(order: ChosenOrder, scenario: Scenario) -> list[Dimension]:
    keys = [key for name in order.keys for key in keys_named(scenario, name)]
    for key in keys:
        if not key.has_number:
            raise ScenarioError(f"{key.name} has no number in the scenario: expected a key that has one")
    if len({key.value for key in keys}) < 2:
        raise order.unexpected("keys", f"numbers that differ; all of them are {keys[0].value:g}")
    return [Dealt(tuple(keys))]


def _chosen(choice: ChosenOption, scenario: Scenario) -> list[Dimension]:
    keys = tuple(key for name in choice.keys for key in keys_named(scenario, name))
    has_floats = all(isinstance(key.value, float) for key in keys)
    options = [float(value) if has_floats and type(value) is int else value for value in choice.values]
    for option in options[1:-1]:  # the first and the last are ends, which are tried with the others
        changed(scenario, dict.fromkeys(keys, option))
    return [Chosen(keys, tuple(options))]


def _check_new(keys: Sequence[ScenarioKey], named: set[str], sampled: Sequence[str]) -> None:
    for key in keys:
        if key.name == SEED:
            raise ScenarioError(f"{SEED} is sampled for each run: expected a quantity of the bridge or its demolition")
        if key.name in sampled:
            raise ScenarioError(f"{key.name} is chosen and sampled as well: leave out its table [[vary]]")
        if key.name in named:
            raise ScenarioError(f"{key.name} is named more than once: expected one table for it")
        named.add(key.name)


def _check_ends(scenario: Scenario, dimension: Dimension) -> None:
    for end in (0.0, 1.0):
        shares = (
            [end] if dimension.size == 1 else [abs(end - index / dimension.size) for index in range(dimension.size)]
        )
        values = dimension.values(shares)
        try:
            changed(scenario, values)
        except ScenarioError as error:
            first, value = next(iter(values.items()))
            raise ScenarioError(
                f"{first.name} may come to {_text(value)}, which the scenario cannot have: {error}"
            ) from error


def _text(value: Any) -> str:
    return f"{value:g}" if isinstance(value, float) else shown(value)


def total_charge_kg(scenario: Scenario) -> float:
    """Return the total mass of a scenario's charges, wherever they are; 0 where it blasts nothing."""
    if not scenario.blast.explosion:
        return 0.0
    charged = (scenario.charges, scenario.blast_zones, scenario.cuts)
    return math.fsum(part.mass_kg for parts in charged for part in parts)


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
