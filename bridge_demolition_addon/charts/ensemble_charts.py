"""Charts of searches and optimisations: the curve of the probability of success; charge against debris distance."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import FigureBase
from matplotlib.ticker import LogLocator, NullFormatter, PercentFormatter

from ..model.optimise.conclusions import Best
from ..model.search.conclusions import Answer
from ..system.disk import whole_file
from ..texts import Text, Unit
from .style import blank_figure, line_style, plain

_HEIGHT_OF_DOTS = 0.06
_BAND = "0.85"


def save_chart(path: Path, draw: Callable[[FigureBase], None]) -> None:
    """Write a chart as a picture."""
    figure = blank_figure(8.0, 5.0, layout="constrained", dpi=150)
    draw(figure)
    with whole_file(path) as part:
        figure.savefig(part, format="png")


def search_curve(figure: FigureBase, answer: Answer) -> None:
    """Draw the runs of a search and its curve."""
    search, curve, values, successes = answer.search, answer.curve, answer.values, answer.trials.successes
    settings, axes = search.settings, figure.subplots()
    if curve is not None:
        known = np.isfinite(curve.lows) & np.isfinite(curve.highs)
        band = curve.probabilities[known], curve.lows[known], curve.highs[known]
        axes.fill_betweenx(*band, color=_BAND, label=Text("limits with {} confidence", f"{settings.confidence:.4g}"))
        axes.plot(curve.values, curve.probabilities, **line_style(0), label=Text("most likely"))
    _dots(axes, values[successes], 1.0, Text("all criteria met"), "o")
    _dots(axes, values[~successes], 0.0, Text("not met"), "x")
    if answer.is_known:
        arrow = "k>" if settings.success == "above" else "k<"
        axes.plot([answer.limit], [settings.probability], arrow, label=Text("the answer"))
    if settings.logarithmic:
        axes.set_xscale("log")
        axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axes.xaxis.set_major_formatter("{x:.10g}")
        axes.xaxis.set_minor_formatter(NullFormatter())
    span = settings.highest - settings.lowest
    axes.set_xlim(settings.lowest - (0 if settings.logarithmic else 0.05 * span), settings.highest + 0.05 * span)
    axes.set_xlabel(plain(search.shown_quantity))
    axes.set_ylabel(Text("runs that meet all criteria"))
    axes.yaxis.set_major_formatter(PercentFormatter(1.0))
    axes.grid(color="0.9", linewidth=0.5)
    axes.set_axisbelow(True)
    figure.legend(loc="outside upper center", ncols=3, frameon=False)


def _dots(axes: Axes, values: np.ndarray, height: float, label: str, marker: str) -> None:
    """Draw dots one above the other where several are at the same position, within the axes."""
    order = np.argsort(values, kind="stable")
    values = values[order]
    earlier = np.arange(len(values)) - np.searchsorted(values, values)
    towards = -1.0 if height else 1.0
    heights = height - towards * _HEIGHT_OF_DOTS + towards * 0.015 * (earlier % 4)
    axes.plot(values, heights, marker, color="k", markersize=4, fillstyle="none", linestyle="none", label=label)


def tradeoff(figure: FigureBase, best: Best) -> None:
    """Draw charge and debris distance of all candidates of an optimisation."""
    settings, tried = best.optimisation.settings, best.tried
    axes = figure.subplots()
    points = np.array([(candidate.charge_kg, candidate.reach_m) for candidate in tried])
    holds, front = (np.array([getattr(candidate, name) for candidate in tried], bool) for name in ("holds", "on_front"))
    axes.plot(*points[~holds].T, "kx", markersize=4, label=Text("fails too often"))
    axes.plot(*points[holds].T, "ko", markersize=4, fillstyle="none", label=Text("succeeds often enough"))
    if front.any():
        on_front = points[front][np.argsort(points[front, 0], kind="stable")]
        label = Text("no other has less of both")
        axes.plot(*on_front.T, "o", drawstyle="steps-post", markersize=4, **line_style(0), label=label)
    chosen = points[[candidate.number == best.candidate for candidate in tried]]
    axes.plot(*chosen.T, "k*", markersize=12, label=Text("the answer"))
    axes.set_xlabel(Text("all charges ({})", Unit("kg")))
    of_several = Text(
        "{} quantile of the debris distance ({}), {} runs each", f"{settings.quantile:g}", Unit("m"), settings.runs_each
    )
    axes.set_ylabel(of_several if settings.runs_each > 1 else Text("debris distance ({}), 1 run each", Unit("m")))
    axes.grid(color="0.9", linewidth=0.5)
    axes.set_axisbelow(True)
    figure.legend(loc="outside upper center", ncols=4, frameon=False)
