"""Reinforcing bars as lines, where their layers say, before anything moves."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ..engineering.geometry.mesh import plane_cuts
from ..model.bridge.member import Member
from ..model.bridge.own_axes import own_axes
from ..model.materials.bar_layers import BarLayer
from ..model.schema import given

_BAR_MM2 = 314.0
"""Area of a bar of 20 mm: a layer has as many lines as it would have of these."""

_MOST_LINES = 40
_FEWEST_LINES = 2
_PARTS = 8
"""Straight parts of a bar that follows a curved member."""


def bar_lines(layers: Sequence[BarLayer], members: Sequence[Member]) -> np.ndarray:
    """Return the bars of layers in their members as lines (2 k, 3), m, spread evenly as bars of 20 mm, at most 40."""
    parts = [np.zeros((0, 3))]
    for member in members:
        for layer in layers:
            if not layer.is_spread and layer.is_in(member.name, member.kind):
                parts += _in_own_axes(layer, member) if layer.own_axes else _of_layer(layer, member)
    return np.concatenate(parts)


def _of_layer(layer: BarLayer, member: Member) -> Iterator[np.ndarray]:
    along, across, beside = layer.axes
    corners = member.without_skew(member.solid.corners)
    lowest, highest = float(corners[..., across].min()), float(corners[..., across].max())
    level = layer.level_m(lowest, highest)
    _, cuts = plane_cuts(corners, across, level)
    if not len(cuts):
        return
    low, high = float(cuts[..., beside].min()), float(cuts[..., beside].max())
    number = int(np.clip(round(given(layer.area_mm2) / _BAR_MM2), _FEWEST_LINES, _MOST_LINES))
    for position in low + (high - low) * (np.arange(number) + 0.5) / number:
        ends = _ends_at(cuts, along, beside, float(position))
        begin, end = max(min(ends), layer.ends_m[0]), min(max(ends), layer.ends_m[1])
        if begin < end:
            line = np.zeros((2, 3))
            line[:, along], line[:, across], line[:, beside] = (begin, end), level, position
            yield member.with_skew(line)


def _in_own_axes(layer: BarLayer, member: Member) -> Iterator[np.ndarray]:
    """Yield the lines of a layer that follows its member, in straight parts."""
    along, across, beside = layer.axes
    axes = own_axes(member)
    level = layer.level_m(*axes.ends_m(across))
    low, high = axes.ends_m(beside)
    if across == 2 and beside == 1:
        inside = 0.5 * ((high - low) - axes.width_at_m(level))
        low, high = low + inside, high - inside
    ends = axes.ends_m(along)
    begin, end = max(ends[0], layer.ends_m[0]), min(ends[1], layer.ends_m[1])
    number = int(np.clip(round(given(layer.area_mm2) / _BAR_MM2), _FEWEST_LINES, _MOST_LINES))
    for position in low + (high - low) * (np.arange(number) + 0.5) / number:
        points = np.zeros((_PARTS + 1, 3))
        points[:, along] = np.linspace(begin, end, _PARTS + 1)
        points[:, across], points[:, beside] = level, position
        line = axes.to_world(points)
        yield np.repeat(line, 2, axis=0)[1:-1]


def _ends_at(cuts: np.ndarray, along: int, beside: int, position: float) -> list[float]:
    """Return where a line along an axis, at a position beside it, crosses the sides (c, 2, 3) of a plane section."""
    first, second = cuts[:, 0], cuts[:, 1]
    before, after = first[:, beside] - position, second[:, beside] - position
    crossed = (before > 0.0) != (after > 0.0)
    share = before[crossed] / (before[crossed] - after[crossed])
    ends = first[crossed, along] + share * (second[crossed, along] - first[crossed, along])
    return ends.tolist() or [0.0]
