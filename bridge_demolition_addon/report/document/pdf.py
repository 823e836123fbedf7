"""Write a report as a PDF: pages are laid out here and drawn by matplotlib, so that pictures stay vectors."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache
from pathlib import Path

import matplotlib
from matplotlib.backends.backend_pdf import FigureCanvasPdf, PdfPages
from matplotlib.figure import Figure, FigureBase
from matplotlib.font_manager import FontProperties
from matplotlib.image import imread
from matplotlib.textpath import TextToPath

from ...charts.style import MM_PER_INCH, MM_PER_POINT, PAGE_WIDTH_MM, blank_figure
from ...core.disk import whole_file
from .blocks import Block, DataTable, Document, Listing, Paragraph, Photo, Picture

PAGE_MM = (210.0, 297.0)
LEFT_MM = (PAGE_MM[0] - PAGE_WIDTH_MM) / 2.0
TOP_MM, BOTTOM_MM = 20.0, 277.0
FOOT_MM = 285.0
LINE = 1.4
"""Height of a line by the size of its letters."""

TITLE_PT, HEADING_PT, TEXT_PT, SMALL_PT, LISTING_PT = 18.0, 13.0, 9.5, 8.0, 7.0
SMALLEST_COLUMN_MM = 14.0
_KEPT_TOGETHER_MM = 120.0
"""A table that is not higher stays on one page."""

GAP_MM = 3.0
"""Between columns of a table."""

PHOTO_DOTS_PER_INCH = 150.0


def write_pdf(document: Document, path: Path, finished: Callable[[int, int], None] = lambda *_: None) -> None:
    """Write a report as pages; `finished` is called with how many are written, and how many there are."""
    # Letters that stay letters: text can be searched and copied.
    with matplotlib.rc_context({"pdf.fonttype": 42}):
        pages = laid_out(document)
        # Without a date the same run gives the same file.
        metadata = {"Title": document.title, "CreationDate": None}
        with whole_file(path) as part, PdfPages(part, metadata=metadata) as file:
            for number, page in enumerate(pages, start=1):
                file.savefig(page)
                finished(number, len(pages))


def laid_out(document: Document) -> list[Figure]:
    """Return the pages of a report."""
    pages = _Pages()
    pages.text(document.title, TITLE_PT, weight="bold")
    pages.text(document.subtitle, TEXT_PT)
    for number, section in enumerate(document.sections, start=1):
        pages.heading(f"{number} {section.title}", section.blocks[0] if section.blocks else None)
        for block in section.blocks:
            pages.add(block)
    for number, page in enumerate(pages.figures, start=1):
        foot = f"page {number} of {len(pages.figures)}"
        _put(page, LEFT_MM, FOOT_MM, _shortened(document.title, PAGE_WIDTH_MM - 40.0, SMALL_PT), SMALL_PT)
        _put(page, LEFT_MM + PAGE_WIDTH_MM, FOOT_MM, foot, SMALL_PT, align="right")
    return pages.figures


class _Pages:
    """Pages that are filled from the top."""

    def __init__(self) -> None:
        self.figures: list[Figure] = []
        self._turn()

    def add(self, block: Block) -> None:
        """Put a block below everything so far."""
        match block:
            case Paragraph() if block.is_notice:
                self._notice(block.text)
            case Paragraph():
                self.text(block.text, TEXT_PT)
            case Listing():
                self._listing(block.text)
            case DataTable():
                self._table(block)
            case Picture():
                self._picture(block.draw, block.height_mm, block.title)
            case Photo():
                self._photo(block)

    def heading(self, text: str, first: Block | None) -> None:
        """Write a section's heading, never at the foot of a page alone."""
        self._need(22.0 + min(_height_mm(first), 160.0))
        self._y += 6.0
        self.text(text, HEADING_PT, weight="bold", after_mm=0.5)
        self._rule(0.8)
        self._y += 3.0

    def text(self, text: str, size_pt: float, *, weight: str = "normal", after_mm: float = 2.5) -> None:
        """Write a paragraph."""
        for line in _wrapped(text, PAGE_WIDTH_MM, size_pt, weight):
            self._line(line, size_pt, weight=weight)
        self._y += after_mm

    def _notice(self, text: str) -> None:
        lines = list(_wrapped(text, PAGE_WIDTH_MM - 8.0, TEXT_PT, "bold"))
        height = len(lines) * TEXT_PT * LINE * MM_PER_POINT + 4.0
        self._need(height)
        page, top = self.figures[-1], self._y
        corners = (LEFT_MM / PAGE_MM[0], 1.0 - (top + height) / PAGE_MM[1])
        size = (PAGE_WIDTH_MM / PAGE_MM[0], height / PAGE_MM[1])
        box = matplotlib.patches.Rectangle(corners, *size, fill=False, linewidth=1.5, transform=page.transFigure)
        page.add_artist(box)
        self._y += 2.0
        for line in lines:
            self._line(line, TEXT_PT, weight="bold", indent_mm=4.0)
        self._y = top + height + 3.0

    def _listing(self, text: str) -> None:
        for line in text.splitlines():
            for part in _wrapped(line, PAGE_WIDTH_MM, LISTING_PT, family="monospace") if line.strip() else [""]:
                self._line(part, LISTING_PT, family="monospace")
        self._y += 2.5

    def _table(self, table: DataTable) -> None:
        rows, headings = table.shown_rows(), [column.heading for column in table.columns]
        widths = _column_widths([headings, *rows])
        height = 8.0 + sum(_row_height(row, widths) for row in [headings, *rows])
        self._need(height if height < _KEPT_TOGETHER_MM else 20.0)
        self.text(table.title, TEXT_PT, weight="bold", after_mm=1.0)
        self._headings(headings, widths, table)
        for row in rows:
            if self._needs(_row_height(row, widths)):
                self._turn()
                self._headings(headings, widths, table)
            self._row(row, widths, table)
            self._rule(0.25)
        self._y += 4.0

    def _headings(self, texts: Sequence[str], widths: Sequence[float], table: DataTable) -> None:
        if any(texts):
            self._row(texts, widths, table, weight="bold")
            self._rule(0.8)

    def _row(self, texts: Sequence[str], widths: Sequence[float], table: DataTable, weight: str = "normal") -> None:
        top, left = self._y, LEFT_MM
        for text, width, column in zip(texts, widths, table.columns, strict=True):
            for number, line in enumerate(_wrapped(text, width, SMALL_PT, weight)):
                y = top + 0.8 + number * SMALL_PT * LINE * MM_PER_POINT
                x, align = (left + width, "right") if column.form else (left, "left")
                _put(self.figures[-1], x, y, line, SMALL_PT, weight=weight, align=align)
            left += width + GAP_MM
        self._y = top + _row_height(texts, widths, weight)

    def _picture(self, draw: Callable[[FigureBase], None], height_mm: float, title: str) -> None:
        caption = list(_wrapped(title, PAGE_WIDTH_MM, SMALL_PT))
        self._need(height_mm + 8.0 + 5.0 * len(caption))
        draw(_part(self.figures[-1], self._y, height_mm))
        self._y += height_mm + 1.0
        for line in caption:
            self._line(line, SMALL_PT)
        self._y += 4.0

    def _photo(self, photo: Photo) -> None:
        pixels = imread(photo.path)
        height_mm = min(PAGE_WIDTH_MM * pixels.shape[0] / pixels.shape[1], BOTTOM_MM - TOP_MM - 20.0)

        def draw(figure: FigureBase) -> None:
            axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
            step = max(1, int(pixels.shape[1] / (PAGE_WIDTH_MM / MM_PER_INCH * PHOTO_DOTS_PER_INCH)))
            axes.imshow(pixels[::step, ::step])
            axes.set_axis_off()

        self._picture(draw, height_mm, photo.title)

    def _line(self, text: str, size_pt: float, *, indent_mm: float = 0.0, **font: str) -> None:
        height = size_pt * LINE * MM_PER_POINT
        self._need(height)
        _put(self.figures[-1], LEFT_MM + indent_mm, self._y, text, size_pt, **font)
        self._y += height

    def _rule(self, width_pt: float) -> None:
        page, y = self.figures[-1], 1.0 - self._y / PAGE_MM[1]
        ends = (LEFT_MM / PAGE_MM[0], (LEFT_MM + PAGE_WIDTH_MM) / PAGE_MM[0])
        rule = matplotlib.lines.Line2D(ends, (y, y), color="black", linewidth=width_pt, transform=page.transFigure)
        page.add_artist(rule)

    def _needs(self, height_mm: float) -> bool:
        """Return whether so much does not fit on the page any more; on an empty page everything has to."""
        return self._y + height_mm > BOTTOM_MM and self._y > TOP_MM

    def _need(self, height_mm: float) -> None:
        if self._needs(height_mm):
            self._turn()

    def _turn(self) -> None:
        size = (side / MM_PER_INCH for side in PAGE_MM)
        self.figures.append(blank_figure(*size, FigureCanvasPdf, layout="constrained"))
        self._y = TOP_MM


