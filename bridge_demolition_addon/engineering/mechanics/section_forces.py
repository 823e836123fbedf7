"""Forces and moments of connections in the axes of the sections they stand for: axial, shear, torsion, bending.

A connection is a cut between two bodies. Its x axis is the normal of the cut, from the first body to the second; y and
z lie in the cut, y level and z as steep as can be. Forces and moments are those on the first body, and so act on the
face that looks along x: they count positive along the positive axes, and an axial force is positive in tension.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from ..geometry.vectors import length, transformed_back, unit

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
