"""Which shards never move, because their member, or the face they are part of, is fixed."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...engineering.geometry.mesh import TriangleMesh, triangle_areas_and_normals
from ...engineering.geometry.vectors import dot
from ...errors import GeometryError
from ..bridge.member import Member, members_named
from ..scenario.bodies import Support

DIRECTIONS = {
    "bottom": (0.0, 0.0, -1.0),
    "top": (0.0, 0.0, 1.0),
    "start": (-1.0, 0.0, 0.0),
    "end": (1.0, 0.0, 0.0),
    "right": (0.0, -1.0, 0.0),
    "left": (0.0, 1.0, 0.0),
}

_SAME_PLANE = 1e-7
"""Part of a member's longest extent within which a shard's face lies in a plane."""

_SAME_LEANING = 1e-6
"""Difference of two cosines below which faces look the same way."""


def fixed_shards(
    supports: Sequence[Support], members: Sequence[Member], shards: Sequence[TriangleMesh], member_of_shard: np.ndarray
) -> np.ndarray:
    """Return whether each shard, before gaps are made, is fixed, (n,) bool."""
    fixed = np.zeros(len(shards), dtype=bool)
    for support in supports:
        for index in members_named(support.member, members, "supports.member"):
            own = np.flatnonzero(member_of_shard == index).tolist()
            if support.face == "all":
                fixed[own] = True
            else:
                parts = [shards[shard] for shard in own]
                fixed[own] |= on_outermost_face(members[index].solid, parts, np.array(DIRECTIONS[support.face]))
    if len(fixed) and fixed.all():
        raise GeometryError("Every shard is held by supports, so that nothing is left to move; hold fewer members.")
    return fixed


def on_outermost_face(solid: TriangleMesh, shards: Sequence[TriangleMesh], direction: np.ndarray) -> np.ndarray:
    """Return which shards (n,) are part of a solid's outermost face that looks most in a direction (3,)."""
    corners = solid.corners
    areas, normals = triangle_areas_and_normals(corners)
    heights = dot(normals, corners[:, 0])
    tolerance = _SAME_PLANE * solid.longest_extent
    outermost = (dot(solid.vertices[:, None], normals) <= heights + tolerance).all(axis=0) & (areas > 0.0)
    leaning = np.where(outermost, dot(normals, direction), -np.inf)
    faces = np.flatnonzero(leaning > leaning.max() - _SAME_LEANING)
    planes = np.unique(np.column_stack([normals[faces], heights[faces]]).round(9), axis=0)
    return np.array([_has_face_in(shard, planes, tolerance) for shard in shards], dtype=bool)


def _has_face_in(shard: TriangleMesh, planes: np.ndarray, tolerance: float) -> bool:
    """Return whether a triangle with an area lies in one of the planes (p, 4): normals and heights."""
    corners = shard.corners
    areas, normals = triangle_areas_and_normals(corners)
    lies = np.abs(dot(corners[:, :, None], planes[:, :3]) - planes[:, 3]).max(axis=1) <= tolerance
    looks = dot(normals[:, None], planes[:, :3]) > 1.0 - _SAME_LEANING
    return bool((lies & looks & (areas > tolerance * tolerance)[:, None]).any())
