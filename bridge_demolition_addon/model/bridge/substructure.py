"""What carries the deck as solids: piers, pier caps, abutments, an arch, legs of a frame."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...engineering.geometry.arches import across_road
from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.solids import box, round_column
from ..scenario import Bridge
from ..scenario.bridge_parts import Abutments, PierCaps
from ..schema import given
from .arch import above_arch, arch_members
from .frame import frame_legs
from .ground import GroundHeight, foot_m, level_ground
from .layout import deck_underside, pier_axes, skewed, turned_with_axis, without_shear, without_turn
from .member import Member


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
    top, parts = deck_underside(bridge), []
    for number, axis in enumerate(axes, start=1):
        name = f"abutment {number}"
        foot = foot_m(name, axis, 0.0, top, ground)
        size = (abutments.length_m, abutments.width_m, top - foot)
        solid = skewed(bridge, box(size, (axis, 0.0, (top + foot) / 2.0)))
        parts.append(Member(name, "abutment", solid, unskewed=without_shear(bridge)))
    return parts


def _piers(bridge: Bridge, axes: np.ndarray, ground: GroundHeight) -> list[Member]:
    parts = []
    for number, axis in enumerate(axes, start=1):
        if bridge.pier_caps:
            cap = _pier_cap(bridge, bridge.pier_caps, axis)
            parts.append(Member(f"pier {number} cap", "pier cap", cap, unskewed=without_shear(bridge)))
        parts += _columns(bridge, number, axis, ground)
    return parts


def _pier_cap(bridge: Bridge, cap: PierCaps, axis: float) -> TriangleMesh:
    piers = given(bridge.piers)
    if cap.end_height_m is None:
        middle = (axis, 0.0, piers.height_m + cap.height_m / 2.0)
        return skewed(bridge, box((cap.length_m, cap.width_m, cap.height_m), middle))
    half, foot, top = 0.5 * cap.width_m, piers.height_m, piers.height_m + cap.height_m
    level, end = bridge.columns_half_width_m, top - cap.end_height_m
    outline = [(-level, foot), (level, foot), (half, end), (half, top), (-half, top), (-half, end)]
    along = across_road(np.array(outline), cap.length_m)
    # Turned by a right angle: what ran along the road runs across it.
    turned = along.vertices[:, [1, 0, 2]] * (-1.0, 1.0, 1.0) + (axis, 0.0, 0.0)
    return skewed(bridge, replace(along, vertices=turned))


def _columns(bridge: Bridge, number: int, axis: float, ground: GroundHeight) -> list[Member]:
    """Columns of one pier, each in the middle of its share of the width that they carry, or its wall."""
    piers = given(bridge.piers)
    parts = []
    for column in range(piers.columns):
        across = bridge.carried_width_m * ((column + 0.5) / piers.columns - 0.5)
        name = f"pier {number}" if piers.columns == 1 else f"pier {number} column {column + 1}"
        foot = foot_m(name, axis + across * bridge.shift_across, across, piers.height_m, ground)
        size = (piers.column_length_m, piers.column_width_m, piers.height_m - foot)
        middle = (axis, across, (piers.height_m + foot) / 2.0)
        upright = round_column(size[0], size[2], middle) if piers.is_round else box(size, middle)
        solid = skewed(bridge, upright) if piers.is_wall else turned_with_axis(bridge, upright, axis, across)
        unskewed = without_shear(bridge) if piers.is_wall else without_turn(bridge)
        parts.append(Member(name, "pier", solid, unskewed=unskewed))
    return parts
