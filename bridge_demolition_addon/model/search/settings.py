"""The tables of a search file, as checked values, and the scale that they say."""

import math
from dataclasses import dataclass
from typing import ClassVar

from .. import schema
from ..study.settings import EnsembleSettings

FEWEST_TRIALS = 10
"""Runs that a search has at least: with fewer, successes and failures hardly ever overlap."""

_LARGEST_EXPONENT = 700.0

_DIGITS = 9
"""Of the values that are tried: rounding that differs from library to library is not among them."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SearchSettings(EnsembleSettings):
    """What is searched for, along which quantity, and how well it is to be known."""

    table: ClassVar[str] = "search"
    raised_later: ClassVar[tuple[str, ...]] = ("trials",)

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
        "Whether higher (`above`) or lower (`below`) values meet all criteria more often.",
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
        "Probability with which the limit that is given holds.",
        default=0.95,
        at_least=0.5,
        at_most=0.999,
        label="Certainty of the Limit",
    )
    trials: int = schema.key("Most runs.", default=60, at_least=FEWEST_TRIALS, at_most=100_000)
    within: float | None = schema.key(
        "The search stops as soon as the limit is that close to the likeliest value, in the unit of the quantity. By "
        "default it makes all runs.",
        default=None,
        above=0,
    )
    at_once: int = schema.key(
        "Runs that are under way while the next is chosen. It decides which runs are made, on any number of "
        "processors.",
        default=4,
        at_least=1,
        at_most=1000,
    )

    def _check_together(self) -> None:
        if not self.lowest < self.highest:
            raise self.unexpected("highest", f"more than search.lowest, {self.lowest:g}")
        if self.logarithmic and not self.lowest > 0.0:
            raise self.unexpected("lowest", "more than 0 where the search is logarithmic")
        if self.step is not None and not 3.0 * self.step <= self.highest - self.lowest:
            raise self.unexpected("step", "at most a third of the range")
        if not self.criteria:
            raise self.unexpected("criteria", "at least one table [[criteria]]: what is a success")


@dataclass(frozen=True, slots=True)
class LevelScale:
    """From the values of a quantity to levels, and back: higher levels succeed more often."""

    settings: SearchSettings

    @property
    def is_falling(self) -> bool:
        """Whether lower values of the quantity succeed more often."""
        return self.settings.success == "below"

    @property
    def ends(self) -> tuple[float, float]:
        """Lowest and highest level."""
        low, high = sorted((self.level(self.settings.lowest), self.level(self.settings.highest)))
        return low, high

    @property
    def spread(self) -> float:
        """Guess of the spread of levels."""
        low, high = self.ends
        return (high - low) / 6.0 if self.settings.spread is None else self.settings.spread

    def level(self, value: float) -> float:
        """Level of a value."""
        level = math.log(value) if self.settings.logarithmic else value
        return -level if self.is_falling else level

    def value(self, level: float) -> float:
        """Value of a level; ± ∞ where it is infinite or too large."""
        level = -level if self.is_falling else level
        if not self.settings.logarithmic or not math.isfinite(level):
            return level
        return math.exp(level) if abs(level) < _LARGEST_EXPONENT else math.copysign(math.inf, level)

    def tried(self, level: float) -> float:
        """Value that is tried for a level: within the range, and a multiple of the step."""
        settings = self.settings
        value = self.value(level)
        if settings.step is not None and math.isfinite(value):
            value = round(value / settings.step) * settings.step
        value = float(f"{value:.{_DIGITS}g}")
        return min(max(value, settings.lowest), settings.highest)

    def rounded(self, level: float) -> float:
        """Level of the value that is tried for a level."""
        return self.level(self.tried(level))
