"""Where the supports of a bridge, the ribs of its arch and the legs of its frame are."""

from __future__ import annotations

from itertools import accumulate
from typing import TYPE_CHECKING

from ...engineering.geometry.arches import ArchAxis
from ..schema import given

if TYPE_CHECKING:
    from .bridge import Bridge


def axes_m(bridge: Bridge) -> list[float]:
    """Return the positions along the road of the axes of all supports, in the middle of the road."""
    return list(accumulate(bridge.span_lengths_m, initial=0.0))


def arch_axis(bridge: Bridge) -> ArchAxis:
    """Return the axis of the arch."""
    return given(bridge.arch).axis_between(*springing_axes_m(bridge))


def rib_axes_m(bridge: Bridge) -> list[float]:
    """Return the positions across the road of the ribs of the arch."""
    ribs = given(bridge.arch).ribs
    return [bridge.carried_width_m * ((rib + 0.5) / ribs - 0.5) for rib in range(ribs)]


def leg_axes_m(bridge: Bridge) -> list[float]:
    """Return the positions along the road of the legs of the frame, where they meet the deck."""
    return axes_m(bridge)[1:-1] if bridge.abutments else axes_m(bridge)


def upright_names(bridge: Bridge) -> list[list[str]]:
    """Return the names of the columns, walls or legs of each axis between the abutments, in their order."""
    if bridge.frame:
        count, kind, beside = len(leg_axes_m(bridge)), "leg", "."
        each = bridge.frame.legs
    elif bridge.piers:
        count, kind, beside = len(axes_m(bridge)) - (2 if bridge.abutments else 0), "pier", " column "
        each = bridge.piers.columns
    else:
        return []
    return [
        [f"{kind} {axis}"] if each == 1 else [f"{kind} {axis}{beside}{number}" for number in range(1, each + 1)]
        for axis in range(1, count + 1)
    ]


def axes_on_arch_m(bridge: Bridge) -> list[float]:
    """Return the positions along the road of the piers that stand on the arch."""
    arch, axes = given(bridge.arch), axes_m(bridge)
    return axes[arch.from_support : arch.last_support(len(axes)) - 1]


def springing_axes_m(bridge: Bridge) -> tuple[float, float]:
    """Return the positions along the road of the piers on the thrust blocks of the arch."""
    arch, axes = given(bridge.arch), axes_m(bridge)
    return axes[arch.from_support - 1], axes[arch.last_support(len(axes)) - 1]
