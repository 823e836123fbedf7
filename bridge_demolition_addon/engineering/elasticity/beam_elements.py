"""Joints between two rigid bodies that make them an element of a beam, however long it is.

A spring half-way between two nodes that turns as E I / L and shifts as 1 / (L / G A + L³ / 12 E I) is the element of
Timoshenko's beam between them, exactly: J. S. Przemieniecki (1968), Theory of Matrix Structural Analysis, 5.6.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from ..geometry.vectors import product
from .section_stiffness import SHEAR_FACTOR, ElasticModuli, torsion_constants


@dataclass(frozen=True, slots=True)
class BeamSection:
    """Section of a beam along x: area, second moments about y and z, torsion constant, and areas in shear."""

    area_m2: float
    about_y_m4: float
    about_z_m4: float
    torsion_m4: float
    shear_y_m2: float
    shear_z_m2: float

    @classmethod
    def rectangle(cls, width_m: float, depth_m: float) -> BeamSection:
        """Return that of a bar, wide along y and deep along z."""
        area = width_m * depth_m
        about_y, about_z = area * depth_m * depth_m / 12.0, area * width_m * width_m / 12.0
        torsion = float(torsion_constants(np.array([area]), np.diag([about_y, about_z])[None])[0])
        return cls(area, about_y, about_z, torsion, SHEAR_FACTOR * area, SHEAR_FACTOR * area)

    def joint(self, moduli: ElasticModuli, length_m: float) -> FloatArray:
        """Return the stiffness (6, 6) half-way of an element against shifts along x, y and z and turns about them."""
        young, shear = moduli.young_pa / length_m, moduli.shear_pa / length_m
        bending = np.array([self.about_y_m4, self.about_z_m4])
        bent = length_m * length_m / (12.0 * young * bending)
        along_z, along_y = 1.0 / (1.0 / (shear * np.array([self.shear_z_m2, self.shear_y_m2])) + bent)
        return np.diag([young * self.area_m2, along_y, along_z, shear * self.torsion_m4, *(young * bending)])


def web_torsion_m4(web_m: float, depth_m: float, flange_m: float) -> float:
    """Return the torsion constant of a web below a flange of a thickness, and of where the two meet.

    W. C. Young and R. G. Budynas (2002), Roark's Formulas for Stress and Strain, 7th edition, table 10.1, section T
    without fillets. The web is half of a rectangle twice as deep.
    """
    twice = BeamSection.rectangle(web_m, 2.0 * depth_m).torsion_m4
    met = min(web_m, 2.0 * flange_m)
    circle = flange_m + met * met / (4.0 * flange_m)
    return 0.5 * twice + 0.15 * min(web_m, flange_m) / max(web_m, flange_m) * circle * circle * circle * circle


def measured_at(matrix: FloatArray, away_m: FloatArray) -> FloatArray:
    """Return the stiffness (6, 6) for motions at a point, of one whose motions are those at a point away (3,) of it."""
    x, y, z = away_m.tolist()
    carried = np.eye(6)
    carried[:3, 3:] = [(0.0, z, -y), (-z, 0.0, x), (y, -x, 0.0)]
    return product(product(carried.T, matrix), carried)
