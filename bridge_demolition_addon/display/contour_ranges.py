"""Ranges of contours: what the user asks for, and the position of a value between the lowest and the highest colour."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from ..errors import ContourError
from .colour_scale import ColourMap
from .contour_quantities import ContourQuantity


class RangeKind(StrEnum):
    """Which values the lowest and the highest colour stand for."""

    RUN = "run"
    FRAME = "frame"
    FIXED = "fixed"


@dataclass(frozen=True, slots=True)
class ContourSettings:
    """What bodies are coloured by, and how. Ranges are in N, Pa or m."""

    quantity: ContourQuantity = ContourQuantity.RESULTANT
    peak: bool = False  # the largest value up to a frame, not that of the frame
    whole_run: bool = False  # the peak of all frames, whichever is shown: where the bridge will be loaded most
    range_kind: RangeKind = RangeKind.RUN  # of all frames so far, of each frame, or fixed from low to high
    low: float = 1e3
    high: float = 1e6
    logarithmic: bool = True  # equal steps of colour are equal ratios, without signs
    decades: float = 3.0  # powers of ten in an automatic range that is logarithmic
    percentile: float = 100.0  # of values other than 0 within an automatic range, %; others have its end's colour
    colour_map: ColourMap = ColourMap.VIRIDIS
    shaded: bool = True  # faces are darker the more they look away from the light; else as in the bar
    magnification: float = 1.0  # factor on displacements

    def __post_init__(self) -> None:
        if self.range_kind != RangeKind.FIXED:
            return
        if not self.low < self.high:
            raise ContourError(f"range of contours: its low end, {self.low:g}, has to be below its high, {self.high:g}")
        if self.logarithmic and self.low <= 0.0:
            raise ContourError(f"range of contours: a logarithmic one has to begin above 0, not at {self.low:g}")

    def scale(self, low: float, high: float) -> ContourScale:
        """Return the fixed range, or else that of values from low to high."""
        if self.range_kind == RangeKind.FIXED:
            return ContourScale(self.low, self.high, self.logarithmic)
        if not self.logarithmic:
            return ContourScale(low, high)
        largest = max(-low, high)
        return ContourScale(largest / 10.0**self.decades, largest, True) if largest > 0.0 else ContourScale(0.0, 0.0)


@dataclass(frozen=True, slots=True)
class ContourScale:
    """From values to shares of the range: `low` and below is 0, `high` and above is 1."""

    low: float
    high: float
    logarithmic: bool = False

    def shares(self, values: np.ndarray) -> np.ndarray:
        """Return shares (n,) of values (n,), nan where there is no value; all 0 in a range without an extent."""
        values = np.asarray(values, float)
        low, high = self.low, self.high
        if not low < high:
            return np.where(np.isfinite(values), 0.0, np.nan)
        if self.logarithmic:
            values, low, high = np.log10(np.maximum(abs(values), low)), math.log10(low), math.log10(high)
        return np.clip((values - low) / (high - low), 0.0, 1.0)

    def ticks(self, most: int = 6) -> np.ndarray:
        """Return round values within the range, from low to high, no more than `most` of them."""
        if not self.low < self.high:
            return np.array([self.low])
        if self.logarithmic:
            first, last = math.ceil(math.log10(self.low) - 1e-9), math.floor(math.log10(self.high) + 1e-9)
            exponents = np.arange(first, last + 1)
            powers = 10.0 ** exponents[:: max(1, math.ceil(len(exponents) / most))]
            return powers if len(powers) > 1 else np.array([self.low, self.high])
        step = _round_step((self.high - self.low) / (most - 1))
        first, last = math.ceil(self.low / step - 1e-9), math.floor(self.high / step + 1e-9)
        return step * np.arange(first, last + 1)


def percentiles(values: np.ndarray, percentile: float) -> tuple[float, float]:
    """Return the percentile of the values (n,) below 0, downwards, and of those above it; 0 where there are none."""
    ends = []
    for side in (-1.0, 1.0):
        beyond = (side * values)[side * values > 0.0]
        ends.append(side * float(np.percentile(beyond, percentile)) if len(beyond) else 0.0)
    return ends[0], ends[1]


def _round_step(step: float) -> float:
    """Return the next larger of 1, 2 and 5 times a power of ten."""
    power = 10.0 ** math.floor(math.log10(step))
    return next(power * digit for digit in (1.0, 2.0, 5.0, 10.0) if power * digit >= step * (1.0 - 1e-9))
