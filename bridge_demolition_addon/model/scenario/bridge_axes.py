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


def axes_on_arch_m(bridge: Bridge) -> list[float]:
    """Return the positions along the road of the piers that stand on the arch."""
    arch, axes = given(bridge.arch), axes_m(bridge)
    return axes[arch.from_support : arch.last_support(len(axes)) - 1]


def springing_axes_m(bridge: Bridge) -> tuple[float, float]:
    """Return the positions along the road of the piers on the thrust blocks of the arch."""
    arch, axes = given(bridge.arch), axes_m(bridge)
    return axes[arch.from_support - 1], axes[arch.last_support(len(axes)) - 1]
