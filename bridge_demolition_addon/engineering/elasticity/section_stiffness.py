"""Stiffness of connections: that of the faces that shards share, as far as the two shards extend behind them.

Between two Voronoi cells, springs with the same stiffness along a face as across it, E by the distance between the
cells' points, deform evenly under every even stress, however irregular the cells are: J. E. Bolander and S. Saito
(1998), Fracture analyses using spring networks with random geometry, Engineering Fracture Mechanics 61, 569-591. That
stands for a material without Poisson's effect, which `member_shapes` brings in. By what part of a face its shards
resist turning, the shape of their member decides: `member_shapes`. Where one shard is as deep as its member, the
stiffness along the face is κ G, as in a beam of Timoshenko.

A spring half-way between two nodes that turns as E I / L and shifts as 1 / (L / G A + L³ / 12 E I) is the element of
Timoshenko's beam between them, exactly: J. S. Przemieniecki (1968), Theory of Matrix Structural Analysis, 5.6.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...errors import ScenarioError
from ..arrays import BoolArray, FloatArray, IntArray
from ..geometry.vectors import product
from .joint_rows import matrix_products, transposed
from .member_shapes import principal_moments

SHEAR_FACTOR = 5.0 / 6.0
"""Share of a rectangular section that resists shear evenly, κ (E. Reissner 1945)."""

DAMPING_RATIO = 0.05
"""Damping of concrete structures near their strength, where none is given: EN 1998-1:2004, 3.2.2.2 (3)."""

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
    """Stiffness of m connections in the axes of their sections (`mechanics.section_forces`).

    `matrices` (m, 6, 6) make forces, N, and moments, N·m, of shifts along x, y and z, m, and turns about them, rad.
    """

    matrices: FloatArray

    @classmethod
    def uncoupled(
        cls, axial_n_m: FloatArray, shear_n_m: FloatArray, torsion_nm: FloatArray, bending_nm: FloatArray
    ) -> SectionStiffness:
        """Return that of (m,) against shifts along x, (m, 2) along y and z, (m,) turns about x, (m, 2, 2) y and z."""
        matrices = np.zeros((len(axial_n_m), 6, 6))
        matrices[:, 0, 0], matrices[:, 1, 1], matrices[:, 2, 2] = axial_n_m, *shear_n_m.T
        matrices[:, 3, 3], matrices[:, 4:, 4:] = torsion_nm, bending_nm
        return cls(matrices)

    def __len__(self) -> int:
        return len(self.matrices)

    @property
    def axial_n_m(self) -> FloatArray:
        """Stiffness (m,) against shifts along x, N/m."""
        return self.matrices[:, 0, 0]

    def only(self, rows: IntArray) -> SectionStiffness:
        """Return the stiffness of some connections (r,)."""
        return SectionStiffness(self.matrices[rows])


def section_stiffness(
    young_pa: FloatArray,
    shear_pa: FloatArray,
    areas_m2: FloatArray,
    lengths_m: FloatArray,
    is_deep: BoolArray,
    turning_m4: FloatArray,
    levers_m: FloatArray | None = None,
    slips_m_n: FloatArray | None = None,
    moduli_pa: FloatArray | None = None,
) -> SectionStiffness:
    """Return the stiffness of connections by faces.

    Parameters
    ----------
    young_pa, shear_pa : (m,) float
        Moduli of the material between the two points.
    areas_m2 : (m,) float
        Of the faces.
    lengths_m : (m,) float
        Between the two points, along the normal.
    is_deep : (m, 2) bool
        Whether the shards are as deep as their members along y, and along z.
    turning_m4 : (m, 3, 3) float
        Second moments with which faces resist turning, in the axes of the sections.
    levers_m : (m, 3, 3) float, optional
        By how much shifts are larger for each turn, where they are not measured at the middle of the face.
    slips_m_n : (m, 2) float, optional
        How much farther shards shift along y and z, m/N.
    moduli_pa : (m, 3, 3) float, optional
        With which faces resist shifts along x, y and z; `young_pa` in all directions where it is not given.
    """
    lengths = np.maximum(lengths_m, SHORTEST * np.sqrt(areas_m2))
    if moduli_pa is None:
        moduli_pa = young_pa[:, None, None] * np.eye(3)
    matrices = np.zeros((len(lengths), 6, 6))
    matrices[:, :3, :3] = moduli_pa * (areas_m2 / lengths)[:, None, None]
    for row in (1, 2):
        deep = is_deep[:, row - 1]
        along = np.where(deep, SHEAR_FACTOR * shear_pa * areas_m2 / lengths, matrices[:, row, row])
        matrices[deep, row, :3] = matrices[deep, :3, row] = 0.0
        slips = 0.0 if slips_m_n is None else slips_m_n[:, row - 1]
        matrices[:, row, row] = along / (1.0 + along * slips)
    matrices[:, 3:, 3:] = turning_m4 * (young_pa / lengths)[:, None, None]
    if levers_m is not None:
        by_turns = product(matrices[:, :3, :3], levers_m)
        matrices[:, :3, 3:], matrices[:, 3:, :3] = by_turns, np.swapaxes(by_turns, 1, 2)
        matrices[:, 3:, 3:] += product(np.swapaxes(levers_m, 1, 2), by_turns)
    return SectionStiffness(matrices)


def whole_section_stiffness(
    young_pa: FloatArray,
    shear_pa: FloatArray,
    areas_m2: FloatArray,
    second_moments_m4: FloatArray,
    lengths_m: FloatArray,
) -> SectionStiffness:
    """Return the stiffness of connections by faces that are the sections of a beam.

    Moduli, areas and lengths (m,) are those of `section_stiffness`; second moments about y and z are (m, 2, 2).
    """
    turning = whole_section_turning(areas_m2, second_moments_m4, shear_pa / young_pa)
    is_deep = np.ones((len(areas_m2), 2), bool)
    return section_stiffness(young_pa, shear_pa, areas_m2, lengths_m, is_deep, turning)


def whole_section_turning(
    areas_m2: FloatArray, second_moments_m4: FloatArray, shear_over_young: FloatArray
) -> FloatArray:
    """Return the second moments (m, 3, 3) with which faces resist turning that are whole sections of their members.

    Their second moments about y and z are (m, 2, 2).
    """
    turning = np.zeros((len(areas_m2), 3, 3))
    turning[:, 0, 0] = shear_over_young * torsion_constants(areas_m2, second_moments_m4)
    turning[:, 1:, 1:] = second_moments_m4
    return turning


def torsion_constants(areas_m2: FloatArray, second_moments_m4: FloatArray) -> FloatArray:
    """Return the torsion constants (m,) of the rectangles with these areas and second moments, m⁴.

    W. C. Young and R. G. Budynas (2002), Roark's Formulas for Stress and Strain, 7th edition, table 10.1, case 4, which
    is within 0.6 % of Saint-Venant's series.
    """
    area = np.where(areas_m2 > 0.0, areas_m2, 1.0)
    shorter, longer = (np.sqrt(12.0 * moment / area) for moment in principal_moments(second_moments_m4))
    slender = np.divide(shorter, longer, out=np.zeros_like(shorter), where=longer > 0.0)
    square = slender * slender
    constants: FloatArray = (
        longer * shorter * shorter * shorter * (1.0 / 3.0 - 0.21 * slender * (1.0 - square * square / 12.0))
    )
    return constants


def in_frames(stiffness: SectionStiffness, sections: FloatArray, held: BoolArray) -> FloatArray:
    """Return stiffness (6, 6, m) in the axes of frames, from that in sections (3, 3, m), whose axes are the columns.

    Rows that are not held (6, m) resist nothing, and the others resist no more for that.
    """
    own = np.moveaxis(stiffness.matrices, 0, -1)
    turned = np.empty(own.shape)
    for rows in (slice(3), slice(3, 6)):
        for columns in (slice(3), slice(3, 6)):
            turned[rows, columns] = matrix_products(matrix_products(sections, own[rows, columns]), transposed(sections))
    for row in range(6):
        _let_go(turned, row, ~held[row])
    return turned


def _let_go(matrix: FloatArray, row: int, free: BoolArray) -> None:
    """Take the stiffness of one row out of matrices (6, 6, m), where it is free (m,): a static condensation."""
    column = matrix[:, row].copy()
    pivot = np.where(column[row] > 0.0, column[row], 1.0)
    taken = column[:, None] * column[None] / pivot
    matrix -= np.where(free, taken, 0.0)
    matrix[row] = np.where(free, 0.0, matrix[row])
    matrix[:, row] = np.where(free, 0.0, matrix[:, row])


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
