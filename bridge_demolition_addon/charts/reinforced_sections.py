"""Sections of members with their bars: outlines of the concrete, bars at their positions, and what they are."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection, LineCollection
from matplotlib.figure import FigureBase
from matplotlib.patches import Polygon

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.plan_areas import outlines
from ..engineering.geometry.solids import to_manifold
from ..engineering.reinforced_concrete.least_areas import clear_m
from ..model.bridge.member import Member
from ..model.reinforcement.schedule import Schedule, ScheduledBars
from ..texts import Quantity, Text, Unit
from .style import plain

_PLANES = {0: (1, 2), 1: (0, 2), 2: (1, 0)}
"""Axes to the right and upwards in sections across each axis."""

_AXIS_OF_KIND = {"deck": 0, "girder": 0, "pier cap": 1, "pier": 2, "abutment": 2}
_NAMES = {
    0: Text("x along the road ({})", Unit("m")),
    1: Text("y across the road ({})", Unit("m")),
    2: Text("height ({})", Unit("m")),
}
_SHORT = "xyz"
_CONCRETE, _ACROSS, _BARS = "0.9", "#2166ac", "#b2182b"
_LETTERS_PT = 7.0


@dataclass(frozen=True, slots=True, eq=False)
class MemberSection:
    """A section across the axis of one member, or of a deck with its girders."""

    title: str
    axis: int
    members: tuple[Member, ...]

    @property
    def at_m(self) -> float:
        """Where along the axis it is: in the middle of the first member."""
        return 0.5 * sum(_ends(self.members[0], self.axis))


def sections_to_draw(members: Sequence[Member], schedule: Schedule) -> list[MemberSection]:
    """Return a section of the first deck with its girders, of the first pier cap and of the first pier with bars.

    None is drawn of members whose bars follow them.
    """
    with_bars = {name for row in schedule.bars if not row.layer.own_axes for name in row.members}
    sections = []
    for kind in ("deck", "pier cap", "pier"):
        first = next((member for member in members if member.kind == kind and member.name in with_bars), None)
        if first is None:
            continue
        prefix = first.name.removesuffix("deck")
        girders = [m for m in members if kind == "deck" and m.kind == "girder" and m.name.startswith(f"{prefix}girder")]
        sections.append(MemberSection(first.name, _AXIS_OF_KIND[kind], (first, *girders)))
    return sections


def draw_sections(figure: FigureBase, sections: Sequence[MemberSection], schedule: Schedule) -> None:
    """Draw sections, the first one over the whole width, with bars as large as they are."""
    rows = 1 + (len(sections) > 1)
    grid = figure.add_gridspec(rows, max(len(sections) - 1, 1))
    for number, section in enumerate(sections):
        axes = figure.add_subplot(grid[0, :] if number == 0 else grid[1, number - 1])
        _draw(axes, section, schedule)


def _draw(axes: Axes, section: MemberSection, schedule: Schedule) -> None:
    right, up = _PLANES[section.axis]
    labels: list[tuple[float, str]] = []
    for member in section.members:
        rings = _outlines(member, section.axis, section.at_m)
        for ring in rings:
            colour = "white" if _is_hole(ring) else _CONCRETE
            axes.add_patch(Polygon(ring, facecolor=colour, edgecolor="black", linewidth=0.8))
        for row in (row for row in schedule.bars if member.name in row.members and _is_at(row, section)):
            if row.layer.axes[0] == section.axis:
                _draw_points(axes, bar_positions(row, member, section), row)
            elif row.layer.axes[1] != section.axis:
                _draw_line(axes, row, rings, (right, up), member)
            if member in section.members[:2]:
                labels.append((_label_height(row, member, up), _label(row)))
    axes.set_aspect("equal", adjustable="datalim")
    axes.autoscale_view()
    at = Text(", {} = {}", _SHORT[section.axis], Quantity(section.at_m, "m", ".2f"))
    axes.set_title(plain(section.title + at), fontsize=_LETTERS_PT + 1.5)
    axes.tick_params(labelsize=_LETTERS_PT)
    axes.set_ylabel(_NAMES[up], fontsize=_LETTERS_PT)
    lines = [_NAMES[right], *(text for _, text in sorted(labels, key=lambda label: -label[0]))]
    axes.set_xlabel("\n".join(lines), fontsize=_LETTERS_PT)


def _is_at(row: ScheduledBars, section: MemberSection) -> bool:
    """Return whether bars that cross the plane of a section go as far as it."""
    begin, end = row.layer.ends_m
    return row.layer.axes[0] != section.axis or begin <= section.at_m <= end


def _label(row: ScheduledBars) -> str:
    return Text("{}: {}", row.where, row.bars_text if row.choice else f"{row.layer.area_mm2:.0f} mm²")


def _label_height(row: ScheduledBars, member: Member, up: int) -> float:
    """Return the height of a layer in the drawing; the middle of the member for layers that stand in it."""
    lowest, highest = _ends(member, up)
    return row.layer.level_m(lowest, highest) if row.layer.axes[1] == up else 0.5 * (lowest + highest)


def _ends(member: Member, axis: int) -> tuple[float, float]:
    """Return from where to where a member goes along an axis, without skew."""
    ends = member.without_skew(member.solid.vertices)[:, axis]
    return float(ends.min()), float(ends.max())


def _outlines(member: Member, axis: int, at_m: float) -> list[np.ndarray]:
    """Return the outlines (k, 2) of a member without skew in a plane across an axis, outer ones first."""
    order = [(axis + 1) % 3, (axis + 2) % 3, axis]
    vertices = member.without_skew(member.solid.vertices)[:, order]
    turned = TriangleMesh(np.ascontiguousarray(vertices), member.solid.triangles)
    rings = outlines(to_manifold(turned, member.name).slice(at_m))
    right, _ = _PLANES[axis]
    # Reversed together with their corners, outlines stay counter-clockwise, and holes clockwise.
    in_plane = [ring if order[0] == right else ring[::-1, ::-1] for ring in rings]
    return sorted(in_plane, key=lambda ring: -abs(_area(ring)))


def _area(ring: np.ndarray) -> float:
    x, y = ring.T
    return 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))


def _is_hole(ring: np.ndarray) -> bool:
    return _area(ring) < 0.0


def bar_positions(row: ScheduledBars, member: Member, section: MemberSection) -> np.ndarray:
    """Return where the bars of a layer that crosses a section are in it, (k, 2), m; none without a choice of bars."""
    if row.choice is None:
        return np.zeros((0, 2))
    _, across, beside = row.layer.axes
    level = row.layer.level_m(*_ends(member, across))
    right, up = _PLANES[section.axis]
    rings = _outlines(member, section.axis, section.at_m)
    low, high = _extent(rings, level, 0 if across == right else 1)
    in_row = -(-row.choice.number // row.choice.rows)
    step = row.choice.diameter_m + clear_m(row.choice.diameter_m)
    positions, left = [], row.choice.number
    for number in range(row.choice.rows):
        count = min(in_row, left)
        left -= count
        half = 0.5 * (count - 1) * (0.0 if np.isnan(row.choice.spacing_m) else row.choice.spacing_m)
        spread = 0.5 * (low + high) + np.linspace(-half, half, count)
        depth = level + (number - 0.5 * (row.choice.rows - 1)) * step
        columns = (spread, np.full(count, depth)) if beside == right else (np.full(count, depth), spread)
        positions.append(np.column_stack(columns))
    assert {across, beside} == {right, up}
    return np.concatenate(positions)


def _extent(rings: Sequence[np.ndarray], level: float, across: int) -> tuple[float, float]:
    """Return from where to where outlines are crossed by a line at a level of one of the axes of the drawing."""
    ends = list(_crossings(rings, level, across))
    return (min(ends), max(ends)) if ends else (0.0, 0.0)


def _crossings(rings: Sequence[np.ndarray], level: float, across: int) -> Iterator[float]:
    for ring in rings:
        for start, end in zip(ring, np.roll(ring, -1, axis=0), strict=True):
            before, after = start[across] - level, end[across] - level
            if (before > 0.0) != (after > 0.0):
                share = before / (before - after)
                yield float(start[1 - across] + share * (end[1 - across] - start[1 - across]))


def _draw_points(axes: Axes, positions: np.ndarray, row: ScheduledBars) -> None:
    if row.choice is None or not len(positions):
        return
    sizes = np.full(len(positions), row.choice.diameter_m)
    axes.add_collection(
        EllipseCollection(
            sizes,
            sizes,
            np.zeros(len(positions)),
            units="xy",
            offsets=positions,
            offset_transform=axes.transData,
            facecolors=_BARS,
            edgecolors=_BARS,
            linewidths=0.8,
        )
    )


def _draw_line(
    axes: Axes, row: ScheduledBars, rings: Sequence[np.ndarray], plane: tuple[int, int], member: Member
) -> None:
    """Draw a layer whose bars run in the plane of the section."""
    _, across, _ = row.layer.axes
    level = row.layer.level_m(*_ends(member, across))
    is_upwards = across == plane[1]
    low, high = _extent(rings, level, 1 if is_upwards else 0)
    line = [(low, level), (high, level)] if is_upwards else [(level, low), (level, high)]
    axes.add_collection(LineCollection([line], colors=_ACROSS, linewidths=1.0))
