"""Maps in plan: debris with the bridge's outline, the height of the pile, and the exclusion zone."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any, Protocol

import numpy as np
from manifold3d import CrossSection
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure, FigureBase
from matplotlib.patches import PathPatch
from matplotlib.path import Path as Outline
from matplotlib.ticker import MaxNLocator
from matplotlib.tri import Triangulation

from ..engineering.geometry.plan_areas import outlines
from ..engineering.terrain.surface import RecordedGround
from ..engineering.units import rounded_up
from ..model.debris.footprint import plan_hulls
from ..model.debris.throws import Debris, HeightMap
from ..model.debris.zones import ExclusionZone
from ..model.results.arrays import Results
from ..texts import Quantity, Text, Unit
from .style import MM_PER_INCH, MM_PER_POINT, PAGE_WIDTH_MM, blank_figure, lay_out, plain

NAMED_THROWS = 5
"""Largest throws that the map names."""

_ROOM = 0.04
_LABEL_SHARE = 0.03
"""How far a zone's name is from its sides, as a share of these."""

_SIDES = {"left": 0.0, "bottom": 0.0, "center": 0.5, "right": 1.0, "top": 1.0}
_NAME_PLACES = tuple((across, upwards) for across in ("left", "right") for upwards in ("top", "bottom", "center"))
"""Places in a zone in the order in which its name tries them."""

_NAME_POINTS = 7.0
_LETTER_SHARE, _LINE_SHARE = 0.6, 1.5
"""Mean width of a letter, and height of a line with its white box, over the size of the letters."""

_AXES_SHARES = (0.85, 0.75)
"""About how much of a map's width and height are left beside its labels, ticks and legend."""

_MAPS_ABREAST = 2
_MAP_TITLE_MM, _MAP_LEGEND_MM, _HIGHEST_MAPS_MM = 20.0, 10.0, 220.0
"""What title and labels of one of the maps beside each other need, their legend, and what fits on a page."""

_SHORTEST_MAP_MM, _TALLEST_MAP_MM = 75.0, 150.0

LEVEL_GROUND = RecordedGround()

_SURFACE_COLOURS = {"water": "tab:blue", "river bank": "tab:green"}
_CONTOUR, _CONTOUR_LINES, _FLAT_M = "peru", 12, 0.01
_SEEN = 33
"""Positions along each side of a map at which its heights are looked up."""

_ARROW = {"arrowstyle": "-|>", "color": "black", "linewidth": 0.8, "shrinkA": 0.0, "shrinkB": 0.0}


class OnPlan(Protocol):
    """What is drawn on plans by its outline and its name: a zone, a fall bed."""

    @property
    def name(self) -> str: ...
    @property
    def corners_m(self) -> tuple[tuple[float, float], ...]: ...


def debris_map(
    figure: FigureBase, results: Results, debris: Debris, zones: Sequence[OnPlan] = (), *, trajectories: bool = False
) -> None:
    """Draw where the debris lies, where the bridge stood and, if asked for, the paths of the shards' centres."""
    axes = plan_axes(figure)
    draw_zones(axes, zones)
    shards = [ring for hull in plan_hulls(results, debris.bodies, -1) for ring in outlines(hull)]
    axes.add_collection(PolyCollection(shards, facecolors="0.78", edgecolors="0.45", linewidths=0.3))
    if trajectories:
        paths = np.swapaxes(results.frames.positions_m[:, debris.bodies, :2], 0, 1)
        axes.add_collection(
            LineCollection(list(paths), colors="0.3", linewidths=0.3, label=Text("paths of the shards"))
        )
    draw_area(axes, debris.area, fill=False, edgecolor="black", linewidth=1.0, label=Text("footprint of the debris"))
    draw_area(
        axes, debris.outline, fill=False, edgecolor="black", linewidth=1.6, linestyle="--", label=Text("bridge before")
    )
    balls = results.inventory.of_kind("ball")
    for ball, hull in zip(balls, plan_hulls(results, balls, -1), strict=True):
        name = plain(results.inventory.body_names[ball])
        draw_area(axes, hull, facecolor="0.25", edgecolor="black", linewidth=0.5, label=name)
    largest = np.argsort(-debris.throws_m, kind="stable")[:NAMED_THROWS]
    for number, row in enumerate(largest, start=1):
        first, last = results.frames.positions_m[[0, -1], debris.bodies[row], :2]
        axes.annotate("", last, first, arrowprops=_ARROW)
        box = {"boxstyle": "circle,pad=0.15", "facecolor": "white", "edgecolor": "black", "linewidth": 0.6}
        axes.annotate(str(number), last, ha="center", va="center", fontsize=6, bbox=box)
    fit(axes, figure)
    name_zones(axes, zones)
    draw_ground(axes, debris.ground)


