"""Shear: what concrete without links resists, the links that a beam needs, and punching."""

from __future__ import annotations

import math
from dataclasses import dataclass

from .materials import CONCRETE_FACTOR, Concrete

_MEGA = 1e6
_LARGEST_COT = 2.5
_LEVER_ARM = 0.9
"""z / d: EN 1992-1-1:2004, 6.2.3 (1)."""

FRICTION_ALONG_CRACK = 0.9
"""μ along a crack between web and slab, cast in one: EN 1992-1-1:2004, 6.2.5 (2), indented. Cohesion, c, is none under
traffic: EN 1992-2:2005, 6.2.5 (105)."""


def without_links_n(width_m: float, depth_m: float, bars_m2: float, concrete: Concrete) -> float:
    """Return V_Rd,c of a section without axial force: EN 1992-1-1:2004, equations 6.2a, 6.2b and 6.3N."""
    size = min(1.0 + math.sqrt(0.2 / depth_m), 2.0)
    ratio = min(bars_m2 / (width_m * depth_m), 0.02)
    f_ck = concrete.strength_pa / _MEGA
    stress = 0.18 / CONCRETE_FACTOR * size * math.cbrt(100.0 * ratio * f_ck)
    least = 0.035 * math.sqrt(size**3 * f_ck)
    return max(stress, least) * _MEGA * width_m * depth_m


@dataclass(frozen=True, slots=True)
class Links:
    """Links of a beam: their area by length along it, m²/m, and the slope of the struts between them."""

    area_m2_m: float
    cot_strut: float


def struts_n(width_m: float, depth_m: float, concrete: Concrete, cot_strut: float) -> float:
    """Return V_Rd,max, at which the struts are crushed: equations 6.9 and 6.6N, without axial force."""
    weakened = 0.6 * (1.0 - concrete.strength_pa / _MEGA / 250.0)
    return width_m * _LEVER_ARM * depth_m * weakened * concrete.design_pa / (cot_strut + 1.0 / cot_strut)


def links(shear_n: float, width_m: float, depth_m: float, concrete: Concrete, yield_pa: float) -> Links | None:
    """Return the links that a shear force needs, with struts as flat as they can be; None where no struts carry it.

    Slopes are from cot θ = 2.5 to 1, as EN 1992-1-1:2004, equation 6.7N recommends; links by equation 6.8.
    """
    largest = struts_n(width_m, depth_m, concrete, 1.0)
    if shear_n > largest:
        return None
    angle = 0.5 * math.asin(shear_n / largest)
    cot = _LARGEST_COT if angle <= math.atan(1.0 / _LARGEST_COT) else 1.0 / math.tan(angle)
    return Links(shear_n / (_LEVER_ARM * depth_m * yield_pa * cot), cot)


def links_along_m2_m(shear_n: float, depth_m: float, yield_pa: float) -> float:
    """Return the links across the joint of a web and its slab: EN 1992-1-1:2004, equations 6.24 and 6.25, β = 1."""
    return shear_n / (_LEVER_ARM * depth_m * yield_pa * FRICTION_ALONG_CRACK)


_LARGEST_RATIO = 0.02


def punching_stress_pa(depth_m: float, ratio: float, strength_pa: float) -> float:
    """Return the shear stress that a slab resists on the control perimeter: EN 1992-1-1:2004, equation 6.47.

    `ratio` is the mean of the bars both ways, √(ρ_x ρ_y). Without γ_c = 1.5 its factors are 0.18, and 0.0525 for the
    least stress, where the design values are 0.12 and 0.035 (equation 6.3N).
    """
    size, f_ck = min(1.0 + math.sqrt(0.2 / depth_m), 2.0), strength_pa / _MEGA
    by_bars = 0.18 * size * math.cbrt(100.0 * min(ratio, _LARGEST_RATIO) * f_ck)
    return _MEGA * max(by_bars, 0.0525 * math.sqrt(size**3 * f_ck))


def punching_n(depth_m: float, loaded_m: float, ratio: float, strength_pa: float) -> float:
    """Return the force that punches, on a circle of a diameter: control perimeter 2 d around it, 6.4.2 (1)."""
    return punching_stress_pa(depth_m, ratio, strength_pa) * math.pi * (loaded_m + 4.0 * depth_m) * depth_m
