"""What carries the deck as solids: piers, pier caps and abutments."""

from __future__ import annotations

from ..geometry.mesh import TriangleMesh
from ..geometry.solids import box
from ..scenario import Bridge
from .layout import deck_underside, pier_axes, skewed, turned_with_axis
from .member import Member


def substructure(bridge: Bridge) -> list[Member]:
    """Every abutment, pier cap, column and wall; piers are numbered along the road."""
    axes = pier_axes(bridge)
    if bridge.abutments is None:
        return _piers(bridge, axes)
    return [*_abutments(bridge, (axes[0], axes[-1])), *_piers(bridge, axes[1:-1])]


def _abutments(bridge: Bridge, axes: tuple[float, float]) -> list[Member]:
    abutments, height = bridge.abutments, deck_underside(bridge)
    size = (abutments.length_m, abutments.width_m, height)
    return [
        Member(f"abutment {number}", "abutment", skewed(bridge, box(size, (axis, 0.0, height / 2.0))))
        for number, axis in enumerate(axes, start=1)
    ]


def _piers(bridge: Bridge, axes: list[float]) -> list[Member]:
    parts = []
    for number, axis in enumerate(axes, start=1):
        if bridge.pier_caps:
            parts.append(Member(f"pier {number} cap", "pier cap", _pier_cap(bridge, axis)))
        parts += _columns(bridge, number, axis)
    return parts


def _pier_cap(bridge: Bridge, axis: float) -> TriangleMesh:
    cap = bridge.pier_caps
    middle = (axis, 0.0, bridge.piers.height_m + cap.height_m / 2.0)
    return skewed(bridge, box((cap.length_m, cap.width_m, cap.height_m), middle))


def _columns(bridge: Bridge, number: int, axis: float) -> list[Member]:
    """Columns of one pier, each in the middle of its share of the width that they carry, or its wall."""
    piers = bridge.piers
    size = (piers.column_length_m, piers.column_width_m, piers.height_m)
    parts = []
    for column in range(piers.columns):
        across = bridge.carried_width_m * ((column + 0.5) / piers.columns - 0.5)
        name = f"pier {number}" if piers.columns == 1 else f"pier {number} column {column + 1}"
        upright = box(size, (axis, across, piers.height_m / 2.0))
        is_wall = piers.kind == "wall"
        solid = skewed(bridge, upright) if is_wall else turned_with_axis(bridge, upright, axis, across)
        parts.append(Member(name, "pier", solid))
    return parts
