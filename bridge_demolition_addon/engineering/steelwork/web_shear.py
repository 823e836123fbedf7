"""Webs of steel bars in shear, which buckle where they are thin (EN 1993-1-5:2006, 5.2 and 5.3).

The contribution of the web alone, without that of the flanges and without partial factors: γ_M1 = 1.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from .sections import SteelSection

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
