# SPDX-License-Identifier: GPL-3.0-or-later
"""Overloaded connections by numpy: what the compiled core has for loads that turn with bodies, and for cuts."""

from __future__ import annotations

import numpy as np

from bridge_demolition_addon.engineering.geometry.proximity import ranges
from bridge_demolition_addon.engineering.geometry.vectors import (
    carried_axes,
    carried_points,
    cross_by_component,
    product,
)
from bridge_demolition_addon.engineering.mechanics.carried_sections import CarriedSections
from bridge_demolition_addon.engineering.mechanics.section_cuts import (
    ConnectedFaces,
    ConnectionLoads,
    SectionCuts,
    SectionForces,
    section_forces,
)
from bridge_demolition_addon.engineering.mechanics.strength import Sections, Strength, strength_at

from .strength import cut_loads, rectangular_sections, utilisation


def carried_loads(
    sections: CarriedSections, loads: np.ndarray, positions_m: np.ndarray, rotations: np.ndarray
) -> ConnectionLoads:
    """Return the loads (s, m, 3) of all connections about their points."""
    turned = rotations.take(sections.bodies, axis=-1).transpose(2, 3, 0, 1)
    centres = positions_m.take(sections.bodies, axis=-1).transpose(1, 2, 0)
    force, torque = np.split(loads.transpose(1, 2, 0), 2, axis=-1)
    points = carried_points(sections.points_m, centres, turned)
    moment, sign = torque - cross_by_component(points - centres, force), sections.signs[:, None]
    return ConnectionLoads(sign * force, sign * moment, points)


def loads_at_once(sections: CarriedSections, loads: np.ndarray, *places: np.ndarray) -> ConnectionLoads:
    """Return the loads (m, 3) of all connections at one time."""
    positions_m, rotations = places
    found = carried_loads(sections, loads[:, None], positions_m[:, None], rotations[:, :, None])
    return ConnectionLoads(found.forces_n[0], found.moments_nm[0], found.points_m[0])


def section_axes_of(sections: CarriedSections, rows: np.ndarray, rotations: np.ndarray) -> np.ndarray:
    """Return the axes (r, 3, 3) of connections (r,), as columns, under rotations (3, 3, n) of the bodies."""
    return carried_axes(sections.axes[rows], sections.bodies[rows], rotations.transpose(2, 0, 1))


def forces_in_sections(sections: CarriedSections, loads: np.ndarray, *places: np.ndarray) -> SectionForces:
    """Return the loads of all connections in their own axes."""
    carried, turned = loads_at_once(sections, loads, *places), places[1].transpose(2, 0, 1)[sections.bodies]
    return section_forces(product(turned, sections.axes), carried.forces_n, carried.moments_nm)


def cut_sections(
    cuts: SectionCuts, rows: np.ndarray, intact: np.ndarray, loads: ConnectionLoads, axes: np.ndarray
) -> tuple[SectionForces, np.ndarray, np.ndarray]:
    """Return loads, areas and second moments (2 k) of the cuts of intact connections (k,), first of first bodies."""
    chosen = np.concatenate((rows, rows + len(intact)))
    owners, entries = ranges(cuts.starts[chosen], np.diff(cuts.starts)[chosen])
    holds = intact[cuts.faces[entries]]
    owners, entries = owners[holds], entries[holds]
    faces, signs, cosines = cuts.faces[entries], cuts.signs[entries], cuts.cosines[entries]
    return cut_loads(cuts.connected, loads, owners, faces, signs, cosines, np.concatenate((axes, axes)))


class ReferenceOverloads:
    """Judges connections as `Overloads` does by cuts."""

    def __init__(
        self,
        faces: ConnectedFaces,
        moves: np.ndarray,
        strength: Strength,
        pressed: np.ndarray | None = None,
        friction: np.ndarray | None = None,
    ):
        self._sections = rectangular_sections(faces.areas_m2, faces.second_moments_m4)
        self._cuts, self._strength = SectionCuts.through(faces, moves), strength
        self._pressed, self._friction = pressed, friction

    def over_alone(
        self, intact: np.ndarray, sections: CarriedSections, loads: np.ndarray, *places_and_left: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return which connections are overloaded alone, whatever bound may leave them out, and their utilisations."""
        *places, left = places_and_left
        rows = np.flatnonzero(intact)
        of_all = forces_in_sections(sections, loads, *places)
        used = self._used(np.arange(len(intact)), of_all, self._sections)[rows] / left[rows]
        return rows[used > 1.0], used[used > 1.0]

    def in_cuts(self, rows: np.ndarray, loads: ConnectionLoads, axes: np.ndarray, intact: np.ndarray) -> np.ndarray:
        """Return the mean utilisations (r,) of the cuts of some connections."""
        of_cuts, areas, second_moments = cut_sections(self._cuts, rows, intact, loads, axes)
        both = np.concatenate((rows, rows))
        used = self._used(both, of_cuts, rectangular_sections(areas, second_moments))
        return used.reshape(2, -1).mean(axis=0)

    def _used(self, rows: np.ndarray, forces: SectionForces, sections: Sections) -> np.ndarray:
        """Return the utilisations (r,) of sections by the strength of some connections."""
        strength = strength_at(self._strength, rows)
        if self._pressed is not None:
            names = ("compression_pa", "tension_pa", "shear_pa", "torsion_pa", "bending_pa")
            values = [np.broadcast_to(getattr(strength, name), len(rows)) for name in names]
            strength = Strength(self._pressed[rows] * values[0], *values[1:])
        return utilisation(forces, sections, strength, None if self._friction is None else self._friction[rows])

    def over_in_cuts(
        self, intact: np.ndarray, sections: CarriedSections, loads: np.ndarray, *places_and_left: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return which connections are overloaded alone and in cuts, and their utilisations in these."""
        *places, left = places_and_left
        rows, _ = self.over_alone(intact, sections, loads, *places_and_left)
        of_all, axes = loads_at_once(sections, loads, *places), section_axes_of(sections, rows, places[1])
        used = self.in_cuts(rows, of_all, axes, intact) / left[rows]
        return rows[used > 1.0], used[used > 1.0]
