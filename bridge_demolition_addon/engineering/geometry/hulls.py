"""Convex hulls of bodies as flat arrays, which a blast wave meets, and which hide others from it; and how deep two lie
in each other.

Two are apart where a plane separates them, which then lies along a face of one of them, or along an edge of both (S.
Gottschalk, M. C. Lin, D. Manocha 1996, OBBTree, SIGGRAPH 96, section 5).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...errors import GeometryError
from ..arrays import FloatArray, IntArray
from .mesh import TriangleMesh
from .solids import from_manifold, hull
from .vectors import dot, length, transformed, unit

THINNEST = 1e-9
"""Part of the cube of its longest extent that a body's hull must fill to be one."""

_SAME_PLANE_DIGITS = 9
"""Digits after the point (of m, and of unit normals) in which triangles of one face agree."""


@dataclass(frozen=True, eq=False)
class ConvexHulls:
    """Convex hulls of n bodies with f faces and v vertices in all, structure of arrays, in the axes of their bodies.

    Faces and vertices of a body follow each other.
    """

    normals: FloatArray  # (f, 3), outward unit normals
    areas: FloatArray  # (f,), m²
    face_vectors: FloatArray  # (3, f), normals times areas, m²
    offsets: FloatArray  # (f,), distances of the faces from the body's centre of mass along their normals, m
    starts: IntArray  # (n + 1,), first face of each body, and the number of faces
    vertices: FloatArray  # (v, 3), from the bodies' centres of mass, m
    vertex_starts: IntArray  # (n + 1,), first vertex of each body, and the number of vertices

    def __len__(self) -> int:
        return len(self.starts) - 1

    @cached_property
    def bodies(self) -> IntArray:
        """(f,) the body of every face."""
        return np.repeat(np.arange(len(self)), np.diff(self.starts))

    @cached_property
    def most_faces(self) -> int:
        """Most faces of a body."""
        return int(np.diff(self.starts).max(initial=0))

    @property
    def radii(self) -> FloatArray:
        """(n,) distances of the farthest vertices from the centres of mass, m."""
        distances = length(self.vertices)
        return np.maximum.reduceat(distances, self.vertex_starts[:-1]) if len(self) else np.zeros(0)


def convex_hulls(bodies: Sequence[FloatArray], names: Sequence[str] | None = None) -> ConvexHulls:
    """Convex hulls of bodies.

    Parameters
    ----------
    bodies : n arrays (v, 3) float
        Vertices of each body, m, in its own axes from its centre of mass.
    names : sequence of str, optional
        What each body is called where it is refused; by default its number.
    """
    called: Iterable[int | str] = range(len(bodies)) if names is None else map(repr, names)
    meshes = [_hull(np.asarray(vertices, float), name) for name, vertices in zip(called, bodies, strict=True)]
    faces = [_faces(mesh.corners) for mesh in meshes]
    planes = np.concatenate([np.zeros((0, 4)), *(planes for planes, _ in faces)])
    areas = np.concatenate([np.zeros(0), *(areas for _, areas in faces)])
    return ConvexHulls(
        normals=planes[:, :3],
        areas=areas,
        face_vectors=np.ascontiguousarray((planes[:, :3] * areas[:, None]).T),
        offsets=planes[:, 3],
        starts=np.cumsum([0, *(len(areas) for _, areas in faces)]),
        vertices=np.concatenate([np.zeros((0, 3)), *(mesh.vertices for mesh in meshes)]),
        vertex_starts=np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)]),
    )


def _hull(points: FloatArray, name: int | str) -> TriangleMesh:
    """Convex hull of points (v, 3) that do not lie in one plane."""
    if len(points) >= 4 and np.isfinite(points).all():
        around = hull(points)
        # Points in one plane come out as a mesh too, of no volume.
        mesh = from_manifold(around)
        if mesh.triangles.size and around.volume() > THINNEST * mesh.cube_volume:
            return mesh
    raise GeometryError(f"body {name} has no volume: expected finite vertices that do not lie in one plane")


def _faces(corners: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Planes (f, 4), normal and offset, and areas (f,) of triangles (t, 3, 3), those in one plane as one face."""
    doubled = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = length(doubled)
    # A sliver has no direction and adds no area.
    corners, doubled, lengths = (values[lengths > 0.0] for values in (corners, doubled, lengths))
    normals = doubled / lengths[:, None]
    planes = np.column_stack((normals, dot(normals, corners[:, 0])))
    rounded = planes.round(_SAME_PLANE_DIGITS) + 0.0  # no -0
    _, first, face_of = np.unique(rounded, axis=0, return_index=True, return_inverse=True)
    return planes[first], np.bincount(face_of.ravel(), lengths / 2.0)


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
