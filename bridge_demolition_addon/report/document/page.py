"""A page of a PDF: its style, texts in lines that fit, rules, boxes and drawings, each at its position in mm."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache, lru_cache
from itertools import groupby, pairwise
from typing import Any

import numpy as np
from matplotlib.backends.backend_mixed import MixedModeRenderer
from matplotlib.backends.backend_pdf import Name, Op, PdfFile, RendererPdf
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties, findfont, get_font
from matplotlib.ft2font import FT2Font, Kerning, LoadFlags
from matplotlib.path import Path as Outline
from matplotlib.transforms import IdentityTransform

from ...charts.style import MM_PER_INCH, MM_PER_POINT, PAGE_WIDTH_MM, POINTS_PER_INCH
from ..languages.letters import families, pieces
from .drawings import IMAGE_DOTS_PER_INCH

PAGE_MM = (210.0, 297.0)
"""A4."""

_MEASURED_PT = 100.0

_WIDTH_IN, _HEIGHT_IN = (side / MM_PER_INCH for side in PAGE_MM)


@dataclass(frozen=True, slots=True)
class Font:
    """Letters of a size."""

    size_pt: float
    weight: str = "normal"
    family: str = "sans-serif"

    @property
    def families(self) -> tuple[str, ...]:
        """Its family, and those that have letters of the report's language that it lacks."""
        return families(self.family)

    @property
    def height_mm(self) -> float:
        """Height of its letters."""
        return self.size_pt * MM_PER_POINT


@dataclass(frozen=True, slots=True)
class Line:
    """A line of text: where its base line begins."""

    text: str
    font: Font
    left_mm: float
    base_mm: float


@dataclass(frozen=True, eq=False, slots=True)
class Placed:
    """A drawing on a page: its left and upper edge, and how much smaller than drawn it stands there."""

    drawn: Figure
    left_mm: float
    top_mm: float
    scale: float = 1.0

    @property
    def size_mm(self) -> tuple[float, float]:
        """Width and height on the page."""
        width_in, height_in = self.drawn.get_size_inches()
        return self.scale * width_in * MM_PER_INCH, self.scale * height_in * MM_PER_INCH


@dataclass(frozen=True, slots=True)
class Start:
    """Where a section starts on a page: its heading, and how far down that is."""

    title: str
    top_mm: float


@dataclass(frozen=True, eq=False, slots=True)
class Page:
    """A page: lines of text, strokes, drawings, and sections that start on it."""

    lines: list[Line] = field(default_factory=list)
    strokes: list[tuple[np.ndarray, float]] = field(default_factory=list)  # corners (k, 2) in mm, pen in points
    drawings: list[Placed] = field(default_factory=list)
    starts: list[Start] = field(default_factory=list)

    def write(self, file: PageFile) -> None:
        """Add the page to a PDF."""
        file.newPage(_WIDTH_IN, _HEIGHT_IN)
        renderer = RendererPdf(file, IMAGE_DOTS_PER_INCH, _HEIGHT_IN, _WIDTH_IN)
        pen = renderer.new_gc()
        for corners_mm, width_pt in self.strokes:
            pen.set_linewidth(width_pt)
            renderer.draw_path(pen, Outline(_points(corners_mm)), IdentityTransform())
        renderer.finalize()
        for line in self.lines:
            file.line(line)
        for placed in self.drawings:
            drawn, scale = placed.drawn, placed.scale
            x, y = _points(np.array([placed.left_mm, placed.top_mm + placed.size_mm[1]]))
            file.output(Op.gsave, scale, 0, 0, scale, x, y, Op.concat_matrix)
            on_page = RendererPdf(file, IMAGE_DOTS_PER_INCH, *drawn.get_size_inches()[::-1])
            # What is drawn as dots would leave a renderer of lines alone.
            # Its stub in matplotlib lacks what it takes.
            mixed: Any = MixedModeRenderer(  # type: ignore[call-arg]
                drawn, *drawn.get_size_inches(), IMAGE_DOTS_PER_INCH, on_page
            )
            drawn.draw(mixed)
            mixed.finalize()
            file.output(Op.grestore)


