"""Blocks of a report, for a browser or as a PDF: sections of text, tables and pictures."""

from __future__ import annotations

import csv
import gzip
import math
from base64 import b64encode
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Self

from matplotlib.figure import FigureBase

from ...engineering.unit_systems import NEAREST, UP, Unit
from ...engineering.units import name_and_unit, with_digits
from ...model.scenario.recording import ReportSettings
from ...model.schema import given
from ...system.disk import whole_file
from ...system.reading import csv_cell

MISSING = "-"
"""Stands in a table where a value is not known."""


@dataclass(frozen=True, slots=True)
class Paragraph:
    """Text; a notice is set apart, so that it is not overlooked."""

    text: str
    is_notice: bool = False


@dataclass(frozen=True, slots=True)
class Listing:
    """Text that keeps its lines, such as a scenario file."""

    text: str


@dataclass(frozen=True, slots=True)
class Column:
    """A column of a table: its heading for people, which gets its unit, and the key that heads it in CSV files."""

    heading: str
    key: str  # ends in the unit
    form: str = ""  # Python's format of a number, such as ".1f"; empty for texts
    value: Callable[..., Any] | None = None  # of a row, by its item; None where rows are given to the table
    significant: int = 0  # digits that a number with decimals has at least
    unit: str | None = None  # behind the heading; None for that at the end of the key
    is_reach: bool = False  # a distance that people keep or debris may reach, which is never rounded down
    of_row: bool = False  # its numbers have the unit that the row gives, next to its name or in a column of units

    @property
    def shown_unit(self) -> Unit:
        """Return the unit behind its heading; empty without one."""
        return Unit(name_and_unit(self.key)[1] if self.unit is None else self.unit, UP if self.is_reach else NEAREST)

    def shown(self, value: Any) -> str:
        """Return a value as people read it."""
        if value is None or (isinstance(value, float) and not math.isfinite(value)):
            return MISSING
        if self.significant:
            return with_digits(value, int(self.form.strip(".f")), self.significant)
        return format(value, self.form) if self.form else str(value)


@dataclass(frozen=True, slots=True)
class DataTable:
    """A table; its rows also become a CSV file of its name. None is a value that is not known."""

    name: str  # empty for a table that is only read
    title: str
    columns: tuple[Column, ...]
    rows: Sequence[tuple[Any, ...]]

    @classmethod
    def of(cls, name: str, title: str, columns: tuple[Column, ...], *items: Iterable[Any]) -> Self:
        """Return a table with a row for each item, or for items of several kinds side by side, as `map` takes them."""
        values = [given(column.value) for column in columns]
        rows = [tuple(value(*row) for value in values) for row in zip(*items, strict=True)]
        return cls(name, title, columns, rows)

    def shown_rows(self) -> list[list[str]]:
        """Return all rows as people read them."""
        return [[column.shown(value) for column, value in zip(self.columns, row, strict=True)] for row in self.rows]


@dataclass(frozen=True, slots=True)
class Picture:
    """A figure with its caption, drawn once for every kind of report, and its height at the full width of a page."""

    draw: Callable[[FigureBase], None]
    title: str
    height_mm: float = 90.0


@dataclass(frozen=True, slots=True)
class Photo:
    """A rendered picture: the PNG file, and its caption."""

    path: Path
    title: str


@dataclass(frozen=True, slots=True)
class AnimatedModel:
    """An animated model, a GLB file packed by gzip in base64, which a page shows and paper does not."""

    packed: str
    title: str

    @classmethod
    def of(cls, content: bytes, title: str) -> Self:
        """Pack the content of a GLB file; the same content gives the same text."""
        return cls(b64encode(gzip.compress(content, mtime=0)).decode("ascii"), title)


Block = Paragraph | Listing | DataTable | Picture | Photo | AnimatedModel


@dataclass(frozen=True, slots=True)
class Section:
    """A headed part of a report."""

    title: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True, slots=True)
class Control:
    """What identifies a report: on its first page before and after the summary, and at the foot of each page."""

    cover: tuple[DataTable, ...] = ()
    signatures: tuple[DataTable, ...] = ()
    foot: str = ""
    author: str = ""


@dataclass(frozen=True, slots=True)
class Document:
    """A whole report; its summary stands on the first page, before all sections."""

    title: str
    subtitle: str
    sections: tuple[Section, ...]
    summary: tuple[Block, ...] = ()
    control: Control = Control()

    @property
    def first_page(self) -> tuple[Block, ...]:
        """What stands before all sections: what identifies the report, the summary, and lines to sign."""
        return (*self.control.cover, *self.summary, *self.control.signatures)

    def blocks(self) -> Iterator[Block]:
        """Return the blocks of the first page and of every section in order."""
        yield from self.first_page
        for section in self.sections:
            yield from section.blocks

    def named_tables(self) -> list[DataTable]:
        """Return the tables that are also files."""
        return [block for block in self.blocks() if isinstance(block, DataTable) and block.name]

    def table(self, name: str) -> DataTable | None:
        """Return the table of a name; None without one."""
        return next((table for table in self.named_tables() if table.name == name), None)


@dataclass(frozen=True, slots=True)
class Report:
    """A report that is to be written, with tables that are only files, and files that are written already.

    Of a run or a study there are single pages, too, by whom they are for. `settings` are the units and the language
    that its scenario asks for.
    """

    document: Document
    tables: tuple[DataTable, ...] = ()
    files: tuple[Path, ...] = ()
    single_pages: Mapping[str, Document] = field(default_factory=dict)
    settings: ReportSettings = field(default_factory=ReportSettings)


def facts(title: str, rows: Sequence[tuple[str, str]], name: str = "") -> DataTable:
    """Return a table of names and values."""
    return DataTable(name, title, (Column("", "fact"), Column("", "value")), rows)


def write_tables(tables: Iterable[DataTable], folder: Path) -> list[Path]:
    """Write tables as CSV, each in a file of its name, with all digits; what is not known stays empty."""
    written = []
    for table in tables:
        path = folder / f"{table.name}.csv"
        with whole_file(path) as part, part.open("w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(column.key for column in table.columns)
            writer.writerows(["" if value is None else csv_cell(value) for value in row] for row in table.rows)
        written.append(path)
    return written
