"""Bars that stand bare where a blast zone has lost its concrete: which shards they end in, and where."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...engineering.geometry.vectors import AXES
from ...engineering.mechanics.strength import NEWTON_PER_SQUARE_MILLIMETRE
from ..schema import given

if TYPE_CHECKING:
    from .zone_firings import ZoneFiring

_CORNERS = np.array([(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)])

_AT_PLANE = 0.02
"""Part of the height of a zone within which a connection is at one of its two planes."""


@dataclass(frozen=True, slots=True, eq=False)
class StandingBars:
    """Four groups of bars, at the corners of the rectangle with the same second moments as all of them.

    Attributes
    ----------
    bodies : (4, 2) int
        Shards that each group ends in, at the lower and at the upper plane of the zone.
    connections : (4, 2) int
        Connections of the zone to these shards, nearest to the group.
    points_m : (4, 2, 3) float
        Where the bars leave the concrete, in the bridge as it was built.
    count, diameter_m, yield_pa : float
        Bars in each group, and what they are.
    zone : str
        Name of their zone.
    tension_n, compression_n : float
        What all of them resist.
    """

    bodies: np.ndarray
    connections: np.ndarray
    points_m: np.ndarray
    count: float
    diameter_m: float
    yield_pa: float
    zone: str
    tension_n: float
    compression_n: float


def standing_bars(
    zone: ZoneFiring, is_in_zone: np.ndarray, pairs: np.ndarray, points_m: np.ndarray
) -> StandingBars | None:
    """Return the bars that stay in a zone without its concrete; None where there is none, or where the zone shares an
    end with its member.

    `is_in_zone` (n,) are the bodies of the zone, among whose connections are pairs (m, 2) at points (m, 3).
    """
    if not zone.bars or zone.left > 0.0:
        return None
    box_m, along = np.array((given(zone.lowest_corner_m), given(zone.highest_corner_m))), AXES.index(zone.along)
    section = [axis for axis in range(3) if axis != along]
    leaves = np.flatnonzero(is_in_zone[pairs].sum(axis=1) == 1)
    height_m = float(np.diff(box_m[:, along])[0])
    corners = box_m.mean(axis=0)[section] + _CORNERS * zone.bar_distances_m
    connections, ends = [], []
    for plane_m in box_m[:, along]:
        at_plane = leaves[abs(points_m[leaves, along] - plane_m) < _AT_PLANE * height_m]
        if not len(at_plane):
            return None
        apart = points_m[at_plane][:, section] - corners[:, None]
        connections.append(at_plane[(apart * apart).sum(axis=2).argmin(axis=1)])
        points = np.full((len(corners), 3), plane_m)
        points[:, section] = corners
        ends.append(points)
    rows = np.stack(connections, axis=1)
    outside = np.where(is_in_zone[pairs[rows]][..., 0], pairs[rows][..., 1], pairs[rows][..., 0])
    return StandingBars(
        outside,
        rows,
        np.stack(ends, axis=1),
        zone.bars / len(corners),
        1e-3 * zone.bar_diameter_mm,
        NEWTON_PER_SQUARE_MILLIMETRE * zone.bar_yield_n_mm2,
        zone.name,
        zone.cage_tension_n,
        zone.cage_compression_n,
    )
