"""Style: what all charts and pages have in common."""

from __future__ import annotations

from typing import Any

from matplotlib.backend_bases import FigureCanvasBase
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

MM_PER_INCH = 25.4
POINTS_PER_INCH = 72.0
MM_PER_POINT = MM_PER_INCH / POINTS_PER_INCH

PAGE_WIDTH_MM = 170.0
"""Width between the margins of a page."""

_LINES = (
    ("-", "0.0"),
    ("--", "#b2182b"),
    ("-.", "#2166ac"),
    (":", "0.45"),
    ((0, (6, 1, 1, 1, 1, 1)), "#542788"),
    ((0, (10, 2)), "#b35806"),
    ((0, (1, 3)), "0.0"),
    ((0, (3, 1)), "0.45"),
)
"""Dash and colour of lines."""


def line_style(number: int, width_pt: float = 1.4) -> dict[str, Any]:
    """Return how the line with a number looks; dashes tell lines apart without colour."""
    dash, shade = _LINES[number % len(_LINES)]
    return {"linestyle": dash, "color": shade, "linewidth": width_pt}


def blank_figure(
    width_in: float, height_in: float, canvas: type[FigureCanvasBase] = FigureCanvasAgg, **options: Any
) -> Figure:
    """Return an empty figure: pyplot would set up a window system inside Blender, and keep every figure alive."""
    figure = Figure(figsize=(width_in, height_in), **options)
    canvas(figure)
    return figure


def lay_out(figure: Figure) -> None:
    """Lay a figure out for good: left to matplotlib, every saving lays it out again and draws it twice."""
    if engine := figure.get_layout_engine():
        engine.execute(figure)
    figure.set_layout_engine(None)


def plain(text: object) -> str:
    r"""Return a text that matplotlib writes as it is: no formula, and in a legend even where it begins with ``_``.

    Not `parse_math=False`: a title that is wrapped, and a legend, look for formulas all the same.
    """
    shown = str(text).replace("$", r"\$")
    return f" {shown}" if shown.startswith("_") else shown
