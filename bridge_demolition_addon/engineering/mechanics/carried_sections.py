"""Sections of connections that turn with bodies, and the loads in them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays import FloatArray, IntArray
from ..geometry.rotations import carried_axes, carried_points
from ..geometry.vectors import by_component, length, product
from .compiled_mechanics import overload_loops
from .forces import moments_at
from .packed_faces import CARRIED, pack
from .section_cuts import ConnectionLoads
from .section_forces import SectionForces, section_forces


@dataclass(frozen=True, eq=False)
class CarriedSections:
    """Sections of m connections, each fixed in the body that its load is known on, and in the axes of that body."""

    bodies: IntArray  # (m,)
    signs: FloatArray  # (m,), 1 where that is the first body of the connection, -1 where it is the second
    points_m: FloatArray  # (m, 3), of the connections, from the centres of the bodies
    axes: FloatArray  # (m, 3, 3), of the sections, as columns

    @cached_property
    def lever_arms_m(self) -> FloatArray:
        """Distances (m,) of the connections from the centres of the bodies."""
        return length(self.points_m)

    @cached_property
    def packed(self) -> np.ndarray:
        """All of it (m,), as compiled loops take it."""
        return pack(CARRIED, body=self.bodies, sign=self.signs, point=self.points_m, axes=self.axes)

    def forces(
        self, rows: IntArray, loads: FloatArray, positions_m: FloatArray, rotations: FloatArray
    ) -> SectionForces:
        """Return the loads of connections (r,) in their own axes.

        Loads (6, m) are forces, and moments about the centres of the bodies, at positions (3, n) in rotations
        (3, 3, n).
        """
        bodies = self.bodies[rows]
        turned = rotations.take(bodies, axis=-1).transpose(2, 0, 1)
        centres, loads = positions_m.take(bodies, axis=-1).T, loads.take(rows, axis=-1).T
        sections = CarriedSections(bodies, self.signs[rows], self.points_m[rows], self.axes[rows])
        carried = sections._about_points(loads, centres, turned)
        return section_forces(product(turned, sections.axes), carried.forces_n, carried.moments_nm)

    def loads(self, loads: FloatArray, positions_m: FloatArray, rotations: FloatArray) -> ConnectionLoads:
        """Return the loads of all connections after each of s sub-steps, as arrays (s, m, 3).

        Loads (6, s, m), positions (3, s, n) and rotations (3, 3, s, n) are as those of `forces`. Each component lies
        together in memory.
        """
        loops = overload_loops()
        if loops is not None:
            found = loops.carried_loads(loads, positions_m, rotations, self.bodies, self.signs, self.points_m)
            return ConnectionLoads(*(components.transpose(1, 2, 0) for components in found))
        turned = rotations.take(self.bodies, axis=-1).transpose(2, 3, 0, 1)
        centres = positions_m.take(self.bodies, axis=-1).transpose(1, 2, 0)
        sections = CarriedSections(self.bodies, self.signs, by_component(*self.points_m.T), self.axes)
        return sections._about_points(loads.transpose(1, 2, 0), centres, turned)

    def loads_at_once(self, loads: FloatArray, positions_m: FloatArray, rotations: FloatArray) -> ConnectionLoads:
        """Return the loads of all connections at one time, as arrays (m, 3); all is given as `forces` takes it."""
        found = self.loads(loads[:, None], positions_m[:, None], rotations[:, :, None])
        return ConnectionLoads(found.forces_n[0], found.moments_nm[0], found.points_m[0])

    def carried_axes(self, rows: IntArray, rotations: FloatArray) -> FloatArray:
        """Return the axes (r, 3, 3) of connections (r,), as columns, under rotations (3, 3, n) of the bodies."""
        return carried_axes(self.axes[rows], self.bodies[rows], rotations.transpose(2, 0, 1))

    def _about_points(self, loads: FloatArray, centres_m: FloatArray, rotations: FloatArray) -> ConnectionLoads:
        """Loads on first bodies, about the connections, from those (..., m, 6) about centres (..., m, 3)."""
        force, torque = loads[..., :3], loads[..., 3:]
        points = carried_points(self.points_m, centres_m, rotations)
        moment, sign = moments_at(points, force, torque, centres_m), self.signs[:, None]
        return ConnectionLoads(sign * force, sign * moment, points)
