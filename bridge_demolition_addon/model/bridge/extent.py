"""The box around members, and how high they are at a position."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...engineering.geometry.vectors import cross_2d, length
from ...errors import GeometryError
from ..scenario import Scenario
from . import deck_top
from .member import Member

_DEBRIS_ROOM = 10.0
"""Ground to each side of the bridge, as a multiple of its height; debris of a felled bridge stays well inside."""

_ON_EDGE = 1e-9
"""How far outside a triangle, as a part of it, a position may lie and still be on it."""


def extent(members: Sequence[Member]) -> np.ndarray:
    """Return the lowest and the highest corner (2, 3), m, of the box around all members."""
    boxes = np.array([member.solid.bounds for member in members])
    return np.stack([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])


def ground_half_size(members: Sequence[Member], clear_height_m: float) -> float:
    """Return how far the ground extends from the origin to every side, m, with room for debris.

    A ball hangs `clear_height_m` above the members; 0 without one.
    """
    lower, upper = extent(members)
    farthest = float(length(np.maximum(abs(lower[:2]), abs(upper[:2]))))
    across = float(length((upper - lower)[:2]))
    height = float(upper[2]) - min(float(lower[2]), 0.0)
    return max(across, farthest) + _DEBRIS_ROOM * (height + clear_height_m)


def room_around(scenario: Scenario, members: Sequence[Member]) -> float:
    """Return how far the ground of a scenario with these members extends from the origin to every side, m."""
    return ground_half_size(members, scenario.ball.largest_height_m(0.0) if scenario.ball else 0.0)


def surface_height(scenario: Scenario, members: Sequence[Member], position_m: tuple[float, float]) -> float:
    """Return the height of the top of all members at a position along and across the road, m.

    Of a bridge alone it is that of the deck, which joints do not interrupt.
    """
    if scenario.bridge and not scenario.geometry and not scenario.steelwork:
        return deck_top(scenario.bridge)
    corners = np.concatenate([member.solid.corners for member in members])
    heights = _heights_above(corners, np.asarray(position_m, dtype=float))
    if not len(heights):
        raise GeometryError(
            f"No member lies under {list(position_m)}; aim the ball at a position that has something under it."
        )
    return float(heights.max())


def _heights_above(corners: np.ndarray, position: np.ndarray) -> np.ndarray:
    """Return the heights of the triangles (t, 3, 3) that lie over or under a position (2,)."""
    origin = corners[:, 0]
    first, second = corners[:, 1] - origin, corners[:, 2] - origin
    area = cross_2d(first, second)
    lies = np.abs(area) > 0.0
    origin, first, second, area = origin[lies], first[lies], second[lies], area[lies]
    offset = position - origin[:, :2]
    u, v = cross_2d(offset, second) / area, cross_2d(first, offset) / area
    inside = (u >= -_ON_EDGE) & (v >= -_ON_EDGE) & (u + v <= 1.0 + _ON_EDGE)
    return (origin[:, 2] + u * first[:, 2] + v * second[:, 2])[inside]
