"""Contours: a quantity of every body, frame by frame or of stages, as colours in a range, with their colour bar."""

from __future__ import annotations

import bisect
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property
from typing import Protocol

import numpy as np

from ..engineering.geometry.vectors import rotated, rotation_vectors
from ..engineering.unit_systems import IMPERIAL, UnitSystem
from ..errors import ContourError
from ..model.results.arrays import Results
from ..model.results.frames import Frame, Inventory
from ..model.stages.stages import Stage
from ..model.structure.model import Model
from .colour_scale import ColourMap, colours, tick_text
from .contour_quantities import BREAKS, ContourQuantity, ContourUnit


class RangeKind(StrEnum):
    """Which values the lowest and the highest colour stand for."""

    RUN = "run"
    FRAME = "frame"
    FIXED = "fixed"


@dataclass(frozen=True, slots=True)
class ContourSettings:
    """What bodies are coloured by, and how. Ranges are in N, Pa or m."""

    quantity: ContourQuantity = ContourQuantity.RESULTANT
    peak: bool = False  # the largest value up to a frame, not the frame's
    whole_run: bool = False  # the peak over the run, whichever frame is shown: where the bridge will be loaded most
    range_kind: RangeKind = RangeKind.RUN  # over the frames so far, of each frame, or fixed from low to high
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
        """Return the fixed range, or else the range of the values from low to high."""
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


_BALL = "ball"


@dataclass(frozen=True, slots=True)
class ContourFrame:
    """Colours (n, 3) of one frame on a screen, and their values (n,) in N, Pa or m; nan where a body has none."""

    frame: int
    time_s: float
    values: np.ndarray
    scale: ContourScale
    screen_colours: np.ndarray


class FrameLookup(Protocol):
    """Frames that are looked up by their row."""

    def __len__(self) -> int: ...

    def __getitem__(self, row: int) -> Frame: ...


class ContourSeries:
    """The frames of a recording as contours: of one that still grows, or of a finished one.

    Bodies that do not move are not coloured and do not count for ranges. A ball is coloured and does not count, as the
    force on it is larger than that on any shard. Frames are looked up when they are needed; there may be more later.
    """

    def __init__(self, inventory: Inventory, recorded: FrameLookup):
        self.body_names = inventory.body_names.tolist()
        self.moves, self.pairs, self.points_m = inventory.moves, inventory.pairs, inventory.points_m
        self._counts = inventory.moves & (inventory.body_kinds != _BALL)
        self.recorded = recorded
        self._rows: dict[int, int] = {}
        self._numbers: list[int] = []
        self._times_s: list[float] = []
        self._values: dict[tuple[ContourQuantity, bool], list[np.ndarray]] = {}
        self._extents: dict[tuple[ContourQuantity, bool], list[tuple[float, float]]] = {}
        self._percentiles: dict[tuple[ContourQuantity, bool, float], tuple[int, tuple[float, float]]] = {}

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
        """Return the frame of a row with its bodies displaced and turned by the magnification."""
        frame, first = self.recorded[row], self._first
        if magnification == 1.0:
            return frame
        turns = rotation_vectors(first.rotations, frame.rotations)
        return replace(
            frame,
            positions_m=first.positions_m + magnification * (frame.positions_m - first.positions_m),
            rotations=rotated(first.rotations, magnification * turns),
        )

    def values(self, row: int, quantity: ContourQuantity, *, peak: bool = False) -> np.ndarray:
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
        self, row: int | None, quantity: ContourQuantity, *, peak: bool = False, percentile: float = 100.0
    ) -> tuple[float, float]:
        """Return the lowest and highest value, N, Pa or m, of a row or, for None, of every row; 0 is always among them.

        As in 2019 a range has 0 in it, so that what is free of load has the colour of that. Below 100 the percentile
        counts the values above 0 and the values below 0 apart.
        """
        self._fill(quantity, peak)
        if percentile < 100.0:
            return self._percentile(row, quantity, peak, percentile)
        extents = self._extents[quantity, peak]
        chosen = extents if row is None else extents[row : row + 1]
        return min(low for low, _ in chosen), max(high for _, high in chosen)

    def _percentile(
        self, row: int | None, quantity: ContourQuantity, peak: bool, percentile: float
    ) -> tuple[float, float]:
        values = self._values[quantity, peak]
        if row is not None:
            return percentiles(values[row][self._counts], percentile)
        rows, extent = self._percentiles.get((quantity, peak, percentile), (0, (0.0, 0.0)))
        if rows < len(values):
            extent = percentiles(np.concatenate([value[self._counts] for value in values]), percentile)
            self._percentiles[quantity, peak, percentile] = len(values), extent
        return extent

    def _scale(self, row: int, settings: ContourSettings) -> ContourScale:
        rows = row if settings.range_kind == RangeKind.FRAME else None
        is_fixed = settings.range_kind == RangeKind.FIXED
        percentile = 100.0 if is_fixed else settings.percentile  # a percentile over a whole run takes long
        return settings.scale(*self.extent(rows, settings.quantity, peak=settings.peak, percentile=percentile))

    def _fill(self, quantity: ContourQuantity, peak: bool) -> None:
        """Calculate the rows that were added since."""
        values = self._values.setdefault((quantity, peak), [])
        extents = self._extents.setdefault((quantity, peak), [])
        for row in range(len(values), len(self)):
            values_of = quantity.peak if peak else quantity.mean
            row_values = np.where(self.moves, values_of(self.recorded[row], self._first), np.nan)
            if peak and values:
                row_values = np.fmax(values[-1], row_values)
            known = row_values[self._counts & np.isfinite(row_values)]
            values.append(row_values)
            extents.append((float(known.min(initial=0.0)), float(known.max(initial=0.0))))


