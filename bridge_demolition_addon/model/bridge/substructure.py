"""What carries the deck as solids: piers, pier caps and abutments."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.solids import box
from ...errors import GeometryError
from ..scenario import Bridge
from ..scenario.bridge import Abutments, PierCaps
from ..schema import given
from .layout import deck_underside, pier_axes, skewed, turned_with_axis, without_shear, without_turn
from .member import Member

GroundHeight = Callable[[str, float, float], float]
"""How high the ground is, m, under a member of a name with its middle at x and y."""

_SHORTEST_M = 0.1
"""Least height of what stands on the ground."""


def level_ground(_name: str, _x_m: float, _y_m: float) -> float:
    """Height of ground that is flat, m."""
    return 0.0


def substructure(bridge: Bridge, ground: GroundHeight = level_ground) -> list[Member]:
    """Return every abutment, pier cap, column and wall, down to the ground under their middles.

    Piers are numbered along the road.
    """
    axes = pier_axes(bridge)
    if bridge.abutments is None:
        return _piers(bridge, axes, ground)
    ends = _abutments(bridge, bridge.abutments, (axes[0], axes[-1]), ground)
    return [*ends, *_piers(bridge, axes[1:-1], ground)]


def _abutments(bridge: Bridge, abutments: Abutments, axes: tuple[float, float], ground: GroundHeight) -> list[Member]:
    top, parts = deck_underside(bridge), []
    for number, axis in enumerate(axes, start=1):
        name = f"abutment {number}"
        foot = _foot(name, axis, 0.0, top, ground)
        size = (abutments.length_m, abutments.width_m, top - foot)
        solid = skewed(bridge, box(size, (axis, 0.0, (top + foot) / 2.0)))
        parts.append(Member(name, "abutment", solid, unskewed=without_shear(bridge)))
    return parts


def _foot(name: str, x_m: float, y_m: float, top_m: float, ground: GroundHeight) -> float:
    """Height of the ground under a member, m."""
    foot = ground(name, x_m, y_m)
    if foot > max(top_m - _SHORTEST_M, 0.0):  # on level ground the keys say how high a pier has to be
        raise GeometryError(
            f"The ground is at {foot:.2f} m under {name}, whose top is at {top_m:.2f} m; make the bridge higher, or "
            "give ground.origin another height."
        )
    return foot


def _piers(bridge: Bridge, axes: np.ndarray, ground: GroundHeight) -> list[Member]:
    parts = []
    for number, axis in enumerate(axes, start=1):
        if bridge.pier_caps:
            cap = _pier_cap(bridge, bridge.pier_caps, axis)
            parts.append(Member(f"pier {number} cap", "pier cap", cap, unskewed=without_shear(bridge)))
        parts += _columns(bridge, number, axis, ground)
    return parts


def _pier_cap(bridge: Bridge, cap: PierCaps, axis: float) -> TriangleMesh:
    middle = (axis, 0.0, given(bridge.piers).height_m + cap.height_m / 2.0)
    return skewed(bridge, box((cap.length_m, cap.width_m, cap.height_m), middle))


def _columns(bridge: Bridge, number: int, axis: float, ground: GroundHeight) -> list[Member]:
    """Columns of one pier, each in the middle of its share of the width that they carry, or its wall."""
    piers = given(bridge.piers)
    parts = []
    for column in range(piers.columns):
        across = bridge.carried_width_m * ((column + 0.5) / piers.columns - 0.5)
        name = f"pier {number}" if piers.columns == 1 else f"pier {number} column {column + 1}"
        foot = _foot(name, axis + across * bridge.shift_across, across, piers.height_m, ground)
        size = (piers.column_length_m, piers.column_width_m, piers.height_m - foot)
        upright = box(size, (axis, across, (piers.height_m + foot) / 2.0))
        is_wall = piers.kind == "wall"
        solid = skewed(bridge, upright) if is_wall else turned_with_axis(bridge, upright, axis, across)
        unskewed = without_shear(bridge) if is_wall else without_turn(bridge)
        parts.append(Member(name, "pier", solid, unskewed=unskewed))
    return parts
