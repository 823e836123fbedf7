"""Write a report as a PDF: pages are laid out here and drawn by matplotlib, so that pictures stay vectors."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import Self

import matplotlib
import numpy as np
from matplotlib.backends.backend_pdf import PdfFile
from matplotlib.figure import Figure
from matplotlib.image import imread

from ...charts.style import MM_PER_INCH, PAGE_WIDTH_MM, POINTS_PER_INCH, blank_figure
from ...system.disk import whole_file
from ..languages.letters import pieces
from ..languages.translation import IN_ENGLISH, Translation
from .blocks import AnimatedModel, Block, Column, DataTable, Document, Listing, Paragraph, Photo, Picture
from .drawings import Drawings
from .page import PAGE_MM, Font, Line, Page, Placed, width_mm

LEFT_MM = (PAGE_MM[0] - PAGE_WIDTH_MM) / 2.0
TOP_MM, BOTTOM_MM = 20.0, 277.0
FOOT_MM = 285.0
LINE = 1.4
"""Height of a line by the size of its letters."""

TITLE, HEADING = Font(18.0, "bold"), Font(13.0, "bold")
TEXT, STRONG = Font(9.5), Font(9.5, "bold")
SMALL, SMALL_STRONG = Font(8.0), Font(8.0, "bold")
LISTING = Font(7.0, family="monospace")
SMALLEST_COLUMN_MM = 14.0
_KEPT_TOGETHER_MM = 45.0
"""A table whose rows are not higher stays on one page."""

_HEADING_MM = 22.0
"""What a heading takes, with the room around it."""

_ROWS_AT_FOOT = 3
"""Of a longer table at least so many rows stand below its headings."""

_LINES_TOGETHER = 3
"""First lines of a paragraph that stand on one page."""

_SMALLEST_SCALE = 0.8
"""Of a drawing that is made smaller so that it fits on the rest of a page: its letters can still be read."""

_PHOTOS_ABREAST = 2
_PHOTO_GAP_MM = 4.0

GAP_MM = 3.0
"""Between columns of a table."""

PHOTO_DOTS_PER_INCH = 150.0

_Cells = Sequence[Sequence[str]]
"""The lines of each cell of a row."""


def write_pdf(
    document: Document,
    drawings: Drawings,
    path: Path,
    finished: Callable[[int, int], None] = lambda *_: None,
    translation: Translation = IN_ENGLISH,
) -> None:
    """Write a report as pages; `finished` is called with how many are written, and how many there are.

    `translation` has the words at the foot of each page.
    """
    # Letters that stay letters: text can be searched and copied.
    with matplotlib.rc_context({"pdf.fonttype": 42}):
        pages = laid_out(document, drawings, translation)
        # Without a date the same run gives the same file.
        metadata = {"Title": document.title, "CreationDate": None}
        with whole_file(path) as part, closing(PdfFile(part, metadata=metadata)) as file:
            for number, page in enumerate(pages, start=1):
                page.write(file)
                finished(number, len(pages))
            file.finalize()


def laid_out(document: Document, drawings: Drawings, translation: Translation = IN_ENGLISH) -> list[Page]:
    """Return the pages of a report."""
    pages = _Pages(drawings)
    pages.text(document.title, TITLE)
    pages.text(document.subtitle, TEXT)
    pages.flow(_abreast(document.summary))
    for number, section in enumerate(document.sections, start=1):
        pages.section(f"{number} {section.title}", section.blocks)
    title = _shortened(document.title, PAGE_WIDTH_MM - 40.0, SMALL)
    for number, page in enumerate(pages.pages, start=1):
        foot = translation.text(f"page {number} of {len(pages.pages)}")
        _put(page, title, SMALL, LEFT_MM, FOOT_MM)
        _put(page, foot, SMALL, LEFT_MM + PAGE_WIDTH_MM - width_mm(foot, SMALL), FOOT_MM)
    return pages.pages


class _Pages:
    """Pages that are filled from the top."""

    def __init__(self, drawings: Drawings) -> None:
        self.pages: list[Page] = []
        self._drawings = drawings
        self._y = 0.0
        self._turn()

    def section(self, title: str, blocks: Sequence[Block]) -> None:
        """Write a section. What does not fit on the rest of a page and is no text lets the text after it go first."""
        shown = list(_abreast(blocks))
        self._heading(title, shown)
        self.flow(shown)

    def flow(self, blocks: Iterable[_Shown]) -> None:
        """Put blocks below everything so far; pictures keep their order, and stand on the next page at the latest."""
        waiting: deque[_Drawn] = deque()
        for block in blocks:
            if isinstance(block, _Drawn):
                waiting.append(block)
            else:
                self._add(block)
            while waiting and self._scale_of(waiting[0]):
                self._drawn(waiting.popleft())
        for block in waiting:
            self._drawn(block)

    def _add(self, block: Paragraph | Listing | DataTable) -> None:
        match block:
            case Paragraph() if block.is_notice:
                self._notice(block.text)
            case Paragraph():
                self.text(block.text, TEXT)
            case Listing():
                self._listing(block.text)
            case DataTable():
                self._table(block)

    def _heading(self, text: str, blocks: Sequence[_Shown]) -> None:
        """Write a section's heading, never at the foot of a page alone."""
        texts = [block for block in blocks if not isinstance(block, _Drawn)]
        least_mm = _least_mm(texts[0] if texts else blocks[0]) if blocks else 0.0
        self._need(_HEADING_MM + least_mm)
        self._y += 6.0
        self.text(text, HEADING, after_mm=0.5)
        self._rule(0.8)
        self._y += 3.0

    def text(self, text: str, font: Font, *, after_mm: float = 2.5) -> None:
        """Write a paragraph, whose first lines stand together."""
        lines = list(_wrapped(text, PAGE_WIDTH_MM, font))
        self._need(min(len(lines), _LINES_TOGETHER) * LINE * font.height_mm)
        for line in lines:
            self._line(line, font)
        self._y += after_mm

    def _notice(self, text: str) -> None:
        lines = _notice_lines(text)
        height = _notice_mm(lines)
        self._need(height)
        page, top = self.pages[-1], self._y
        left, right, bottom = LEFT_MM, LEFT_MM + PAGE_WIDTH_MM, top + height
        box = np.array([(left, top), (right, top), (right, bottom), (left, bottom), (left, top), (right, top)])
        page.strokes.append((box, 1.5))
        self._y += 2.0
        for line in lines:
            self._line(line, STRONG, indent_mm=4.0)
        self._y = bottom + 3.0

    def _listing(self, text: str) -> None:
        """Write lines in two columns, the left one first, over as many pages as it takes."""
        width_mm, height_mm = (PAGE_WIDTH_MM - GAP_MM) / 2.0, LINE * LISTING.height_mm
        lines = [
            part for line in text.splitlines() for part in (_wrapped(line, width_mm, LISTING) if line.strip() else [""])
        ]
        while lines:
            self._need(_LINES_TOGETHER * height_mm)
            fitting = max(1, int((BOTTOM_MM - self._y) / height_mm))
            rows = min(fitting, math.ceil(len(lines) / 2))
            for number, line in enumerate(lines[: 2 * rows]):
                column, row = divmod(number, rows)
                left_mm = LEFT_MM + column * (width_mm + GAP_MM)
                _put(self.pages[-1], line, LISTING, left_mm, self._y + row * height_mm)
            lines = lines[2 * rows :]
            self._y += rows * height_mm
        self._y += 2.5

    def _table(self, table: DataTable) -> None:
        rows = _Rows.of(table)
        self._need(rows.least_mm)
        self.text(table.title, STRONG, after_mm=1.0)
        self._headings(rows)
        last = len(rows.cells) - 1
        for number, cells in enumerate(rows.cells):
            # The last row does not stand alone on the next page.
            together = rows.cells[number:] if number == last - 1 else [cells]
            if self._needs(math.fsum(map(_row_height, together))):
                self._turn()
                self._headings(rows)
            self._row(cells, rows, SMALL)
            self._rule(0.25)
        self._y += 4.0

    def _headings(self, rows: _Rows) -> None:
        if rows.headings:
            self._row(rows.headings, rows, SMALL_STRONG)
            self._rule(0.8)

    def _row(self, cells: _Cells, rows: _Rows, font: Font) -> None:
        left = LEFT_MM
        for lines, width, column in zip(cells, rows.widths, rows.columns, strict=True):
            for number, line in enumerate(lines):
                indent = width - width_mm(line, font) if column.form else 0.0
                top = self._y + 0.8 + number * LINE * font.height_mm
                _put(self.pages[-1], line, font, left + indent, top)
            left += width + GAP_MM
        self._y += _row_height(cells)

    def _scale_of(self, block: _Drawn) -> float:
        """Return how much smaller than drawn a block fits on the rest of the page; 0 where it does not."""
        room_mm = BOTTOM_MM - self._y - _caption_mm(block)
        scale = min(1.0, room_mm / _height_mm(block))
        return scale if scale >= _SMALLEST_SCALE else 0.0

    def _drawn(self, block: _Drawn) -> None:
        scale = self._scale_of(block)
        if not scale:
            self._turn()
            scale = self._scale_of(block) or _SMALLEST_SCALE
        if isinstance(block, Picture):
            self._picture(block, scale)
        else:
            self._photos(block, scale)

    def _picture(self, picture: Picture, scale: float) -> None:
        left_mm = LEFT_MM + (1.0 - scale) * PAGE_WIDTH_MM / 2.0
        self.pages[-1].drawings.append(Placed(self._drawings[picture], left_mm, self._y, scale))
        self._y += scale * picture.height_mm + 1.0
        for line in _wrapped(picture.title, PAGE_WIDTH_MM, SMALL):
            self._line(line, SMALL)
        self._y += 4.0

    def _photos(self, photos: _Photos, scale: float) -> None:
        """Put photos beside each other, each with its caption."""
        top_mm, height_mm, width_mm = self._y, scale * _height_mm(photos), scale * photos.width_mm
        left_mm = LEFT_MM + (PAGE_WIDTH_MM - len(photos.photos) * width_mm - photos.gaps_mm) / 2.0
        lowest_mm = top_mm
        for photo in photos.photos:
            self.pages[-1].drawings.append(Placed(_photo_drawn(photo, width_mm), left_mm, top_mm))
            below_mm = top_mm + height_mm + 1.0
            for line in _wrapped(photo.title, width_mm, SMALL):
                _put(self.pages[-1], line, SMALL, left_mm, below_mm)
                below_mm += LINE * SMALL.height_mm
            lowest_mm = max(lowest_mm, below_mm)
            left_mm += width_mm + _PHOTO_GAP_MM
        self._y = lowest_mm + 4.0

    def _line(self, text: str, font: Font, *, indent_mm: float = 0.0) -> None:
        height = LINE * font.height_mm
        self._need(height)
        _put(self.pages[-1], text, font, LEFT_MM + indent_mm, self._y)
        self._y += height

    def _rule(self, width_pt: float) -> None:
        ends = np.array([(LEFT_MM, self._y), (LEFT_MM + PAGE_WIDTH_MM, self._y)])
        self.pages[-1].strokes.append((ends, width_pt))

    def _needs(self, height_mm: float) -> bool:
        """Return whether so much does not fit on the page any more; on an empty page everything has to."""
        return self._y + height_mm > BOTTOM_MM and self._y > TOP_MM

    def _need(self, height_mm: float) -> None:
        if self._needs(height_mm):
            self._turn()

    def _turn(self) -> None:
        self.pages.append(Page())
        self._y = TOP_MM


