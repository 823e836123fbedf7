"""Stiffness of connections: that of the faces that shards share, as far as the two shards extend behind them.

Between two Voronoi cells, springs with the same stiffness along a face as across it, E by the distance between the
cells' points, deform evenly under every even stress, however irregular the cells are: J. E. Bolander and S. Saito
(1998), Fracture analyses using spring networks with random geometry, Engineering Fracture Mechanics 61, 569-591. That
stands for a material without Poisson's effect. Of two cells that turn against each other, only a part is the bending of
the body that they are cut from; over all directions of faces it is two thirds, and their turning counts as much.

Where one shard is as deep as its member, its face is the whole section: there the stiffness along it is κ G, as in a
beam of Timoshenko, and all turning is bending.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...errors import ScenarioError
from ..arrays import BoolArray, FloatArray
from .joint_rows import matrix_products, transposed

SHEAR_FACTOR = 5.0 / 6.0
"""Share of a rectangular section that resists shear evenly, κ (E. Reissner 1945)."""

DAMPING_RATIO = 0.05
"""Damping of concrete structures near their strength, where none is given: EN 1998-1:2004, 3.2.2.2 (3)."""

BENDING_SHARE = 2.0 / 3.0
"""Part of the turning of two cells against each other that is bending: ⟨nx² z²⟩ / ⟨nx² (x² + z²)⟩ over all directions
of normals n, of round faces that a bar along x is cut into, which bends about y."""

SHORTEST = 0.02
"""Part of the root of a face's area that the distance of two points is at least taken for."""


@dataclass(frozen=True, slots=True)
class ElasticModuli:
    """Modulus of elasticity and Poisson's ratio of a material."""

    young_pa: float
    poisson: float

    def __post_init__(self) -> None:
        if not (np.isfinite(self.young_pa) and self.young_pa > 0.0):
            raise ScenarioError(f"young_pa is {self.young_pa}: expected a number above 0 (Pa)")
        if not 0.0 <= self.poisson < 0.5:
            raise ScenarioError(f"poisson is {self.poisson}: expected 0 or more and less than 0.5")

    @property
    def shear_pa(self) -> float:
        """Shear modulus, G = E / (2 (1 + ν))."""
        return self.young_pa / (2.0 * (1.0 + self.poisson))


_CONCRETE = ElasticModuli(34e9, 0.2)

ELASTIC_MODULI = {
    "concrete": _CONCRETE,
    "reinforced concrete column": _CONCRETE,
    "reinforced concrete slab": _CONCRETE,
    "reinforced concrete wall": _CONCRETE,
    "masonry": ElasticModuli(10e9, 0.25),
    "steel": ElasticModuli(210e9, 0.3),
}
"""Moduli to start from where none were measured, for the materials with strengths.

Concrete is C35/45, whose compressive strength those materials have: EN 1992-1-1:2004, table 3.1, and 3.1.3 (4) for the
ratio of uncracked concrete. Masonry: 1000 times its compressive strength, and a shear modulus of 40 % of that, EN
1996-1-1:2005, 3.7.2 (2) and 3.7.3. Steel: EN 1993-1-1:2005, 3.2.6.
"""


@dataclass(frozen=True, slots=True, eq=False)
class SectionStiffness:
    """Stiffness of m connections in the axes of their sections (`mechanics.section_forces`)."""

    axial_n_m: FloatArray  # (m,), against shifts along x
    shear_n_m: FloatArray  # (m, 2), against shifts along y and z
    torsion_nm: FloatArray  # (m,), against turns about x, N·m/rad
    bending_nm: FloatArray  # (m, 2, 2), against turns about y and z

    def against_shifts(self) -> FloatArray:
        """Return the matrices (3, 3, m) that make forces of shifts."""
        matrices = np.zeros((3, 3, len(self.axial_n_m)))
        matrices[0, 0], matrices[1, 1], matrices[2, 2] = self.axial_n_m, *self.shear_n_m.T
        return matrices

    def against_turns(self) -> FloatArray:
        """Return the matrices (3, 3, m) that make moments of turns."""
        matrices = np.zeros((3, 3, len(self.axial_n_m)))
        matrices[0, 0] = self.torsion_nm
        matrices[1:, 1:] = np.moveaxis(self.bending_nm, 0, 2)
        return matrices


