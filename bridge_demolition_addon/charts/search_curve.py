"""Chart of a search: its trials, and the curve of the probability of success with its limits."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import FigureBase
from matplotlib.ticker import PercentFormatter

from ..model.search.conclusions import Answer
from ..model.search.curve import SearchCurve
from ..model.search.file import Search
from ..system.disk import whole_file
from .style import blank_figure, line_style, plain

_HEIGHT_OF_DOTS = 0.06
_BAND = "0.85"


def save_search_curve(path: Path, *shown: Any) -> None:
    """Write the picture of what `search_curve` draws."""
    figure = blank_figure(8.0, 5.0, layout="constrained", dpi=150)
    search_curve(figure, *shown)
    with whole_file(path) as part:
        figure.savefig(part, format="png")


def search_curve(
    figure: FigureBase,
    search: Search,
    values: np.ndarray,
    successes: np.ndarray,
    answer: Answer,
    curve: SearchCurve | None,
) -> None:
    """Draw the trials of a search and what they say.

    Parameters
    ----------
    figure
        Where to.
    search, answer, curve
        What was asked, and found.
    values, successes : (n,) float, (n,) bool
        Where each trial was made, and whether it succeeded.
    """
    settings, axes = search.settings, figure.subplots()
    if curve is not None:
        known = np.isfinite(curve.lows) & np.isfinite(curve.highs)
        axes.fill_betweenx(
            curve.probabilities[known],
            curve.lows[known],
            curve.highs[known],
            color=_BAND,
            label=f"limits with {settings.confidence:.4g} confidence",
        )
        axes.plot(curve.values, curve.probabilities, **line_style(0), label="most likely")
    _dots(axes, values[successes], 1.0, "all criteria met", "o")
    _dots(axes, values[~successes], 0.0, "not met", "x")
    if answer.is_known:
        axes.plot(
            [answer.limit], [settings.probability], "k>" if settings.success == "above" else "k<", label="the answer"
        )
    if settings.logarithmic:
        axes.set_xscale("log")
    span = settings.highest - settings.lowest
    axes.set_xlim(settings.lowest - (0 if settings.logarithmic else 0.05 * span), settings.highest + 0.05 * span)
    unit = f" ({search.unit})" if search.unit else (" (factor)" if settings.factor else "")
    axes.set_xlabel(plain(settings.key + unit))
    axes.set_ylabel("runs that meet all criteria")
    axes.yaxis.set_major_formatter(PercentFormatter(1.0))
    axes.grid(color="0.9", linewidth=0.5)
    axes.set_axisbelow(True)
    figure.legend(loc="outside upper center", ncols=3, frameon=False)


def _dots(axes: Axes, values: np.ndarray, height: float, label: str, marker: str) -> None:
    """Draw dots one above the other where several are at the same place, within the axes."""
    order = np.argsort(values, kind="stable")
    values = values[order]
    earlier = np.arange(len(values)) - np.searchsorted(values, values)
    towards = -1.0 if height else 1.0
    heights = height - towards * _HEIGHT_OF_DOTS + towards * 0.015 * (earlier % 4)
    axes.plot(values, heights, marker, color="k", markersize=4, fillstyle="none", linestyle="none", label=label)