def _part(page: Figure, top_mm: float, height_mm: float) -> FigureBase:
    """Return a part of a page between its margins, for a picture."""
    widths = [LEFT_MM, PAGE_WIDTH_MM, PAGE_MM[0] - LEFT_MM - PAGE_WIDTH_MM]
    heights = [top_mm, height_mm, PAGE_MM[1] - top_mm - height_mm]
    edges = {"left": 0.0, "right": 1.0, "top": 1.0, "bottom": 0.0, "wspace": 0.0, "hspace": 0.0}
    return page.add_subfigure(page.add_gridspec(3, 3, width_ratios=widths, height_ratios=heights, **edges)[1, 1])


def _put(
    page: Figure,
    left_mm: float,
    top_mm: float,
    text: str,
    size_pt: float,
    *,
    weight: str = "normal",
    family: str = "sans-serif",
    align: str = "left",
) -> None:
    # On its base line, as letters without descenders would stand too low by their top.
    y = 1.0 - (top_mm + size_pt * MM_PER_POINT) / PAGE_MM[1]
    font = {"fontsize": size_pt, "weight": weight, "family": family}
    page.text(left_mm / PAGE_MM[0], y, text, ha=align, va="baseline", parse_math=False, **font)


def _height_mm(block: Block | None) -> float:
    """Return about how much of a page the beginning of a block takes."""
    match block:
        case Picture():
            return block.height_mm
        case Photo():
            return PAGE_WIDTH_MM * 9.0 / 16.0
        case _:
            return 15.0


