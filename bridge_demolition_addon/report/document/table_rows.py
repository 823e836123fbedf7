"""Tables as pages show them: texts wrapped into columns that fit beside each other."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

from ...charts.style import PAGE_WIDTH_MM
from ..languages.letters import pieces
from .blocks import Column, DataTable
from .page import Font, width_mm
from .page_style import GAP_MM, LINE, SMALL, SMALL_STRONG
from .wrapping import wrapped

SMALLEST_COLUMN_MM = 14.0
_KEPT_TOGETHER_MM = 45.0
"""A table whose rows are not higher stays on one page."""

_ROWS_AT_FOOT = 3
"""Of a longer table at least so many rows stand below its headings."""

Cells = Sequence[Sequence[str]]
"""The lines of each cell of a row."""


@dataclass(frozen=True, slots=True)
class Rows:
    """A table as it is laid out: the lines of all cells, and the widths of its columns in mm."""

    columns: Sequence[Column]
    headings: Cells
    cells: Sequence[Cells]
    widths: Sequence[float]

    @classmethod
    def of(cls, table: DataTable) -> Self:
        """Wrap the texts of a table."""
        rows, headings = table.shown_rows(), [column.heading for column in table.columns]
        widths = _column_widths([headings, *rows])
        wrapped = _wrapped_cells(headings, widths, SMALL_STRONG) if any(headings) else []
        return cls(table.columns, wrapped, [_wrapped_cells(row, widths, SMALL) for row in rows], widths)

    @property
    def least_mm(self) -> float:
        """Height of its title and of as many rows as stay together."""
        heights = [row_height_mm(row) for row in (self.headings, *self.cells)]
        together = heights if math.fsum(heights) < _KEPT_TOGETHER_MM else heights[: 1 + _ROWS_AT_FOOT]
        return 8.0 + math.fsum(together)


def _column_widths(rows: Sequence[Sequence[str]]) -> list[float]:
    """Return widths in mm: what the texts need where there is room, else less for the widest columns.

    Words are cut only where there is no other way.
    """
    columns = list(zip(*rows, strict=True))
    widths = [_widest_mm(column) for column in columns]
    words = [_widest_mm([word for _, word in pieces(" ".join(column))]) for column in columns]
    evenly_mm = (PAGE_WIDTH_MM - GAP_MM * (len(widths) - 1)) / len(widths)
    for least_mm in (math.inf, SMALLEST_COLUMN_MM, min(evenly_mm, SMALLEST_COLUMN_MM)):
        _narrow(widths, [min(word, least_mm) for word in words])
    return widths


def _narrow(widths: list[float], least: Sequence[float]) -> None:
    """Make the widest columns narrower until all fit on a page, or have their least widths."""
    room = PAGE_WIDTH_MM - GAP_MM * (len(widths) - 1)
    while math.fsum(widths) > room:
        wider = [number for number, width in enumerate(widths) if width > least[number]]
        if not wider:
            return
        widest = max(wider, key=widths.__getitem__)
        widths[widest] = max(widths[widest] - 1.0, least[widest])


def _widest_mm(texts: Sequence[str]) -> float:
    return max((width_mm(text, SMALL_STRONG) for text in texts), default=0.0)


def _wrapped_cells(texts: Sequence[str], widths: Sequence[float], font: Font) -> Cells:
    return [list(wrapped(text, width, font)) for text, width in zip(texts, widths, strict=True)]


def row_height_mm(cells: Cells) -> float:
    return max(1, *map(len, cells)) * LINE * SMALL.height_mm + 1.2 if cells else 0.0
