"""Convex hulls of bodies as flat arrays: what a blast wave sees of them, and what they hide from it."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from manifold3d import Manifold

from ..errors import GeometryError

_SAME_PLANE_DIGITS = 9
"""Digits after the point (of m, and of unit normals) in which triangles of one face agree."""


@dataclass(frozen=True, eq=False, slots=True)
class ConvexHulls:
    """Convex hulls of n bodies with f faces in all, structure of arrays, each in the axes of its own body.

    Attributes
    ----------
    normals
        (f, 3) outward unit normals; the faces of a body follow each other.
    areas
        (f,) face areas, m².
    offsets
        (f,) distances of the faces from the body's centre of mass along their normals, m.
    starts
        (n + 1,) where the faces of each body begin, and the number of all.
    radii
        (n,) distances of the farthest vertices from the centres of mass, m.
    """

    normals: np.ndarray
    areas: np.ndarray
    offsets: np.ndarray
    starts: np.ndarray
    radii: np.ndarray

    def __len__(self) -> int:
        return len(self.radii)

    @property
    def bodies(self) -> np.ndarray:
        """(f,) the body of every face."""
        return np.repeat(np.arange(len(self)), np.diff(self.starts))


def convex_hulls(bodies: Sequence[np.ndarray]) -> ConvexHulls:
    """Convex hulls of bodies.

    Parameters
    ----------
    bodies
        Vertices (v, 3) of each body, m, in its own axes from its centre of mass.

    Raises
    ------
    GeometryError
        A body has no volume.
    """
    faces = [_faces_of_hull(np.asarray(vertices, float), number) for number, vertices in enumerate(bodies)]
    planes = np.concatenate([np.zeros((0, 4)), *(planes for planes, _ in faces)])
    areas = np.concatenate([np.zeros(0), *(areas for _, areas in faces)])
    starts = np.cumsum([0, *(len(areas) for _, areas in faces)])
    radii = np.array([np.linalg.norm(vertices, axis=1).max() for vertices in bodies])
    return ConvexHulls(planes[:, :3], areas, planes[:, 3], starts, radii)


def _faces_of_hull(vertices: np.ndarray, number: int) -> tuple[np.ndarray, np.ndarray]:
    """Planes (f, 4), normal and offset, and areas (f,) of a hull whose coplanar triangles are one face."""
    mesh = Manifold.hull_points(vertices).to_mesh64()
    corners = mesh.vert_properties[:, :3][mesh.tri_verts]
    doubled = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(doubled, axis=1)
    # A sliver has no direction and adds no area.
    corners, doubled, lengths = (values[lengths > 0.0] for values in (corners, doubled, lengths))
    if not len(lengths):
        raise GeometryError(f"body {number} has no volume: expected vertices that do not lie in one plane")
    normals = doubled / lengths[:, None]
    offsets = np.einsum("fi,fi->f", normals, corners[:, 0])
    planes = np.column_stack((normals, offsets))
    _, first, face_of = np.unique(planes.round(_SAME_PLANE_DIGITS) + 0.0, axis=0, return_index=True, return_inverse=True)
    return planes[first], np.bincount(face_of.ravel(), lengths / 2.0)
