"""Colour bar of the contours at the edge of a rendered picture."""

from __future__ import annotations

from pathlib import Path
from textwrap import wrap
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.image import imread, imsave

from ..display.colour_scale import colours
from ..display.contours import ContourFrame, ContourSettings, colour_bar
from ..system.disk import whole_file
from .style import POINTS_PER_INCH, blank_figure

_DPI = 100.0
_BAR_HEIGHT = 0.62
_BAR_LEFT_EM, _BAR_WIDTH_EM, _PANEL_EM = 1.0, 1.6, 13.5
_EM_SHARE = 1.0 / 40.0
_TITLE_LETTERS = 18
_SHADE = (0.1, 0.1, 0.1)


def add_legend(picture: Path, settings: ContourSettings, frame: ContourFrame) -> None:
    """Put a colour bar with ticks, unit, name of the quantity, frame and time to the left of a PNG picture."""
    pixels = _opaque(imread(picture))
    legend = legend_pixels(pixels.shape[0], settings, frame)
    with whole_file(picture) as part:
        imsave(part, np.clip(np.hstack((legend, pixels)), 0.0, 1.0))


def legend_width(height_px: int) -> int:
    """Return how wide the legend of a picture is, px; an even number."""
    return 2 * round(_PANEL_EM * _EM_SHARE * height_px / 2.0)


def legend_pixels(height_px: int, settings: ContourSettings, frame: ContourFrame) -> np.ndarray:
    """Return the pixels (height, width, 3) of the colour bar by itself, 0 to 1, from top to bottom."""
    em_px, width_px = height_px * _EM_SHARE, legend_width(height_px)
    figure = blank_figure(width_px / _DPI, height_px / _DPI, dpi=_DPI)
    figure.patch.set_facecolor(_SHADE)
    em_points = em_px * POINTS_PER_INCH / _DPI
    left, width = _BAR_LEFT_EM * em_px / width_px, _BAR_WIDTH_EM * em_px / width_px
    bottom = (1.0 - _BAR_HEIGHT) / 2.0
    axes = figure.add_axes((left, bottom, width, _BAR_HEIGHT))
    axes.imshow(colours(settings.colour_map, np.linspace(1.0, 0.0, 512))[:, None], aspect="auto", extent=(0, 1, 0, 1))
    bar = colour_bar(settings, frame)
    axes.set_xticks([])
    axes.yaxis.tick_right()
    axes.set_yticks(bar.tick_shares, bar.tick_texts)
    axes.tick_params(colors="white", labelsize=em_points)
    heading = [*wrap(bar.title, _TITLE_LETTERS), *wrap(bar.subtitle, _TITLE_LETTERS), bar.unit]
    text: dict[str, Any] = {"color": "white", "fontsize": em_points, "parse_math": False}
    figure.text(left, 1.0 - bottom / 3.0, "\n".join(heading), va="top", **text)
    figure.text(left, bottom / 2.0, f"{bar.frame}\n{bar.time}", va="center", **text)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return np.array(canvas.buffer_rgba(), np.float64)[..., :3] / 255.0


def _opaque(pixels: np.ndarray) -> np.ndarray:
    """Return pixels (h, w, 3), 0 to 1, whatever a PNG has per pixel."""
    if pixels.ndim == 2:
        pixels = np.repeat(pixels[..., None], 3, axis=-1)
    return np.array(pixels[..., :3], float)
