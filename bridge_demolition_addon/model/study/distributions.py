"""Distributions that inputs are sampled from, each by the inverse of its cumulative distribution.

A value begins as a probability, a multiple of 2⁻⁵³ above 0 and below 1. So the values of each distribution have ends,
also of a normal one: none lies further from its mean than `FARTHEST_DEVIATION` deviations. Values have the same bits on
every processor.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import Field, dataclass
from functools import cached_property, reduce
from typing import Any, ClassVar, Protocol

from ...engineering.arithmetic import coefficients, exponential, logarithm
from ...errors import ScenarioError

LEAST_PROBABILITY = 1.0 / 2**53
"""The smallest probability; the largest is as far from 1."""

LEAST_KEPT = 1e-6
"""Smallest part of a distribution that its `lowest` and `highest` may leave."""

_CENTRE = (
    coefficients(
        "3.3871328727963666080 1.3314166789178437745e2 1.9715909503065514427e3 1.3731693765509461125e4 "
        "4.5921953931549871457e4 6.7265770927008700853e4 3.3430575583588128105e4 2.5090809287301226727e3"
    ),
    coefficients(
        "1.0 4.2313330701600911252e1 6.8718700749205790830e2 5.3941960214247511077e3 "
        "2.1213794301586595867e4 3.9307895800092710610e4 2.8729085735721942674e4 5.2264952788528545610e3"
    ),
)
_SHOULDER = (
    coefficients(
        "1.42343711074968357734 4.63033784615654529590 5.76949722146069140550 3.64784832476320460504 "
        "1.27045825245236838258 2.41780725177450611770e-1 2.27238449892691845833e-2 7.74545014278341407640e-4"
    ),
    coefficients(
        "1.0 2.05319162663775882187 1.67638483018380384940 6.89767334985100004550e-1 "
        "1.48103976427480074590e-1 1.51986665636164571966e-2 5.47593808499534494600e-4 1.05075007164441684324e-9"
    ),
)
_TAIL = (
    coefficients(
        "6.65790464350110377720 5.46378491116411436990 1.78482653991729133580 2.96560571828504891230e-1 "
        "2.65321895265761230930e-2 1.24266094738807843860e-3 2.71155556874348757815e-5 2.01033439929228813265e-7"
    ),
    coefficients(
        "1.0 5.99832206555887937690e-1 1.36929880922735805310e-1 1.48753612908506148525e-2 "
        "7.86869131145613259100e-4 1.84631831751005468180e-5 1.42151175831644588870e-7 2.04426310338993978564e-15"
    ),
)


def normal_quantile(probability: float) -> float:
    """Return the value that a standard normal variable stays below with a probability, above 0 and below 1.

    M. J. Wichura (1988), Algorithm AS 241: The percentage points of the normal distribution, Applied Statistics 37,
    477-484, PPND16: within about 1e-16, relative.
    """
    from_middle = probability - 0.5
    if abs(from_middle) <= 0.425:
        return from_middle * _ratio(_CENTRE, 0.180625 - from_middle * from_middle)
    depth = math.sqrt(-float(logarithm(min(probability, 1.0 - probability))))
    size = _ratio(_SHOULDER, depth - 1.6) if depth <= 5.0 else _ratio(_TAIL, depth - 5.0)
    return math.copysign(size, from_middle)


def normal_probability(value: float) -> float:
    """Return the probability that a standard normal variable is below a value: the inverse of `normal_quantile`.

    By halving, until no number lies between.
    """
    if value == -math.inf:
        return 0.0
    if value > 0.0:
        return 1.0 - normal_probability(-value)
    low, high = 0.0, 0.5
    while low < (middle := 0.5 * (low + high)) < high:
        low, high = (low, middle) if normal_quantile(middle) > value else (middle, high)
    return low if value < 0.0 else 0.5


def _ratio(polynomials: tuple[Sequence[float], Sequence[float]], x: float) -> float:
    """Return the ratio of two polynomials, by Horner."""
    upper, lower = (reduce(lambda value, part: part + x * value, reversed(parts), 0.0) for parts in polynomials)
    return upper / lower


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
