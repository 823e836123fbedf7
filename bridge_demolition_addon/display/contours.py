"""Contours: a quantity of every body, frame by frame, as colours."""

from __future__ import annotations

import bisect
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol

import numpy as np

from ..engineering.geometry.rotations import rotated, rotation_vectors
from ..model.results.arrays import Results
from ..model.results.frames import Frame
from ..model.results.inventory import Inventory
from .colour_scale import colours
from .contour_quantities import ContourQuantity
from .contour_ranges import ContourScale, ContourSettings, RangeKind, percentiles

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
        """Return the lowest and highest value, N, Pa or m, of a row, or of all rows for None; 0 is always among them.

        As in 2019 a range has 0 in it, so that what is free of load has the colour of that. Below 100 the percentile is
        that of the values above 0, and of those below it.
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
        percentile = 100.0 if is_fixed else settings.percentile  # a percentile of all frames takes long
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