def section_stiffness(
    young_pa: FloatArray,
    shear_pa: FloatArray,
    areas_m2: FloatArray,
    second_moments_m4: FloatArray,
    lengths_m: FloatArray,
    is_deep: BoolArray,
) -> SectionStiffness:
    """Return the stiffness of m connections by faces with areas (m,) and second moments (m, 2, 2) in their axes.

    `lengths_m` (m,) are between the shards' points along the normal; `young_pa` and `shear_pa` (m,) are the moduli
    there. `is_deep` (m, 2) says whether the shards are as deep as their members along y, and along z.
    """
    lengths = np.maximum(lengths_m, SHORTEST * np.sqrt(areas_m2))
    along = np.where(is_deep, (SHEAR_FACTOR * shear_pa)[:, None], young_pa[:, None])
    about_y, about_z = second_moments_m4[:, 0, 0], second_moments_m4[:, 1, 1]  # ∫ z² dA, ∫ y² dA
    share = np.where(is_deep, 1.0, BENDING_SHARE)[:, ::-1]  # about y counts the depth along z
    twisting = along[:, 0] * share[:, 0] * about_y + along[:, 1] * share[:, 1] * about_z
    twisting = np.where(is_deep.all(axis=1), shear_pa * torsion_constants(areas_m2, second_moments_m4), twisting)
    return SectionStiffness(
        axial_n_m=young_pa * areas_m2 / lengths,
        shear_n_m=along * (areas_m2 / lengths)[:, None],
        torsion_nm=twisting / lengths,
        bending_nm=second_moments_m4
        * np.sqrt(share[:, :, None] * share[:, None])
        * (young_pa / lengths)[:, None, None],
    )


def torsion_constants(areas_m2: FloatArray, second_moments_m4: FloatArray) -> FloatArray:
    """Return the torsion constants (m,) of the rectangles with these areas and second moments, m⁴.

    W. C. Young and R. G. Budynas (2002), Roark's Formulas for Stress and Strain, 7th edition, table 10.1, case 4, which
    is within 0.6 % of Saint-Venant's series.
    """
    one, beside, other = second_moments_m4[:, 0, 0], second_moments_m4[:, 0, 1], second_moments_m4[:, 1, 1]
    mean, spread = (one + other) / 2.0, np.sqrt(np.square((one - other) / 2.0) + np.square(beside))
    area = np.where(areas_m2 > 0.0, areas_m2, 1.0)
    shorter, longer = (np.sqrt(12.0 * np.maximum(moment, 0.0) / area) for moment in (mean - spread, mean + spread))
    slender = np.divide(shorter, longer, out=np.zeros_like(shorter), where=longer > 0.0)
    square = slender * slender
    constants: FloatArray = (
        longer * shorter * shorter * shorter * (1.0 / 3.0 - 0.21 * slender * (1.0 - square * square / 12.0))
    )
    return constants


def in_frames(stiffness: SectionStiffness, sections: FloatArray, held: BoolArray) -> FloatArray:
    """Return stiffness (2, 3, 3, m) in the axes of frames, from that in sections (3, 3, m), whose axes are the columns.

    Rows that are not `held` (6, m) resist nothing, and the others resist no more for that.
    """
    matrices = np.stack((stiffness.against_shifts(), stiffness.against_turns()))
    turned = [matrix_products(matrix_products(sections, matrix), transposed(sections)) for matrix in matrices]
    for matrix, rows in zip(turned, (held[:3], held[3:]), strict=True):
        for row in range(3):
            _let_go(matrix, row, ~rows[row])
    return np.stack(turned)


def _let_go(matrix: FloatArray, row: int, free: BoolArray) -> None:
    """Take the stiffness of one row out of matrices (3, 3, m), where it is free (m,): a static condensation."""
    column = matrix[:, row].copy()
    pivot = np.where(column[row] > 0.0, column[row], 1.0)
    taken = column[:, None] * column[None] / pivot
    matrix -= np.where(free, taken, 0.0)
    matrix[row] = np.where(free, 0.0, matrix[row])
    matrix[:, row] = np.where(free, 0.0, matrix[:, row])
