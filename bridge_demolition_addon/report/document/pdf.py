"""Write a report as a PDF: pages are laid out here and drawn by matplotlib, so that pictures stay vectors."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Iterable, Sequence
from contextlib import closing
from pathlib import Path

import matplotlib
import numpy as np

from ...charts.style import PAGE_WIDTH_MM
from ...system.disk import whole_file
from ...texts import Text
from ..languages.translation import IN_ENGLISH, Translation
from .blocks import Block, DataTable, Document, Listing, Paragraph, Picture
from .drawings import Drawings
from .page import (
    BOTTOM_MM,
    FOOT_MM,
    GAP_MM,
    HEADING,
    LEFT_MM,
    LINE,
    LISTING,
    SMALL,
    SMALL_STRONG,
    STRONG,
    TEXT,
    TITLE,
    TOP_MM,
    Font,
    Line,
    Page,
    PageFile,
    Placed,
    Start,
    shortened,
    width_mm,
    wrapped,
)
from .rows import (
    PHOTO_GAP_MM,
    SMALLEST_SCALE,
    Cells,
    Drawn,
    PhotoRow,
    Rows,
    Shown,
    abreast,
    caption_mm,
    drawn_height_mm,
    photo_drawn,
    row_height_mm,
)

_HEADING_MM = 22.0
"""What a heading takes, with the room around it."""

_FEWEST_LISTED = 3
"""Sections from which on a report has a list of contents."""

_FOOT_LINE_MM = 4.0

_LINES_TOGETHER = 3
"""First lines of a paragraph that stand on one page."""


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
        about = {"Title": document.title, "Subject": document.subtitle, "Author": document.control.author or None}
        metadata = {**{name: str(text) for name, text in about.items() if text}, "CreationDate": None}
        with whole_file(path) as part, closing(PageFile(part, metadata=metadata)) as file:
            for number, page in enumerate(pages, start=1):
                page.write(file)
                finished(number, len(pages))
            file.finish(pages, translation.table.tag)


def laid_out(document: Document, drawings: Drawings, translation: Translation = IN_ENGLISH) -> list[Page]:
    """Return the pages of a report."""
    pages = _Pages(drawings)
    pages.text(document.title, TITLE)
    pages.text(document.subtitle, TEXT)
    pages.flow(abreast(document.first_page))
    titles = [f"{number} {section.title}" for number, section in enumerate(document.sections, start=1)]
    entries = pages.contents(translation.pattern("Contents"), titles) if len(titles) >= _FEWEST_LISTED else []
    for heading, section in zip(titles, document.sections, strict=True):
        pages.section(heading, section.blocks)
    begins = [number for number, page in enumerate(pages.pages, start=1) for _ in page.starts]
    for (page, top_mm), number in zip(entries, begins, strict=False):
        shown = str(number)
        _put(page, shown, TEXT, LEFT_MM + PAGE_WIDTH_MM - width_mm(shown, TEXT), top_mm)
    title = shortened(document.title, PAGE_WIDTH_MM - 40.0, SMALL)
    for number, page in enumerate(pages.pages, start=1):
        foot = translation.text(Text("page {} of {}", number, len(pages.pages)))
        _put(page, title, SMALL, LEFT_MM, FOOT_MM)
        _put(page, foot, SMALL, LEFT_MM + PAGE_WIDTH_MM - width_mm(foot, SMALL), FOOT_MM)
        if document.control.foot:
            _put(page, shortened(document.control.foot, PAGE_WIDTH_MM, SMALL), SMALL, LEFT_MM, FOOT_MM - _FOOT_LINE_MM)
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
        shown = list(abreast(blocks))
        self._heading(title, shown)
        self.flow(shown)

    def contents(self, heading: str, titles: Sequence[str]) -> list[tuple[Page, float]]:
        """Write the list of sections, and return where the number of the page of each goes: page and top in mm."""
        self._need((len(titles) + 1) * LINE * TEXT.height_mm)
        self.text(heading, STRONG, after_mm=1.0)
        places = []
        for title in titles:
            line = shortened(title, PAGE_WIDTH_MM - 12.0, TEXT)
            self._need(LINE * TEXT.height_mm)
            places.append((self.pages[-1], self._y))
            self._line(line, TEXT)
        self._y += 4.0
        return places

    def flow(self, blocks: Iterable[Shown]) -> None:
        """Put blocks below everything so far; pictures keep their order, and stand on the next page at the latest."""
        waiting: deque[Drawn] = deque()
        for block in blocks:
            if isinstance(block, Drawn):
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

    def _heading(self, text: str, blocks: Sequence[Shown]) -> None:
        """Write a section's heading, never at the foot of a page alone."""
        texts = [block for block in blocks if not isinstance(block, Drawn)]
        least_mm = _least_mm(texts[0] if texts else blocks[0]) if blocks else 0.0
        self._need(_HEADING_MM + least_mm)
        self._y += 6.0
        self.pages[-1].starts.append(Start(text, self._y))
        self.text(text, HEADING, after_mm=0.5)
        self._rule(0.8)
        self._y += 3.0

    def text(self, text: str, font: Font, *, after_mm: float = 2.5) -> None:
        """Write a paragraph, whose first lines stand together."""
        lines = list(wrapped(text, PAGE_WIDTH_MM, font))
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
            part for line in text.splitlines() for part in (wrapped(line, width_mm, LISTING) if line.strip() else [""])
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
        rows = Rows.of(table)
        self._need(rows.least_mm)
        self.text(table.title, STRONG, after_mm=1.0)
        self._headings(rows)
        last = len(rows.cells) - 1
        for number, cells in enumerate(rows.cells):
            # The last row does not stand alone on the next page.
            together = rows.cells[number:] if number == last - 1 else [cells]
            if self._needs(math.fsum(map(row_height_mm, together))):
                self._turn()
                self._headings(rows)
            self._row(cells, rows, SMALL)
            self._rule(0.25)
        self._y += 4.0

    def _headings(self, rows: Rows) -> None:
        if rows.headings:
            self._row(rows.headings, rows, SMALL_STRONG)
            self._rule(0.8)

    def _row(self, cells: Cells, rows: Rows, font: Font) -> None:
        left = LEFT_MM
        for lines, width, column in zip(cells, rows.widths, rows.columns, strict=True):
            for number, line in enumerate(lines):
                indent = width - width_mm(line, font) if column.form else 0.0
                top = self._y + 0.8 + number * LINE * font.height_mm
                _put(self.pages[-1], line, font, left + indent, top)
            left += width + GAP_MM
        self._y += row_height_mm(cells)

    def _scale_of(self, block: Drawn) -> float:
        """Return how much smaller than drawn a block fits on the rest of the page; 0 where it does not."""
        room_mm = BOTTOM_MM - self._y - caption_mm(block)
        scale = min(1.0, room_mm / drawn_height_mm(block))
        return scale if scale >= SMALLEST_SCALE else 0.0

    def _drawn(self, block: Drawn) -> None:
        scale = self._scale_of(block)
        if not scale:
            self._turn()
            scale = self._scale_of(block) or SMALLEST_SCALE
        if isinstance(block, Picture):
            self._picture(block, scale)
        else:
            self._photos(block, scale)

    def _picture(self, picture: Picture, scale: float) -> None:
        left_mm = LEFT_MM + (1.0 - scale) * PAGE_WIDTH_MM / 2.0
        self.pages[-1].drawings.append(Placed(self._drawings[picture], left_mm, self._y, scale))
        self._y += scale * picture.height_mm + 1.0
        for line in wrapped(picture.title, PAGE_WIDTH_MM, SMALL):
            self._line(line, SMALL)
        self._y += 4.0

    def _photos(self, photos: PhotoRow, scale: float) -> None:
        """Put photos side by side, each with its caption."""
        top_mm, height_mm, width_mm = self._y, scale * drawn_height_mm(photos), scale * photos.width_mm
        left_mm = LEFT_MM + (PAGE_WIDTH_MM - len(photos.photos) * width_mm - photos.gaps_mm) / 2.0
        lowest_mm = top_mm
        for photo in photos.photos:
            self.pages[-1].drawings.append(Placed(photo_drawn(photo, width_mm), left_mm, top_mm))
            below_mm = top_mm + height_mm + 1.0
            for line in wrapped(photo.title, width_mm, SMALL):
                _put(self.pages[-1], line, SMALL, left_mm, below_mm)
                below_mm += LINE * SMALL.height_mm
            lowest_mm = max(lowest_mm, below_mm)
            left_mm += width_mm + PHOTO_GAP_MM
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


def _least_mm(block: Shown) -> float:
    """Return how much of a page the beginning of a block takes at least."""
    match block:
        case Picture() | PhotoRow():
            return SMALLEST_SCALE * drawn_height_mm(block) + caption_mm(block)
        case DataTable():
            return Rows.of(block).least_mm
        case Paragraph() if block.is_notice:
            return _notice_mm(_notice_lines(block.text))
        case _:
            return _LINES_TOGETHER * LINE * TEXT.height_mm


def _notice_lines(text: str) -> list[str]:
    return list(wrapped(text, PAGE_WIDTH_MM - 8.0, STRONG))


def _notice_mm(lines: Sequence[str]) -> float:
    return len(lines) * LINE * STRONG.height_mm + 4.0
