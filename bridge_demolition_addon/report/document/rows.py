"""Rows on the pages of a PDF: tables whose texts fit side by side, drawings, and photos side by side."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import Self

from matplotlib.figure import Figure
from matplotlib.image import imread
from PIL import Image

from ...charts.style import MM_PER_INCH, PAGE_WIDTH_MM, POINTS_PER_INCH, blank_figure
from ..languages.letters import pieces
from .blocks import AnimatedModel, Block, Column, DataTable, Listing, Paragraph, Photo, Picture
from .page import BOTTOM_MM, GAP_MM, LINE, SMALL, SMALL_STRONG, TOP_MM, Font, width_mm, wrapped

SMALLEST_COLUMN_MM = 14.0
_KEPT_TOGETHER_MM = 45.0
"""A table whose rows are not higher stays on one page."""

_ROWS_AT_FOOT = 3
"""Of a longer table at least so many rows stand below its headings."""

Cells = Sequence[Sequence[str]]
"""The lines of each cell of a row."""


@dataclass(frozen=True, slots=True)
class Rows:
    """A table as it is laid out: the lines of its cells, and the widths of its columns in mm."""

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


SMALLEST_SCALE = 0.8
"""Of a drawing that is made smaller so that it fits on the rest of a page: its letters can still be read."""

_PHOTOS_ABREAST = 2
PHOTO_GAP_MM = 4.0

PHOTO_DOTS_PER_INCH = 150.0


@dataclass(frozen=True, slots=True)
class PhotoRow:
    """Photos side by side."""

    photos: tuple[Photo, ...]

    @property
    def gaps_mm(self) -> float:
        return (len(self.photos) - 1) * PHOTO_GAP_MM

    @property
    def width_mm(self) -> float:
        """Width of each."""
        return (PAGE_WIDTH_MM - self.gaps_mm) / len(self.photos)


Drawn = Picture | PhotoRow
Shown = Paragraph | Listing | DataTable | Drawn


def abreast(blocks: Iterable[Block]) -> Iterator[Shown]:
    """Yield blocks with photos that follow each other side by side, and without what paper does not show."""
    on_paper = (block for block in blocks if not isinstance(block, AnimatedModel))
    for is_photo, run in groupby(on_paper, key=lambda block: isinstance(block, Photo)):
        if is_photo:
            photos = [block for block in run if isinstance(block, Photo)]
            for first in range(0, len(photos), _PHOTOS_ABREAST):
                yield PhotoRow(tuple(photos[first : first + _PHOTOS_ABREAST]))
        else:
            yield from (block for block in run if not isinstance(block, Photo | AnimatedModel))


def drawn_height_mm(block: Drawn) -> float:
    """Return how high a block is as it is drawn, without its caption."""
    if isinstance(block, Picture):
        return block.height_mm
    return max(_photo_mm(photo, block.width_mm)[1] for photo in block.photos)


def caption_mm(block: Drawn) -> float:
    """Return what the caption of a block takes, with the room around it."""
    if isinstance(block, Picture):
        lines = len(list(wrapped(block.title, PAGE_WIDTH_MM, SMALL)))
    else:
        width_mm = SMALLEST_SCALE * block.width_mm
        lines = max(len(list(wrapped(photo.title, width_mm, SMALL))) for photo in block.photos)
    return 1.0 + lines * LINE * SMALL.height_mm


def _photo_mm(photo: Photo, width_mm: float) -> tuple[float, float]:
    """Return the width and height of a photo that is not to be wider, and not higher than a page."""
    with Image.open(photo.path) as image:
        width, height = image.size
    return width_mm, min(width_mm * height / width, BOTTOM_MM - TOP_MM - 20.0)


def photo_drawn(photo: Photo, width_mm: float) -> Figure:
    """Return a photo as a figure of this width, with no more dots than paper shows."""
    pixels, (width_mm, height_mm) = imread(photo.path), _photo_mm(photo, width_mm)
    drawn = blank_figure(width_mm / MM_PER_INCH, height_mm / MM_PER_INCH, dpi=POINTS_PER_INCH)
    axes = drawn.add_axes((0.0, 0.0, 1.0, 1.0))
    step = max(1, int(pixels.shape[1] / (width_mm / MM_PER_INCH * PHOTO_DOTS_PER_INCH)))
    axes.imshow(pixels[::step, ::step])
    axes.set_axis_off()
    return drawn
