"""Settings of an optimisation: which quantities may change, what is best, what has to hold, and how many runs."""

import math
from dataclasses import dataclass
from typing import ClassVar

from ...engineering.statistics.order_limits import least_runs
from .. import schema
from ..schema import Table
from ..study.criteria import neighbour_output
from ..study.runs_table import REACH
from ..study.settings import EnsembleSettings

CHARGE = "charge_kg"
"""Output that says how heavy all charges of a run are together."""

_OUTPUTS = {"reach": (REACH, "m"), "charge": (CHARGE, "kg"), "time": ("came_to_rest_s", "s"), "vibration": ("", "mm/s")}
"""Outputs that objectives are made of, and their units; that of vibration is a neighbour's."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ChosenQuantity(Table):
    """A number of the scenario that may change within a range. As with `search.key`, a key of a list without a name is
    that of all its tables alike."""

    table: ClassVar[str] = "quantities"

    key: str = schema.key('Which number: `charges."mid pier".mass_kg`, `charges.delay_ms`, `ball.drop_height_m`.')
    factor: bool = schema.key(
        "Whether what is tried is a factor on the scenario's own values, instead of a value in the key's unit.",
        default=False,
    )
    lowest: float = schema.key("Lowest value that is tried.")
    highest: float = schema.key("Highest value that is tried.")
    logarithmic: bool = schema.key(
        "Whether a step from 1 to 2 is as large as one from 2 to 4, as suits masses over a wide range.", default=False
    )
    step: float | None = schema.key(
        "Values are tried in multiples of this only, such as delays of 25 ms. By default all.", default=None, above=0
    )

    def _check_together(self) -> None:
        if not self.lowest < self.highest:
            raise self.unexpected("highest", f"more than quantities.lowest, {self.lowest:g}")
        if self.logarithmic and not self.lowest > 0.0:
            raise self.unexpected("lowest", "more than 0 where the quantity is logarithmic")
        if self.step is not None and not self.step <= self.highest - self.lowest:
            raise self.unexpected("step", "at most the range")

    def value(self, share: float) -> float:
        """Return the value at a share of the range, 0 to 1."""
        low, high = (math.log(end) if self.logarithmic else end for end in (self.lowest, self.highest))
        value = low + share * (high - low)
        value = math.exp(value) if self.logarithmic else value
        if self.step is not None:
            value = round(value / self.step) * self.step
        return min(max(float(f"{value:.9g}"), self.lowest), self.highest)


@dataclass(frozen=True, slots=True, kw_only=True)
class ChosenPlace(Table):
    """A position of the scenario that may change within a box along the axes."""

    table: ClassVar[str] = "places"

    key: str = schema.key('Which position: `charges."mid pier".position_m`, `ball.target_m`.')
    lowest_corner_m: tuple[float, ...] = schema.key("Lowest coordinates that are tried.", unit="m")
    highest_corner_m: tuple[float, ...] = schema.key(
        "Highest coordinates that are tried; one that is as its lowest does not change.", unit="m"
    )

    def _check_together(self) -> None:
        if len(self.lowest_corner_m) != len(self.highest_corner_m):
            raise self.unexpected("highest_corner_m", f"{len(self.lowest_corner_m)} numbers, as in lowest_corner_m")
        pairs = list(zip(self.lowest_corner_m, self.highest_corner_m, strict=True))
        if any(low > high for low, high in pairs):
            listed = ", ".join(f"{low:g}" for low in self.lowest_corner_m)
            raise self.unexpected("highest_corner_m", f"no coordinate below that of places.lowest_corner_m, [{listed}]")
        if all(low == high for low, high in pairs):
            raise self.unexpected("highest_corner_m", "a coordinate above that of places.lowest_corner_m")


@dataclass(frozen=True, slots=True, kw_only=True)
class ChosenOrder(Table):
    """Numbers of the scenario that are exchanged: times of steps or delays of charges, whose order is looked for."""

    table: ClassVar[str] = "orders"

    keys: tuple[str, ...] = schema.key(
        'Whose numbers are dealt out differently: `["removals.1.time_s", "removals.2.time_s", "removals.3.time_s"]`.'
    )

    def _check_together(self) -> None:
        if len(self.keys) < 2:
            raise self.unexpected("keys", "two keys or more")


@dataclass(frozen=True, slots=True, kw_only=True)
class ChosenOption(Table):
    """One of several values for some keys alike: which explosive, or what a pier is loaded with, nothing being 0."""

    table: ClassVar[str] = "choices"

    keys: tuple[str, ...] = schema.key(
        """Whose value is chosen, the same for all: `['blast_zones."P2.1".charge_g', 'blast_zones."P2.2".charge_g']`."""
    )
    values: tuple[schema.Scalar, ...] = schema.key(
        "What they are chosen from: `[0, 73.5]`, `[true, false]`, names of a list."
    )

    def _check_together(self) -> None:
        if len(set(self.values)) < 2:
            raise self.unexpected("values", "two that differ, or more")


@dataclass(frozen=True, slots=True, kw_only=True)
class OptimiseSettings(EnsembleSettings):
    """What is to be as small as can be, what has to hold, and the numbers of runs."""

    table: ClassVar[str] = "optimise"
    raised_later: ClassVar[tuple[str, ...]] = ("candidates", "confirmation_runs")

    objective: str = schema.key(
        "What is to be as small as can be. `reach`: the debris distance from the bridge's plan. `charge`: the mass of "
        "all charges. `vibration`: what the charges do to a neighbour's ground. `time`: until everything rests.",
        choices=tuple(_OUTPUTS),
    )
    neighbour: str | None = schema.key("Whose `vibration`, by its name in `[[neighbours]]`.", default=None)
    quantile: float = schema.key(
        "Quantile of what scatters from run to run: the objective.",
        default=0.9,
        at_least=0.5,
        at_most=0.99,
        label="Share of Runs Within",
    )
    probability: float = schema.key(
        "With which probability all criteria have to be met.", default=0.9, at_least=0.01, at_most=0.999
    )
    confidence: float = schema.key(
        "Probability with which limits hold in the end.",
        default=0.95,
        at_least=0.5,
        at_most=0.999,
        label="Certainty of the Limit",
    )
    candidates: int = schema.key(
        "How many sets of values are tried: at least 10, and 5 for each number that may change.",
        default=80,
        at_least=10,
        at_most=100_000,
    )
    runs_each: int = schema.key("Runs of each of these.", default=5, at_least=1, at_most=1000)
    finalists: int = schema.key(
        "How many of the best are run again, to choose among them.", default=4, at_least=1, at_most=1000
    )
    finalist_runs: int = schema.key("Fresh runs of each finalist.", default=20, at_least=1, at_most=100_000)
    confirmation_runs: int = schema.key(
        "Fresh runs of the chosen candidate: its result rests on these alone.",
        default=59,
        at_least=1,
        at_most=100_000,
    )
    at_once: int = schema.key(
        "Candidates that are under way while the next is proposed. It decides which are tried, on any number of "
        "processors.",
        default=2,
        at_least=1,
        at_most=1000,
    )
    quantities: tuple[ChosenQuantity, ...] = ()
    places: tuple[ChosenPlace, ...] = ()
    orders: tuple[ChosenOrder, ...] = ()
    choices: tuple[ChosenOption, ...] = ()

    @property
    def output(self) -> str:
        """Output of each run that is the objective."""
        if self.objective == "vibration":
            return neighbour_output(schema.given(self.neighbour), "vibration_mm_s")
        return _OUTPUTS[self.objective][0]

    @property
    def unit(self) -> str:
        """Unit of the objective."""
        return _OUTPUTS[self.objective][1]

    @property
    def runs(self) -> int:
        """Number of runs in all."""
        return self.candidates * self.runs_each + self.finalists * self.finalist_runs + self.confirmation_runs

    def _check_together(self) -> None:
        if not (self.quantities or self.places or self.orders or self.choices):
            tables = "[[quantities]], [[places]], [[orders]] or [[choices]]"
            raise self.unexpected("quantities", f"at least one table {tables}")
        if not self.criteria:
            raise self.unexpected(
                "criteria",
                f"at least one table [[criteria]]: the smallest {self.objective} without one is that of a bridge that "
                "stays",
            )
        if (self.objective == "vibration") != (self.neighbour is not None):
            wanted = "none" if self.neighbour is not None else "it"
            raise self.unexpected("neighbour", f'{wanted} with objective "{self.objective}"')
        if self.finalists > self.candidates:
            raise self.unexpected("finalists", f"at most optimise.candidates, {self.candidates}")
        least = least_runs(self.probability, self.confidence)
        if self.confirmation_runs < least:
            raise self.unexpected(
                "confirmation_runs",
                f"at least {least}: with fewer, not even a success in every run shows a probability of "
                f"{self.probability:g} with {self.confidence:g} confidence",
            )
