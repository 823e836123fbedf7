"""Write a report as a PDF: pages are laid out here and drawn by matplotlib, so that pictures stay vectors."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.backends.backend_pdf import PdfFile
from matplotlib.figure import Figure
from matplotlib.image import imread

from ...charts.style import MM_PER_INCH, PAGE_WIDTH_MM, POINTS_PER_INCH, blank_figure
from ...system.disk import whole_file
from .blocks import AnimatedModel, Block, DataTable, Document, Listing, Paragraph, Photo, Picture
from .drawings import Drawings
from .page import PAGE_MM, Font, Line, Page, width_mm

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
_KEPT_TOGETHER_MM = 112.0
"""A table whose rows are not higher stays on one page."""

_HIGHEST_FIRST_MM = 200.0
"""What begins a section and is not higher stands on the page of its heading."""

_CAPTION_MM = 18.0
"""What a caption of two lines takes, with the room around it."""

_ROWS_AT_FOOT = 3
"""Of a longer table at least so many rows stand below its headings."""

GAP_MM = 3.0
"""Between columns of a table."""

PHOTO_DOTS_PER_INCH = 150.0

_Cells = Sequence[Sequence[str]]
"""The lines of each cell of a row."""


def write_pdf(
    document: Document, drawings: Drawings, path: Path, finished: Callable[[int, int], None] = lambda *_: None
) -> None:
    """Write a report as pages; `finished` is called with how many are written, and how many there are."""
    # Letters that stay letters: text can be searched and copied.
    with matplotlib.rc_context({"pdf.fonttype": 42}):
        pages = laid_out(document, drawings)
        # Without a date the same run gives the same file.
        metadata = {"Title": document.title, "CreationDate": None}
        with whole_file(path) as part, closing(PdfFile(part, metadata=metadata)) as file:
            for number, page in enumerate(pages, start=1):
                page.write(file)
                finished(number, len(pages))
            file.finalize()


def laid_out(document: Document, drawings: Drawings) -> list[Page]:
    """Return the pages of a report."""
    pages = _Pages(drawings)
    pages.text(document.title, TITLE)
    pages.text(document.subtitle, TEXT)
    for number, section in enumerate(document.sections, start=1):
        pages.heading(f"{number} {section.title}", section.blocks[0] if section.blocks else None)
        for block in section.blocks:
            pages.add(block)
    title = _shortened(document.title, PAGE_WIDTH_MM - 40.0, SMALL)
    for number, page in enumerate(pages.pages, start=1):
        foot = f"page {number} of {len(pages.pages)}"
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

    def add(self, block: Block) -> None:
        """Put a block below everything so far."""
        match block:
            case Paragraph() if block.is_notice:
                self._notice(block.text)
            case Paragraph():
                self.text(block.text, TEXT)
            case Listing():
                self._listing(block.text)
            case DataTable():
                self._table(block)
            case Picture():
                self._picture(self._drawings[block], block.height_mm, block.title)
            case Photo():
                self._photo(block)
            case AnimatedModel():
                pass  # the paragraph beside it says where it is

    def heading(self, text: str, first: Block | None) -> None:
        """Write a section's heading, never at the foot of a page alone."""
        self._need(22.0 + min(_height_mm(first), _HIGHEST_FIRST_MM))
        self._y += 6.0
        self.text(text, HEADING, after_mm=0.5)
        self._rule(0.8)
        self._y += 3.0

    def text(self, text: str, font: Font, *, after_mm: float = 2.5) -> None:
        """Write a paragraph."""
        for line in _wrapped(text, PAGE_WIDTH_MM, font):
            self._line(line, font)
        self._y += after_mm

    def _notice(self, text: str) -> None:
        lines = list(_wrapped(text, PAGE_WIDTH_MM - 8.0, STRONG))
        height = len(lines) * LINE * STRONG.height_mm + 4.0
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
        for line in text.splitlines():
            for part in _wrapped(line, PAGE_WIDTH_MM, LISTING) if line.strip() else [""]:
                self._line(part, LISTING)
        self._y += 2.5

    def _table(self, table: DataTable) -> None:
        rows, headings = table.shown_rows(), [column.heading for column in table.columns]
        widths = _column_widths([headings, *rows])
        cells = [_wrapped_cells(row, widths, SMALL) for row in rows]
        heading_cells = _wrapped_cells(headings, widths, SMALL_STRONG) if any(headings) else []
        heights = [_row_height(row) for row in [heading_cells, *cells]]
        together = heights if sum(heights) < _KEPT_TOGETHER_MM else heights[: 1 + _ROWS_AT_FOOT]
        self._need(8.0 + sum(together))
        self.text(table.title, STRONG, after_mm=1.0)
        self._headings(heading_cells, widths, table)
        for row in cells:
            if self._needs(_row_height(row)):
                self._turn()
                self._headings(heading_cells, widths, table)
            self._row(row, widths, table, SMALL)
            self._rule(0.25)
        self._y += 4.0

    def _headings(self, cells: _Cells, widths: Sequence[float], table: DataTable) -> None:
        if cells:
            self._row(cells, widths, table, SMALL_STRONG)
            self._rule(0.8)

    def _row(self, cells: _Cells, widths: Sequence[float], table: DataTable, font: Font) -> None:
        left = LEFT_MM
        for lines, width, column in zip(cells, widths, table.columns, strict=True):
            for number, line in enumerate(lines):
                indent = width - width_mm(line, font) if column.form else 0.0
                top = self._y + 0.8 + number * LINE * font.height_mm
                _put(self.pages[-1], line, font, left + indent, top)
            left += width + GAP_MM
        self._y += _row_height(cells)

    def _picture(self, drawn: Figure, height_mm: float, title: str) -> None:
        caption = list(_wrapped(title, PAGE_WIDTH_MM, SMALL))
        self._need(height_mm + 8.0 + 5.0 * len(caption))
        self.pages[-1].drawings.append((drawn, LEFT_MM, self._y))
        self._y += height_mm + 1.0
        for line in caption:
            self._line(line, SMALL)
        self._y += 4.0

    def _photo(self, photo: Photo) -> None:
        pixels = imread(photo.path)
        height_mm = min(PAGE_WIDTH_MM * pixels.shape[0] / pixels.shape[1], BOTTOM_MM - TOP_MM - 20.0)
        drawn = blank_figure(PAGE_WIDTH_MM / MM_PER_INCH, height_mm / MM_PER_INCH, dpi=POINTS_PER_INCH)
        axes = drawn.add_axes((0.0, 0.0, 1.0, 1.0))
        step = max(1, int(pixels.shape[1] / (PAGE_WIDTH_MM / MM_PER_INCH * PHOTO_DOTS_PER_INCH)))
        axes.imshow(pixels[::step, ::step])
        axes.set_axis_off()
        self._picture(drawn, height_mm, photo.title)

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


