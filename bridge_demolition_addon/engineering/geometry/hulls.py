"""Convex hulls of bodies as flat arrays, which a blast wave meets, and which hide others from it."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...errors import GeometryError
from ..arrays import FloatArray, IntArray
from .mesh import TriangleMesh
from .solids import from_manifold, hull
from .vectors import dot, length

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
    starts: IntArray  # (n + 1,), first face of each body, and the number of all
    vertices: FloatArray  # (v, 3), from the bodies' centres of mass, m
    vertex_starts: IntArray  # (n + 1,), first vertex of each body, and the number of all

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
