"""The pile of debris: a section through it, and a survey compared with the forecast of a run."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import FigureBase
from matplotlib.patches import Patch

from ..engineering.geometry.plan_areas import outlines
from ..model.debris.pile_sections import Direction, PileSection
from ..model.debris.survey import SurveyComparison
from ..texts import Text, Unit, distance_to_keep
from .plan_maps import draw_area, fit, plan_axes

_COLOURS = ("#4477aa", "#ee6677", "#228833")
_LEAST_M = 0.1


def difference_map(figure: FigureBase, comparison: SurveyComparison) -> None:
    """Draw how much higher the survey has the debris than the forecast, in plan."""
    axes = plan_axes(figure)
    difference = comparison.difference_m
    known = np.abs(difference[np.isfinite(difference)])
    top = max(float(np.percentile(known, 98.0)) if len(known) else 0.0, _LEAST_M)
    image = axes.imshow(
        difference, extent=_extent(comparison), origin="lower", cmap="RdBu_r", vmin=-top, vmax=top, aspect="equal"
    )
    _draw_limits(axes, comparison)
    fit(axes, figure)
    figure.colorbar(image, ax=axes, label=Text("survey less forecast ({})", Unit("m")), shrink=0.8)


def footprints_map(figure: FigureBase, comparison: SurveyComparison) -> None:
    """Draw where debris lies by the forecast, by the survey, and by both."""
    axes = plan_axes(figure)
    foreseen, surveyed = comparison.foreseen, comparison.surveyed
    cells = np.where(foreseen & surveyed, 2.0, np.where(surveyed, 1.0, np.where(foreseen, 0.0, np.nan)))
    axes.imshow(
        cells,
        extent=_extent(comparison),
        origin="lower",
        cmap=ListedColormap(_COLOURS),
        vmin=-0.5,
        vmax=2.5,
        aspect="equal",
    )
    _draw_limits(axes, comparison)
    fit(axes, figure)
    names = (Text("forecast alone"), Text("survey alone"), "both")
    handles = [Patch(color=colour, label=name) for colour, name in zip(_COLOURS, names, strict=True)]
    axes.legend(handles=handles, loc="upper right", fontsize=7)


def _extent(comparison: SurveyComparison) -> tuple[float, float, float, float]:
    xs, ys = comparison.xs_m, comparison.ys_m
    half_x, half_y = (xs[1] - xs[0]) / 2.0, (ys[1] - ys[0]) / 2.0
    return xs[0] - half_x, xs[-1] + half_x, ys[0] - half_y, ys[-1] + half_y


def _draw_limits(axes: Axes, comparison: SurveyComparison) -> None:
    draw_area(
        axes,
        comparison.outline,
        fill=False,
        edgecolor="black",
        linewidth=1.4,
        linestyle="--",
        label=Text("bridge before"),
    )
    limit = comparison.outline.offset(comparison.limit_m)
    draw_area(
        axes,
        limit,
        fill=False,
        edgecolor="tab:red",
        linewidth=1.2,
        label=Text("limit, {}", distance_to_keep(comparison.limit_m, ".1f")),
    )


_DEBRIS, _STANDING = ("#d9a066", "#7f4a1e"), ("0.85", "0.35")
"""Colours of areas and of their outlines."""

_ROOM_M = 0.5


def section_chart(figure: FigureBase, section: PileSection) -> None:
    """Draw a section to one scale both ways, with heights above 0."""
    axes = figure.add_subplot()
    handles = []
    for area, (face, edge), name in (
        (section.standing, _STANDING, "standing"),
        (section.debris, _DEBRIS, Text("debris")),
    ):
        if not area.is_empty():
            draw_area(axes, area, linewidth=0.8, facecolor=face, edgecolor=edge)
            handles.append(Patch(label=name, facecolor=face, edgecolor=edge))
    axes.plot(*section.ground_m.T, color="0.2", linewidth=1.4)
    _fit(axes, section)
    axes.set_aspect("equal")
    axes.grid(visible=True, color="0.85", linewidth=0.5)
    axes.set_axisbelow(True)
    along = "x" if section.direction is Direction.ALONG else "y"
    axes.set_xlabel(Text("{} ({})", along, Unit("m")))
    axes.set_ylabel(Text("height ({})", Unit("m")))
    if handles:
        axes.legend(handles=handles, loc="upper right", fontsize=8)


def section_title(section: PileSection) -> str:
    """Return what the section is of, and its figures."""
    axis = "y" if section.direction is Direction.ALONG else "x"
    what = f"Section {section.direction} the bridge at {axis} = {section.position_m:g} m, {section.time_s:.2f} s"
    if section.debris.is_empty():
        return f"{what}\nno debris is cut"
    return (
        f"{what}\ndebris: {section.debris_area_m2:.2f} m², {section.debris_width_m:.2f} m wide, "
        f"{section.debris_height_m:.2f} m above the ground"
    )


def _fit(axes: Axes, section: PileSection) -> None:
    """Show all of the section and the ground, with some room."""
    heights = list(section.ground_m[:, 1])
    for area in (section.debris, section.standing):
        for ring in outlines(area):
            heights += [ring[:, 1].min(), ring[:, 1].max()]
    axes.set_xlim(section.ground_m[0, 0], section.ground_m[-1, 0])
    axes.set_ylim(min(heights) - _ROOM_M, max(heights) + _ROOM_M)