@dataclass(frozen=True, slots=True, eq=False)
class StageContours:
    """Utilisation of n shards in s stages."""

    times_s: np.ndarray  # (s,) begin of the stages
    used: np.ndarray  # (s, n) largest utilisation of a shard's connections; nan where it has none any more
    centres_m: np.ndarray  # (n, 3), by which the shards are known in a scene

    @classmethod
    def of_stages(cls, model: Model, stages: Sequence[Stage]) -> StageContours:
        """Return the contours of the stages of a model."""
        used = [used_by_shard(model, stage.standing.used) for stage in stages]
        return cls(np.array([stage.time_s for stage in stages]), np.array(used), np.asarray(model.centres_m))

    def __len__(self) -> int:
        return len(self.times_s)

    def show(self, stage: int, settings: ContourSettings) -> ContourFrame:
        """Return the colours of a stage, from 1 on.

        A range that is not fixed is linear, from 0 to where connections break, or as far beyond as they are used.
        """
        values = self.used[stage - 1]
        of = values if settings.range_kind == RangeKind.FRAME else self.used
        _, high = percentiles(of[np.isfinite(of)], settings.percentile)
        is_fixed = settings.range_kind == RangeKind.FIXED
        scale = settings.scale(0.0, high) if is_fixed else ContourScale(0.0, max(high, BREAKS))
        painted = colours(settings.colour_map, scale.shares(values))
        return ContourFrame(stage, float(self.times_s[stage - 1]), values, scale, painted)


def used_by_shard(model: Model, used: np.ndarray) -> np.ndarray:
    """Return the largest utilisation (n,) of each shard's connections, from the connections' (m,)."""
    largest = np.full(len(model.shards), np.nan)
    for shards in model.connections.pairs.T:
        there = shards >= 0  # the ground is no shard
        np.fmax.at(largest, shards[there], used[there])
    return largest


@dataclass(frozen=True, eq=False, slots=True)
class ColourBar:
    """Texts of a colour bar, with ticks at shares (t,) from 0 (lowest) to 1 (highest)."""

    title: str
    subtitle: str
    unit: str
    tick_shares: np.ndarray
    tick_texts: tuple[str, ...]
    frame: str
    time: str


def colour_bar(settings: ContourSettings, frame: ContourFrame, units: UnitSystem = UnitSystem.METRIC) -> ColourBar:
    """Return the colour bar of a frame, with ticks that are round in its unit of a system."""
    scale = frame.scale
    unit = _in_system(settings.quantity.units.of(max(abs(scale.low), abs(scale.high))), units)
    ticks = unit.size * ContourScale(scale.low / unit.size, scale.high / unit.size, scale.logarithmic).ticks()
    if settings.quantity is ContourQuantity.UTILISATION and scale.low <= BREAKS <= scale.high:
        ticks = np.union1d(ticks, BREAKS)
    return ColourBar(
        title=settings.quantity.title,
        subtitle=", ".join(_what_is_shown(settings)),
        unit=f"({unit.name})",
        tick_shares=scale.shares(ticks),
        tick_texts=tuple(tick_text(tick / unit.size) for tick in ticks),
        frame=f"{'stage' if settings.quantity is ContourQuantity.UTILISATION else 'frame'} {frame.frame}",
        time=f"{frame.time_s:.3f} s",
    )


def _in_system(unit: ContourUnit, units: UnitSystem) -> ContourUnit:
    """Return a metric unit, or the one of another system for it, as large in SI units as its numbers need."""
    conversion = IMPERIAL.get(unit.name) if units is UnitSystem.IMPERIAL else None
    return unit if conversion is None else ContourUnit(conversion.unit, unit.size / conversion.factor)


def _what_is_shown(settings: ContourSettings) -> Iterator[str]:
    quantity = settings.quantity
    if quantity is ContourQuantity.UTILISATION:
        yield "worst connection"
    elif settings.peak:
        yield f"{quantity.kind_of_peak} {'of the whole run' if settings.whole_run else 'so far'}"
    elif quantity.kind_of_mean:
        yield quantity.kind_of_mean
    if settings.percentile < 100.0 and settings.range_kind != RangeKind.FIXED:
        yield f"up to percentile {settings.percentile:g}"
    if settings.magnification != 1.0:
        yield f"shape × {settings.magnification:g}"
