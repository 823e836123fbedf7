"""Distributions that inputs are sampled from, each by the inverse of its cumulative distribution.

A value begins as a probability, a multiple of 2⁻⁵³ above 0 and below 1. So the values of each distribution have ends,
also of a normal one: none lies further from its mean than `FARTHEST_DEVIATION` deviations. Values have the same bits on
every processor.
"""

from __future__ import annotations

import math
from dataclasses import Field, dataclass
from functools import cached_property
from typing import Any, ClassVar, Protocol

from ...engineering.arithmetic import exponential, logarithm
from ...engineering.statistics.normal import normal_probability, normal_quantile
from ...errors import ScenarioError

LEAST_PROBABILITY = 1.0 / 2**53
"""The smallest probability; the largest is as far from 1."""

LEAST_KEPT = 1e-6
"""Smallest part of a distribution that its `lowest` and `highest` may leave."""

FARTHEST_DEVIATION = -normal_quantile(LEAST_PROBABILITY)
"""Largest distance of a value of a normal distribution from its mean, in deviations: 8.2."""


class Distribution(Protocol):
    """A distribution that can be sampled: a dataclass of its parameters."""

    __dataclass_fields__: ClassVar[dict[str, Field[Any]]]

    @property
    def tried(self) -> tuple[Any, ...]:
        """The lowest and the highest value, or all values of a choice."""

    def quantile(self, probability: float) -> Any:
        """Return the value that a sample stays below, or is, with a probability above 0 and below 1."""


@dataclass(frozen=True, slots=True)
class Uniform:
    """All values from the lowest to the highest, equally likely."""

    lowest: float
    highest: float

    @property
    def tried(self) -> tuple[float, ...]:
        return self.lowest, self.highest

    def quantile(self, probability: float) -> float:
        return (1.0 - probability) * self.lowest + probability * self.highest


@dataclass(frozen=True, slots=True)
class Triangular:
    """From the lowest to the highest value; the density rises evenly to the most likely one, and falls evenly."""

    lowest: float
    most_likely: float
    highest: float

    @property
    def tried(self) -> tuple[float, ...]:
        return self.lowest, self.highest

    def quantile(self, probability: float) -> float:
        width, rise = self.highest - self.lowest, self.most_likely - self.lowest
        if probability * width < rise:
            return self.lowest + math.sqrt(probability * width * rise)
        return self.highest - math.sqrt((1.0 - probability) * width * (width - rise))


@dataclass(frozen=True)
class Normal:
    """Normal distribution, cut off below the lowest and above the highest value where they are given.

    What is cut off does not pile up at the ends: the rest is scaled up.
    """

    mean: float
    deviation: float
    lowest: float = -math.inf
    highest: float = math.inf

    def __post_init__(self) -> None:
        first, last = self._below
        if last - first < LEAST_KEPT:
            raise ScenarioError(
                f"less than {LEAST_KEPT:g} of this distribution lies from lowest to highest: expected ends around it"
            )

    @property
    def tried(self) -> tuple[float, ...]:
        lowest = self.lowest if self.lowest > -math.inf else self.quantile(LEAST_PROBABILITY)
        return lowest, self.highest if self.highest < math.inf else self.quantile(1.0 - LEAST_PROBABILITY)

    def quantile(self, probability: float) -> float:
        below, above = ((1.0 - probability) * first + probability * last for first, last in (self._below, self._above))
        deviations = normal_quantile(below) if below < above else -normal_quantile(above)
        return min(max(self.mean + self.deviation * deviations, self.lowest), self.highest)

    @cached_property
    def _below(self) -> tuple[float, float]:
        """Probabilities of the whole distribution below the lowest and below the highest value."""
        low, high = (normal_probability((end - self.mean) / self.deviation) for end in (self.lowest, self.highest))
        return low, high

    @cached_property
    def _above(self) -> tuple[float, float]:
        """Probabilities above them: a small one is known to more digits than its difference from 1."""
        low, high = (normal_probability((self.mean - end) / self.deviation) for end in (self.lowest, self.highest))
        return low, high


@dataclass(frozen=True)
class Lognormal:
    """Lognormal distribution by its median and its coefficient of variation, cut off as a normal one is.

    The logarithm is normal with deviation √ln(1 + variation²).
    """

    median: float
    variation: float
    lowest: float = 0.0
    highest: float = math.inf

    def __post_init__(self) -> None:
        _ = self._of_logarithm  # refuses ends that leave nothing

    @property
    def tried(self) -> tuple[float, ...]:
        lowest = self.lowest if self.lowest > 0.0 else self.quantile(LEAST_PROBABILITY)
        return lowest, self.highest if self.highest < math.inf else self.quantile(1.0 - LEAST_PROBABILITY)

    def quantile(self, probability: float) -> float:
        value = self.median * float(exponential(self._of_logarithm.quantile(probability)))
        return min(max(value, self.lowest), self.highest)

    @cached_property
    def _of_logarithm(self) -> Normal:
        """Distribution of the logarithm of value over median."""
        deviation = math.sqrt(float(logarithm(1.0 + self.variation * self.variation)))
        lowest, highest = (float(logarithm(end / self.median)) for end in (self.lowest, self.highest))
        return Normal(0.0, deviation, lowest, highest)


@dataclass(frozen=True, slots=True)
class Chance:
    """True with a probability, otherwise false."""

    probability: float

    @property
    def tried(self) -> tuple[bool, bool]:
        return True, False

    def quantile(self, probability: float) -> bool:
        return probability < self.probability


@dataclass(frozen=True, slots=True)
class Choice:
    """Some values, equally likely."""

    values: tuple[Any, ...]

    @property
    def tried(self) -> tuple[Any, ...]:
        return self.values

    def quantile(self, probability: float) -> Any:
        return self.values[int(probability * len(self.values))]
