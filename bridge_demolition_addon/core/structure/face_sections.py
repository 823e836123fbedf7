"""Second moments of area of the faces that shards share: what a section resists bending with."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..geometry.mesh import TriangleMesh
from ..geometry.plan_areas import signed_area
from ..geometry.vectors import dot, outer, transformed_back
from ..mechanics.section_forces import section_axes

_SAME_PLANE_M = 1e-6
"""How far a corner may lie off the plane of a face and still belong to it: rounding of coordinates of a bridge."""

_SAME_AREA = 1e-3
"""Part by which the area found in a shard's mesh may differ from the face's, before it is taken for another face's."""


def second_moments(
    shards: Sequence[TriangleMesh], first: np.ndarray, areas: np.ndarray, centres: np.ndarray, normals: np.ndarray
) -> np.ndarray:
    """Second moments of area of faces about their own centres.

    The face is looked for in the mesh of its first shard: all triangles in its plane that look its way. Where these are
    not just the face, as on the underside of a deck that rests on a smaller pier cap, it is taken for a square.

    Parameters
    ----------
    shards : sequence of TriangleMesh
        All shards.
    first : (m,) int
        The first shard of each face.
    areas, centres, normals : (m,), (m, 3), (m, 3) float
        Area, centre and unit normal, out of the first shard; a face without area has no moments.

    Returns
    -------
    (m, 2, 2) float
        About the section's y and z axes (`section_forces.section_axes`), m⁴: ∫ z² dA and ∫ y² dA on the
        diagonal, -∫ y z dA beside it.
    """
    in_plane = section_axes(normals)[:, :, 1:]
    squares = np.square(areas[:, None, None]) / 12.0 * np.eye(2)
    found = [
        _of_face(shards[shard], centre, normal, axes, area)
        for shard, centre, normal, axes, area in zip(first, centres, normals, in_plane, areas, strict=True)
    ]
    return np.array([square if each is None else each for each, square in zip(found, squares, strict=True)]).reshape(
        -1, 2, 2
    )


def _of_face(
    shard: TriangleMesh, centre: np.ndarray, normal: np.ndarray, axes: np.ndarray, area: float
) -> np.ndarray | None:
    """Second moments (2, 2) of the face of a shard, None where the mesh does not show it alone."""
    if area == 0.0:
        return None
    is_near = abs(dot(shard.vertices - centre, normal)) <= _SAME_PLANE_M
    triangles = shard.triangles[is_near[shard.triangles].all(axis=1)]
    corners = transformed_back(axes, shard.vertices[triangles] - centre)
    triangle_areas = signed_area(corners)
    if abs(triangle_areas.sum() - area) > _SAME_AREA * area:
        return None
    corners = corners - (triangle_areas[:, None] * corners.mean(axis=1)).sum(axis=0) / triangle_areas.sum()
    # ∫ u v dA over a triangle is A/12 (Σ u v + Σ u Σ v), sums over its corners.
    sums = corners.sum(axis=1)
    products = outer(corners, corners).sum(axis=1) + outer(sums, sums)
    (yy, yz), (_, zz) = (triangle_areas[:, None, None] * products).sum(axis=0) / 12.0
    return np.array(((zz, -yz), (-yz, yy)))
