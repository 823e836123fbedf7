"""Punching of decks by a ball: the least and the most of what they resist, with their lower bars."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ...engineering.reinforced_concrete.resistance import punching_n
from ..bridge.member import Member
from ..materials import BarLayer
from .member_layers import LayersOfMember, layers_of_members

_UP = 2


@dataclass(frozen=True, slots=True)
class Punching:
    """Forces that punch a deck: on a point, and on a circle as large as the ball."""

    member: str
    depth_m: float
    ratio: float
    on_point_n: float
    on_ball_n: float


def punching_of_decks(
    layers: Sequence[BarLayer], members: Sequence[Member], strength_pa: float, ball_m: float
) -> Iterator[Punching]:
    """Yield what punches each deck that has lower bars both ways, by a ball of a diameter.

    The depth is the mean of both ways (EN 1992-1-1:2004, 6.4.2 (1)), and each way has its fewest bars.
    """
    groups = [group for group in layers_of_members(layers, members) if group.axes[1] == _UP]
    for index, member in enumerate(members):
        own = [lower for group in groups if group.member == index and (lower := _lower_bars(group))]
        ways = [[lower for lower in own if lower.axis == axis] for axis in (0, 1)]
        if member.kind != "deck" or not all(ways):
            continue
        fewest = [min(bars, key=lambda lower: lower.ratio) for bars in ways]
        depth_m = 0.5 * math.fsum(lower.depth_m for lower in fewest)
        ratio = math.sqrt(fewest[0].ratio * fewest[1].ratio)
        on_point_n, on_ball_n = (punching_n(depth_m, loaded_m, ratio, strength_pa) for loaded_m in (0.0, ball_m))
        yield Punching(member.name, depth_m, ratio, on_point_n, on_ball_n)


@dataclass(frozen=True, slots=True)
class _LowerBars:
    axis: int  # along the bars
    depth_m: float  # of their middle, below the top
    ratio: float


def _lower_bars(group: LayersOfMember) -> _LowerBars | None:
    """Return the bars in the lower half of a member together."""
    columns = zip(group.layers, group.levels_m, group.widths_m, strict=True)
    lower = [
        (layer.area_m2 / width, group.highest - level)
        for layer, level, width in columns
        if 2.0 * level < group.lowest + group.highest
    ]
    if not lower:
        return None
    area_m = math.fsum(area for area, _ in lower)
    depth_m = math.fsum(area * depth for area, depth in lower) / area_m
    return _LowerBars(group.axes[0], depth_m, area_m / depth_m)