def _height_mm(block: Block | None) -> float:
    """Return about how much of a page the beginning of a block takes."""
    match block:
        case Picture():
            return block.height_mm + _CAPTION_MM
        case Photo():
            return PAGE_WIDTH_MM * 9.0 / 16.0 + _CAPTION_MM
        case _:
            return 15.0


def _column_widths(rows: Sequence[Sequence[str]]) -> list[float]:
    """Return widths in mm: what the texts need where there is room, else less for the widest columns."""
    widths = [max(width_mm(text, SMALL_STRONG) for text in column) for column in zip(*rows, strict=True)]
    room = PAGE_WIDTH_MM - GAP_MM * (len(widths) - 1)
    while sum(widths) > room and max(widths) > SMALLEST_COLUMN_MM:
        widest = widths.index(max(widths))
        widths[widest] = max(widths[widest] - 1.0, SMALLEST_COLUMN_MM)
    return widths


def _wrapped_cells(texts: Sequence[str], widths: Sequence[float], font: Font) -> _Cells:
    return [list(_wrapped(text, width, font)) for text, width in zip(texts, widths, strict=True)]


def _row_height(cells: _Cells) -> float:
    return max(1, *map(len, cells)) * LINE * SMALL.height_mm + 1.2 if cells else 0.0


def _wrapped(text: str, room_mm: float, font: Font) -> Iterator[str]:
    """Yield lines that fit; a word that is longer than a line is cut."""
    line = text[: len(text) - len(text.lstrip())]
    room_mm += 1e-6
    for word in text.split():
        longer = f"{line} {word}" if line.strip() else line + word
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
