"""Headed studs between a slab of concrete and the flange below it: strength, stiffness and how far they slip.

No partial factors: γ_V = γ_Mc = 1.
"""

from __future__ import annotations

import math

STUD_STIFFNESS_N_M = 100e6
"""Shear force by slip of one stud of 19 mm in a solid slab: EN 1994-1-1:2004, A.3 (4)."""

SLIP_CAPACITY_M = 6e-3
"""Slip that ductile studs have before they fail: EN 1994-1-1:2004, 6.6.1.1 (5)."""

STUD_ULTIMATE_PA = 450e6
"""Ultimate strength of the steel of studs SD1: EN ISO 13918:2018."""

FRICTION_OF_STEEL = 0.5
"""Friction of concrete on steel without paint, free from oil and loose rust: EN 1994-1-1:2004, 6.7.4.2 (4)."""

SMALLEST_M, LARGEST_M = 0.016, 0.025
"""Diameters for which the strength is known: EN 1994-1-1:2004, 6.6.3.1 (1)."""

LEAST_HEIGHT = 3.0
"""Least height over diameter: ibid., equation 6.20."""

_TALL = 4.0
_MOST_ULTIMATE_PA = 500e6

_CONE = 12.7
"""k_ucr,N of headed fasteners in concrete that has not cracked, N and mm: EN 1992-4:2018, 7.2.1.4 (2)."""

_HEAD_BY_DIAMETER = 0.5
"""Thickness of the head by the diameter: 8 mm of 16 mm, 10 of 19 and 22, 12 of 25 (EN ISO 13918:2018)."""

_MM = 1e-3


def stud_shear_n(
    diameter_m: float, height_m: float, ultimate_pa: float, concrete_pa: float, concrete_young_pa: float
) -> float:
    """Return the shear strength of a stud in a solid slab, N: EN 1994-1-1:2004, 6.6.3.1, equations 6.18 to 6.21.

    The shank fails at 0.8 f_u π d² / 4, the concrete at 0.29 α d² √(f_c E_c) with α = 0.2 (h / d + 1) up to 1.
    """
    slenderness = height_m / diameter_m
    alpha = 1.0 if slenderness > _TALL else 0.2 * (slenderness + 1.0)
    shank = 0.8 * min(ultimate_pa, _MOST_ULTIMATE_PA) * 0.25 * math.pi * diameter_m * diameter_m
    return min(shank, 0.29 * alpha * diameter_m * diameter_m * math.sqrt(concrete_pa * concrete_young_pa))


def stud_uplift_n(
    diameter_m: float, height_m: float, ultimate_pa: float, concrete_pa: float, spacing_m: float
) -> float:
    """Return the strength of a stud that is pulled, one of a row at a spacing, N.

    The shank fails at f_u π d² / 4, or a cone of concrete breaks out: 12.7 √f_c h^1.5 for one by itself, less by the
    spacing over 3 h where the cones of a row are in each other (EN 1992-4:2018, 7.2.1.4). h is below the head.
    """
    shank = ultimate_pa * 0.25 * math.pi * diameter_m * diameter_m
    below_head_m = height_m - _HEAD_BY_DIAMETER * diameter_m
    alone = _CONE * math.sqrt(concrete_pa * 1e-6) * (below_head_m / _MM) * math.sqrt(below_head_m / _MM)
    return min(shank, alone * min(1.0, spacing_m / (3.0 * below_head_m)))