def _put(page: Page, text: str, font: Font, left_mm: float, top_mm: float) -> None:
    # On its base line, as letters without descenders would stand too low by their top.
    page.lines.append(Line(text, font, left_mm, top_mm + font.height_mm))


@dataclass(frozen=True, slots=True)
class _Photos:
    """Photos that stand beside each other."""

    photos: tuple[Photo, ...]

    @property
    def gaps_mm(self) -> float:
        return (len(self.photos) - 1) * _PHOTO_GAP_MM

    @property
    def width_mm(self) -> float:
        """Width of each."""
        return (PAGE_WIDTH_MM - self.gaps_mm) / len(self.photos)


_Drawn = Picture | _Photos
_Shown = Paragraph | Listing | DataTable | _Drawn


def _abreast(blocks: Iterable[Block]) -> Iterator[_Shown]:
    """Yield blocks with photos that follow each other side by side, and without what paper does not show."""
    on_paper = (block for block in blocks if not isinstance(block, AnimatedModel))
    for is_photo, run in groupby(on_paper, key=lambda block: isinstance(block, Photo)):
        if is_photo:
            photos = [block for block in run if isinstance(block, Photo)]
            for first in range(0, len(photos), _PHOTOS_ABREAST):
                yield _Photos(tuple(photos[first : first + _PHOTOS_ABREAST]))
        else:
            yield from (block for block in run if not isinstance(block, Photo | AnimatedModel))