def debris_figure(results: Results, debris: Debris, zones: Sequence[OnPlan] = ()) -> Figure:
    """Draw `debris_map` on a figure of its own, as wide as a page."""
    low, high = _bounds_of([("", debris)])
    size = PAGE_WIDTH_MM / MM_PER_INCH, map_height_mm((*low, *high)) / MM_PER_INCH
    figure = blank_figure(*size, layout="constrained", dpi=150)
    debris_map(figure, results, debris, zones)
    lay_out(figure)
    return figure


def draw_ground(axes: Axes, ground: RecordedGround) -> None:
    """Draw contour lines of ground that is not flat, and outlines of surfaces on it, in a map that was fitted."""
    left, right, low, high = (*axes.get_xlim(), *axes.get_ylim())
    for surface in ground.surfaces:
        colour = _SURFACE_COLOURS.get(surface.kind, "0.35")
        area = ground.shown(surface)
        if area.is_empty():
            continue
        draw_area(axes, area, linestyle="-.", zorder=0.8, fill=False, edgecolor=colour, linewidth=0.9)
        corner = np.clip(area.bounds()[:2], (left, low), (right, high))
        axes.annotate(plain(surface.name), corner, fontsize=6, va="bottom", color=colour, annotation_clip=True)
    if ground.terrain is not None:
        x, y, heights = ground.terrain.mesh.vertices.T
        positions = np.stack(np.meshgrid(np.linspace(left, right, _SEEN), np.linspace(low, high, _SEEN)), -1)
        levels = _contour_levels(ground.terrain.heights_at(positions))
        if len(levels):
            style: dict[str, Any] = {"colors": _CONTOUR, "linewidths": 0.5, "linestyles": "solid", "zorder": 0.7}
            lines = axes.tricontour(Triangulation(x, y, ground.terrain.mesh.triangles), heights, levels, **style)
            axes.clabel(lines, fmt="%g m", fontsize=5)
    axes.set(xlim=(left, right), ylim=(low, high))


def _contour_levels(heights_m: np.ndarray) -> np.ndarray:
    """Heights of contour lines, a round distance apart; none where the ground is flat to the centimetre."""
    known = heights_m[np.isfinite(heights_m)]
    low, high = float(known.min(initial=np.inf)), float(known.max(initial=-np.inf))
    if not high - low > _FLAT_M:
        return np.zeros(0)
    levels = np.asarray(MaxNLocator(_CONTOUR_LINES, steps=[1, 2, 5, 10]).tick_values(low, high))
    return levels[(levels > low) & (levels < high)]


def pile_map(
    figure: FigureBase, heights: HeightMap, outline: CrossSection, ground: RecordedGround = LEVEL_GROUND
) -> None:
    """Draw how high the debris lies above the ground, in plan."""
    axes = plan_axes(figure)
    xs, ys = heights.xs_m, heights.ys_m
    half = (xs[1] - xs[0]) / 2.0
    extent = (xs[0] - half, xs[-1] + half, ys[0] - half, ys[-1] + half)
    top = float(np.nanmax(heights.heights_m))
    image = axes.imshow(
        heights.heights_m, extent=extent, origin="lower", cmap="Greys", vmin=0.0, vmax=max(top, 0.1), aspect="equal"
    )
    draw_area(axes, outline, fill=False, edgecolor="black", linewidth=1.6, linestyle="--", label=Text("bridge before"))
    fit(axes, figure)
    draw_ground(axes, ground)
    figure.colorbar(image, ax=axes, label=Text("height above the ground ({})", Unit("m")), shrink=0.8)


def exclusion_map(
    figure: FigureBase, zone: ExclusionZone, zones: Sequence[OnPlan] = (), ground: RecordedGround = LEVEL_GROUND
) -> None:
    """Draw the areas that make up the exclusion zone."""
    axes = plan_axes(figure)
    draw_area(
        axes, zone.whole, facecolor="0.93", edgecolor="black", linewidth=2.0, label=Text("exclusion zone of one run")
    )
    draw_zones(axes, zones)
    draw_area(
        axes, zone.drop, facecolor="0.82", edgecolor="black", linewidth=0.8, linestyle=":", label=Text("designed drop")
    )
    style = {"facecolor": "none", "edgecolor": "0.3", "hatch": "....", "linewidth": 0.8}
    draw_area(axes, zone.debris, **style, label=Text("debris of one run"))
    draw_area(axes, zone.plan, facecolor="0.6", edgecolor="black", linewidth=1.2, linestyle="--", label=Text("bridge"))
    fit(axes, figure)
    name_zones(axes, zones)
    draw_ground(axes, ground)
    _dimension(axes, zone)


