"""Charts of a study: debris distances of its runs, how their limit settles, and the influence of each input."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import FigureBase
from matplotlib.ticker import MaxNLocator, PercentFormatter

from ..texts import Text, Unit
from .style import line_style, plain

LIMIT_COLOUR = "#b2182b"
"""Of the limit wherever it is drawn."""

PANELS_ABREAST = 4
MOST_DOTS = 500
"""More would fill a page with megabytes."""

PANEL_MM = 42.0
"""Height of a row of panels."""

_MOST_BINS = 30
_MOST_POINTS = 400
_FEW_LIMITS = 50
"""Points of a line up to which each has a mark."""

_DOTS_OF_FEW, _FEW = 9.0, 300
"""Size of dots while they are few, in square points; of more they are smaller."""


def reach_distribution(
    figure: FigureBase, reaches_m: np.ndarray, limit: tuple[float, str] | None, quantile: float
) -> None:
    """Draw the debris distances (n,) of all runs, and which share of the runs stays within a distance.

    Infinity is a run that did not finish, beyond the right edge. The limit is in metres and as text; the quantile is
    the share of all runs that it is for.
    """
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(2, 3))
    finite = np.sort(reaches_m[np.isfinite(reaches_m)])
    bins = min(_MOST_BINS, max(5, math.isqrt(4 * len(finite))))
    upper.hist(finite, bins=bins, color="0.75", edgecolor="0.35", linewidth=0.5)
    upper.set_ylabel(Text("runs"))
    shares = np.arange(1, len(finite) + 1) / len(reaches_m)
    label = Text("share of the runs of this study")
    lower.step(np.append(0.0, finite), np.append(0.0, shares), where="post", **line_style(0), label=label)
    lower.axhline(quantile, color="0.4", linewidth=0.9, linestyle=":", label=Text("{} %", f"{100.0 * quantile:.10g}"))
    if limit:
        upper.axvline(limit[0], color=LIMIT_COLOUR, linewidth=1.8)
        lower.axvline(limit[0], color=LIMIT_COLOUR, linewidth=1.8, label=Text("limit, {}", limit[1]))
    lower.set(
        xlabel=Text("debris distance from the bridge's plan ({})", Unit("m")),
        ylabel=Text("stays within"),
        ylim=(0.0, 1.02),
    )
    lower.set_xlim(left=0.0)
    lower.yaxis.set_major_formatter(PercentFormatter(1.0, symbol=" %"))
    for axes in (upper, lower):
        axes.grid(alpha=0.3)
        axes.set_axisbelow(True)
    figure.legend(loc="outside lower center", ncols=3, frameon=False, fontsize=8)


def limit_over_runs(figure: FigureBase, reaches_m: np.ndarray, runs: np.ndarray, limits_m: np.ndarray) -> None:
    """Draw how the limit (m,) after so many of the runs (m,) settles, with their largest distance and their median."""
    axes = figure.add_subplot()
    counts = np.arange(1, len(reaches_m) + 1)
    shown = np.unique(np.rint(np.linspace(1, len(reaches_m), min(len(reaches_m), _MOST_POINTS))).astype(int))
    medians = np.array([np.median(reaches_m[:count]) for count in shown])
    some = slice(None, None, 1 + len(reaches_m) // MOST_DOTS)
    axes.plot(counts[some], _drawable(reaches_m[some]), ".", color="0.6", markersize=3.0, label=Text("runs"))
    _mark_endless(axes, counts, reaches_m, {"marker": "x", "color": "0.3", "label": Text("runs that did not finish")})
    largest = np.maximum.accumulate(reaches_m)
    axes.step(counts, _drawable(largest), where="post", **line_style(3, 1.0), label=Text("largest so far"))
    axes.plot(shown, _drawable(medians), **line_style(2, 1.2), label=Text("median so far"))
    marker: dict[str, Any] = {"marker": "o", "markersize": 2.5} if len(runs) < _FEW_LIMITS else {}
    style: dict[str, Any] = {"color": LIMIT_COLOUR, "linewidth": 1.8, "label": Text("limit by the runs so far")}
    axes.step(runs, _drawable(limits_m), where="post", **style, **marker)
    _mark_endless(
        axes, runs, limits_m, {"marker": "^", "color": LIMIT_COLOUR, "label": Text("no limit by the runs so far")}
    )
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.set(xlabel=Text("runs"), ylabel=Text("debris distance ({})", Unit("m")), xlim=(0, len(reaches_m) * 1.02))
    axes.set_ylim(bottom=0.0)
    axes.grid(alpha=0.3)
    figure.legend(loc="outside lower center", ncols=3, frameon=False, fontsize=8)


@dataclass(frozen=True, eq=False, slots=True)
class InputPanel:
    """An input as one panel shows it: name with unit, values (n,) of all runs, rank correlation, None for texts."""

    name: str
    values: np.ndarray
    correlation: float | None


def output_against_inputs(figure: FigureBase, label: str, values: np.ndarray, panels: Sequence[InputPanel]) -> None:
    """Draw an output of all runs (n,) against each input, in a panel each."""
    rows = math.ceil(len(panels) / PANELS_ABREAST)
    grid = figure.subplots(rows, PANELS_ABREAST, squeeze=False, sharey=True)
    size = _DOTS_OF_FEW if len(values) <= _FEW else _DOTS_OF_FEW * _FEW / len(values)
    for axes, panel in zip(grid.flat, panels, strict=False):
        axes.scatter(_places(axes, panel.values), values, s=size, color="0.25", linewidths=0.0, alpha=0.7)
        axes.set_xlabel(plain(panel.name), fontsize=7, wrap=True)
        if panel.correlation is not None and math.isfinite(panel.correlation):
            axes.set_title(Text("rank correlation {}", f"{panel.correlation:+.2f}"), fontsize=7)
        axes.tick_params(labelsize=6)
        axes.grid(alpha=0.3)
    for axes in grid.flat[len(panels) :]:
        axes.remove()
    for axes in grid[:, 0]:
        axes.set_ylabel(plain(label), fontsize=7)


def output_panels_height_mm(panels: int) -> float:
    """Return the height that suits so many panels."""
    return PANEL_MM * math.ceil(panels / PANELS_ABREAST)


def correlation_map(
    figure: FigureBase, inputs: Sequence[str], outputs: Sequence[str], correlations: np.ndarray, by_chance: float
) -> None:
    """Draw rank correlations (inputs, outputs) as shades with their numbers; bold where chance alone is unlikely."""
    axes = figure.add_subplot()
    axes.imshow(np.abs(np.nan_to_num(correlations)), cmap="Greys", vmin=0.0, vmax=1.5, aspect="auto")
    for (row, column), value in np.ndenumerate(correlations):
        if math.isfinite(value):
            weight = "bold" if abs(value) > by_chance else "normal"
            axes.text(column, row, f"{value:+.2f}", ha="center", va="center", fontsize=7, fontweight=weight)
    axes.set_xticks(range(len(outputs)), map(plain, outputs), rotation=30, ha="right", fontsize=7)
    axes.set_yticks(range(len(inputs)), map(plain, inputs), fontsize=7)
    axes.tick_params(length=0)


def correlation_map_height_mm(inputs: int) -> float:
    """Return the height that suits so many inputs."""
    return 35.0 + 6.0 * inputs


def _places(axes: Axes, values: np.ndarray) -> np.ndarray:
    """Return where values stand on the axis: texts one beside the other."""
    if values.dtype != object:
        return values
    names = sorted({str(value) for value in values})
    axes.set_xticks(range(len(names)), map(plain, names))
    axes.set_xlim(-0.5, len(names) - 0.5)
    return np.array([names.index(str(value)) for value in values], float)


def _drawable(values: np.ndarray) -> np.ndarray:
    return np.where(np.isfinite(values), values, np.nan)


def _mark_endless(axes: Axes, positions: np.ndarray, values: np.ndarray, style: dict[str, Any]) -> None:
    """Mark at the upper edge where values are infinite."""
    endless = positions[np.isinf(values)]
    if len(endless):
        at_edge = axes.get_xaxis_transform()
        axes.plot(
            endless, np.ones(len(endless)), linestyle="none", markersize=4.0, clip_on=False, transform=at_edge, **style
        )
