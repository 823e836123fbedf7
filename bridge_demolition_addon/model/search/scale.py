"""The scale on which a search goes: higher levels succeed more often, whatever the quantity does."""

from __future__ import annotations

import math
from dataclasses import dataclass

from .settings import SearchSettings

_LARGEST_EXPONENT = 700.0

_DIGITS = 9
"""Of the values that are tried: what functions of different libraries round otherwise is not among them."""


@dataclass(frozen=True, slots=True)
class LevelScale:
    """From the values of a quantity to levels, and back.

    Attributes
    ----------
    settings : SearchSettings
        Whether it is logarithmic, and which way is up.
    """

    settings: SearchSettings

    @property
    def is_falling(self) -> bool:
        """Whether success is the likelier the lower the quantity."""
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
        """Value of a level; of an infinite one, or what no number holds, ± ∞."""
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
