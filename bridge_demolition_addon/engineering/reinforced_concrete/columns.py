"""Columns: the moment that a pressed section resists, and the bars that slender ones need."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..elasticity.steel_bars import MODULUS_PA
from .least_areas import LARGEST_SHARE
from .materials import Concrete

_HALVINGS = 60
_IMPERFECTION = 1.0 / 200.0
"""θ_0: EN 1992-1-1:2004, 5.2 (5)."""


@dataclass(frozen=True, slots=True)
class ColumnSection:
    """A rectangle with the same bars at both faces across which it bends."""

    height_m: float  # in the plane of bending
    width_m: float
    cover_to_axis_m: float
    concrete: Concrete
    yield_pa: float  # design strength

    @property
    def area_m2(self) -> float:
        return self.height_m * self.width_m

    def moment_nm(self, bars_m2: float, axial_n: float) -> float:
        """Return the moment about the middle that it resists under compression, with bars of both faces together.

        Concrete is crushed at its edge over a stress block, bars are elastic up to their yield strength: EN
        1992-1-1:2004, 6.1 and 3.1.7 (3). Below 0 where the axial force alone is too large.
        """
        low, high = 1e-9, 20.0 * self.height_m
        if self._forces(high, bars_m2)[0] < axial_n:
            return -1.0
        for _ in range(_HALVINGS):
            neutral = 0.5 * (low + high)
            low, high = (neutral, high) if self._forces(neutral, bars_m2)[0] < axial_n else (low, neutral)
        return self._forces(0.5 * (low + high), bars_m2)[1]

    def bars_m2(self, axial_n: float, moment_nm: float) -> float:
        """Return the bars of both faces together that resist an axial force and a moment; infinite beyond 8 %."""
        low, high = 0.0, LARGEST_SHARE * self.area_m2
        if self.moment_nm(0.0, axial_n) >= moment_nm:
            return 0.0
        if self.moment_nm(high, axial_n) < moment_nm:
            return math.inf
        for _ in range(_HALVINGS):
            area = 0.5 * (low + high)
            low, high = (area, high) if self.moment_nm(area, axial_n) < moment_nm else (low, area)
        return high

    def _forces(self, neutral_m: float, bars_m2: float) -> tuple[float, float]:
        """Return compression and moment about the middle with the neutral axis so deep."""
        block = min(self.concrete.block_depth * neutral_m, self.height_m)
        pressed = block * self.width_m * self.concrete.block_pa
        axial, moment = pressed, pressed * 0.5 * (self.height_m - block)
        for depth in (self.cover_to_axis_m, self.height_m - self.cover_to_axis_m):
            stress = MODULUS_PA * self.concrete.crushing_strain * (neutral_m - depth) / neutral_m
            force = 0.5 * bars_m2 * min(max(stress, -self.yield_pa), self.yield_pa)
            axial, moment = axial + force, moment + force * (0.5 * self.height_m - depth)
        return axial, moment


def design_moment_nm(axial_n: float, section: ColumnSection, buckling_m: float) -> float:
    """Return the moment of a column that is loaded in its middle, with all eccentricities of EN 1992-1-1:2004.

    Of first order that of 6.1 (4) or of imperfections, 5.2 (7), whichever is larger. Of second order, where it is more
    slender than 5.8.3.1 (1) allows, by nominal curvature, 5.8.8, with K_r = K_φ = 1 and c = 10. 0.7, 1.1 and 0.7 for
    A, B and C.
    """
    height = section.height_m
    eccentricity = max(height / 30.0, 0.02, _IMPERFECTION * buckling_m / 2.0)
    slenderness = buckling_m / (height / math.sqrt(12.0))
    relative = axial_n / (section.area_m2 * section.concrete.design_pa)
    if slenderness > 20.0 * 0.7 * 1.1 * 0.7 / math.sqrt(max(relative, 1e-9)):
        curvature = section.yield_pa / MODULUS_PA / (0.45 * (height - section.cover_to_axis_m))
        eccentricity += curvature * buckling_m**2 / 10.0
    return axial_n * eccentricity
