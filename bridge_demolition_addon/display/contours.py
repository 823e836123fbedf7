"""Contours: a quantity of every body, frame by frame, and its place within a range of values."""

from __future__ import annotations

import bisect
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property

import numpy as np

from ..engineering.geometry.rotations import rotated, rotation_vectors
from ..engineering.geometry.vectors import length
from ..engineering.mechanics.frame_loads import FrameLoads
from ..engineering.mechanics.stress import principal_stresses
from ..errors import ContourError
from ..model.results.arrays import Results
from ..model.results.frames import Frame
from ..model.results.inventory import Inventory
from .colour_scale import ColourMap, colours


class Quantity(StrEnum):
    """What a body is coloured by."""

    SIGNED_2019 = "signed 2019"
    RESULTANT = "resultant"
    SUM = "sum"
    VON_MISES = "von Mises"
    PRINCIPAL = "principal"
    DISPLACEMENT = "displacement"
    UTILISATION = "utilisation"


TITLES = {
    Quantity.SIGNED_2019: "Contact force of 2019",
    Quantity.RESULTANT: "Resultant force",
    Quantity.SUM: "Sum of forces",
    Quantity.VON_MISES: "Von Mises stress",
    Quantity.PRINCIPAL: "Largest principal stress",
    Quantity.DISPLACEMENT: "Displacement",
    Quantity.UTILISATION: "Utilisation at rest",
}

STRESSES = (Quantity.VON_MISES, Quantity.PRINCIPAL)
"""Quantities in Pa. Displacement is in m, utilisation, of stages alone, a share, and all others are in N."""


PEAKS_OF_SUBSTEPS = (Quantity.RESULTANT, Quantity.SUM)
"""Quantities whose largest value of all sub-steps of a frame is recorded beside the mean over the frame."""


_BALL = "ball"


class RangeKind(StrEnum):
    """Which values the lowest and the highest colour stand for."""

    RUN = "run"
    FRAME = "frame"
    FIXED = "fixed"


@dataclass(frozen=True, slots=True)
class ContourSettings:
    """What is shown, and how.

    Attributes
    ----------
    quantity
        What bodies are coloured by.
    peak
        Whether to show the largest value up to a frame instead of that of the frame.
    whole_run
        Whether that is the largest value of all frames, whichever is shown: where the bridge will be loaded most.
    range_kind
        Of all frames so far, of each frame by itself, or fixed.
    low, high
        The fixed range, N, Pa or m.
    logarithmic
        Whether equal steps of colour stand for equal ratios. Signs are left out then.
    decades
        Powers of ten in an automatic range that is logarithmic.
    percentile
        Share of the values other than 0 that lie within an automatic range, %; the few beyond it have its end's colour.
    colour_map
        Which colours.
    shaded
        Whether faces are darker the more they look away from the light; without it each colour is as in the bar.
    magnification
        How many times as far as they are displaced bodies are shown.

    Raises
    ------
    ContourError
        A fixed range is empty, or begins at 0 or below and is logarithmic.
    """

    quantity: Quantity = Quantity.RESULTANT
    peak: bool = False
    whole_run: bool = False
    range_kind: RangeKind = RangeKind.RUN
    low: float = 1e3
    high: float = 1e6
    logarithmic: bool = True
    decades: float = 3.0
    percentile: float = 100.0
    colour_map: ColourMap = ColourMap.VIRIDIS
    shaded: bool = True
    magnification: float = 1.0

    def __post_init__(self) -> None:
        if self.range_kind != RangeKind.FIXED:
            return
        if not self.low < self.high:
            raise ContourError(f"range of contours: its low end, {self.low:g}, has to be below its high, {self.high:g}")
        if self.logarithmic and self.low <= 0.0:
            raise ContourError(f"range of contours: a logarithmic one has to begin above 0, not at {self.low:g}")


