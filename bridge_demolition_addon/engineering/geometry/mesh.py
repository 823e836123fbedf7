"""The mesh of the project: arrays of vertices and triangles, and where a plane cuts these."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, IntArray
from .vectors import cross, dot, length, unit


@dataclass(frozen=True, eq=False, slots=True)
class TriangleMesh:
    """A surface of triangles."""

    vertices: FloatArray  # (v, 3), m
    triangles: IntArray  # (t, 3), vertices of each triangle, counter-clockwise seen from outside

    @property
    def corners(self) -> FloatArray:
        """(t, 3, 3) corners of every triangle, m."""
        return self.vertices[self.triangles]

    @property
    def bounds(self) -> FloatArray:
        """(2, 3) lowest and highest corner of the box around the surface, m."""
        corners = self.corners.reshape(-1, 3)
        return np.array((corners.min(axis=0), corners.max(axis=0)))

    @property
    def longest_extent(self) -> float:
        """Longest side of the box around the surface, m."""
        lower, upper = self.bounds
        return float((upper - lower).max())

    @property
    def cube_volume(self) -> float:
        """Volume of a cube with that longest side, m³."""
        return self.longest_extent * self.longest_extent * self.longest_extent

    @property
    def volume(self) -> float:
        """Volume within the surface, m³; negative where it is inside out."""
        return float(volumes_and_centres([self])[0][0])

    def flipped(self) -> TriangleMesh:
        """The surface seen from its other side."""
        return TriangleMesh(self.vertices, self.triangles[:, ::-1])


def joined_meshes(meshes: Sequence[TriangleMesh]) -> TriangleMesh:
    """Meshes as one, one after the other."""
    firsts = np.cumsum([0] + [len(mesh.vertices) for mesh in meshes[:-1]])
    triangles = [mesh.triangles + first for mesh, first in zip(meshes, firsts, strict=True)]
    return TriangleMesh(np.concatenate([mesh.vertices for mesh in meshes]), np.concatenate(triangles))


def triangle_areas_and_normals(corners: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Areas (t,) and unit normals (t, 3) of triangles (t, 3, 3); a zero normal where there is no area."""
    doubled = cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return length(doubled) / 2.0, unit(doubled)


def volumes_and_centres(meshes: Sequence[TriangleMesh]) -> tuple[FloatArray, FloatArray]:
    """Volumes (n,), m³, and centres of mass (n, 3), m, of closed meshes of uniform density, by Gauss's theorem.

    The volume of a mesh that is inside out is negative; the centre of one without volume is the mean of its vertices.
    """
    if not len(meshes):
        return np.zeros(0), np.zeros((0, 3))
    # About its own middle, because a small mesh far from the origin would lose its volume in rounding.
    middles = np.array([mesh.vertices.mean(axis=0) for mesh in meshes])
    corners = np.concatenate([mesh.corners - middle for mesh, middle in zip(meshes, middles, strict=True)])
    starts = np.cumsum([0] + [len(mesh.triangles) for mesh in meshes[:-1]])
    six_volumes = dot(corners[:, 0], cross(corners[:, 1], corners[:, 2]))
    moments = six_volumes[:, None] * corners.sum(axis=1) / 24.0
    volumes = np.add.reduceat(six_volumes / 6.0, starts)
    first_moments = np.add.reduceat(moments, starts)
    has_volume = volumes != 0
    offsets = np.divide(first_moments, volumes[:, None], out=np.zeros_like(middles), where=has_volume[:, None])
    return volumes, middles + offsets


def plane_cuts(corners: FloatArray, across: int, level: float) -> tuple[IntArray, FloatArray]:
    """Return which triangles (t, 3, 3) a plane across an axis parts (c,), and the ends of the cuts (c, 2, 3)."""
    heights = corners[..., across] - level
    parted = np.flatnonzero((heights > 0.0).any(axis=1) & (heights <= 0.0).any(axis=1))
    corners, heights = corners[parted], heights[parted]
    # The corner that is alone on its side comes first: both edges from it are cut.
    above = heights > 0.0
    alone = np.where(above.sum(axis=1) == 1, above.argmax(axis=1), above.argmin(axis=1))
    rows = np.arange(len(corners))
    first, height = corners[rows, alone], heights[rows, alone]
    ends = []
    for step in (1, 2):
        other = (alone + step) % 3
        share = height / (height - heights[rows, other])
        ends.append(first + share[:, None] * (corners[rows, other] - first))
    return parted, np.stack(ends, axis=1) if len(ends[0]) else np.zeros((0, 2, 3))
