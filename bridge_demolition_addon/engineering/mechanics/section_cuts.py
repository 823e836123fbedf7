"""Section cuts through a member: the faces of one shard that carry a load together, and forces in their axes.

Statics does not decide how several joints between rigid bodies share a load, and a solver without stiffness gives a
face of a hand's breadth as much of it as one of a square metre. Statics does decide their sum. So a face is judged with
the others that look the same way from its shard, as one section whose plane stays plane, on both of its sides.

A connection is a cut between two bodies. Its x axis is the normal of the cut, from the first body to the second; y and
z lie in the cut, y level and z as steep as can be. Forces and moments are those on the first body, and so act on the
face that looks along x: they count positive along the positive axes, and an axial force is positive in tension.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..geometry.proximity import ranges
from ..geometry.vectors import dot, length, transformed_back, unit

_LEVEL_CUT = 1e-6
"""A normal is vertical when its horizontal part is below this: what rounding leaves of the direction of a level cut."""


@dataclass(frozen=True, eq=False, slots=True)
class SectionForces:
    """Forces and moments in m sections, N and N·m."""

    axial_n: FloatArray  # (m,), along x, tension positive
    shear_n: FloatArray  # (m, 2), along y and z
    torsion_nm: FloatArray  # (m,), about x
    bending_nm: FloatArray  # (m, 2), about y, which pulls where z is positive, and z, which pulls where y is negative


def section_axes(normals: FloatArray) -> FloatArray:
    """Rotations (m, 3, 3) of sections with unit normals (m, 3) from the first body: their x, y and z are the columns.

    Where the cut is level, every direction in it is equally far from the vertical: z then points along the world's x,
    which is along the road.
    """
    x = np.asarray(normals, dtype=float)
    level = length(x[:, :2]) < _LEVEL_CUT
    steepest = np.where(level[:, None], (1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    y = unit(np.cross(steepest, x))
    return np.stack((x, y, np.cross(x, y)), axis=2)


def section_forces(axes: FloatArray, forces: FloatArray, moments: FloatArray) -> SectionForces:
    """Forces and moments of connections in the axes (m, 3, 3) of their sections.

    Those given, (m, 3), are on the first body of each connection, about its own point, in the axes of the world.
    """
    force, moment = transformed_back(axes, forces), transformed_back(axes, moments)
    return SectionForces(force[:, 0], force[:, 1:], moment[:, 0], moment[:, 1:])


SAME_WAY = 0.3
"""Cosine above which two faces of a shard look the same way. The faces of a shard lie at all angles about it; those
within 73° of a direction are what a cut across that direction goes through."""


@dataclass(frozen=True, eq=False, slots=True)
class ConnectedFaces:
    """The faces between bodies that m connections stand for, as they were built."""

    pairs: IntArray  # (m, 2), connected bodies
    points_m: FloatArray  # (m, 3), middles of the faces
    normals: FloatArray  # (m, 3), unit vectors from the first body to the second
    areas_m2: FloatArray  # (m,)
    second_moments_m4: FloatArray  # (m, 2, 2), in the axes of each section


@dataclass(frozen=True, eq=False, slots=True)
class ConnectionLoads:
    """Loads of m connections on their first bodies, about the connections' points, in the axes of the world."""

    forces_n: FloatArray  # (m, 3)
    moments_nm: FloatArray
    points_m: FloatArray

    def in_sections(self, rows: IntArray, axes: FloatArray) -> SectionForces:
        """Loads of some connections (r,) in the axes (r, 3, 3) of their sections."""
        return section_forces(axes, self.forces_n[rows], self.moments_nm[rows])


@dataclass(frozen=True, eq=False, slots=True)
class SectionCuts:
    """Two cuts for each of m connections, through its first and through its second shard."""

    connected: ConnectedFaces
    starts: IntArray  # (2 m + 1,), first face of each cut, first all cuts through first shards; last the count of faces
    faces: IntArray  # (e,), connections whose faces are in a cut
    signs: FloatArray  # (e,), 1 where the load of that connection's first body counts, -1 where its opposite does
    cosines: FloatArray  # (e,), between the normals of a face and of its cut

    @classmethod
    def through(cls, connected: ConnectedFaces, is_shard: BoolArray) -> SectionCuts:
        """The cuts of connections between n bodies.

        `is_shard` (n,): bodies with faces all around. Through any other, such as the ground, a cut has one face only.
        """
        count = len(connected.pairs)
        # A half is a connection as one of its bodies sees it: first the first bodies' halves, then the second bodies'.
        body = connected.pairs.T.ravel()
        outwards = np.concatenate((connected.normals, -connected.normals))
        order = np.argsort(body, kind="stable")
        per_body = np.bincount(body, minlength=len(is_shard))
        first_of_body = np.cumsum(per_body) - per_body
        cut, position = ranges(first_of_body[body], per_body[body])
        half = order[position]
        cosines = dot(outwards[cut], outwards[half])
        own = cut == half
        together = own | (is_shard[body[cut]] & (cosines > SAME_WAY) & (connected.areas_m2[half % count] > 0.0))
        cut, half, cosines = cut[together], half[together], cosines[together]
        starts = np.searchsorted(cut, np.arange(2 * count + 1))
        signs = np.where((cut < count) == (half < count), 1.0, -1.0)
        return cls(connected, starts, half % count, signs, cosines)


def worst_around(pairs: IntArray, used: FloatArray, is_shard: BoolArray) -> BoolArray:
    """Which connections (k,) between pairs (k, 2) use more than any other that shares a shard with them.

    `used` (k,) are utilisations. `is_shard` (n,): connections to any other body, such as the ground, do not compete
    over it.
    """
    most = np.full(len(is_shard), -np.inf)
    np.maximum.at(most, pairs.ravel(), np.repeat(used, 2))
    most[~is_shard] = -np.inf
    return used >= most[pairs].max(axis=1)