@dataclass(frozen=True, slots=True)
class Scale:
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


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit that keeps numbers short: values are divided by `size`."""

    name: str
    size: float


def unit_of(quantity: Quantity, high: float) -> Unit:
    """Return the unit for a quantity whose largest magnitude is `high`, in N, Pa or m."""
    if quantity in STRESSES:
        return Unit("N/mm²", 1e6) if high >= 1e4 else Unit("kPa", 1e3)
    if quantity == Quantity.DISPLACEMENT:
        return Unit("m", 1.0) if high >= 1.0 else Unit("mm", 1e-3)
    if quantity == Quantity.UTILISATION:
        return Unit("%", 0.01)
    return Unit("MN", 1e6) if high >= 1e6 else Unit("kN", 1e3) if high >= 1e3 else Unit("N", 1.0)


def unit_of_range(quantity: Quantity) -> Unit:
    """Return the unit in which a fixed range is given."""
    if quantity == Quantity.DISPLACEMENT:
        return Unit("mm", 1e-3)
    if quantity == Quantity.UTILISATION:
        return Unit("%", 0.01)
    return Unit("N/mm²", 1e6) if quantity in STRESSES else Unit("kN", 1e3)


@dataclass(frozen=True, slots=True)
class ContourFrame:
    """Colours of one frame.

    Attributes
    ----------
    frame, time_s
        Which.
    values : (n,) float
        N, Pa or m; nan where a body has no value.
    scale
        The range.
    screen_colours : (n, 3) float
        As a screen has them.
    """

    frame: int
    time_s: float
    values: np.ndarray
    scale: Scale
    screen_colours: np.ndarray


class ContourSeries:
    """The frames of a recording as contours: of one that still grows, or of a finished one.

    Parameters
    ----------
    inventory : Inventory
        Its bodies and connections. Bodies that do not move are not coloured and do not count for ranges; a ball is
        coloured and does not count, as the force on it is larger than that on any shard.
    recorded : sequence of Frame
        Its frames, each of which is looked up when it is needed; there may be more of them later.

    Attributes
    ----------
    recorded
        As given.
    """

    def __init__(self, inventory: Inventory, recorded: Sequence[Frame]):
        self.body_names = inventory.body_names.tolist()
        self.moves, self.pairs, self.points_m = inventory.moves, inventory.pairs, inventory.points_m
        self._counts = inventory.moves & (inventory.body_kinds != _BALL)
        self.recorded = recorded
        self._rows: dict[int, int] = {}
        self._numbers: list[int] = []
        self._times_s: list[float] = []
        self._values: dict[tuple[Quantity, bool], list[np.ndarray]] = {}
        self._extents: dict[tuple[Quantity, bool], list[tuple[float, float]]] = {}
        self._percentiles: dict[tuple[Quantity, bool, float], tuple[int, tuple[float, float]]] = {}

    @classmethod
    def of_results(cls, results: Results) -> ContourSeries:
        """Return the contours of a finished recording."""
        series = cls(results.inventory, results.frames)
        series.follow()
        return series

    def __len__(self) -> int:
        return len(self._times_s)

    @property
    def frames(self) -> list[int]:
        """Numbers of the frames, in their order."""
        return list(self._rows)

    @property
    def times_s(self) -> np.ndarray:
        """(k,) simulated times of the frames."""
        return np.array(self._times_s, float)

    def follow(self) -> None:
        """Take in the frames that were recorded since the last look."""
        for row in range(len(self), len(self.recorded)):
            frame = self.recorded[row]
            self._rows[int(frame.number)] = row
            self._numbers.append(int(frame.number))
            self._times_s.append(float(frame.time_s))

    def row_at(self, frame: int) -> int | None:
        """Return the row of a frame or of the last recorded one before it, else the first; None without any."""
        if frame in self._rows:
            return self._rows[frame]
        return max(bisect.bisect_right(self.frames, frame) - 1, 0) if self._times_s else None

    def frame(self, row: int) -> Frame:
        """Return the frame of a row as it was recorded."""
        return self.recorded[row]

    @cached_property
    def _first(self) -> Frame:
        """The frame from which displacements are: looking one up may read it from the disk."""
        return self.recorded[0]

    def magnified(self, row: int, magnification: float) -> Frame:
        """Return the frame of a row with its bodies displaced and turned so many times as much as they are."""
        frame, first = self.recorded[row], self._first
        if magnification == 1.0:
            return frame
        turns = rotation_vectors(first.rotations, frame.rotations)
        return replace(
            frame,
            positions_m=first.positions_m + magnification * (frame.positions_m - first.positions_m),
            rotations=rotated(first.rotations, magnification * turns),
        )

    def values(self, row: int, quantity: Quantity, *, peak: bool = False) -> np.ndarray:
        """Return the values (n,) of a row, N, Pa or m; nan for bodies that do not move and where nothing is known."""
        self._fill(quantity, peak)
        return self._values[quantity, peak][row]

    def show(self, row: int, settings: ContourSettings) -> ContourFrame:
        """Return the colours of a row."""
        of = len(self) - 1 if settings.peak and settings.whole_run else row
        values = self.values(of, settings.quantity, peak=settings.peak)
        scale = self._scale(of, settings)
        painted = colours(settings.colour_map, scale.shares(values))
        return ContourFrame(self._numbers[row], self._times_s[row], values, scale, painted)

    def extent(
        self, row: int | None, quantity: Quantity, *, peak: bool = False, percentile: float = 100.0
    ) -> tuple[float, float]:
        """Return the lowest and highest value, N, Pa or m, of a row, or of all rows for None; 0 is always among them.

        As in 2019 a range has 0 in it, so that what is free of load has the colour of that. Below 100 the percentile is
        that of the values above 0, and of those below it.
        """
        self._fill(quantity, peak)
        if percentile < 100.0:
            return self._percentile(row, quantity, peak, percentile)
        extents = self._extents[quantity, peak]
        chosen = extents if row is None else extents[row : row + 1]
        return min(each[0] for each in chosen), max(each[1] for each in chosen)

    def _percentile(self, row: int | None, quantity: Quantity, peak: bool, percentile: float) -> tuple[float, float]:
        values = self._values[quantity, peak]
        if row is not None:
            return percentiles(values[row][self._counts], percentile)
        rows, found = self._percentiles.get((quantity, peak, percentile), (0, (0.0, 0.0)))
        if rows < len(values):
            found = percentiles(np.concatenate([each[self._counts] for each in values]), percentile)
            self._percentiles[quantity, peak, percentile] = len(values), found
        return found

    def _scale(self, row: int, settings: ContourSettings) -> Scale:
        if settings.range_kind == RangeKind.FIXED:
            return fixed_scale(settings)
        of_frame = settings.range_kind == RangeKind.FRAME
        rows = row if of_frame else None
        ends = self.extent(rows, settings.quantity, peak=settings.peak, percentile=settings.percentile)
        return automatic_scale(settings, *ends)

    def _fill(self, quantity: Quantity, peak: bool) -> None:
        """Calculate the rows that were added since."""
        values = self._values.setdefault((quantity, peak), [])
        extents = self._extents.setdefault((quantity, peak), [])
        for row in range(len(values), len(self)):
            found = np.where(self.moves, self._found(row, quantity, peak), np.nan)
            if peak and values:
                found = np.fmax(values[-1], found)
            known = found[self._counts & np.isfinite(found)]
            values.append(found)
            extents.append((float(known.min(initial=0.0)), float(known.max(initial=0.0))))

    def _found(self, row: int, quantity: Quantity, peak: bool) -> np.ndarray:
        """Return the values (n,) of a row, whether bodies move or not."""
        frame = self.recorded[row]
        if quantity == Quantity.UTILISATION:
            return np.full(len(self.moves), np.nan)
        if quantity == Quantity.DISPLACEMENT:
            return length(frame.positions_m - self._first.positions_m)
        return _peaks(quantity, frame.loads) if peak else _means(quantity, frame.loads)


def fixed_scale(settings: ContourSettings) -> Scale:
    """Return the range that the settings give."""
    return Scale(settings.low, settings.high, settings.logarithmic)


def automatic_scale(settings: ContourSettings, low: float, high: float) -> Scale:
    """Return the range for values from low to high."""
    if not settings.logarithmic:
        return Scale(low, high)
    largest = max(-low, high)
    return Scale(largest / 10.0**settings.decades, largest, True) if largest > 0.0 else Scale(0.0, 0.0)


def percentiles(values: np.ndarray, percentile: float) -> tuple[float, float]:
    """Return the percentile of the values (n,) below 0, downwards, and of those above it; 0 where there are none."""
    ends = []
    for side in (-1.0, 1.0):
        beyond = (side * values)[side * values > 0.0]
        ends.append(side * float(np.percentile(beyond, percentile)) if len(beyond) else 0.0)
    return ends[0], ends[1]


def _means(quantity: Quantity, loads: FrameLoads) -> np.ndarray:
    """Return the values (n,) of a frame."""
    match quantity:
        case Quantity.SIGNED_2019:
            return loads.body_signed_2019_n
        case Quantity.RESULTANT:
            return length(loads.body_forces_n)
        case Quantity.SUM:
            return loads.body_sums_n
        case Quantity.VON_MISES:
            return loads.von_mises_pa
        case Quantity.PRINCIPAL:
            return principal_stresses(loads.stresses_pa)[:, 0]


def _peaks(quantity: Quantity, loads: FrameLoads) -> np.ndarray:
    """Return the largest values (n,) within a frame, as far as they are recorded."""
    match quantity:
        case Quantity.SIGNED_2019:
            return abs(_means(quantity, loads))
        case Quantity.RESULTANT:
            return loads.body_peaks_n
        case Quantity.SUM:
            return loads.body_peak_sums_n
        case _:
            return _means(quantity, loads)


def _round_step(step: float) -> float:
    """Return the next larger of 1, 2 and 5 times a power of ten."""
    power = 10.0 ** math.floor(math.log10(step))
    return next(power * digit for digit in (1.0, 2.0, 5.0, 10.0) if power * digit >= step * (1.0 - 1e-9))
