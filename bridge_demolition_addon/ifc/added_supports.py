"""Supports that a file lacks: under bearings that lie on nothing, and under the ends of a bridge without piers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from manifold3d import CrossSection

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.solids import box, from_manifold, to_manifold
from ..engineering.geometry.vectors import cross_2d, dot, length, transformed_back, turn_in_plane, unit
from ..model.bridge.member import Member
from .gaps import STEEPEST, cut_by

KIND = "pier"
WIDEST_M = 0.5
"""Length along the road of a support under the end of a girder; also the least width of one under a bearing."""

_INSET_M, _WITHIN, _LEAST_WIDTH_M = 0.05, 0.9, 0.2
"""Where a support is under the underside of a girder: behind its end, and so much of its width."""

CLEARANCE_M = 5.0
"""Height of the road's underside above the ground, where no part of the file stands on it and none is given."""


@dataclass(frozen=True, slots=True)
class AddedSupport:
    """A support that never moves, and the member that lies on it."""

    solid: TriangleMesh
    above: str


def under_bearing(solid: TriangleMesh) -> TriangleMesh | None:
    """Return a column from the ground to just within the underside of a bearing; None where that lies on the ground."""
    low, high = solid.bounds
    if low[2] <= 0.0:
        return None
    size = np.maximum(high - low, WIDEST_M)[:2]
    return box((*size.tolist(), float(low[2])), (*((low + high) / 2.0)[:2].tolist(), float(low[2]) / 2.0))


def under_ends(member: Member) -> list[AddedSupport]:
    """Return supports under the first and the other end of a member that carries the road, from the ground to it."""
    points = member.solid.vertices
    middle, along = _along(points[:, :2])
    arms = points[:, :2] - middle
    way = dot(arms, along)
    across = np.array((-along[1], along[0]))
    supports = []
    for side in (-1.0, 1.0):
        end = float((side * way).max())
        near = side * way >= end - WIDEST_M
        low = float(points[near, 2].min())
        # What lies at the end, and of that its lowest parts: the bottom flange of a girder, not its wings.
        lowest = near & (points[:, 2] <= low + 0.05)
        beside = dot(arms[lowest], across)
        width = _WITHIN * max(float(np.ptp(beside)), _LEAST_WIDTH_M)
        centre = (
            middle
            + along * side * (end - _INSET_M - 0.5 * WIDEST_M)
            + across * float(beside.min() + beside.max()) / 2.0
        )
        top = low + STEEPEST * WIDEST_M
        column = box((WIDEST_M, width, top), (0.0, 0.0, top / 2.0))
        turn = turn_in_plane(-float(np.arctan2(along[1], along[0])))
        vertices = np.column_stack((transformed_back(turn, column.vertices[:, :2]) + centre, column.vertices[:, 2]))
        supports.append(TriangleMesh(vertices, column.triangles))
    return [AddedSupport(_below(solid, member.solid), member.name) for solid in supports]


def with_one_pinned(supports: Sequence[AddedSupport]) -> list[tuple[AddedSupport, bool]]:
    """Return the supports of what hangs together, and whether each is pinned: those at its beginning alone.

    With others pinned too, such as at the first end of each span, the bridge would be an arch between them.
    """
    middles = [float(support.solid.bounds[:, 0].mean()) for support in supports]
    spans = [abs(end - begin) for begin, end in zip(middles[::2], middles[1::2], strict=True)]
    first = min(middles) + 0.5 * min(spans)
    return [(support, middle < first) for support, middle in zip(supports, middles, strict=True)]


def _below(column: TriangleMesh, solid: TriangleMesh) -> TriangleMesh:
    """Return a column up to the underside of a solid, without what of it is left beside a web above a flange."""
    pieces = to_manifold(cut_by(column, [solid])).decompose()
    return from_manifold(max(pieces, key=lambda piece: piece.volume()))


def _along(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return a point among points (n, 2), and the direction across which they are least wide, towards positive x."""
    (corners,) = CrossSection.hull_points(np.ascontiguousarray(points)).to_polygons()
    sides = np.roll(corners, -1, axis=0) - corners
    ways = unit(sides[length(sides) > 0.0])
    widths = np.ptp(cross_2d(ways[:, None], corners[None]), axis=1)
    along = ways[int(widths.argmin())]
    return corners.mean(axis=0), along if along[0] > 0.0 or (along[0] == 0.0 and along[1] > 0.0) else -along
