"""What steel bars of a grade resist: plastic sections under axial force and bending, and buckling (EN 1993-1-1:2005).

shear, which buckle where they are thin (EN 1993-1-5:2006, 5.2 and 5.3), and lateral torsional buckling.

No partial factors: γ_M0 = γ_M1 = 1. Of shear, the contribution of the web alone, without the flanges.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from ..elasticity.buckling_curves import IMPERFECTIONS, NO_BUCKLING, reduction_factor
from ..elasticity.member_shapes import principal_moments
from ..elasticity.section_stiffness import ElasticModuli
from ..geometry.vectors import unit
from ..mechanics.strength import Strength, rectangular_sections
from .sections import SteelSection

DENSITY_KG_M3 = 7850.0
"""Density of steel: EN 1991-1-1:2002, table A.4, 77 to 78.5 kN/m³."""

STEEL_MODULI = ElasticModuli(210e9, 0.3)
"""EN 1993-1-1:2005, 3.2.6."""

_THIN_M = 0.04

_MPA = 1e6

_STRENGTHS_MPA = {
    "S235": ((235.0, 360.0), (215.0, 360.0)),
    "S275": ((275.0, 430.0), (255.0, 410.0)),
    "S355": ((355.0, 490.0), (335.0, 470.0)),
    "S450": ((440.0, 550.0), (410.0, 550.0)),
}
"""Yield and ultimate strength up to 40 mm, and above that up to 80 mm (ibid.; S355 has 490 N/mm² since AC:2009)."""

GRADES = tuple(_STRENGTHS_MPA)


def strengths_pa(grade: str, thickness_m: float) -> tuple[float, float]:
    """Return yield and ultimate strength of a grade in a thickness."""
    thin, thick = _STRENGTHS_MPA[grade]
    yield_mpa, ultimate_mpa = thin if thickness_m <= _THIN_M else thick
    return _MPA * yield_mpa, _MPA * ultimate_mpa


_ROUNDING = 1e-9

RUPTURE_STRAIN = 0.15
"""Strain of steel as it ruptures: the least elongation of EN 1993-1-1:2005, 3.2.2 (1)."""

_PLATEAU = 1e-4
"""Slope of the stress after yield, by the modulus of elasticity: EN 1993-1-5:2006, C.6 (2), a nominal slope."""

_HINGE_BY_DEPTH = 1.0
"""Length in which a hinge yields, by the depth of the section."""


@dataclass(frozen=True, slots=True)
class SectionHinge:
    """How a section of steel yields as a whole, and ruptures."""

    yield_n: float  # axial force
    yield_strain: float
    hardening: float  # force at rupture over that at yield
    rupture_strain: float
    opening_m: float  # by which it has opened as it ruptures


def section_hinge(section: SteelSection, yield_pa: float, most_m: float = math.inf) -> SectionHinge:
    """Return how a section yields: on a plateau, until a length as long as it is deep has stretched too far.

    It opens by `most_m` at most.
    """
    yield_strain = yield_pa / STEEL_MODULI.young_pa
    hardening = 1.0 + _PLATEAU * (RUPTURE_STRAIN - yield_strain) / yield_strain
    opening_m = min(RUPTURE_STRAIN * _HINGE_BY_DEPTH * float(section.size_m.max()), most_m)
    return SectionHinge(section.area_m2 * yield_pa, yield_strain, hardening, RUPTURE_STRAIN, opening_m)


def plastic_second_moments(
    section: SteelSection, bending_to_axial_ratio: tuple[float, float] = (1.0, 1.0)
) -> FloatArray:
    """Return second moments (2, 2) of the rectangle that stands for a section in what breaks it.

    `bending_to_axial_ratio` is its share of the section's resistance in bending about y and z over its share in axial
    force. The rectangle has the area of the section, and elastic moduli as large as the plastic ones of that: W² = I A
    / 3 for any rectangle. So axial force and bending about both axes together use N / N_pl + M_y / M_pl,y + M_z /
    M_pl,z, the linear rule of EN 1993-1-1:2005, 6.2.1 (7).
    """
    moduli = section.shape.plastic_moduli_m3 * np.array(bending_to_axial_ratio)
    return np.asarray(np.diag(3.0 * np.square(moduli) / section.area_m2))


def plastic_strength(
    section: SteelSection, yield_pa: float, bending_to_axial_ratio: tuple[float, float] = (1.0, 1.0)
) -> Strength:
    """Return the strength with which that rectangle resists as the section does, as `mechanics.strength` judges it.

    Shear resists by the smaller of the two areas that yield, torsion by all plates at yield.
    """
    shear_pa = yield_pa / math.sqrt(3.0)
    area = section.area_m2
    rectangle = rectangular_sections(np.array([area]), plastic_second_moments(section, bending_to_axial_ratio)[None])
    by_torsion = section.torsion_modulus_m3 / float(rectangle.torsion_moduli_m3[0])
    return Strength(
        compression_pa=yield_pa,
        tension_pa=yield_pa,
        shear_pa=shear_pa * float(section.plastic_shear_areas_m2.min()) / area,
        torsion_pa=shear_pa * by_torsion,
        bending_pa=yield_pa,
    )


@dataclass(frozen=True, slots=True)
class Buckling:
    """Resistance of a bar in compression, about the axis in which it is least."""

    axis: str  # "y" or "z", or "v" for the weak axis of an angle
    curve: str
    slenderness: float  # λ, by that at which Euler's load is the plastic one
    reduction: float  # χ
    euler_n: float
    resistance_n: float


def buckling(section: SteelSection, yield_pa: float, lengths_m: tuple[float, float]) -> Buckling:
    """Return the buckling resistance of a bar with buckling lengths about y and z: EN 1993-1-1:2005, 6.3.1."""
    plastic_n, moments = section.area_m2 * yield_pa, section.shape.second_moments_m4
    axes = [(axis, float(moments[row, row]), lengths_m[row], row) for row, axis in enumerate("yz")]
    if abs(moments[0, 1]) > _ROUNDING * moments[0, 0]:  # an angle, which is weakest about another axis
        axes.append(("v", float(principal_moments(moments[None])[0][0]), max(lengths_m), 1))
    about = []
    for axis, moment, long, row in axes:
        euler_n = math.pi * math.pi * STEEL_MODULI.young_pa * moment / (long * long)
        slenderness = math.sqrt(plastic_n / euler_n)
        curve = section.buckling_curves[row]
        reduction = float(reduction_factor(slenderness, curve))
        about.append(Buckling(axis, curve, slenderness, reduction, euler_n, reduction * plastic_n))
    return min(about, key=lambda one: one.resistance_n)


def initial_bow_m(section: SteelSection, yield_pa: float, lengths_m: tuple[float, float]) -> FloatArray:
    """Return how far a strut is bowed in its middle along y and z (2,), so that it buckles as its curve says.

    e_0 = α (λ - 0.2) M_Rk / N_Rk in a half wave, about the axis in which it resists least: EN 1993-1-1:2005, 5.3.2,
    equation 5.10.
    """
    strut, moments = buckling(section, yield_pa, lengths_m), section.shape.second_moments_m4
    about = {"y": np.array((1.0, 0.0)), "z": np.array((0.0, 1.0))}.get(strut.axis)
    if about is None:
        about = unit(np.array((moments[0, 1], principal_moments(moments[None])[0][0] - moments[0, 0])))
    modulus = float(section.shape.plastic_moduli_m3[0 if strut.axis == "y" else 1])
    size = IMPERFECTIONS[strut.curve] * max(0.0, strut.slenderness - NO_BUCKLING) * modulus / section.area_m2
    return np.asarray(size * np.array((-about[1], about[0])))


_HARDENING = 1.2
"""η up to S460: EN 1993-1-5:2006, 5.1 (2), recommended."""

_STOCKY, _SLENDER = 0.83, 1.08
"""Slenderness at which the factor of table 5.1 changes its form: times 1 / η, and for rigid end posts."""

_REFERENCE_PA = 235e6


@dataclass(frozen=True, slots=True)
class WebShear:
    """What the webs of a bar resist in shear."""

    buckling_factor: float  # k_τ
    slenderness: float  # λ_w
    reduction: float  # χ_w, up to η
    resistance_n: float

    @property
    def buckles(self) -> bool:
        """Whether they resist less than by yielding."""
        return self.reduction < 1.0


def web_shear(section: SteelSection, yield_pa: float, stiffeners_m: float, *, rigid_end_posts: bool) -> WebShear | None:
    """Return what webs resist between upright stiffeners at a distance; None of sections without a web between flanges.

    V_bw = χ_w f_yw h_w t / √3 for each web, with λ_w = h_w / (37.4 t ε √k_τ), equations 5.2 and 5.6, and k_τ without
    stiffeners along the bar, A.3 (1).
    """
    if section.web is None:
        return None
    web = section.web
    ratio = web.height_m / stiffeners_m
    one, square = (5.34, 4.0) if ratio <= 1.0 else (4.0, 5.34)
    factor = one + square * ratio * ratio
    epsilon = math.sqrt(_REFERENCE_PA / yield_pa)
    slenderness = web.height_m / (37.4 * web.thickness_m * epsilon * math.sqrt(factor))
    reduction = shear_reduction(slenderness, rigid_end_posts=rigid_end_posts)
    plastic_n = web.count * web.height_m * web.thickness_m * yield_pa / math.sqrt(3.0)
    return WebShear(factor, slenderness, reduction, reduction * plastic_n)


def shear_reduction(slenderness: float, *, rigid_end_posts: bool) -> float:
    """Return χ_w of a web: EN 1993-1-5:2006, table 5.1."""
    if slenderness < _STOCKY / _HARDENING:
        return _HARDENING
    if rigid_end_posts and slenderness >= _SLENDER:
        return 1.37 / (0.7 + slenderness)
    return _STOCKY / slenderness


_UNREDUCED, _BETA = 0.4, 0.75
"""Slenderness up to which a beam does not buckle sideways, and β: EN 1993-1-1:2005, 6.3.2.3 (1), recommended."""

_NARROW = 2.0
"""Height by width above which curves are the worse ones: EN 1993-1-1:2005, table 6.5."""


@dataclass(frozen=True, slots=True)
class LateralBuckling:
    """Resistance of a bar in bending about its strong axis, as it buckles sideways and turns."""

    curve: str
    critical_nm: float
    slenderness: float
    reduction: float  # χ_LT
    resistance_nm: float


def critical_moment_nm(section: SteelSection, length_m: float) -> float | None:
    """Return the elastic critical moment of a bar between forks at a distance; None where it is not judged.

    π² E I_z / L² √(I_w / I_z + L² G I_t / (π² E I_z)) for a moment that is the same all along, which is the worst
    (Timoshenko and Gere, Theory of Elastic Stability, 6.2). I_w = I_z d² / 4, with d between the middles of flanges.
    """
    if section.flanges_apart_m is None:
        return None
    weak = float(section.shape.second_moments_m4[1, 1])
    euler_n = math.pi * math.pi * STEEL_MODULI.young_pa * weak / (length_m * length_m)
    warping_m2 = section.flanges_apart_m * section.flanges_apart_m / 4.0
    return euler_n * math.sqrt(warping_m2 + STEEL_MODULI.shear_pa * section.torsion_m4 / euler_n)


def lateral_buckling(section: SteelSection, yield_pa: float, length_m: float) -> LateralBuckling | None:
    """Return the resistance χ_LT W_pl f_y of a bar that is held sideways at its ends; None where it is not judged."""
    critical_nm = critical_moment_nm(section, length_m)
    if critical_nm is None:
        return None
    plastic_nm = yield_pa * float(section.shape.plastic_moduli_m3[0])
    slenderness = math.sqrt(plastic_nm / critical_nm)
    width, height = section.size_m.tolist()
    better, worse = ("b", "c") if section.is_rolled else ("c", "d")
    curve = worse if height > _NARROW * width + 1e-9 else better
    phi = 0.5 * (1.0 + IMPERFECTIONS[curve] * (slenderness - _UNREDUCED) + _BETA * slenderness * slenderness)
    reduction = 1.0
    if slenderness > _UNREDUCED:
        by_curve = 1.0 / (phi + math.sqrt(phi * phi - _BETA * slenderness * slenderness))
        reduction = min(1.0, by_curve, 1.0 / (slenderness * slenderness))
    return LateralBuckling(curve, critical_nm, slenderness, reduction, reduction * plastic_nm)
