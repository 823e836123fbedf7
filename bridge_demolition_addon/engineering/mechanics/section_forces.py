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
    """Forces and moments in m sections.

    Attributes
    ----------
    axial_n : (m,) float
        Along x, tension positive, N.
    shear_n : (m, 2) float
        Along y and z, N.
    torsion_nm : (m,) float
        About x, N·m.
    bending_nm : (m, 2) float
        About y and z, N·m. About y it pulls where z is positive, about z where y is negative.
    """

    axial_n: FloatArray
    shear_n: FloatArray
    torsion_nm: FloatArray
    bending_nm: FloatArray


def section_axes(normals: FloatArray) -> FloatArray:
    """Axes of sections in the axes of the world.

    Where the cut is level, every direction in it is equally far from the vertical: z then points along the world's x,
    which is along the road.

    Parameters
    ----------
    normals : (m, 3) float
        Unit vectors from the first body to the second.

    Returns
    -------
    (m, 3, 3) float
        Rotations: x, y and z of each section are its columns.
    """
    x = np.asarray(normals, dtype=float)
    level = length(x[:, :2]) < _LEVEL_CUT
    steepest = np.where(level[:, None], (1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    y = unit(np.cross(steepest, x))
    return np.stack((x, y, np.cross(x, y)), axis=2)


def section_forces(axes: FloatArray, forces: FloatArray, moments: FloatArray) -> SectionForces:
    """Forces and moments of connections in the axes of their sections.

    Parameters
    ----------
    axes : (m, 3, 3) float
        From `section_axes` or `rotations.carried_axes`.
    forces, moments : (m, 3) float
        On the first body of each connection, about the connection's own point, in the axes of the world, N and N·m.
    """
    force, moment = (transformed_back(axes, each) for each in (forces, moments))
    return SectionForces(force[:, 0], force[:, 1:], moment[:, 0], moment[:, 1:])