def _least_mm(block: _Shown) -> float:
    """Return how much of a page the beginning of a block takes at least."""
    match block:
        case Picture() | _Photos():
            return _SMALLEST_SCALE * _height_mm(block) + _caption_mm(block)
        case DataTable():
            return _Rows.of(block).least_mm
        case Paragraph() if block.is_notice:
            return _notice_mm(_notice_lines(block.text))
        case _:
            return _LINES_TOGETHER * LINE * TEXT.height_mm


def _height_mm(block: _Drawn) -> float:
    """Return how high a block is as it is drawn, without its caption."""
    if isinstance(block, Picture):
        return block.height_mm
    return max(_photo_mm(photo, block.width_mm)[1] for photo in block.photos)


def _caption_mm(block: _Drawn) -> float:
    """Return what the caption of a block takes, with the room around it."""
    if isinstance(block, Picture):
        lines = len(list(_wrapped(block.title, PAGE_WIDTH_MM, SMALL)))
    else:
        width_mm = _SMALLEST_SCALE * block.width_mm
        lines = max(len(list(_wrapped(photo.title, width_mm, SMALL))) for photo in block.photos)
    return 1.0 + lines * LINE * SMALL.height_mm


def _photo_mm(photo: Photo, width_mm: float) -> tuple[float, float]:
    """Return the width and height of a photo that is not to be wider, and not higher than a page."""
    height, width = imread(photo.path).shape[:2]
    return width_mm, min(width_mm * height / width, BOTTOM_MM - TOP_MM - 20.0)


