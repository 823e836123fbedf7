"""The plan of a study: how likely debris is where, the limit around the bridge, zones and neighbours."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from manifold3d import CrossSection
from matplotlib.figure import FigureBase

from ..engineering.geometry.plan_areas import outlines
from ..model.scenario import Neighbour, Zone
from ..texts import Text
from .blast_maps import name_neighbour
from .plan_maps import draw_area, draw_zones, fit, name_zones, plan_axes
from .study_charts import LIMIT_COLOUR
from .style import plain

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
    """Return the lowest and the highest x and y of all that is drawn, neighbours apart."""
    corners = [ring for area in areas for ring in outlines(area)] + [np.array(zone.corners_m) for zone in zones]
    together = np.concatenate(corners)
    return together.min(axis=0), together.max(axis=0)


def _is_within(neighbour: Neighbour, low: np.ndarray, high: np.ndarray) -> bool:
    position = np.array(neighbour.position_m[:2])
    return bool((position >= low).all() and (position <= high).all())
