"""Parts of members that never move, because the member, or the face that their shards are part of, is held."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

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


@dataclass(frozen=True, slots=True, eq=False)
class HeldPart:
    """A part of a member that never moves, by a support of the scenario.

    `shards` (s,) are those that no support before it holds. `centre_m` (3,) is the middle of the face that is held;
    None where the whole member is.
    """

    member: int
    face: str
    shards: np.ndarray
    centre_m: np.ndarray | None


def held_parts(
    supports: Sequence[Support], members: Sequence[Member], shards: Sequence[TriangleMesh], member_of_shard: np.ndarray
) -> tuple[HeldPart, ...]:
    """Return what supports hold of members whose shards have no gaps yet."""
    free, parts = np.ones(len(shards), dtype=bool), []
    for support in supports:
        for index in members_named(support.member, members, "supports.member"):
            own, centre_m = np.flatnonzero(member_of_shard == index), None
            if support.face != "all":
                direction = np.array(DIRECTIONS[support.face])
                own = own[on_outermost_face(members[index].solid, [shards[shard] for shard in own.tolist()], direction)]
                centre_m = outermost_centre(members[index].solid, direction)
            parts.append(HeldPart(index, support.face, own[free[own]], centre_m))
            free[own] = False
    if len(free) and not free.any():
        raise GeometryError("Every shard is held by supports, so that nothing is left to move; hold fewer members.")
    return tuple(parts)


def on_outermost_face(solid: TriangleMesh, shards: Sequence[TriangleMesh], direction: np.ndarray) -> np.ndarray:
    """Return which shards (n,) are part of a solid's outermost face that looks most in a direction (3,)."""
    _, normals = triangle_areas_and_normals(solid.corners)
    faces, tolerance = _outermost(solid, direction), _SAME_PLANE * solid.longest_extent
    heights = dot(normals, solid.corners[:, 0])
    planes = np.unique(np.column_stack([normals[faces], heights[faces]]).round(9), axis=0)
    return np.array([_has_face_in(shard, planes, tolerance) for shard in shards], dtype=bool)


def outermost_centre(solid: TriangleMesh, direction: np.ndarray) -> np.ndarray:
    """Return the middle (3,) of a solid's outermost face that looks most in a direction (3,)."""
    faces = _outermost(solid, direction)
    areas, _ = triangle_areas_and_normals(solid.corners[faces])
    return (areas[:, None] * solid.corners[faces].mean(axis=1)).sum(axis=0) / areas.sum()


def _outermost(solid: TriangleMesh, direction: np.ndarray) -> np.ndarray:
    """Return the triangles (f,) of a solid's outermost face that looks most in a direction (3,)."""
    corners = solid.corners
    areas, normals = triangle_areas_and_normals(corners)
    heights = dot(normals, corners[:, 0])
    tolerance = _SAME_PLANE * solid.longest_extent
    outermost = (dot(solid.vertices[:, None], normals) <= heights + tolerance).all(axis=0) & (areas > 0.0)
    leaning = np.where(outermost, dot(normals, direction), -np.inf)
    return np.flatnonzero(leaning > leaning.max() - _SAME_LEANING)


def _has_face_in(shard: TriangleMesh, planes: np.ndarray, tolerance: float) -> bool:
    """Return whether a triangle with an area lies in one of the planes (p, 4): normals and heights."""
    corners = shard.corners
    areas, normals = triangle_areas_and_normals(corners)
    lies = np.abs(dot(corners[:, :, None], planes[:, :3]) - planes[:, 3]).max(axis=1) <= tolerance
    looks = dot(normals[:, None], planes[:, :3]) > 1.0 - _SAME_LEANING
    return bool((lies & looks & (areas > tolerance * tolerance)[:, None]).any())
