"""An arch as solids: its ribs, and the thrust blocks that they spring from."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...engineering.geometry.arches import RoadProfile, across_road
from ..scenario import Bridge
from ..scenario.arch import ARCH_KIND, BLOCK_KIND
from ..scenario.bridge_axes import arch_axis, axes_on_arch_m, rib_axes_m, springing_axes_m
from ..schema import given
from .ground import GroundHeight, foot_m
from .member import Member


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
    foot = foot_m(name, axis, 0.0, float(underside), ground)
    outside = inside - arch.block_length_m if number == 0 else inside + arch.block_length_m
    corners = [(outside, foot), (inside, foot), (inside, underside), (top_x, top), (outside, top)]
    width = rib_axes_m(bridge)[-1] - rib_axes_m(bridge)[0] + arch.width_m
    return Member(name, BLOCK_KIND, across_road(np.array(corners if number == 0 else corners[::-1]), width))
