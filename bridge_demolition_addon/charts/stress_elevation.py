"""Stress elevation: the shards at one moment as seen from the side, each as dark as it is stressed."""

from __future__ import annotations

import numpy as np
from manifold3d import CrossSection
from matplotlib.collections import PolyCollection
from matplotlib.colors import LogNorm
from matplotlib.figure import FigureBase

from ..engineering.geometry.plan_areas import outlines
from ..model.debris.footprint import corners_at
from ..model.results.arrays import Results
from ..texts import Text, Unit

DECADES = 2.0
"""Powers of ten of stress from the darkest to the lightest colour."""


def stress_elevation(figure: FigureBase, results: Results, step: int) -> None:
    """Draw all shards and balls at a recorded step as seen across the road, those in front last."""
    shards = results.inventory.of_kind("shard")
    stresses_mpa = np.nan_to_num(results.frames.loads.von_mises_pa[step, shards]) / 1e6
    largest = float(stresses_mpa.max(initial=0.0)) or 1.0
    scale = LogNorm(largest / 10.0**DECADES, largest)
    axes = figure.add_subplot()
    axes.set_aspect("equal", adjustable="box")
    nearest_last = np.argsort(-results.frames.positions_m[step, shards, 1], kind="stable")
    polygons = _elevations(results, step, shards[nearest_last])
    drawn = PolyCollection(polygons, edgecolors="black", linewidths=0.25, cmap="YlOrRd", norm=scale)
    drawn.set_array(np.maximum(stresses_mpa[nearest_last], largest / 10.0**DECADES))
    axes.add_collection(drawn)
    balls = _elevations(results, step, results.inventory.of_kind("ball"))
    axes.add_collection(PolyCollection(balls, facecolors="0.25", edgecolors="black", linewidths=0.5))
    axes.axhline(0.0, color="black", linewidth=1.2)
    axes.autoscale_view()
    axes.set(xlabel=Text("x along the road ({})", Unit("m")), ylabel=Text("height ({})", Unit("m")))
    figure.colorbar(
        drawn,
        ax=axes,
        label=Text("equivalent stress ({})", Unit("MPa")),
        extend="min",
        orientation="horizontal",
        aspect=40,
        shrink=0.6,
    )


def _elevations(results: Results, step: int, bodies: np.ndarray) -> list[np.ndarray]:
    """Return the outlines (k, 2) of bodies as seen across the road."""
    hulls = (CrossSection.hull_points(corners[:, [0, 2]]) for corners in corners_at(results, step, bodies))
    return [rings[0] if (rings := outlines(hull)) else np.zeros((1, 2)) for hull in hulls]
