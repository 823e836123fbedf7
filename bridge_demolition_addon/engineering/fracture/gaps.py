"""Gaps between shards: each is taken back from the faces it was cut with, and not from the surface of its member."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from manifold3d import Manifold, OpType

from ...errors import GeometryError
from ..arrays import BoolArray, FloatArray
from ..geometry.mesh import TriangleMesh, triangle_areas_and_normals
from ..geometry.solids import from_manifold, to_manifold
from ..geometry.vectors import dot, unit

_SAME_POSITION = 1e-7
"""Part of the member's longest extent within which a face of a shard lies in the member's surface."""

_PAIRS_PER_BLOCK = 1_000_000
"""Pairs of triangles compared in one go; bounds the memory."""


def with_gaps(shards: Sequence[TriangleMesh], solid: TriangleMesh, gap_m: float) -> tuple[TriangleMesh, ...]:
    """The closed shards of a solid with a clear distance `gap_m` between them; with 0 they come back as they are.

    Half of it is taken from either side: of a shard that lies behind the plane of a cut, what is too close to the
    plane; of one that bends around the cut, what lies in front of the cut itself.
    """
    if gap_m == 0.0:
        return tuple(shards)
    tolerance = _SAME_POSITION * solid.longest_extent
    return tuple(
        _taken_back(shard, is_cut(shard, solid), gap_m / 2.0, tolerance, number) for number, shard in enumerate(shards)
    )


def is_cut(shard: TriangleMesh, solid: TriangleMesh) -> BoolArray:
    """Which triangles (t,) of a shard do not lie in the surface of the solid it was cut from; none without an area."""
    surface, tolerance = solid.corners, _SAME_POSITION * solid.longest_extent
    corners = shard.corners
    areas, normals = triangle_areas_and_normals(corners)
    middles = corners.mean(axis=1)
    _, of_surface = triangle_areas_and_normals(surface)
    rows = max(1, _PAIRS_PER_BLOCK // len(surface))
    lies = [
        _lie_in(middles[first : first + rows], normals[first : first + rows], surface, of_surface, tolerance)
        for first in range(0, len(middles), rows)
    ]
    return ~np.concatenate(lies) & (areas > tolerance * tolerance)


def _lie_in(
    positions: FloatArray, normals: FloatArray, surface: FloatArray, of_surface: FloatArray, tolerance: float
) -> BoolArray:
    """Whether each position lies in one of the triangles and looks the same way (n,)."""
    close = np.abs(dot(positions[:, None] - surface[:, 0], of_surface)) <= tolerance
    close &= dot(normals[:, None], of_surface) > 1.0 - 1e-6
    for corner in range(3):
        start, end = surface[:, corner], surface[:, (corner + 1) % 3]
        inwards = np.cross(of_surface, unit(end - start))
        close &= dot(positions[:, None] - start, inwards) >= -tolerance
    return close.any(axis=1)


def _taken_back(shard: TriangleMesh, is_cut: BoolArray, depth: float, tolerance: float, number: int) -> TriangleMesh:
    corners = shard.vertices[shard.triangles[is_cut]]
    _, normals = triangle_areas_and_normals(corners)
    heights = dot(normals, corners[:, 0])
    is_behind = (dot(shard.vertices[:, None], normals) <= heights + tolerance).all(axis=0)
    solid = to_manifold(shard, "A shard")
    planes = np.unique(np.column_stack([normals, heights])[is_behind].round(9), axis=0)
    for *normal, height in planes.tolist():
        solid = solid.trim_by_plane([-component for component in normal], depth - height)
    if not is_behind.all():
        prisms = [_prism(*face, depth) for face in zip(corners[~is_behind], normals[~is_behind], strict=True)]
        solid = Manifold.batch_boolean([solid, *prisms], OpType.Subtract)
    if solid.is_empty() or solid.volume() <= 0.0:
        raise GeometryError(f"Nothing is left of shard {number} with gaps of {2.0 * depth:g} m; make them smaller.")
    return from_manifold(solid)


_PRISM_TRIANGLES = np.array([[0, 2, 1], [3, 4, 5], [0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4], [2, 0, 3], [2, 3, 5]])


def _prism(corners: FloatArray, normal: FloatArray, depth: float) -> Manifold:
    """Volume within a depth on either side of a triangle (3, 3)."""
    vertices = np.concatenate([corners - depth * normal, corners + depth * normal])
    return to_manifold(TriangleMesh(vertices, _PRISM_TRIANGLES), "A cut")
