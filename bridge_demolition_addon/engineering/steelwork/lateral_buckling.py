"""Lateral torsional buckling of I-sections whose flanges are alike (EN 1993-1-1:2005, 6.3.2.3)."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..elasticity.buckling_curves import IMPERFECTIONS
from .grades import STEEL_MODULI
from .sections import SteelSection

_PLATEAU, _BETA = 0.4, 0.75
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
    phi = 0.5 * (1.0 + IMPERFECTIONS[curve] * (slenderness - _PLATEAU) + _BETA * slenderness * slenderness)
    reduction = 1.0
    if slenderness > _PLATEAU:
        by_curve = 1.0 / (phi + math.sqrt(phi * phi - _BETA * slenderness * slenderness))
        reduction = min(1.0, by_curve, 1.0 / (slenderness * slenderness))
    return LateralBuckling(curve, critical_nm, slenderness, reduction, reduction * plastic_nm)