def _photo_drawn(photo: Photo, width_mm: float) -> Figure:
    pixels, (width_mm, height_mm) = imread(photo.path), _photo_mm(photo, width_mm)
    drawn = blank_figure(width_mm / MM_PER_INCH, height_mm / MM_PER_INCH, dpi=POINTS_PER_INCH)
    axes = drawn.add_axes((0.0, 0.0, 1.0, 1.0))
    step = max(1, int(pixels.shape[1] / (width_mm / MM_PER_INCH * PHOTO_DOTS_PER_INCH)))
    axes.imshow(pixels[::step, ::step])
    axes.set_axis_off()
    return drawn


def _notice_lines(text: str) -> list[str]:
    return list(_wrapped(text, PAGE_WIDTH_MM - 8.0, STRONG))


def _notice_mm(lines: Sequence[str]) -> float:
    return len(lines) * LINE * STRONG.height_mm + 4.0


@dataclass(frozen=True, slots=True)
class _Rows:
    """A table as it is laid out: the lines of all cells, and the widths of its columns in mm."""

    columns: Sequence[Column]
    headings: _Cells
    cells: Sequence[_Cells]
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
        heights = [_row_height(row) for row in (self.headings, *self.cells)]
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


def _wrapped_cells(texts: Sequence[str], widths: Sequence[float], font: Font) -> _Cells:
    return [list(_wrapped(text, width, font)) for text, width in zip(texts, widths, strict=True)]


def _row_height(cells: _Cells) -> float:
    return max(1, *map(len, cells)) * LINE * SMALL.height_mm + 1.2 if cells else 0.0


def _wrapped(text: str, room_mm: float, font: Font) -> Iterator[str]:
    """Yield lines that fit; a word that is longer than a line is cut."""
    line = text[: len(text) - len(text.lstrip())]
    room_mm += 1e-6
    for blank, word in pieces(text):
        longer = f"{line}{blank}{word}" if line.strip() else line + word
        if width_mm(longer, font) <= room_mm:
            line = longer
            continue
        if line.strip():
            yield line
        while width_mm(word, font) > room_mm and len(word) > 1:
            cut = max(1, _fitting(word, room_mm, font))
            yield word[:cut]
            word = word[cut:]
        line = word
    if line.strip():
        yield line


def _shortened(text: str, room_mm: float, font: Font) -> str:
    if width_mm(text, font) <= room_mm:
        return text
    return text[: _fitting(text, room_mm - width_mm("…", font), font)] + "…"


def _fitting(text: str, room_mm: float, font: Font) -> int:
    """Return how many letters of a text fit."""
    return bisect_right(range(1, len(text) + 1), room_mm, key=lambda count: width_mm(text[:count], font))
