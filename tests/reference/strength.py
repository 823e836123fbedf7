# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections, utilisations and loads of cuts by numpy: what the compiled core has."""

from __future__ import annotations

import numpy as np

from bridge_demolition_addon.engineering.geometry.vectors import (
    cross,
    length,
    transformed_back,
)
from bridge_demolition_addon.engineering.mechanics.section_cuts import (
    ConnectedFaces,
    ConnectionLoads,
    SectionForces,
    section_forces,
)
from bridge_demolition_addon.engineering.mechanics.strength import Sections, Strength

from .geometry import symmetric_eigenvectors_2d

ROUNDING = 1e-9
"""Largest difference of principal second moments of a square that was cut from a mesh, as a part of the larger."""


def rectangular_sections(areas: np.ndarray, second_moments: np.ndarray) -> Sections:
    """Return sections with areas (m,) and second moments (m, 2, 2) as the rectangles that have the same."""
    areas = np.where(np.asarray(areas) > 0.0, areas, np.nan)
    moments, directions = symmetric_eigenvectors_2d(second_moments)
    # Of squares, second moments are equal but for rounding, which alone would then turn the section.
    are_square = moments[:, 1] - moments[:, 0] <= ROUNDING * moments[:, 1]
    directions = np.where(are_square[:, None, None], np.eye(2), directions)
    sides = np.sqrt(12.0 * moments / areas[:, None])
    short, long = sides.T
    torsion_moduli = areas * short / (3.0 + 1.8 * short / long)
    return Sections(areas, directions, 2.0 * moments / sides, torsion_moduli)


def utilisation(
    forces: SectionForces, sections: Sections, strength: Strength, friction: np.ndarray | None = None
) -> np.ndarray:
    """Return the utilisation (m,) of each section."""
    axial = forces.axial_n / sections.areas_m2
    moments = transformed_back(sections.directions, forces.bending_nm)
    bending = (np.abs(moments) / sections.bending_moduli_m3).sum(axis=1)
    shear_pa = length(forces.shear_n) / sections.areas_m2
    if friction is not None:
        shear_pa = np.maximum(shear_pa + friction * np.minimum(axial, 0.0), 0.0)
    shear = shear_pa / strength.shear_pa
    shear += np.abs(forces.torsion_nm) / sections.torsion_moduli_m3 / strength.torsion_pa
    stretched = axial / np.where(axial > 0.0, strength.tension_pa, strength.bending_pa) + bending / strength.bending_pa
    pressed = (bending - axial) / strength.compression_pa
    return length(np.stack((np.maximum(stretched, pressed), shear), axis=-1))


def cut_loads(
    connected: ConnectedFaces,
    loads: ConnectionLoads,
    owners: np.ndarray,
    faces: np.ndarray,
    signs: np.ndarray,
    cosines: np.ndarray,
    axes: np.ndarray,
) -> tuple[SectionForces, np.ndarray, np.ndarray]:
    """Loads, areas (k,) and second moments (k, 2, 2) of k cuts through faces that stay plane together.

    `owners` and `faces` (e,): cuts, from 0 to k - 1 in order, and the connections whose faces are in them. `signs` and
    `cosines` (e,) are as in `SectionCuts`, `axes` (k, 3, 3) those of the cuts, as columns.
    """
    firsts = np.searchsorted(owners, np.arange(len(axes)))

    def total(values: np.ndarray) -> np.ndarray:
        return np.add.reduceat(values, firsts, axis=0) if len(values) else values[:0]

    shares, points = connected.areas_m2[faces] * cosines, loads.points_m[faces]
    cut_areas = total(shares)
    levers = points - (total(shares[:, None] * points) / cut_areas[:, None])[owners]
    pulls = signs[:, None] * loads.forces_n[faces]
    turns = signs[:, None] * loads.moments_nm[faces] + cross(levers, pulls)
    across = transformed_back(axes[owners], levers)[:, 1:]
    own = connected.second_moments_m4[faces] * cosines[:, None, None]
    cut_moments = total(own + shares[:, None, None] * _moved_axes(across))
    return section_forces(axes, total(pulls), total(turns)), cut_areas, cut_moments


def _moved_axes(across: np.ndarray) -> np.ndarray:
    """Second moments (e, 2, 2) of a unit of area by its distance (e, 2), y and z, from the axes."""
    y, z = across.T
    return np.stack((np.stack((z * z, -y * z), axis=1), np.stack((-y * z, y * y), axis=1)), axis=1)
