"""The documents of a report, put into a system of units."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from ...engineering.unit_systems import LEAST_DIGITS, Conversion, UnitSystem
from ...engineering.units import name_and_unit
from ..document.blocks import (
    AnimatedModel,
    Block,
    Column,
    DataTable,
    Document,
    Paragraph,
    Photo,
    Picture,
    Section,
)
from .quantities import ReportUnits, rounding_of

NOTE = (
    "Quantities here are in US customary units: a short ton is 2000 lb, a kip 1000 lbf, and distances that debris "
    "reaches or people keep are rounded up. Tables in files, site plans, the scenario, formulas with constants, "
    "distributions of studies, diameters of bars after Ø (mm) and rendered pictures are in SI units."
)
"""What a report says at its head where its units are not those of its files."""

_NUMBER = re.compile(r"-?\d+(\.\d+)?(e[-+]\d+)?")


def measured_document(document: Document, english: Document, quantities: ReportUnits) -> Document:
    """Return a report with its quantities in a system of units.

    Parameters
    ----------
    document
        The report in its language.
    english
        The same in English, which tells distances to keep.
    quantities
        What converts them.
    """
    if quantities.are_metric:
        return document
    sections = tuple(
        Section(quantities.text(section.title, same.title), _blocks(section.blocks, same.blocks, quantities))
        for section, same in zip(document.sections, english.sections, strict=True)
    )
    title, subtitle = quantities.text(document.title), quantities.text(document.subtitle)
    return Document(title, subtitle, sections, _blocks(document.summary, english.summary, quantities))


def notes_on_units(system: UnitSystem) -> list[str]:
    """Return what a report in a system of units says at its head, in English."""
    return [] if system is UnitSystem.METRIC else [NOTE]


def _blocks(blocks: Sequence[Block], english: Sequence[Block], quantities: ReportUnits) -> tuple[Block, ...]:
    return tuple(_block(block, same, quantities) for block, same in zip(blocks, english, strict=True))


def _block(block: Block, english: Block, quantities: ReportUnits) -> Block:
    match block, english:
        case Paragraph(), Paragraph():
            return replace(block, text=quantities.text(block.text, english.text))
        case DataTable(), DataTable():
            return _table(block, english, quantities)
        case ((Picture() | Photo() | AnimatedModel()), (Picture() | Photo() | AnimatedModel())):
            return replace(block, title=quantities.heading(block.title, english.title))
    return block


def _table(table: DataTable, english: DataTable, quantities: ReportUnits) -> DataTable:
    """Return a table as people read it: its file is written from that in SI units."""
    conversions = [_conversion(column, table.title, quantities) for column in table.columns]
    columns = tuple(
        _column(column, conversion, quantities) for column, conversion in zip(table.columns, conversions, strict=True)
    )
    rows = [
        _row(table, row, english, same, conversions, quantities)
        for row, same in zip(table.rows, english.rows, strict=True)
    ]
    return replace(table, title=quantities.heading(table.title, english.title), columns=columns, rows=rows)


def _conversion(column: Column, title: str, quantities: ReportUnits) -> Conversion | None:
    """Return the conversion of a column with a unit in its heading, or in its key and the title of the table."""
    if (own := quantities.conversion(column.heading)) or not column.form:
        return own
    of_title, of_key = quantities.conversion(title), quantities.of_unit(name_and_unit(column.key)[1])
    return of_title if of_title is of_key else None


def _row(
    table: DataTable,
    row: tuple[Any, ...],
    english: DataTable,
    same: tuple[Any, ...],
    conversions: Sequence[Conversion | None],
    quantities: ReportUnits,
) -> tuple[Any, ...]:
    """Return a row in the system, by the units of its columns, or by its own."""
    texts = [str(value) for value in same if isinstance(value, str)]
    by_row = any(column.of_row for column in table.columns)
    own = _unit_of_row(table, row, quantities) if by_row else None
    cells = []
    for number, (column, value) in enumerate(zip(table.columns, row, strict=True)):
        conversion = own if column.of_row else conversions[number]
        about = " ".join([english.title, english.columns[number].heading, *texts])
        if conversion is not None and (column.form or column.of_row):
            cells.append(_number(column, value, conversion, about))
        elif column.cites or not isinstance(value, str):
            cells.append(value)
        else:
            cells.append(quantities.heading(value, about) if by_row else quantities.text(value, about))
    return tuple(cells)


def _unit_of_row(table: DataTable, row: tuple[Any, ...], quantities: ReportUnits) -> Conversion | None:
    """Return the conversion of a row by the unit in one of its cells: by itself, or in brackets behind a name."""
    cells = (value for column, value in zip(table.columns, row, strict=True) if not (column.of_row or column.form))
    conversions = (quantities.conversion(str(value)) for value in cells)
    return next((conversion for conversion in conversions if conversion), None)


def _number(column: Column, value: Any, conversion: Conversion, about: str) -> Any:
    """Return the number of a cell in the system, rounded as it is shown; as text where it was one."""
    shown = column.shown(value)
    if not _NUMBER.fullmatch(shown):
        return value
    number = conversion.number(shown, rounding_of(conversion, about))
    return float(number) + 0.0 if column.form else number  # no zero with a sign


def _column(column: Column, conversion: Conversion | None, quantities: ReportUnits) -> Column:
    """Return a column with its unit in the system, and about as many digits as it had."""
    heading = quantities.heading(column.heading)
    if not column.form or (conversion is None and not column.of_row):
        return replace(column, heading=heading)
    if column.form.endswith("g"):
        return replace(column, heading=heading, form=f".{int(column.form.strip('.g')) + 1}g")
    assert conversion is not None  # numbers by the unit of their row have no fixed decimals
    decimals = max(0, -conversion.last_digit(column.shown(0.0)))
    return replace(column, heading=heading, form=f".{decimals}f", significant=LEAST_DIGITS)