def debris_maps(figure: FigureBase, runs: Sequence[tuple[str, Debris]]) -> None:
    """Draw the footprints of the debris of several runs side by side, at one scale, each with its run's name."""
    low, high = _bounds_of(runs)
    rows = math.ceil(len(runs) / _MAPS_ABREAST)
    panels = figure.subplots(rows, min(len(runs), _MAPS_ABREAST), squeeze=False)
    for axes, (name, debris) in zip(panels.flat, runs, strict=False):
        axes.set_title(plain(name), fontsize=8, loc="left")
        axes.set_aspect("equal", adjustable="box")
        axes.set(xlabel=Text("x along the road ({})", Unit("m")), ylabel=Text("y across ({})", Unit("m")))
        axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
        axes.grid(alpha=0.25)
        axes.set_axisbelow(True)
        draw_area(
            axes, debris.area, facecolor="0.7", edgecolor="0.3", linewidth=0.4, label=Text("footprint of the debris")
        )
        style = {"fill": False, "edgecolor": "black", "linewidth": 1.2, "linestyle": "--"}
        draw_area(axes, debris.outline, label=Text("bridge before"), **style)
        draw_ground(axes, debris.ground)
    for axes in panels.flat[len(runs) :]:
        axes.remove()
    handles, labels = panels.flat[0].get_legend_handles_labels()
    if handles:
        figure.legend(handles, labels, loc="outside lower center", ncols=2, frameon=False, fontsize=8)


def debris_maps_height_mm(runs: Sequence[tuple[str, Debris]]) -> float:
    """Return the height of `debris_maps` that suits their shape at the full width of a page."""
    low, high = _bounds_of(runs)
    columns, rows = min(len(runs), _MAPS_ABREAST), math.ceil(len(runs) / _MAPS_ABREAST)
    wide, across = high - low
    map_mm = PAGE_WIDTH_MM / columns * float(across / wide) + _MAP_TITLE_MM
    return min(rows * map_mm + _MAP_LEGEND_MM, _HIGHEST_MAPS_MM)


def _bounds_of(runs: Sequence[tuple[str, Debris]]) -> tuple[np.ndarray, np.ndarray]:
    """Return the lowest and the highest x and y of debris and bridges, with some room around them."""
    areas = [area for _, debris in runs for area in (debris.area, debris.outline) if not area.is_empty()]
    bounds = np.array([area.bounds() for area in areas])
    low, high = bounds[:, :2].min(axis=0), bounds[:, 2:].max(axis=0)
    room = _ROOM * float((high - low).max())
    return low - room, high + room


def map_height_mm(bounds: Sequence[float]) -> float:
    """Return the height of a map of an area with these bounds at the full width of a page, with axes and legend."""
    width, height = bounds[2] - bounds[0], bounds[3] - bounds[1]
    return float(np.clip(25.0 + 150.0 * height / max(width, 1e-9), _SHORTEST_MAP_MM, _TALLEST_MAP_MM))


def draw_area(axes: Axes, area: CrossSection, label: str | None = None, **style: Any) -> None:
    """Draw an area with its holes; nothing where it is empty."""
    rings = outlines(area)
    if rings:
        path = Outline.make_compound_path(*(Outline(np.vstack([ring, ring[:1]]), closed=True) for ring in rings))
        axes.add_patch(PathPatch(path, label=label, **style))


def draw_zones(axes: Axes, zones: Iterable[OnPlan]) -> None:
    """Draw zones of the site."""
    for zone in zones:
        corners = np.array(zone.corners_m)
        path = Outline(np.vstack([corners, corners[:1]]), closed=True)
        axes.add_patch(PathPatch(path, facecolor="none", edgecolor="0.2", hatch="//", linewidth=1.0, alpha=0.6))


