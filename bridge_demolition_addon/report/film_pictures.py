"""What is laid over the pictures of a film: the colour bar of the contours, the time, and how fast the film runs."""

from __future__ import annotations

from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.image import imread, imsave

from ..core.results import Results

COLOUR_MAP = "YlOrRd"
DECADES = 2.0
"""What is stressed less than the largest by more than so many powers of ten is as light as can be."""

_DOTS_PER_INCH = 100.0


def stress_scale(results: Results) -> LogNorm:
    """One scale for the whole film, up to the largest stress of any shard at any time."""
    largest = float(np.nan_to_num(results.von_mises_pa[:, results.of_kind("shard")]).max(initial=0.0)) / 1e6 or 1.0
    return LogNorm(largest / 10.0**DECADES, largest)


def stress_colours(stresses_pa: np.ndarray, scale: LogNorm) -> np.ndarray:
    """Colours (n, 3) in sRGB of stresses (n,)."""
    stresses_mpa = np.clip(np.nan_to_num(stresses_pa) / 1e6, scale.vmin, scale.vmax)
    return matplotlib.colormaps[COLOUR_MAP](scale(stresses_mpa))[:, :3]


def lay_over(picture: Path, output: Path, scale: LogNorm, words: str) -> None:
    """Lay colour bar and words over a picture, and write the result."""
    pixels = imread(picture)[:, :, :3]
    height, width = pixels.shape[:2]
    figure = Figure(figsize=(width / _DOTS_PER_INCH, height / _DOTS_PER_INCH), dpi=_DOTS_PER_INCH)
    canvas = FigureCanvasAgg(figure)
    figure.patch.set_alpha(0.0)
    size = max(6.0, height / 50.0)
    axes = figure.add_axes((0.62, 0.115, 0.34, 0.022))
    bar = figure.colorbar(ScalarMappable(scale, COLOUR_MAP), cax=axes, orientation="horizontal", extend="min")
    bar.set_label("equivalent stress (MPa)", color="white", fontsize=size)
    bar.ax.tick_params(colors="white", labelsize=size)
    figure.text(0.03, 0.04, words, color="white", fontsize=1.3 * size, parse_math=False)
    canvas.draw()
    over = np.asarray(canvas.buffer_rgba(), float) / 255.0
    alpha = over[:, :, 3:]
    imsave(output, pixels * (1.0 - alpha) + over[:, :, :3] * alpha)
