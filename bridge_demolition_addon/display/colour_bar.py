"""Colour bar: texts and ticks beside the colours of a frame, in pictures and in the 3D view."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..engineering.unit_systems import IMPERIAL, UnitSystem
from .colour_scale import tick_text
from .contour_quantities import BREAKS, ContourQuantity, ContourUnit
from .contour_ranges import ContourScale, ContourSettings, RangeKind
from .contours import ContourFrame


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