class PageFile(PdfFile):
    """A PDF whose lines of text are put together of words and letters; matplotlib is asked for each one once.

    It has bookmarks and its language, which matplotlib does not write: so the root of the file is written last.
    """

    def __init__(self, *args: Any, **options: Any) -> None:
        self._is_open = True
        self._words: dict[tuple[str, Font], list[Any]] = {}
        self._letters: dict[tuple[str, Font], list[tuple[object, Any]]] = {}
        self._noted: list[Any] | None = None
        super().__init__(*args, **options)

    def writeObject(self, object: Any, contents: Any) -> None:  # noqa: N802
        """Write an object, but for the root as matplotlib has it."""
        if not (self._is_open and object is self.rootObject):
            super().writeObject(object, contents)

    def finish(self, pages: Sequence[Page], language: str) -> None:
        """Write what pages share, with a bookmark for each section, and the language for who has it read aloud."""
        self.endStream()
        self._is_open = False
        root = {"Type": Name("Catalog"), "Pages": self.pagesObject, "Lang": language}
        root["ViewerPreferences"] = {"DisplayDocTitle": True}
        starts = [(number, start) for number, page in enumerate(pages) for start in page.starts]
        if starts:
            root |= {"Outlines": self._outlines(starts), "PageMode": Name("UseOutlines")}
        self.writeObject(self.rootObject, root)
        self.finalize()

    def _outlines(self, starts: Sequence[tuple[int, Start]]) -> Any:
        """Write the bookmarks, one below the other, and return their list."""
        whole = self.reserveObject("bookmarks")
        each = [self.reserveObject("bookmark") for _ in starts]
        for number, ((page, start), own) in enumerate(zip(starts, each, strict=True)):
            _, top = _points(np.array([LEFT_MM, start.top_mm]))
            entry = {"Title": start.title, "Parent": whole}
            entry["Dest"] = [self.pageList[page], Name("XYZ"), 0, float(top), 0]
            entry |= {"Prev": each[number - 1]} if number else {}
            entry |= {"Next": each[number + 1]} if number + 1 < len(each) else {}
            self.writeObject(own, entry)
        self.writeObject(whole, {"Type": Name("Outlines"), "First": each[0], "Last": each[-1], "Count": len(each)})
        return whole

    def output(self, *data: Any) -> None:
        """Write operators, or note a letter's."""
        if self._noted is None:
            super().output(*data)
        else:
            self._noted += data

    def line(self, line: Line) -> None:
        """Write a line of text."""
        x, y = _points(np.array([line.left_mm, line.base_mm]))
        shown = [part for word in _parts(line.text) for part in self._word(word, line.font)]
        operators: list[Any] = [Op.begin_text, x, y, Op.textpos]
        for name, parts in groupby(shown, key=lambda part: part[0]):
            operators += [name, line.font.size_pt, Op.selectfont, [each for _, each in parts], Op.showkern]
        self.output(*operators, Op.end_text)

    def _word(self, word: str, font: Font) -> list[Any]:
        """Return the parts of a word: the name of a font, and letters or what brings the next one nearer."""
        if (word, font) not in self._words:
            parts = [*self._letter(word[0], font)]
            for pair in pairwise(word):
                if parts and (kerning := _kerning(*pair, font.weight, font.families)):
                    parts.append((parts[-1][0], -1000.0 * kerning))
                parts += self._letter(pair[1], font)
            self._words[word, font] = parts
        return self._words[word, font]

    def _letter(self, letter: str, font: Font) -> list[tuple[object, Any]]:
        """Return the name of the font in the file, with the glyph of a letter in it; nothing for what has none."""
        if (letter, font) not in self._letters:
            renderer = RendererPdf(self, IMAGE_DOTS_PER_INCH, _HEIGHT_IN, _WIDTH_IN)
            noted = self._noted = []
            try:
                renderer.draw_text(renderer.new_gc(), 0.0, 0.0, letter, _properties(font, font.families), 0.0)
            finally:
                self._noted = None
            fonts = [noted[row - 2] for row, each in enumerate(noted) if each is Op.selectfont]
            shown = [noted[row - 1][-1] for row, each in enumerate(noted) if each is Op.showkern]
            self._letters[letter, font] = list(zip(fonts, shown, strict=True))
        return self._letters[letter, font]


