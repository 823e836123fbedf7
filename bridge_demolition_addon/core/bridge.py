"""The bridge as solids: deck, pier columns and pier caps, placed on the ground.

x runs along the road from the axis of the first pier, y across it from its middle, z up from the ground.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import trimesh

from .scenario import Bridge
from .solids import box


@dataclass(frozen=True, slots=True)
class Member:
    """A structural member: its name, its kind (``deck``, ``pier cap`` or ``pier``) and its closed solid."""

    name: str
    kind: str
    solid: trimesh.Trimesh

    @property
    def volume_m3(self) -> float:
        """Volume of the solid, m³."""
        return float(self.solid.volume)


def pier_axes(bridge: Bridge) -> np.ndarray:
    """Positions of the pier axes along the road, (spans + 1,) in m."""
    return np.concatenate(([0.0], np.cumsum(bridge.span_lengths_m)))


def deck_underside(bridge: Bridge) -> float:
    """Height of the deck's underside above the ground, m."""
    cap_height = bridge.pier_caps.height_m if bridge.pier_caps else 0.0
    return bridge.piers.height_m + cap_height


def deck_top(bridge: Bridge) -> float:
    """Height of the road surface above the ground, m."""
    return deck_underside(bridge) + bridge.deck.thickness_m


def bridge_members(bridge: Bridge) -> tuple[Member, ...]:
    """Solids of all members, touching without overlap: the deck, then each pier's cap and columns."""
    members = [_deck(bridge)]
    for number, axis in enumerate(pier_axes(bridge), start=1):
        if bridge.pier_caps:
            members.append(_pier_cap(bridge, number, axis))
        members += _columns(bridge, number, axis)
    return tuple(members)


def bridge_density(bridge: Bridge, members: tuple[Member, ...]) -> float:
    """Density, kg/m³: as given, or the one that spreads the given total mass evenly over all members."""
    if bridge.density_kg_m3 is not None:
        return bridge.density_kg_m3
    return bridge.mass_kg / sum(member.volume_m3 for member in members)


def _deck(bridge: Bridge) -> Member:
    deck = bridge.deck
    middle = (bridge.spans_m / 2.0, 0.0, deck_underside(bridge) + deck.thickness_m / 2.0)
    return Member("deck", "deck", box((bridge.length_m, deck.width_m, deck.thickness_m), middle))


def _pier_cap(bridge: Bridge, number: int, axis: float) -> Member:
    cap = bridge.pier_caps
    middle = (axis, 0.0, bridge.piers.height_m + cap.height_m / 2.0)
    return Member(f"pier {number} cap", "pier cap", box((cap.length_m, cap.width_m, cap.height_m), middle))


def _columns(bridge: Bridge, number: int, axis: float) -> list[Member]:
    """Columns of one pier, each in the middle of its share of the width that they carry."""
    piers = bridge.piers
    carried = bridge.pier_caps or bridge.deck
    size = (piers.column_length_m, piers.column_width_m, piers.height_m)
    members = []
    for column in range(piers.columns):
        across = carried.width_m * ((column + 0.5) / piers.columns - 0.5)
        name = f"pier {number}" if piers.columns == 1 else f"pier {number} column {column + 1}"
        members.append(Member(name, "pier", box(size, (axis, across, piers.height_m / 2.0))))
    return members
