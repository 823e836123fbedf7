"""Colour bar: texts and ticks beside the colours of a frame, in pictures and in the 3D view."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from .colour_scale import tick_text
from .contours import PEAKS_OF_SUBSTEPS, TITLES, ContourFrame, ContourSettings, Quantity, RangeKind, unit_of


@dataclass(frozen=True, eq=False, slots=True)
class ColourBar:
    """What a colour bar says.

    Attributes
    ----------
    title, subtitle
        The quantity, and what is shown of it; the subtitle may be empty.
    unit
        Of the ticks, in brackets.
    tick_shares : (t,) float
        Where the ticks are, from 0 (lowest) to 1 (highest).
    tick_texts
        Their t numbers.
    frame, time
        Which frame it is.
    """

    title: str
    subtitle: str
    unit: str
    tick_shares: np.ndarray
    tick_texts: tuple[str, ...]
    frame: str
    time: str


def colour_bar(settings: ContourSettings, frame: ContourFrame) -> ColourBar:
    """Return the colour bar of a frame."""
    scale = frame.scale
    unit, ticks = unit_of(settings.quantity, max(abs(scale.low), abs(scale.high))), scale.ticks()
    return ColourBar(
        title=TITLES[settings.quantity],
        subtitle=", ".join(_what_is_shown(settings)),
        unit=f"({unit.name})",
        tick_shares=scale.shares(ticks),
        tick_texts=tuple(tick_text(tick / unit.size) for tick in ticks),
        frame=f"{'stage' if settings.quantity == Quantity.UTILISATION else 'frame'} {frame.frame}",
        time=f"{frame.time_s:.3f} s",
    )


def _what_is_shown(settings: ContourSettings) -> Iterator[str]:
    since = "of the whole run" if settings.whole_run else "so far"
    if settings.quantity == Quantity.UTILISATION:
        yield "worst connection"
    elif settings.quantity == Quantity.DISPLACEMENT:
        if settings.peak:
            yield f"peak {since}"
    elif settings.peak:
        yield f"sub-step peak {since}" if settings.quantity in PEAKS_OF_SUBSTEPS else f"frame mean, peak {since}"
    else:
        yield "frame mean"
    if settings.percentile < 100.0 and settings.range_kind != RangeKind.FIXED:
        yield f"up to percentile {settings.percentile:g}"
    if settings.magnification != 1.0:
        yield f"shape × {settings.magnification:g}"
