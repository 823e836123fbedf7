"""Charts of studies, searches and optimisations: limits, influence, plan, curve of success, debris against charge."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from manifold3d import CrossSection
from matplotlib.axes import Axes
from matplotlib.figure import FigureBase
from matplotlib.ticker import LogLocator, MaxNLocator, NullFormatter, PercentFormatter

from ..engineering.geometry.plan_areas import outlines
from ..model.optimise.conclusions import Best
from ..model.scenario import Neighbour, Zone
from ..model.search.conclusions import Answer
from ..system.disk import whole_file
from ..texts import Text, Unit
from .blast_maps import name_neighbour
from .plan_maps import draw_area, draw_zones, fit, name_zones, plan_axes
from .style import blank_figure, line_style, plain

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
    """Draw the runs' debris distances (n,), and which share of the runs stays within a distance.

    Infinity is a run that did not finish, beyond the right edge. The limit is in metres and as text; the quantile is
    its share of the runs.
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
    """Draw how the limit (m,) settles with the number of runs (m,), with their largest distance and their median."""
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
    """An input as one panel shows it: name with unit, the runs' values (n,), rank correlation, None for texts."""

    name: str
    values: np.ndarray
    correlation: float | None


def output_against_inputs(figure: FigureBase, label: str, values: np.ndarray, panels: Sequence[InputPanel]) -> None:
    """Draw an output (n,), one value a run, against each input, in a panel each."""
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
    """Return the height that suits a number of panels."""
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
    """Return the height that suits a number of inputs."""
    return 35.0 + 6.0 * inputs


def _places(axes: Axes, values: np.ndarray) -> np.ndarray:
    """Return where values stand on the axis: texts side by side."""
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
    """Draw charge and debris distance of an optimisation's candidates."""
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


_SHADES = ("0.92", "0.78", "0.58")
"""Of areas from the largest, where debris is rare, to the smallest."""


def study_plan(
    figure: FigureBase,
    bridge: CrossSection,
    likely: Mapping[str, CrossSection],
    limits: Mapping[str, CrossSection],
    zones: Sequence[Zone] = (),
    neighbours: Sequence[Neighbour] = (),
) -> None:
    """Draw the plan of a study.

    `likely` holds up to three areas of debris by what the legend says, the largest first; `limits` the limit around the
    bridge, then that with its buffer. A neighbour beyond all that is drawn is left out: it would shrink everything
    else.
    """
    axes = plan_axes(figure)
    for shade, (label, area) in zip(_SHADES[-len(likely) :] if likely else (), likely.items(), strict=True):
        draw_area(axes, area, facecolor=shade, edgecolor="0.35", linewidth=0.5, label=plain(label))
    draw_zones(axes, zones)
    draw_area(axes, bridge, fill=False, edgecolor="black", linewidth=1.6, linestyle="--", label=Text("bridge before"))
    for number, (label, area) in enumerate(limits.items()):
        style = {"linewidth": 1.8, "linestyle": "-"} if not number else {"linewidth": 1.0, "linestyle": (0, (6, 2))}
        draw_area(axes, area, fill=False, edgecolor=LIMIT_COLOUR, label=plain(label), **style)
    low, high = _corners([bridge, *likely.values(), *limits.values()], zones)
    near = [neighbour for neighbour in neighbours if _is_within(neighbour, low, high)]
    if near:
        positions = np.array([neighbour.position_m[:2] for neighbour in near])
        axes.plot(*positions.T, "^", color="black", markersize=5.0, linestyle="none", label=Text("neighbours"))
    fit(axes, figure)
    name_zones(axes, zones)
    for neighbour in near:
        name_neighbour(axes, neighbour, to_the_left=neighbour.position_m[0] > (low[0] + high[0]) / 2.0)


def _corners(areas: Sequence[CrossSection], zones: Sequence[Zone]) -> tuple[np.ndarray, np.ndarray]:
    """Return the lowest and the highest x and y drawn, neighbours apart."""
    corners = [ring for area in areas for ring in outlines(area)] + [np.array(zone.corners_m) for zone in zones]
    together = np.concatenate(corners)
    return together.min(axis=0), together.max(axis=0)


def _is_within(neighbour: Neighbour, low: np.ndarray, high: np.ndarray) -> bool:
    position = np.array(neighbour.position_m[:2])
    return bool((position >= low).all() and (position <= high).all())
