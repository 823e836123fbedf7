"""Pictures of a report, each drawn and laid out once, then written as SVG and onto a page."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterable, Mapping

import matplotlib
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

from ...charts.style import MM_PER_INCH, PAGE_WIDTH_MM, POINTS_PER_INCH, blank_figure, lay_out
from ..languages.translated_report import translate_figure
from ..languages.translation import IN_ENGLISH, Translation
from .blocks import Document, Picture

Drawings = Mapping[Picture, Figure]
"""The pictures of a document, drawn."""

IMAGE_DOTS_PER_INCH = 100.0
"""Of images within a drawing, such as a map of heights; all else is drawn as lines."""


def drawings(
    documents: Document | Iterable[Document],
    finished: Callable[[int, int], None] = lambda *_: None,
    translation: Translation = IN_ENGLISH,
) -> Drawings:
    """Draw all pictures of documents once; `finished` is called with how many are drawn, and how many there are.

    Their texts are put into the language and the units of `translation`.
    """
    each = [documents] if isinstance(documents, Document) else documents
    blocks = (block for document in each for block in document.blocks())
    pictures = list(dict.fromkeys(block for block in blocks if isinstance(block, Picture)))
    drawn = {}
    for number, picture in enumerate(pictures, start=1):
        drawn[picture] = drawing(picture, translation)
        finished(number, len(pictures))
    return drawn


def drawing(picture: Picture, translation: Translation = IN_ENGLISH) -> Figure:
    """Draw a picture as wide as a page, laid out for good: writing it does not lay it out again."""
    size = PAGE_WIDTH_MM / MM_PER_INCH, picture.height_mm / MM_PER_INCH
    # The dots of SVG and PDF are points.
    figure = blank_figure(*size, FigureCanvasSVG, layout="constrained", dpi=POINTS_PER_INCH)
    picture.draw(figure)
    translate_figure(figure, translation)
    lay_out(figure)
    return figure


def svg(drawn: Figure) -> bytes:
    """Return a drawing as SVG."""
    file = io.BytesIO()
    # A fixed salt, so that the same run gives the same file.
    with matplotlib.rc_context({"svg.hashsalt": "report", "svg.fonttype": "path"}):
        drawn.savefig(file, format="svg", dpi=IMAGE_DOTS_PER_INCH, metadata={"Date": None})
    return file.getvalue()