def name_zones(axes: Axes, zones: Iterable[OnPlan]) -> None:
    """Write each zone's name where no other name is, if there is such a position at its sides."""
    letter_m = _NAME_POINTS * MM_PER_POINT * _metres_per_mm(axes)
    style: dict[str, Any] = {
        "fontsize": _NAME_POINTS,
        "bbox": {"facecolor": "white", "edgecolor": "none", "pad": 1.0},
        "zorder": 5,
    }
    occupied: list[np.ndarray] = []
    for zone in zones:
        size = letter_m * np.array([_LETTER_SHARE * len(zone.name), _LINE_SHARE])
        choices = [(*position, *_name_box(zone, *position, size)) for position in _NAME_PLACES]
        free = (choice for choice in choices if not any(_overlap(choice[3], other) for other in occupied))
        across, upwards, anchor, box = next(free, choices[0])
        occupied.append(box)
        axes.annotate(plain(zone.name), (anchor[0], anchor[1]), ha=across, va=upwards, **style)


def _name_box(zone: OnPlan, across: str, upwards: str, size: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return where a name of a size is anchored in its zone, and its lowest and highest corner (2, 2)."""
    corners = np.array(zone.corners_m)
    low, high = corners.min(axis=0), corners.max(axis=0)
    sides = np.array([_SIDES[across], _SIDES[upwards]])
    anchor = low + (high - low) * (_LABEL_SHARE + (1.0 - 2.0 * _LABEL_SHARE) * sides)
    lowest = anchor - size * sides
    return anchor, np.array([lowest, lowest + size])


def _overlap(first: np.ndarray, second: np.ndarray) -> bool:
    return bool((first[0] < second[1]).all() and (second[0] < first[1]).all())


def _metres_per_mm(axes: Axes) -> float:
    """Return about how many metres of a map are a millimetre of its drawing."""
    shown = np.ptp([axes.get_xlim(), axes.get_ylim()], axis=1)
    figure = axes.figure
    drawn_mm = MM_PER_INCH / figure.dpi * np.array([figure.bbox.width, figure.bbox.height]) * _AXES_SHARES
    return float((shown / drawn_mm).max())


def plan_axes(figure: FigureBase) -> Axes:
    """Return axes in metres along and across the road, at one scale."""
    axes = figure.add_subplot()
    axes.set_aspect("equal", adjustable="box")
    axes.set(xlabel=Text("x along the road ({})", Unit("m")), ylabel=Text("y across the road ({})", Unit("m")))
    axes.grid(alpha=0.25)
    axes.set_axisbelow(True)
    return axes


def fit(axes: Axes, figure: FigureBase) -> None:
    """Show all that was drawn, with a legend below it."""
    corners = [axes.dataLim.get_points()]
    corners += [patch.get_extents().transformed(axes.transData.inverted()).get_points() for patch in axes.patches]
    low = np.min([corner.min(axis=0) for corner in corners if np.isfinite(corner).all()], axis=0)
    high = np.max([corner.max(axis=0) for corner in corners if np.isfinite(corner).all()], axis=0)
    room = _ROOM * float((high - low).max())
    axes.set_xlim(low[0] - room, high[0] + room)
    axes.set_ylim(low[1] - room, high[1] + room)
    handles, labels = axes.get_legend_handles_labels()
    unique = dict(zip(labels, handles, strict=True))
    if unique:
        figure.legend(unique.values(), unique.keys(), loc="outside lower center", ncols=4, frameon=False, fontsize=8)


def _dimension(axes: Axes, zone: ExclusionZone) -> None:
    """Draw how far the zone reaches beyond the bridge to each side."""
    low_x, low_y, high_x, high_y = zone.whole.bounds()
    bridge = zone.plan.bounds()
    middle_x, middle_y = (bridge[0] + bridge[2]) / 2.0, (bridge[1] + bridge[3]) / 2.0
    sides = (
        ((bridge[2], middle_y), (high_x, middle_y), high_x - bridge[2]),
        ((bridge[0], middle_y), (low_x, middle_y), bridge[0] - low_x),
        ((middle_x, bridge[3]), (middle_x, high_y), high_y - bridge[3]),
        ((middle_x, bridge[1]), (middle_x, low_y), bridge[1] - low_y),
    )
    arrow = {"arrowstyle": "<|-|>", "color": "black", "linewidth": 0.9, "shrinkA": 0.0, "shrinkB": 0.0}
    box = {"facecolor": "white", "edgecolor": "none", "pad": 1.0}
    for start, end, length in sides:
        axes.annotate("", end, start, arrowprops=arrow)
        position = (np.array(start) + np.array(end)) / 2.0
        axes.annotate(
            Quantity(rounded_up(length, "0.1"), "m"), position, ha="center", va="center", fontsize=8, bbox=box
        )
