"""The colour bar of contours, beside a rendered picture."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.image import imread, imsave

from ..core.display.colour_scale import colours, tick_text
from ..core.display.contours import ContourFrame, ContourSettings, unit_of

_DPI = 100.0
_BAR_HEIGHT = 0.62
_BAR_LEFT_EM, _BAR_WIDTH_EM, _PANEL_EM = 1.0, 1.6, 13.5
_EM_SHARE = 1.0 / 40.0
_SHADE = (0.1, 0.1, 0.1)


def add_legend(picture: Path, settings: ContourSettings, frame: ContourFrame) -> None:
    """Put a colour bar with ticks, unit, name of the quantity, frame and time to the left of a PNG picture."""
    pixels = _opaque(imread(picture))
    legend = legend_pixels(pixels.shape[0], settings, frame)
    imsave(picture, np.clip(np.hstack((legend, pixels)), 0.0, 1.0))


def legend_width(height_px: int) -> int:
    """How wide the legend of a picture is, px; an even number."""
    return 2 * round(_PANEL_EM * _EM_SHARE * height_px / 2.0)


def legend_pixels(height_px: int, settings: ContourSettings, frame: ContourFrame) -> np.ndarray:
    """Pixels (height, width, 3) of the colour bar by itself, 0 to 1, from top to bottom."""
    em_px, width_px = height_px * _EM_SHARE, legend_width(height_px)
    figure = Figure(figsize=(width_px / _DPI, height_px / _DPI), dpi=_DPI)
    canvas = FigureCanvasAgg(figure)
    figure.patch.set_facecolor(_SHADE)
    em_points = em_px * 72.0 / _DPI
    left, width = _BAR_LEFT_EM * em_px / width_px, _BAR_WIDTH_EM * em_px / width_px
    bottom = (1.0 - _BAR_HEIGHT) / 2.0
    axes = figure.add_axes((left, bottom, width, _BAR_HEIGHT))
    axes.imshow(colours(settings.colour_map, np.linspace(1.0, 0.0, 512))[:, None], aspect="auto", extent=(0, 1, 0, 1))
    unit = unit_of(settings.quantity, max(abs(frame.scale.low), abs(frame.scale.high)))
    ticks = frame.scale.ticks()
    axes.set_xticks([])
    axes.yaxis.tick_right()
    axes.set_yticks(frame.scale.shares(ticks), [tick_text(tick / unit.size) for tick in ticks])
    axes.tick_params(colors="white", labelsize=em_points)
    name, _, more = settings.title.partition(", ")
    lines = [*name.rsplit(" ", 1)] if len(name) > 18 else [name]
    lines += [more] if more else []
    text = {"color": "white", "fontsize": em_points, "parse_math": False}
    figure.text(left, 1.0 - bottom / 3.0, "\n".join([*lines, f"({unit.name})"]), va="top", **text)
    figure.text(left, bottom / 2.0, f"frame {frame.frame}\n{frame.time_s:.3f} s", va="center", **text)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba(), float)[..., :3] / 255.0


def _opaque(pixels: np.ndarray) -> np.ndarray:
    """Pixels (h, w, 3), 0 to 1, whatever a PNG has per pixel."""
    if pixels.ndim == 2:
        pixels = np.repeat(pixels[..., None], 3, axis=-1)
    return np.array(pixels[..., :3], float)
