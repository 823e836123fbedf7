"""Where a charge is put that is added by a button: at the face of a pier, near its foot."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from manifold3d import CrossSection

from ...engineering.geometry.mesh import TriangleMesh, plane_cuts
from ...engineering.geometry.vectors import distance

ABOVE_FOOT_M = 1.0
"""Height of a new charge above the foot of its pier: where a person can fix it, and where columns are cut."""

_MOST_OF_HEIGHT = 0.5
"""Share of the height of a low pier that it is put at instead."""

_ON_BRIDGE_M = 0.05
"""Who clicks on a face puts the 3D cursor no further from it."""

_SAME_M = 1e-4
"""Corners of cuts through several shards that are nearer to a straight side are no corners of the pier."""

_UP = 2


def is_on_bridge(position_m: np.ndarray, boxes_m: np.ndarray) -> bool:
    """Return whether a position (3,), m, is in or on one of the boxes (n, 2, 3) around pieces of a bridge."""
    inside = (position_m >= boxes_m[:, 0] - _ON_BRIDGE_M) & (position_m <= boxes_m[:, 1] + _ON_BRIDGE_M)
    return bool(inside.all(axis=1).any())


def place_at_pier(piers: Sequence[TriangleMesh], near_m: np.ndarray) -> tuple[float, float, float] | None:
    """Return the middle of that face of the piers, 1 m above its foot, which is nearest on plan to a position (3,), m.

    None where there is no pier.
    """
    places = [place for pier in piers for place in _faces(pier)]
    if not places:
        return None
    away_m = [distance(place[:_UP], near_m[:_UP]) for place in places]
    x, y, z = places[int(np.argmin(away_m))].tolist()
    return x, y, z


def _faces(pier: TriangleMesh) -> list[np.ndarray]:
    """Return the middles (3,) of the sides of a pier at the height of a charge."""
    foot, top = pier.vertices[:, _UP].min(), pier.vertices[:, _UP].max()
    height = min(foot + ABOVE_FOOT_M, foot + _MOST_OF_HEIGHT * (top - foot))
    _, ends = plane_cuts(pier.vertices[pier.triangles], _UP, height)
    if not len(ends):
        return []
    return [
        np.array((*middle, height))
        for outline in CrossSection.hull_points(ends.reshape(-1, 3)[:, :_UP]).simplify(_SAME_M).to_polygons()
        for middle in (outline + np.roll(outline, -1, axis=0)) / 2.0
    ]
