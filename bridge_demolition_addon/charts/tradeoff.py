"""Charge against reach: what each candidate of an optimisation came to, and those that no other beats in both."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import FigureBase

from ..model.optimise.candidates_table import Tried
from ..model.optimise.settings import OptimiseSettings
from ..system.disk import whole_file
from .style import blank_figure, line_style


def save_tradeoff(path: Path, *shown: Any) -> None:
    """Write the picture of what `tradeoff` draws."""
    figure = blank_figure(8.0, 5.0, layout="constrained", dpi=150)
    tradeoff(figure, *shown)
    with whole_file(path) as part:
        figure.savefig(part, format="png")


def tradeoff(figure: FigureBase, settings: OptimiseSettings, tried: Sequence[Tried], chosen: int) -> None:
    """Draw charge and reach of candidates.

    Parameters
    ----------
    figure
        Where to.
    settings, tried
        What was asked, and what came of each candidate in the search.
    chosen
        Number of the one that was chosen.
    """
    axes = figure.subplots()
    places = np.array([(each.charge_kg, each.reach_m) for each in tried])
    holds, front = (np.array([getattr(each, name) for each in tried], bool) for name in ("holds", "on_front"))
    axes.plot(*places[~holds].T, "kx", markersize=4, label="fails too often")
    axes.plot(*places[holds].T, "ko", markersize=4, fillstyle="none", label="succeeds often enough")
    if front.any():
        on_front = places[front][np.argsort(places[front, 0], kind="stable")]
        axes.plot(*on_front.T, drawstyle="steps-post", **line_style(0), label="no other has less of both")
    best = [(each.charge_kg, each.reach_m) for each in tried if each.number == chosen]
    axes.plot(*np.array(best).T, "k*", markersize=12, label="the answer")
    axes.set_xlabel("all charges (kg)")
    axes.set_ylabel(f"{settings.quantile:g} quantile of the reach (m), {settings.runs_each} runs each")
    axes.grid(color="0.9", linewidth=0.5)
    axes.set_axisbelow(True)
    figure.legend(loc="outside upper center", ncols=4, frameon=False)
