"""A section through a pile as a drawing: debris, what stands, the ground, and a scale of heights."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import FigureBase
from matplotlib.patches import Patch

from ..engineering.geometry.plan_areas import outlines
from ..model.debris.pile_sections import Direction, PileSection
from ..texts import Text, Unit
from .plan_maps import draw_area

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
