"""Charge against debris distance of the candidates of an optimisation, and those that no other beats in both."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.figure import FigureBase

from ..model.optimise.conclusions import Best
from ..system.disk import whole_file
from .style import blank_figure, line_style


def save_tradeoff(path: Path, best: Best) -> None:
    """Write the picture of what `tradeoff` draws."""
    figure = blank_figure(8.0, 5.0, layout="constrained", dpi=150)
    tradeoff(figure, best)
    with whole_file(path) as part:
        figure.savefig(part, format="png")


def tradeoff(figure: FigureBase, best: Best) -> None:
    """Draw charge and debris distance of all candidates of an optimisation."""
    settings, tried = best.optimisation.settings, best.tried
    axes = figure.subplots()
    points = np.array([(candidate.charge_kg, candidate.reach_m) for candidate in tried])
    holds, front = (np.array([getattr(candidate, name) for candidate in tried], bool) for name in ("holds", "on_front"))
    axes.plot(*points[~holds].T, "kx", markersize=4, label="fails too often")
    axes.plot(*points[holds].T, "ko", markersize=4, fillstyle="none", label="succeeds often enough")
    if front.any():
        on_front = points[front][np.argsort(points[front, 0], kind="stable")]
        axes.plot(*on_front.T, drawstyle="steps-post", **line_style(0), label="no other has less of both")
    chosen = points[[candidate.number == best.candidate for candidate in tried]]
    axes.plot(*chosen.T, "k*", markersize=12, label="the answer")
    axes.set_xlabel("all charges (kg)")
    axes.set_ylabel(f"{settings.quantile:g} quantile of the debris distance (m), {settings.runs_each} runs each")
    axes.grid(color="0.9", linewidth=0.5)
    axes.set_axisbelow(True)
    figure.legend(loc="outside upper center", ncols=4, frameon=False)
