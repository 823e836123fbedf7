"""Kinds of connections, and when one breaks: strengths by area, so that it does not matter how finely a bridge is cut.

A connection stands for the section it was cut with. Its axial force, shear, torsion and bending give stresses in that
section, and these are compared with the strengths of the material together. A broken connection may go on as a ductile
one, such as the reinforcement across a crack, until it has opened too far.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from enum import StrEnum

import numpy as np

from ...errors import ScenarioError
from ..arrays import FloatArray, IntArray
from ..core.calls import call
from ..core.structs import Doubles
from ..elasticity.section_stiffness import ElasticModuli
from ..geometry.vectors import length
from .carried_sections import RESISTING, pack
from .section_cuts import SectionForces

NEWTON_PER_SQUARE_MILLIMETRE = 1e6
"""1 N/mm² in Pa."""


@dataclass(frozen=True, eq=False, slots=True)
class Strength:
    """Stresses at which a material breaks, each a positive number, or an array (m,) with one for every connection."""

    compression_pa: float | FloatArray  # axial force by area
    tension_pa: float | FloatArray
    shear_pa: float | FloatArray  # mean over the section, which codes of practice give their shear strengths for
    torsion_pa: float | FloatArray  # moment by torsion modulus: shear stress at the edge of an uncracked section
    bending_pa: float | FloatArray  # moment by elastic section modulus: stress at the edge of an uncracked section

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            least, most = (value.min(), value.max()) if isinstance(value, np.ndarray) and value.size else (value, value)
            if not np.all((np.asarray(least) > 0.0) & (np.asarray(most) < np.inf)):
                raise ScenarioError(f"{field.name} of a strength is {value}: expected a positive number")

    @classmethod
    def in_n_mm2(cls, compression: float, tension: float, shear: float, torsion: float, bending: float) -> Strength:
        """Strength from numbers in N/mm²."""
        return cls(*(NEWTON_PER_SQUARE_MILLIMETRE * value for value in (compression, tension, shear, torsion, bending)))

    def times(self, factor: float) -> Strength:
        """All strengths times a factor above 0; with a factor of 1 the same object."""
        return self if factor == 1.0 else Strength(*(factor * getattr(self, field.name) for field in fields(self)))


MATERIALS = {
    "concrete": Strength.in_n_mm2(compression=35.0, tension=3.5, shear=0.9, torsion=3.5, bending=3.5),
    "reinforced concrete column": Strength.in_n_mm2(
        compression=35.0, tension=5.2, shear=1.55, torsion=5.2, bending=12.6
    ),
    "reinforced concrete slab": Strength.in_n_mm2(compression=35.0, tension=5.2, shear=0.9, torsion=5.2, bending=12.6),
    "reinforced concrete wall": Strength.in_n_mm2(compression=35.0, tension=5.2, shear=0.9, torsion=5.2, bending=12.6),
    "masonry": Strength.in_n_mm2(compression=10.0, tension=0.2, shear=0.5, torsion=0.2, bending=0.1),
    "steel": Strength.in_n_mm2(compression=235.0, tension=235.0, shear=135.7, torsion=135.7, bending=235.0),
}
"""Strengths to start from where none were measured.

Compression, tension and shear of concrete and masonry are those of the Bullet Constraints Builder 3.6.5 (K. Kostack).
Torsion, for which it has none, is tension: a section that is twisted cracks where its shear stress, which in pure shear
is the principal tensile stress, gets to the tensile strength (EN 1992-1-1:2004, 6.3.2 (5)).
Two of its numbers are not stresses in N/mm² and are not taken as such:

- It gives bending as moment by area, in N·m/mm², which is a stress for one depth of section only. Here, plain concrete
  bends as it is pulled, the lower bound of EN 1992-1-1:2004, equation 3.23. Reinforced concrete has its yield moment:
  with half of the steel at each edge, M / W = 3 × steel ratio × yield stress × lever arm / depth, which is
  3 × 0.0105 × 500 × 0.8 for the same bars that give the 5.2 N/mm² of tension. Masonry has the flexural strength of
  EN 1996-1-1:2005, 3.6.4, of clay units in general-purpose mortar along the bed joints.
- Its shear of columns, 155, takes the ratio of links in per cent for a plain number. Here it is a hundredth of that:
  two legs of 6 mm every 100 mm in its section of 150 mm × 250 mm carry 1.53 N/mm² by EN 1992-1-1:2004, equation 6.8,
  with struts at 45°.

