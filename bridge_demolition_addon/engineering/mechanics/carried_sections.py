"""Sections of connections that turn with bodies, and the loads in them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, IntArray
from ..geometry.rotations import carried_points
from ..geometry.vectors import product
from .forces import moments_at
from .section_forces import SectionForces, section_forces


@dataclass(frozen=True, eq=False, slots=True)
class CarriedSections:
    """Sections of m connections, each fixed in the body that its load is known on, and in the axes of that body."""

    bodies: IntArray  # (m,)
    signs: FloatArray  # (m,), 1 where that is the first body of the connection, -1 where it is the second
    points_m: FloatArray  # (m, 3), of the connections, from the centres of the bodies
    axes: FloatArray  # (m, 3, 3), of the sections, as columns

    def forces(
        self, rows: IntArray, loads: FloatArray, positions_m: FloatArray, rotations: FloatArray
    ) -> SectionForces:
        """Return the loads of connections (r,) in their own axes.

        Loads (6, m) are forces, and moments about the centres of the bodies, at positions (3, n) in rotations
        (3, 3, n).
        """
        bodies, sign = self.bodies[rows], self.signs[rows, None]
        turned = np.moveaxis(rotations.take(bodies, axis=-1), -1, 0)
        centres, loads = positions_m.take(bodies, axis=-1).T, loads.take(rows, axis=-1).T
        force, torque = loads[:, :3], loads[:, 3:]
        points = carried_points(self.points_m[rows], centres, turned)
        moment = moments_at(points, force, torque, centres)
        return section_forces(product(turned, self.axes[rows]), sign * force, sign * moment)
