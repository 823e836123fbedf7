"""Second moments of area of the faces that shards share, by which a section resists bending."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..geometry.mesh import TriangleMesh
from ..geometry.plan_areas import signed_area
from ..geometry.proximity import blocks, ranges
from ..geometry.vectors import dot, outer, transformed_back
from ..mechanics.section_forces import section_axes

_SAME_PLANE_M = 1e-6
"""Distance from the plane of a face up to which a corner belongs to it: rounding of coordinates of a bridge."""

_SAME_AREA = 1e-3
"""Largest difference of the area in a shard's mesh from that of the face, as a part of it."""


def second_moments(
    shards: Sequence[TriangleMesh], first: IntArray, areas: FloatArray, centres: FloatArray, normals: FloatArray
) -> FloatArray:
    """Second moments of area (m, 2, 2), m⁴, of faces about their own centres, by the first shard (m,) of each.

    About the section's y and z axes (`section_forces.section_axes`) they are ∫ z² dA and ∫ y² dA on the diagonal, and
    -∫ y z dA beside it. Normals (m, 3) point out of the first shard; a face without area has no moments.

    The face is looked for in the mesh of its first shard: all triangles in its plane that look its way. Where these are
    not just the face, as on the underside of a deck that rests on a smaller pier cap, it is taken for a square.
    """
    moments = np.square(areas[:, None, None]) / 12.0 * np.eye(2)
    with_area = np.flatnonzero(areas > 0.0)
    for part in blocks(np.array([len(shards[shard].triangles) for shard in first[with_area]], int)):
        rows = with_area[part]
        face, corners = triangles_in_faces([shards[shard] for shard in first[rows]], centres[rows], normals[rows])
        counts = np.bincount(face, minlength=len(rows))
        # Faces of as many triangles together: each is summed as it would be alone, to the last bit.
        for count in np.unique(counts[counts > 0]):
            alike = np.flatnonzero(counts == count)
            own = corners[counts[face] == count].reshape(len(alike), count, 3, 2)
            of_faces, is_alone = _about_own_centres(own, areas[rows[alike]])
            moments[rows[alike[is_alone]]] = of_faces[is_alone]
    return moments


def triangles_in_faces(
    shards: Sequence[TriangleMesh], centres: FloatArray, normals: FloatArray
) -> tuple[IntArray, FloatArray]:
    """Face (t,), in ascending order, and corners (t, 3, 2) of all triangles in the planes of k faces.

    Corners are in the face's own y and z, about its centre. There is a first shard for each face.
    """
    vertex_counts = np.array([len(shard.vertices) for shard in shards])
    faces, _ = ranges(np.zeros(len(shards), int), vertex_counts)
    arms = np.concatenate([shard.vertices for shard in shards]) - centres[faces]
    is_near = abs(dot(arms, normals[faces])) <= _SAME_PLANE_M
    face, _ = ranges(np.zeros(len(shards), int), np.array([len(shard.triangles) for shard in shards]))
    first_vertices = np.cumsum(vertex_counts) - vertex_counts
    triangles = np.concatenate([shard.triangles for shard in shards]) + first_vertices[face][:, None]
    lies = is_near[triangles].all(axis=1)
    in_plane = section_axes(normals)[:, :, 1:]
    return face[lies], transformed_back(in_plane[face[lies]][:, None], arms[triangles[lies]])


def _about_own_centres(corners: FloatArray, areas: FloatArray) -> tuple[FloatArray, BoolArray]:
    """Second moments (k, 2, 2) of faces by corners (k, t, 3, 2) of triangles, and whether they are alone (k,).

    They are not where the triangles' area differs from the face's own (k,).
    """
    triangle_areas = signed_area(corners)
    whole = triangle_areas.sum(axis=1)
    is_alone = abs(whole - areas) <= _SAME_AREA * areas
    moments = (triangle_areas[..., None] * corners.mean(axis=2)).sum(axis=1)
    middles = np.divide(moments, whole[:, None], out=np.zeros_like(moments), where=is_alone[:, None])
    corners = corners - middles[:, None, None]
    # ∫ u v dA over a triangle is A/12 (Σ u v + Σ u Σ v), sums over its corners.
    sums = corners.sum(axis=2)
    products = outer(corners, corners).sum(axis=2) + outer(sums, sums)
    integrals = (triangle_areas[..., None, None] * products).sum(axis=1) / 12.0
    yy, yz, zz = integrals[:, 0, 0], integrals[:, 0, 1], integrals[:, 1, 1]
    return np.stack((np.stack((zz, -yz), axis=-1), np.stack((-yz, yy), axis=-1)), axis=-2), is_alone
