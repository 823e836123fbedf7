"""The tables of a search file, as checked values."""

from dataclasses import dataclass
from typing import ClassVar

from .. import schema
from ..schema import LARGEST_INTEGER, Table
from ..study.criteria import Criterion
from ..study.settings import Vary

FEWEST_TRIALS = 10
"""Opening trials that a search has at least: with fewer, hardly any trials overlap."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SearchSettings(Table):
    """What is searched for, along which quantity, and how well it is to be known."""

    table: ClassVar[str] = "search"

    scenario: str = schema.key("Path of the scenario file, from the search file's folder.")
    key: str = schema.key(
        "Which quantity, by its key as in a study: `ball.drop_height_m`, `charges.mass_kg` for all charges alike."
    )
    factor: bool = schema.key(
        "Whether what is tried is a factor on the scenario's own values, instead of a value in the key's unit.",
        default=False,
    )
    lowest: float = schema.key("Lowest value that is tried.")
    highest: float = schema.key("Highest value that is tried.")
    logarithmic: bool = schema.key(
        "Whether the logarithm of the quantity is what scatters about a median, as with charges and strengths.",
        default=False,
    )
    spread: float | None = schema.key(
        "Guess of the standard deviation, by default a sixth of the range; of the natural logarithm if `logarithmic`.",
        default=None,
        above=0,
    )
    step: float | None = schema.key(
        "Values are tried in multiples of this only, such as charges of 0.5 kg. By default all.", default=None, above=0
    )
    success: str = schema.key(
        "Whether all criteria are met the more often `above` or `below`: the higher or the lower the quantity.",
        default="above",
        choices=("above", "below"),
    )
    probability: float = schema.key(
        "With which probability the criteria are to be met at the value that is looked for.",
        default=0.9,
        at_least=0.01,
        at_most=0.999,
    )
    confidence: float = schema.key(
        "Probability with which the limit that is given holds.", default=0.95, at_least=0.5, at_most=0.999
    )
    trials: int = schema.key("Most trials.", default=60, at_least=FEWEST_TRIALS, at_most=100_000)
    within: float | None = schema.key(
        "The search stops as soon as the limit is that close to the likeliest value, in the unit of the quantity. By "
        "default it makes all trials.",
        default=None,
        above=0,
    )
    at_once: int = schema.key(
        "Trials that are under way while the next is chosen. It decides which trials are made, on any number of "
        "processors.",
        default=4,
        at_least=1,
        at_most=1000,
    )
    seed: int = schema.key("Start of the random numbers.", default=0, at_least=0, at_most=LARGEST_INTEGER)
    time_limit_s: float | None = schema.key(
        "Time after which a run is ended that hangs; it counts as no success. By default none.",
        default=None,
        unit="s",
        above=0,
    )
    memory_limit_mb: float | None = schema.key(
        "Memory of a run's process above which it is ended, on Linux; it counts as no success. By default none.",
        default=None,
        unit="MB",
        above=0,
    )
    vary: tuple[Vary, ...] = ()
    criteria: tuple[Criterion, ...] = ()

    def _check_together(self) -> None:
        if not self.lowest < self.highest:
            raise self.unexpected("highest", f"more than search.lowest, {self.lowest:g}")
        if self.logarithmic and not self.lowest > 0.0:
            raise self.unexpected("lowest", "more than 0 where the search is logarithmic")
        if self.step is not None and not 3.0 * self.step <= self.highest - self.lowest:
            raise self.unexpected("step", "at most a third of the range")
        if not self.criteria:
            raise self.unexpected("criteria", "at least one table [[criteria]]: what is a success")
