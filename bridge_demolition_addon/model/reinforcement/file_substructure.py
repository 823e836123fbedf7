"""Bars of members from files that carry decks, or stand next to them: caps, columns, walls, footings and the rest."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...engineering.reinforced_concrete.influence_lines import MovingLoad, extreme_effects, influence_lines
from ...engineering.reinforced_concrete.least_areas import LARGEST_SHARE, level_of_wall_m2, upright_of_wall_m2
from ...engineering.reinforced_concrete.materials import PERMANENT_FACTOR, VARIABLE_FACTOR
from ...engineering.reinforced_concrete.resistance import ColumnSection, design_moment_nm
from ..bridge.member import own_axes
from .design_basis import LEAST, beam_effects, column_loads
from .file_decks import FileDeckLine, beam_rows
from .file_members import LEAST_RATIO, FileDesign, LyingSection, Rows, in_own_axes, spread_rows
from .load_paths import carriers_of, spans
from .substructure import ColumnSize, column_bars

_WALL = 4.0
"""Length of the section of a wall by its thickness, from which on it is no column: EN 1992-1-1:2004, 9.6.1 (1)."""

_FREE_TOP, _HELD_TOP = 2.0, 1.0
"""Buckling length by the height: EN 1992-1-1:2004, figure 5.7 b and a."""

_ON_GROUND = ("footing", "abutment", "approach slab", "wing wall")

NOT_REINFORCED = ("fill",)
"""Kinds of members of which nothing is designed."""


@dataclass(slots=True)
class CarriedLoad:
    """Vertical loads on a member, without factors."""

    permanent_n: float = 0.0
    traffic_n: float = 0.0


def loads_of_carriers(basis: FileDesign, lines: Sequence[FileDeckLine]) -> dict[int, CarriedLoad]:
    """Return the loads on what carries decks, and on what carries that, down to footings and abutments.

    What several members carry together they share evenly; of the traffic each has twice that, as it may stand off the
    axis of the road.
    """
    loads: dict[int, CarriedLoad] = {}
    for line in lines:
        own = beam_effects(line.lines, line.permanent_n_m, ()).permanent_reactions_n
        _, traffic = extreme_effects(line.lines.points_m, line.lines.reactions, line.moving)
        for support, permanent_n, traffic_n in zip(line.part.supports, own, traffic, strict=True):
            _add(loads, support.carriers, float(permanent_n), float(traffic_n))
    waiting = sorted(loads, key=lambda index: -float(basis.members[index].solid.bounds[1, 2]))
    done: set[int] = set()
    while waiting:
        index = waiting.pop(0)
        if index in done or basis.members[index].kind in _ON_GROUND:
            continue
        done.add(index)
        below = tuple(dict.fromkeys(contact.below for contact in carriers_of(index, basis.contacts)))
        if below:
            load = loads[index]
            _add(loads, below, load.permanent_n + basis.weight_n([index]), load.traffic_n)
            waiting += [other for other in below if other not in done]
    return loads


def _add(loads: dict[int, CarriedLoad], carriers: Sequence[int], permanent_n: float, traffic_n: float) -> None:
    for carrier in carriers:
        load = loads.setdefault(carrier, CarriedLoad())
        load.permanent_n += permanent_n / len(carriers)
        load.traffic_n += traffic_n * min(1.0, 2.0 / len(carriers))


def file_substructure_bars(basis: FileDesign, indices: Sequence[int], loads: dict[int, CarriedLoad]) -> Rows:
    """Yield the bars of members that span nothing."""
    for index in indices:
        member = basis.members[index]
        if member.kind in NOT_REINFORCED:
            continue
        if member.kind == "pier cap" or (spans(member) and index in loads):
            yield from basis.rows_or_least(index, in_own_axes(_cap(basis, index, loads.get(index, CarriedLoad()))))
        elif member.kind == "footing":
            yield from basis.rows_or_least(index, _footing(basis, index))
        elif member.kind == "pier" and not _is_wall(basis, index):
            yield from basis.rows_or_least(index, in_own_axes(_column(basis, index, loads.get(index, CarriedLoad()))))
        elif member.kind in ("pier", "wall", "abutment", "wing wall"):
            yield from _wall(basis, index, loads.get(index, CarriedLoad()))
        else:
            yield from spread_rows(basis.design, member, dict.fromkeys("xyz", LEAST_RATIO))


def _cap(basis: FileDesign, index: int, load: CarriedLoad) -> Rows:
    """Yield the bars of a beam over columns: loads of decks are spread evenly over it, traffic where it is worst."""
    member = basis.members[index]
    axes = own_axes(member)
    points = [contact.point_m for contact in carriers_of(index, basis.contacts)]
    stations = sorted(set(axes.from_world(np.array(points).reshape(-1, 3))[:, 0].tolist()))
    at = stations or [0.5 * axes.length_m]
    lines = influence_lines(at, min(0.0, at[0]), max(axes.length_m, at[-1]))
    permanent = (load.permanent_n + basis.weight_n([index])) / axes.length_m
    effects = beam_effects(lines, permanent, (MovingLoad(uniform_n_m=load.traffic_n / axes.length_m),))
    yield from beam_rows(basis, index, LyingSection.of(member), effects, at)


def _is_wall(basis: FileDesign, index: int) -> bool:
    axes = own_axes(basis.members[index])
    return axes.length_m > _WALL * axes.width_m


def _column(basis: FileDesign, index: int, load: CarriedLoad) -> Rows:
    """Yield the bars of a column, as of a rectangle of its area with the sides of its plan."""
    design, member = basis.design, basis.members[index]
    axes = own_axes(member)
    share = float(np.sqrt(member.volume_m3 / (axes.length_m * axes.width_m * axes.height_m)))
    size = ColumnSize(share * axes.length_m, share * axes.width_m, axes.height_m)
    axial = PERMANENT_FACTOR * (load.permanent_n + design.weight_n(member)) + VARIABLE_FACTOR * load.traffic_n
    buckling = _HELD_TOP * axes.height_m
    rows = basis.as_much_as_fits(
        member.name,
        "the axial force",
        axial,
        lambda axial_n: list(column_bars(design, [member.name], size, axial_n, (buckling, buckling))),
    )
    yield from rows


def _wall(basis: FileDesign, index: int, load: CarriedLoad) -> Rows:
    """Yield the bars of a wall, both faces together: upright, and level both ways."""
    design, member = basis.design, basis.members[index]
    axes = own_axes(member)
    low, high = member.solid.bounds
    height = float(high[2] - low[2])
    section_m2 = member.volume_m3 / height
    thickness = min(axes.width_m, axes.length_m)
    upright, reason = upright_of_wall_m2(section_m2), LEAST
    axial = PERMANENT_FACTOR * (load.permanent_n + design.weight_n(member)) + VARIABLE_FACTOR * load.traffic_n
    if member.kind == "pier" and axial:
        to_axis = design.rule.cover_m + design.secondary_m + 0.5 * design.bar_m
        shape = ColumnSection(thickness, section_m2 / thickness, to_axis, design.concrete, design.design_yield_pa)
        moment = design_moment_nm(axial, shape, _FREE_TOP * height)
        needed = shape.bars_m2(axial, moment)
        if not np.isfinite(needed):
            needed = LARGEST_SHARE * section_m2
            basis.note(member.name, f"does not carry an axial force of {axial / 1e3:.0f} kN with any bars")
        if needed > upright:
            upright, reason = needed, column_loads(axial, moment)
    level = level_of_wall_m2(upright / section_m2 * thickness, thickness) / thickness
    yield from spread_rows(design, member, {"z": upright / section_m2}, reason)
    yield from spread_rows(design, member, {"x": level, "y": level})


def _footing(basis: FileDesign, index: int) -> Rows:
    """Yield the bars at the bottom of a footing both ways."""
    design, member = basis.design, basis.members[index]
    length, width, height = np.ptp(member.solid.vertices, axis=0).tolist()
    outside = design.rule.cover_m
    for along, size, other in (("x", length, width), ("y", width, length)):
        least = design.of_beam_m2(other, height - outside)
        found = design.least_bars(member.name, height, other, least, outside, LEAST)
        yield design.scheduled(
            [member.name], member.kind, "bottom", along, found, section_m2=height * other, length_m=size
        )
        outside = found.depth_m + 0.5 * found.choice.diameter_m
