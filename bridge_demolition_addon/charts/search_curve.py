"""Chart of a search: its runs, and the curve of the probability of success with its limits."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import FigureBase
from matplotlib.ticker import PercentFormatter

from ..model.search.conclusions import Answer
from ..system.disk import whole_file
from .style import blank_figure, line_style, plain

_HEIGHT_OF_DOTS = 0.06
_BAND = "0.85"


def save_search_curve(path: Path, answer: Answer) -> None:
    """Write the picture of what `search_curve` draws."""
    figure = blank_figure(8.0, 5.0, layout="constrained", dpi=150)
    search_curve(figure, answer)
    with whole_file(path) as part:
        figure.savefig(part, format="png")


def search_curve(figure: FigureBase, answer: Answer) -> None:
    """Draw the runs of a search and its curve."""
    search, curve, values, successes = answer.search, answer.curve, answer.values, answer.trials.successes
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