Steel is S235 up to 40 mm thick, at yield: EN 1993-1-1:2005, table 3.1; in shear 1/√3 of it, equation 6.18.
"""

SMEARED = dict.fromkeys(
    ("reinforced concrete column", "reinforced concrete slab", "reinforced concrete wall"), "concrete"
)
"""Materials whose tension, bending, torsion and, of columns, shear stand for steel that is smeared over a face, and
their plain concrete: where bars are given, that cracks, and the bars hold. No steel counts twice."""


@dataclass(frozen=True, eq=False, slots=True)
class Sections:
    """Resisting properties of m sections; nan throughout for a section without an area."""

    areas_m2: FloatArray  # (m,)
    directions: FloatArray  # (m, 2, 2), principal axes of bending as columns, in the section's y and z
    bending_moduli_m3: FloatArray  # (m, 2), elastic moduli about these axes: moment by stress at the edge
    torsion_moduli_m3: FloatArray  # (m,)


@dataclass(frozen=True, eq=False, slots=True)
class Ductility:
    """Resistance of a broken connection; numbers, or arrays (m,) with one for every connection.

    The elongation is a length and not a share of one: the distance between two shards depends on how finely the bridge
    is cut, the width of a crack does not.
    """

    strength_share: float | FloatArray  # part of the strength that is left, from 0, nothing, to 1
    elongation_m: float | FloatArray  # how far the two sides of the crack may part

    def __post_init__(self) -> None:
        share, elongation = np.asarray(self.strength_share), np.asarray(self.elongation_m)
        if not np.all((share >= 0.0) & (share <= 1.0)):
            raise ScenarioError(f"strength_share of a ductility is {self.strength_share}: expected 0 to 1")
        if not np.all(elongation >= 0.0):
            raise ScenarioError(f"elongation_m of a ductility is {self.elongation_m}: expected 0 or more")


def rectangular_sections(areas: FloatArray, second_moments: FloatArray) -> Sections:
    """Sections with areas (m,), m², and second moments of area, as the rectangles that have the same.

    The second moments (m, 2, 2), m⁴, are about the section's y and z axes through its centre: ∫ z² dA and ∫ y² dA on
    the diagonal, -∫ y z dA off it; positive definite.

    A section of any shape gets the edges of the rectangle with the same area and second moments: √(3 I / A). That is
    exact for rectangles, whichever way they are turned, but for squares, whose second moments do not say it: these lie
    along the section's axes, as in upright columns and level beams.

    Torsion of a rectangle b > c: stress = T / (b c²) × (3 + 1.8 c/b), within 5 % (S. Timoshenko, 1955, Strength of
    Materials, part I, 3rd edition, section 62).
    """
    areas = np.where(np.asarray(areas, float) > 0.0, areas, np.nan)
    count = len(areas)
    directions, bending, torsion = np.empty((count, 2, 2)), np.empty((count, 2)), np.empty(count)
    second_moments = Doubles.checked("second moments", np.ascontiguousarray(second_moments, float), 4 * count)
    call("bda_rectangles", count, areas, second_moments, directions, bending, torsion)
    return Sections(areas, directions, bending, torsion)


def resisting_records(sections: Sections, strength: Strength, second_moments: FloatArray | float = 0.0) -> np.ndarray:
    """Sections and strengths (m,) as the core takes them, with second moments (m, 3) where cuts go through them."""
    count = len(sections.areas_m2)
    strengths = [np.broadcast_to(np.asarray(getattr(strength, item.name), float), count) for item in fields(strength)]
    return pack(
        RESISTING,
        area=sections.areas_m2,
        second=np.broadcast_to(np.asarray(second_moments, float), (count, 3)),
        directions=sections.directions.reshape(-1, 4),
        moduli=sections.bending_moduli_m3,
        torsion_modulus=sections.torsion_moduli_m3,
        strength=np.stack(strengths, axis=1),
    )


def sections_at(sections: Sections, rows: IntArray) -> Sections:
    """Some of the sections (k,)."""
    return Sections(*(getattr(sections, item.name)[rows] for item in fields(Sections)))


def strength_at(strength: Strength, rows: IntArray) -> Strength:
    """The strength of some connections (k,), of a strength for all or for each of them."""
    values = (np.asarray(getattr(strength, item.name)) for item in fields(Strength))
    return Strength(*(value[rows] if value.ndim else value for value in values))


def largest_utilisations(sections: Sections, strength: Strength) -> tuple[FloatArray, FloatArray]:
    """Bounds (m,) and (m,) of `utilisation` by a force of 1 N and by a moment of 1 N·m, however they are directed.

    A force F and a moment M together use no more than F times the first plus M times the second, as neither of the
    edge stresses nor shear is larger than the sum of what the two make alone, and √(edge² + shear²) is a length.
    """
    weakest_pa = np.minimum(strength.tension_pa, strength.compression_pa)
    edge_by_moment = length(1.0 / sections.bending_moduli_m3) / np.minimum(strength.bending_pa, strength.compression_pa)
    shear_by_moment = 1.0 / sections.torsion_moduli_m3 / strength.torsion_pa
    by_force = np.stack((1.0 / weakest_pa / sections.areas_m2, 1.0 / strength.shear_pa / sections.areas_m2), axis=-1)
    return length(by_force), length(np.stack((edge_by_moment, shear_by_moment), axis=-1))


def utilisation(
    forces: SectionForces, sections: Sections, strength: Strength, friction: FloatArray | None = None
) -> FloatArray:
    """Utilisation (m,) of each connection; above 1 it breaks. Nan where the section has no area, or the forces are nan.

    - Stretched edge: axial tension by its strength plus bending by its own; compression relieves it.
    - Pressed edge: compression plus bending, by the strength in compression.
    - Shear: the mean of shear by its strength plus the edge stress of torsion by its own.

    The larger of the two edges acts together with shear as √(edge² + shear²). For steel that is the yield criterion of
    von Mises, EN 1993-1-1:2005, equation 6.1. For joints that are pulled apart it is the quadratic criterion of nominal
    stress (L. Ye, 1988, Composites Science and Technology 33, 257-277; P. Camanho, C. Dávila, 2002,
    NASA/TM-2002-211737). Friction, which helps a pressed section against shear, counts with a coefficient (m,) where
    one is given: EN 1992-1-1:2004, equation 6.25, v_Rd = c f_ctd + μ σ_n.

    The stress of a rectangle is largest at a corner: bending about its two axes adds up.
    """
    parts = forces.axial_n, forces.shear_n, forces.torsion_nm, forces.bending_nm
    count, used = len(sections.areas_m2), np.empty(len(sections.areas_m2))
    along = Doubles.checked("forces", np.column_stack(parts).astype(float, copy=False), 6 * count)
    friction = np.zeros(count) if friction is None else np.ascontiguousarray(friction, float)
    records = resisting_records(sections, strength).view(float)
    call("bda_utilisations", count, records, along, Doubles.checked("friction", friction, count), used)
    return used


TYPES = ("FIXED", "POINT", "HINGE", "GENERIC", "GENERIC_SPRING")
"""Kinds of connections: FIXED holds everything, POINT a point, HINGE all but the rotation about the vertical, GENERIC
all but what is free, and GENERIC_SPRING has springs in what is free."""


class JointMotion(StrEnum):
    """Motions of one body against the other: along and about the axes of the world, as they are built."""

    MOVE_X = "move x"
    MOVE_Y = "move y"
    MOVE_Z = "move z"
    TURN_X = "turn x"
    TURN_Y = "turn y"
    TURN_Z = "turn z"

    @property
    def turns(self) -> bool:
        """Whether the body turns about an axis, instead of moving along it."""
        return self in (JointMotion.TURN_X, JointMotion.TURN_Y, JointMotion.TURN_Z)


MOTIONS = tuple(motion.value for motion in JointMotion)
"""Names of these motions in a scenario."""


@dataclass(frozen=True, slots=True)
class Springs:
    """Springs in the motions that a GENERIC_SPRING connection lets happen; without load as it was built."""

    stiffness_n_m: float = 0.0  # along each free axis
    damping_ns_m: float = 0.0
    turning_stiffness_nm_rad: float = 0.0  # about each free axis
    turning_damping_nms_rad: float = 0.0

    def of(self, motion: JointMotion) -> tuple[float, float]:
        """Return stiffness and damping of the spring in a motion."""
        if motion.turns:
            return self.turning_stiffness_nm_rad, self.turning_damping_nms_rad
        return self.stiffness_n_m, self.damping_ns_m


@dataclass(frozen=True, eq=False, slots=True)
class Joint:
    """Properties that many connections share; None where a connection has none of that kind."""

    type: str  # one of `TYPES`
    free: tuple[str, ...] = ()  # the `MOTIONS` that a GENERIC or GENERIC_SPRING connection lets happen
    springs: Springs = Springs()
    breaking_force_n: float | None = None
    strength: Strength | None = None  # stresses that break it
    moduli: ElasticModuli | None = None  # None where it is rigid
