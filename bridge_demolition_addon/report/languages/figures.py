"""The texts and axes within a drawing, put into the language and the units of a report: it is drawn in SI units."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.text import Text as DrawnText
from matplotlib.ticker import (
    AutoLocator,
    FixedFormatter,
    Formatter,
    Locator,
    LogFormatterSciNotation,
    LogLocator,
    NullFormatter,
    ScalarFormatter,
)

from ...engineering.unit_systems import Conversion
from ...texts import Text, Unit
from .translation import Translation


def translate_figure(figure: Figure, translation: Translation) -> None:
    """Put the texts of a drawing, and the numbers along its axes, into language and units, before it is laid out."""
    for axis in figure.findobj(Axis):
        for formatter in (axis.get_major_formatter(), axis.get_minor_formatter()):
            if isinstance(formatter, FixedFormatter):
                formatter.seq = [translation.text(text) for text in formatter.seq]
        if conversion := _conversion(axis.get_label_text(), translation):
            _measure_axis(axis, conversion)
    for text in figure.findobj(DrawnText):
        if (shown := text.get_text()).strip():
            text.set_text(translation.text(shown))


def _conversion(label: str, translation: Translation) -> Conversion | None:
    """Return the conversion of an axis by the unit in its label."""
    units = [value for value in label.values if isinstance(value, Unit)] if isinstance(label, Text) else []
    return translation.conversion(units[-1]) if units else None


def _measure_axis(axis: Axis, conversion: Conversion) -> None:
    """Have an axis count in another unit than what is drawn along it."""
    factor = conversion.factor
    if axis.get_scale() == "log":
        axis.set_major_locator(_OtherTicks(LogLocator(), factor))
        axis.set_major_formatter(_OtherNumbers(LogFormatterSciNotation(), factor))
        axis.set_minor_locator(_OtherTicks(LogLocator(subs="auto"), factor))
        axis.set_minor_formatter(NullFormatter())
    elif not isinstance(axis.get_major_formatter(), FixedFormatter):
        axis.set_major_locator(_OtherTicks(AutoLocator(), factor))
        axis.set_major_formatter(_OtherNumbers(ScalarFormatter(), factor))


class _Borrowed:
    """An axis as a locator or formatter of the other unit sees it."""

    def __init__(self, axis: Any, factor: float) -> None:
        self._axis, self._factor = axis, factor

    def get_view_interval(self) -> np.ndarray:
        return np.asarray(self._axis.get_view_interval()) * self._factor

    def get_data_interval(self) -> np.ndarray:
        return np.asarray(self._axis.get_data_interval()) * self._factor

    def __getattr__(self, name: str) -> Any:
        return getattr(self._axis, name)


def _borrowed(axis: Any, factor: float) -> Any:
    """Return an axis in the other unit, as locators and formatters take one."""
    return _Borrowed(axis, factor)


class _OtherTicks(Locator):
    """Ticks at round numbers of the other unit."""

    def __init__(self, inner: Locator, factor: float) -> None:
        self._inner, self._factor = inner, factor

    def set_axis(self, axis: Any) -> None:
        super().set_axis(axis)
        self._inner.set_axis(_borrowed(axis, self._factor))

    def __call__(self) -> Any:
        return np.asarray(self._inner()) / self._factor

    def tick_values(self, vmin: float, vmax: float) -> Any:
        return np.asarray(self._inner.tick_values(vmin * self._factor, vmax * self._factor)) / self._factor


class _OtherNumbers(Formatter):
    """Numbers of the other unit at ticks."""

    def __init__(self, inner: Formatter, factor: float) -> None:
        self._inner, self._factor = inner, factor

    def set_axis(self, axis: Any) -> None:
        super().set_axis(axis)
        self._inner.set_axis(_borrowed(axis, self._factor))

    def __call__(self, x: float, pos: int | None = None) -> str:
        return self._inner(x * self._factor, pos)

    def set_locs(self, locs: list[float]) -> None:
        super().set_locs(locs)
        self._inner.set_locs([loc * self._factor for loc in locs])

    def get_offset(self) -> str:
        return self._inner.get_offset()
