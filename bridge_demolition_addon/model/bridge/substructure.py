"""What carries the deck as solids: piers, pier caps, abutments, an arch, legs of a frame."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ...engineering.arithmetic import cosine
from ...engineering.geometry.arches import RoadProfile, across_road
from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.solids import box, round_column
from ...engineering.geometry.vectors import transformed, unit
from ..scenario import Bridge
from ..scenario.arch import ARCH_KIND, BLOCK_KIND
from ..scenario.bridge_checks import (
    arch_axis,
    axes_on_arch_m,
    axis_line,
    deck_top,
    deck_underside,
    leg_axes_m,
    lower_by_m,
    rib_axes_m,
    springing_axes_m,
)
from ..scenario.bridge_parts import Abutments, PierCaps, Piers
from ..schema import given
from .layout import (
    GroundHeight,
    foot_m,
    level_ground,
    pier_axes,
    seat_m,
    seated,
    skewed,
    turned_with_axis,
    without_shear,
    without_turn,
)
from .member import Member, Rows, Taper

LEG = "leg"


def frame_legs(bridge: Bridge, ground: GroundHeight) -> list[Member]:
    """Return every leg, down to the ground under the middle of its foot. They are numbered along the road."""
    frame, axes = given(bridge.frame), leg_axes_m(bridge)
    members = []
    for number, (axis, lean) in enumerate(zip(axes, frame.leans_m(len(axes)), strict=True), start=1):
        for leg in range(frame.legs):
            name = f"leg {number}" if frame.legs == 1 else f"leg {number}.{leg + 1}"
            across = bridge.deck.width_m * ((leg + 0.5) / frame.legs - 0.5)
            members.append(_leg(bridge, name, (axis, across), lean, ground))
    return members


def deck_profile(bridge: Bridge, begin_m: float, end_m: float) -> RoadProfile:
    """Return the deck with its haunches between its ends along the road."""
    frame = given(bridge.frame)
    half = 0.5 * frame.leg_thickness_m
    away = half + frame.haunch_length_m
    corners = [
        (axis + side, frame.clear_height_m - (frame.haunch_depth_m if abs(side) == half else 0.0))
        for axis in leg_axes_m(bridge)
        for side in (-away, -half, half, away)
    ]
    along, heights = (np.array(column) for column in zip(*corners, strict=True))
    inside = (along > begin_m) & (along < end_m)
    x = np.concatenate(([begin_m], along[inside], [end_m]))
    undersides = np.interp(x, along, heights)
    return RoadProfile(np.column_stack((x, undersides)), np.column_stack((x, np.full(len(x), deck_top(bridge)))))


def _leg(bridge: Bridge, name: str, top_m: tuple[float, float], lean_m: float, ground: GroundHeight) -> Member:
    frame, (axis, across) = given(bridge.frame), top_m
    half, top = 0.5 * frame.leg_thickness_m, frame.leg_top_m
    foot = foot_m(name, (axis + lean_m, across, top), ground)
    at_foot = axis + lean_m
    corners = [(at_foot - half, foot), (at_foot + half, foot), (axis + half, top), (axis - half, top)]
    solid = across_road(np.array(corners), frame.leg_width_m, across)
    if lean_m == 0.0:
        return Member(name, LEG, solid)
    along, up = unit(np.array([-lean_m, top - foot])).tolist()
    return Member(name, LEG, solid, parts=(solid,), directions=((along, up),))


def arch_members(bridge: Bridge, ground: GroundHeight) -> list[Member]:
    """Return the ribs, whose straight pieces are their convex parts, and the thrust blocks on the ground."""
    profile = arch_axis(bridge).profile(axes_on_arch_m(bridge), given(bridge.piers).column_length_m)
    ends = np.stack((profile.undersides_m, profile.tops_m))[:, [0, -1]]
    blocks = (_thrust_block(bridge, number, ends[:, number], ground) for number in range(2))
    return [*_ribs(bridge, profile), *blocks]


def above_arch(bridge: Bridge, ground: GroundHeight) -> GroundHeight:
    """Return the height of what piers and abutments stand on: the arch, its thrust blocks, else the ground."""
    if bridge.arch is None:
        return ground
    axis, length = arch_axis(bridge), given(bridge.piers).column_length_m
    seats = {position: axis.seat_m(position, length) for position in axes_on_arch_m(bridge)}
    block_top = float(axis.points_m(np.array([axis.begin_m]), 1.0)[0, 1])
    levels = seats | dict.fromkeys(springing_axes_m(bridge), block_top)
    return lambda name, x_m, y_m: levels[x_m] if x_m in levels else ground(name, x_m, y_m)


def _ribs(bridge: Bridge, profile: RoadProfile) -> Iterator[Member]:
    arch = given(bridge.arch)
    directions = tuple((along, up) for along, up in profile.directions.tolist())
    for number, across in enumerate(rib_axes_m(bridge), start=1):
        yield Member(
            ARCH_KIND if arch.ribs == 1 else f"{ARCH_KIND} rib {number}",
            ARCH_KIND,
            profile.solid(arch.width_m, across),
            parts=profile.pieces(arch.width_m, across),
            is_in_pieces=True,
            directions=directions,
        )


def _thrust_block(bridge: Bridge, number: int, section_m: np.ndarray, ground: GroundHeight) -> Member:
    """Return the block behind the first or the last section of the arch, its underside and top (2, 2)."""
    arch, axis, name = given(bridge.arch), springing_axes_m(bridge)[number], f"{BLOCK_KIND} {number + 1}"
    (inside, underside), (top_x, top) = section_m
    foot = foot_m(name, (axis, 0.0, float(underside)), ground)
    outside = inside - arch.block_length_m if number == 0 else inside + arch.block_length_m
    corners = [(outside, foot), (inside, foot), (inside, underside), (top_x, top), (outside, top)]
    width = rib_axes_m(bridge)[-1] - rib_axes_m(bridge)[0] + arch.width_m
    return Member(name, BLOCK_KIND, across_road(np.array(corners if number == 0 else corners[::-1]), width))


def substructure(bridge: Bridge, ground: GroundHeight = level_ground) -> list[Member]:
    """Return every abutment, pier cap, column and wall, and an arch, down to the ground under their middles.

    Piers are numbered along the road. Those over an arch stand on it.
    """
    axes, below = pier_axes(bridge), above_arch(bridge, ground)
    if bridge.frame:
        ends = _abutments(bridge, bridge.abutments, (axes[0], axes[-1]), ground) if bridge.abutments else []
        return [*ends, *frame_legs(bridge, ground)]
    arch = arch_members(bridge, ground) if bridge.arch else []
    if bridge.abutments is None:
        return [*arch, *_piers(bridge, axes, below)]
    ends = _abutments(bridge, bridge.abutments, (axes[0], axes[-1]), below)
    return [*ends, *arch, *_piers(bridge, axes[1:-1], below)]


def _abutments(bridge: Bridge, abutments: Abutments, axes: tuple[float, float], ground: GroundHeight) -> list[Member]:
    parts = []
    for number, axis in enumerate(axes, start=1):
        name, top = f"abutment {number}", deck_underside(bridge) - lower_by_m(bridge, axis)
        seat = seat_m(bridge, axis, 0.0, top)
        foot = foot_m(name, seat, ground, is_level=bridge.alignment is None)
        low = foot + (top - seat[2])
        size = (abutments.length_m, abutments.width_m, top - low)
        solid = skewed(bridge, box(size, (axis, 0.0, (top + low) / 2.0)))
        own = without_shear(bridge, axis)
        parts.append(Member(name, "abutment", seated(bridge, axis, solid, foot), unskewed=own))
    return parts


def _piers(bridge: Bridge, axes: np.ndarray, ground: GroundHeight) -> list[Member]:
    parts = []
    for number, axis in enumerate(axes, start=1):
        if bridge.pier_caps:
            cap = _pier_cap(bridge, bridge.pier_caps, number, axis)
            own, solid = without_shear(bridge, axis), seated(bridge, axis, cap)
            parts.append(Member(f"pier {number} cap", "pier cap", solid, unskewed=own, line=axis_line(bridge, axis)))
        parts += _columns(bridge, number, axis, ground)
    return parts


def _pier_cap(bridge: Bridge, cap: PierCaps, number: int, axis: float) -> TriangleMesh:
    foot = given(bridge.piers).height_m - lower_by_m(bridge, axis)
    if cap.end_height_m is None:
        middle = (axis, 0.0, foot + cap.height_m / 2.0)
        return skewed(bridge, box((cap.length_m, cap.width_m, cap.height_m), middle))
    half, top = 0.5 * cap.width_m, foot + cap.height_m
    level, end = bridge.columns_half_width_m(bridge.piers_of(number)), top - cap.end_height_m
    outline = [(-level, foot), (level, foot), (half, end), (half, top), (-half, top), (-half, end)]
    along = across_road(np.array(outline), cap.length_m)
    # Turned by a right angle: what ran along the road runs across it.
    turned = along.vertices[:, [1, 0, 2]] * (-1.0, 1.0, 1.0) + (axis, 0.0, 0.0)
    return skewed(bridge, replace(along, vertices=turned))


def _columns(bridge: Bridge, number: int, axis: float, ground: GroundHeight) -> list[Member]:
    """Columns of one pier, each in the middle of its share of the width that they carry, or its wall."""
    piers = bridge.piers_of(number)
    top, parts = piers.height_m - lower_by_m(bridge, axis), []
    for column in range(piers.columns):
        share = (column + 0.5) / piers.columns - 0.5
        across = bridge.carried_width_m * share
        outwards = _outwards_m(bridge, piers, share)
        name = f"pier {number}" if piers.columns == 1 else f"pier {number} column {column + 1}"
        seat = seat_m(bridge, axis, across, top)
        on_ground = (*seat_m(bridge, axis, across + outwards, top)[:2], seat[2]) if outwards else seat
        foot = foot_m(name, on_ground, ground, is_level=bridge.alignment is None)
        low = foot + (top - seat[2])
        size = (piers.column_length_m, piers.column_width_m, top - low)
        middle = (axis, across, (top + low) / 2.0)
        upright = round_column(size[0], size[2], middle) if piers.is_round else box(size, middle)
        unskewed = without_shear(bridge, axis) if piers.is_wall else without_turn(bridge, axis)
        taper = _taper(bridge, piers, outwards / size[2], (seat, unskewed))
        if taper:
            upright = replace(
                upright, vertices=replace(taper, middle_m=(axis, across), top_m=top).to_world(upright.vertices)
            )
        solid = skewed(bridge, upright) if piers.is_wall else turned_with_axis(bridge, upright, axis, across)
        parts.append(Member(name, "pier", seated(bridge, axis, solid, foot), unskewed=unskewed, taper=taper))
    return parts


def _outwards_m(bridge: Bridge, piers: Piers, share: float) -> float:
    """Return how far across the road the foot of a column is from its top, at a share of the width that is carried."""
    if piers.feet_apart_m is None:
        return 0.0
    apart = piers.feet_apart_m / (1.0 - 1.0 / piers.columns)
    return share * (apart - bridge.carried_width_m)


def _taper(bridge: Bridge, piers: Piers, lean: float, top: tuple[tuple[float, float, float], Rows]) -> Taper | None:
    """Return how a column leans and grows towards its foot, from its top and the rows without its turn."""
    if not (lean or piers.batter_percent):
        return None
    (x, y, height), rows = top
    along, across = transformed(np.array(rows), np.array([[x, y]]))[0].tolist()
    turned = lean if piers.is_wall else lean / float(cosine(math.radians(bridge.skew_deg)))
    return Taper((along, across), height, piers.column_length_m, 0.02 * piers.batter_percent, turned)
