"""A page of a PDF: lines of text, rules, boxes and drawings, each at its position in mm from the upper left corner."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import numpy as np
from matplotlib.backends.backend_mixed import MixedModeRenderer
from matplotlib.backends.backend_pdf import Op, PdfFile, RendererPdf
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.path import Path as Outline
from matplotlib.textpath import TextToPath
from matplotlib.transforms import IdentityTransform

from ...charts.style import MM_PER_INCH, MM_PER_POINT
from ..languages.letters import families
from .drawings import IMAGE_DOTS_PER_INCH

PAGE_MM = (210.0, 297.0)
"""A4."""

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


@dataclass(frozen=True, eq=False, slots=True)
class Page:
    """A page: lines of text, strokes, and drawings."""

    lines: list[Line] = field(default_factory=list)
    strokes: list[tuple[np.ndarray, float]] = field(default_factory=list)  # corners (k, 2) in mm, pen in points
    drawings: list[Placed] = field(default_factory=list)

    def write(self, file: PdfFile) -> None:
        """Add the page to a PDF."""
        file.newPage(_WIDTH_IN, _HEIGHT_IN)
        renderer = RendererPdf(file, IMAGE_DOTS_PER_INCH, _HEIGHT_IN, _WIDTH_IN)
        pen = renderer.new_gc()
        for corners_mm, width_pt in self.strokes:
            pen.set_linewidth(width_pt)
            renderer.draw_path(pen, Outline(_points(corners_mm)), IdentityTransform())
        for line in self.lines:
            x, y = _points(np.array([line.left_mm, line.base_mm]))
            renderer.draw_text(pen, x, y, line.text, _properties(line.font, line.font.families), 0.0)
        renderer.finalize()
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


def _points(positions_mm: np.ndarray) -> np.ndarray:
    """Return positions (..., 2) in the PDF's own units: points, from the lower left corner."""
    return (np.array([0.0, PAGE_MM[1]]) + positions_mm * (1.0, -1.0)) / MM_PER_POINT


@lru_cache
def _properties(font: Font, families: tuple[str, ...]) -> FontProperties:
    return FontProperties(family=families, weight=font.weight, size=font.size_pt)


def width_mm(text: str, font: Font) -> float:
    """Return how wide a text is: its words and the spaces between them, as words are measured once each."""
    families = font.families
    return sum(_word_mm(word, font, families) for word in text.split(" ")) + text.count(" ") * _word_mm(
        " ", font, families
    )


@lru_cache(maxsize=50_000)
def _word_mm(word: str, font: Font, families: tuple[str, ...]) -> float:
    # Between two bars, as what is measured is ink, without the room at its sides.
    return _ink_mm(f"|{word}|", font, families) - _ink_mm("||", font, families) if word else 0.0


@lru_cache(maxsize=50_000)
def _ink_mm(text: str, font: Font, families: tuple[str, ...]) -> float:
    properties = _properties(font, families)
    width, _, _ = TextToPath().get_text_width_height_descent(text, properties, ismath=False)
    return width * MM_PER_POINT
