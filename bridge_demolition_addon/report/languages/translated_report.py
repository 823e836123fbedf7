"""The documents and drawings of a report, put into a language and a system of units."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
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

from ...engineering.unit_systems import LEAST_DIGITS, Conversion
from ...texts import Text, Unit
from ..document.blocks import AnimatedModel, Block, Column, DataTable, Document, Paragraph, Photo, Picture, Section
from .translation import Translation

_MOST_SHOWN = 3
"""Texts that stayed English, and are named at the head of the report."""

_LACKING = "The table of this language lacks {} texts of this report, which are in English, such as: {}"
_DRAWINGS = Text("The drawings are in English: no font with the letters of this language was found.")
NOTE = Text(
    "Quantities here are in US customary units: a short ton is 2000 lb, a kip 1000 lbf, and distances that debris "
    "reaches or people keep are rounded up. Tables in files, site plans, the scenario, formulas with constants, "
    "distributions of studies, diameters of bars after Ø (mm) and rendered pictures are in SI units."
)
"""What a report says at its head where its units are not those of its files."""

_NUMBER = re.compile(r"-?\d+(\.\d+)?(e[-+]\d+)?")


def translated_document(document: Document, translation: Translation) -> Document:
    """Return a report in language and units. Keys, names of files, listings of files and what files hold stay.

    Where the table of the language lacks a text, the report says so at its head.
    """
    sections = tuple(
        Section(translation.label(section.title), _blocks(section.blocks, translation)) for section in document.sections
    )
    title, subtitle = translation.text(document.title), translation.text(document.subtitle)
    control = replace(
        document.control,
        cover=tuple(_table(table, translation) for table in document.control.cover),
        signatures=tuple(_table(table, translation) for table in document.control.signatures),
        foot=translation.text(document.control.foot),
    )
    return Document(title, subtitle, sections, _blocks(document.summary, translation), control)


def with_notes(document: Document, notes: Sequence[str]) -> Document:
    """Return a report with notes at its head."""
    return replace(document, summary=(*(Paragraph(note, is_notice=True) for note in notes), *document.summary))


def notes_at_head(translation: Translation, can_draw: bool) -> list[str]:
    """Return what a report says of its units, and what of it stayed English: texts without a translation, drawings."""
    notes = [translation.text(NOTE)] if translation.converts else []
    if translation.missing:
        first = "; ".join(translation.missing[:_MOST_SHOWN])
        notes.append(translation.text(Text(_LACKING, len(translation.missing), first)))
    return notes if can_draw else [*notes, translation.text(_DRAWINGS)]


def _blocks(blocks: Sequence[Block], translation: Translation) -> tuple[Block, ...]:
    return tuple(_block(block, translation) for block in blocks)


def _block(block: Block, translation: Translation) -> Block:
    match block:
        case Paragraph():
            return replace(block, text=translation.label(block.text))
        case DataTable():
            return _table(block, translation)
        case Picture() | Photo() | AnimatedModel():
            return replace(block, title=translation.label(block.title))
    return block


def _table(table: DataTable, translation: Translation) -> DataTable:
    """Return a table as people read it: its file is written from that in English and SI units."""
    columns = tuple(_column(column, translation) for column in table.columns)
    rows = [_row(table.columns, row, translation) for row in table.rows]
    return replace(table, title=translation.label(table.title), columns=columns, rows=rows)


def _unit(column: Column) -> Unit:
    """Return the unit of the numbers of a column, which may be its heading; empty for texts."""
    if not column.form:
        return Unit("")
    return column.heading if isinstance(column.heading, Unit) else column.shown_unit


def _column(column: Column, translation: Translation) -> Column:
    """Return a column with its unit, and about as many digits as it had."""
    heading, unit = translation.label(column.heading), translation.unit(column.shown_unit)
    own = replace(column, heading=f"{heading} ({unit})" if unit else heading)
    conversion = translation.conversion(_unit(column))
    if conversion is None and not (column.of_row and column.form and translation.converts):
        return own
    if column.form.endswith("g"):
        return replace(own, form=f".{int(column.form.strip('.g')) + 1}g")
    assert conversion is not None  # numbers by the unit of their row have no fixed decimals
    decimals = max(0, -conversion.last_digit(column.shown(0.0)))
    return replace(own, form=f".{decimals}f", significant=LEAST_DIGITS)


def _row(columns: Sequence[Column], row: tuple[Any, ...], translation: Translation) -> tuple[Any, ...]:
    own = _unit_of_row(row) if any(column.of_row for column in columns) else Unit("")
    return tuple(
        _cell(column, value, own if column.of_row else _unit(column), translation)
        for column, value in zip(columns, row, strict=True)
    )


def _unit_of_row(row: tuple[Any, ...]) -> Unit:
    """Return the unit in one of the cells of a row: by itself, or within a text; empty without one."""
    within = [part for cell in row if isinstance(cell, Text) for part in cell.values]
    return next((unit for unit in (*row, *within) if isinstance(unit, Unit)), Unit(""))


def _cell(column: Column, value: Any, unit: Unit, translation: Translation) -> Any:
    """Return a value of a table, numbers in the unit of the column, rounded as they are shown."""
    shown, conversion = column.shown(value), translation.conversion(unit)
    if conversion is not None and _NUMBER.fullmatch(shown):
        number = conversion.number(shown, unit.rounding)
        return float(number) + 0.0 if column.form else number  # no zero with a sign
    return value if column.form or value is None else translation.text(shown)


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