def _points(positions_mm: np.ndarray) -> np.ndarray:
    """Return positions (..., 2) in the PDF's own units: points, from the lower left corner."""
    return (np.array([0.0, PAGE_MM[1]]) + positions_mm * (1.0, -1.0)) / MM_PER_POINT


@lru_cache
def _properties(font: Font, families: tuple[str, ...]) -> FontProperties:
    return FontProperties(family=families, weight=font.weight, size=font.size_pt)


def width_mm(text: str, font: Font) -> float:
    """Return how wide a text is: its words and the spaces between them, as words are measured once each."""
    families = font.families
    return font.height_mm * sum(_word_em(word, font.weight, families) for word in _parts(text))


def _parts(text: str) -> Iterator[str]:
    """Yield the words of a text and the spaces between them."""
    for number, word in enumerate(text.split(" ")):
        if number:
            yield " "
        if word:
            yield word


@lru_cache(maxsize=50_000)
def _word_em(word: str, weight: str, families: tuple[str, ...]) -> float:
    """Width of a word by the size of its letters."""
    nearer = sum(_kerning(left, right, weight, families) for left, right in pairwise(word))
    return sum(_advance(letter, weight, families) for letter in word) + nearer


@cache
def _advance(letter: str, weight: str, families: tuple[str, ...]) -> float:
    """Width of a letter by its size, of the first font that has it; where none has, of what stands for it."""
    faces = [_face(file) for file in _font_files(weight, families)]
    face = next((face for face in faces if face.get_char_index(ord(letter))), faces[0])
    glyph = face.load_glyph(face.get_char_index(ord(letter)), flags=LoadFlags.NO_HINTING)
    return glyph.linearHoriAdvance / 65536.0 / _MEASURED_PT


@cache
def _kerning(left: str, right: str, weight: str, families: tuple[str, ...]) -> float:
    """Return how much farther from a letter the next one stands, by the size of letters: negative where nearer."""
    face = _face(_font_files(weight, families)[0])
    indices = face.get_char_index(ord(left)), face.get_char_index(ord(right))
    return face.get_kerning(*indices, Kerning.UNFITTED) / 64.0 / _MEASURED_PT if all(indices) else 0.0


def _face(file: str) -> FT2Font:
    face = get_font(file)
    face.set_size(_MEASURED_PT, POINTS_PER_INCH)  # matplotlib draws with the same, in other sizes
    return face


@cache
def _font_files(weight: str, families: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(findfont(FontProperties(family=family, weight=weight)) for family in families)


LEFT_MM = (PAGE_MM[0] - PAGE_WIDTH_MM) / 2.0
TOP_MM, BOTTOM_MM = 20.0, 277.0
FOOT_MM = 285.0
LINE = 1.4
"""Height of a line by the size of its letters."""

TITLE, HEADING = Font(18.0, "bold"), Font(13.0, "bold")
TEXT, STRONG = Font(9.5), Font(9.5, "bold")
SMALL, SMALL_STRONG = Font(8.0), Font(8.0, "bold")
LISTING = Font(7.0, family="monospace")

GAP_MM = 3.0
"""Between columns of a table."""


def wrapped(text: str, room_mm: float, font: Font) -> Iterator[str]:
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


def shortened(text: str, room_mm: float, font: Font) -> str:
    if width_mm(text, font) <= room_mm:
        return text
    return text[: _fitting(text, room_mm - width_mm("…", font), font)] + "…"


def _fitting(text: str, room_mm: float, font: Font) -> int:
    """Return how many letters of a text fit."""
    return bisect_right(range(1, len(text) + 1), room_mm, key=lambda count: width_mm(text[:count], font))