def _column_widths(rows: Sequence[Sequence[str]]) -> list[float]:
    """Return widths in mm: what the texts need where there is room, else less for the widest columns."""
    widths = [max(_width_mm(text, SMALL_PT, "bold") for text in column) for column in zip(*rows, strict=True)]
    room = PAGE_WIDTH_MM - GAP_MM * (len(widths) - 1)
    while sum(widths) > room and max(widths) > SMALLEST_COLUMN_MM:
        widest = widths.index(max(widths))
        widths[widest] = max(widths[widest] - 1.0, SMALLEST_COLUMN_MM)
    return widths


def _row_height(texts: Sequence[str], widths: Sequence[float], weight: str = "normal") -> float:
    lines = max(len(list(_wrapped(text, width, SMALL_PT, weight))) for text, width in zip(texts, widths, strict=True))
    return max(lines, 1) * SMALL_PT * LINE * MM_PER_POINT + 1.2


def _wrapped(
    text: str, width_mm: float, size_pt: float, weight: str = "normal", family: str = "sans-serif"
) -> Iterator[str]:
    """Yield lines that fit; a word that is longer than a line is cut."""
    line = text[: len(text) - len(text.lstrip())]
    slack = 1e-6
    for word in text.split():
        longer = f"{line} {word}" if line.strip() else line + word
        if _width_mm(longer, size_pt, weight, family) <= width_mm + slack:
            line = longer
            continue
        if line.strip():
            yield line
        while _width_mm(word, size_pt, weight, family) > width_mm + slack and len(word) > 1:
            cut = max(
                (n for n in range(1, len(word)) if _width_mm(word[:n], size_pt, weight, family) <= width_mm), default=1
            )
            yield word[:cut]
            word = word[cut:]
        line = word
    if line.strip():
        yield line


def _shortened(text: str, width_mm: float, size_pt: float) -> str:
    if _width_mm(text, size_pt) <= width_mm:
        return text
    while text and _width_mm(text + "…", size_pt) > width_mm:
        text = text[:-1]
    return text + "…"


@lru_cache(maxsize=50_000)
def _width_mm(text: str, size_pt: float, weight: str = "normal", family: str = "sans-serif") -> float:
    font = FontProperties(family=family, weight=weight, size=size_pt)
    width, _, _ = TextToPath().get_text_width_height_descent(text, font, ismath=False) if text else (0.0, 0.0, 0.0)
    return width * MM_PER_POINT
