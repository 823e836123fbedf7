"""How deep two convex bodies lie in each other.

They are apart where a plane separates them, which then is that of a face of one of them, or along an edge of both
(S. Gottschalk, M. C. Lin, D. Manocha 1996, OBBTree, SIGGRAPH 96, section 5).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from .hulls import convex_hulls
from .solids import from_manifold, hull
from .vectors import dot, length, transformed, unit

_SAME_DIGITS = 6
"""Digits after the point in which edges of one direction agree."""

_PARALLEL = 1e-6
"""Length of the cross product of two edges below which they count as parallel, and say nothing new."""


@dataclass(frozen=True, slots=True, eq=False)
class ConvexBody:
    """A convex body with f faces, v vertices and edges of e directions."""

    normals: FloatArray  # (f, 3), outward unit normals
    offsets_m: FloatArray  # (f,), distances of the faces from the origin along their normals
    vertices_m: FloatArray  # (v, 3)
    edges: FloatArray  # (e, 3), unit vectors

    def placed(self, rotation: FloatArray, position_m: FloatArray) -> ConvexBody:
        """Return it turned by a rotation (3, 3), and then moved by (3,)."""
        normals = transformed(rotation, self.normals)
        return ConvexBody(
            normals,
            self.offsets_m + dot(normals, position_m),
            transformed(rotation, self.vertices_m) + position_m,
            transformed(rotation, self.edges),
        )


def convex_body(points_m: FloatArray) -> ConvexBody:
    """Return the convex hull of points (p, 3).

    Raises
    ------
    GeometryError
        Where they lie in one plane.
    """
    around = convex_hulls([points_m])
    corners = from_manifold(hull(points_m)).corners
    edges = unit((np.roll(corners, -1, axis=1) - corners).reshape(-1, 3))
    # Both ways along an edge are one direction.
    leading = np.take_along_axis(edges, np.abs(edges).argmax(axis=1)[:, None], axis=1)
    edges = np.where(leading < 0.0, -edges, edges)
    _, first = np.unique(edges.round(_SAME_DIGITS) + 0.0, axis=0, return_index=True)
    return ConvexBody(around.normals, around.offsets, around.vertices, edges[first])


def depth_m(first: ConvexBody, second: ConvexBody) -> float:
    """Return how far one of two bodies has to go until they are apart; below 0, by how much they are."""
    by_faces = min(_behind_m(first, second), _behind_m(second, first))
    return by_faces if by_faces < 0.0 else min(by_faces, _between_edges_m(first, second))


def _behind_m(faces: ConvexBody, corners: ConvexBody) -> float:
    """Return how deep the vertices of a body lie behind that face of another behind which they lie least."""
    beyond = dot(faces.normals[:, None], corners.vertices_m[None]) - faces.offsets_m[:, None]
    return -float(beyond.min(axis=1).max())


def _between_edges_m(first: ConvexBody, second: ConvexBody) -> float:
    """Return the same for planes along an edge of both."""
    crosses = np.cross(first.edges[:, None], second.edges[None]).reshape(-1, 3)
    sizes = length(crosses)
    across = crosses[sizes > _PARALLEL] / sizes[sizes > _PARALLEL, None]
    if not len(across):
        return np.inf
    one, other = (dot(across[:, None], body.vertices_m[None]) for body in (first, second))
    depths = np.minimum(one.max(axis=1) - other.min(axis=1), other.max(axis=1) - one.min(axis=1))
    return float(depths.min())
