"""What sections of reinforced concrete resist, and the bars that they need: bending, shear and punching, columns."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..elasticity.steel_bars import MODULUS_PA
from .least_areas import LARGEST_SHARE
from .materials import CONCRETE_FACTOR, Concrete


@dataclass(frozen=True, slots=True)
class PressedShape:
    """What is pressed of a section in bending: a web, and a flange at the pressed edge if it is wider."""

    height_m: float
    web_m: float
    flange_m: float
    flange_depth_m: float

    @classmethod
    def rectangle(cls, height_m: float, width_m: float) -> PressedShape:
        return cls(height_m, width_m, width_m, height_m)


@dataclass(frozen=True, slots=True)
class TensionSteel:
    """Area of bars in tension, and depth of the neutral axis by the bars' depth; both infinite where no area does."""

    area_m2: float
    neutral_axis: float


def tension_steel(
    moment_nm: float, shape: PressedShape, depth_m: float, concrete: Concrete, yield_pa: float
) -> TensionSteel:
    """Return the bars at a depth below the pressed edge with which a section resists a moment.

    Plane sections, a stress block, no concrete in tension, bars at their design strength: EN 1992-1-1:2004, 6.1 and
    3.1.7 (3). In a T-section the flange on both sides of the web resists first, and the web resists the rest.
    """
    stress = concrete.block_pa
    as_wide = _block_m(moment_nm, shape.flange_m, depth_m, stress)
    if as_wide <= shape.flange_depth_m:
        return TensionSteel(as_wide * shape.flange_m * stress / yield_pa, as_wide / concrete.block_depth / depth_m)
    beside_n = stress * (shape.flange_m - shape.web_m) * shape.flange_depth_m
    rest_nm = moment_nm - beside_n * (depth_m - 0.5 * shape.flange_depth_m)
    block = _block_m(rest_nm, shape.web_m, depth_m, stress)
    area = (beside_n + block * shape.web_m * stress) / yield_pa
    return TensionSteel(area, block / concrete.block_depth / depth_m)


def _block_m(moment_nm: float, width_m: float, depth_m: float, stress_pa: float) -> float:
    """Return the depth of the stress block: M = b a σ (d - a / 2); infinite where no depth does."""
    relative = moment_nm / (width_m * depth_m**2 * stress_pa)
    return depth_m * (1.0 - math.sqrt(1.0 - 2.0 * relative)) if relative <= 0.5 else math.inf


def flange_width_m(web_m: float, beside_m: tuple[float, float], between_zeros_m: float) -> float:
    """Return the effective width of a flange: EN 1992-1-1:2004, equations 5.7 to 5.7b.

    `beside_m` is half the clear distance to the next web, or the whole overhang, on each side; `between_zeros_m` the
    distance between points where the moment is 0.
    """
    parts = [min(0.2 * b + 0.1 * between_zeros_m, 0.2 * between_zeros_m, b) for b in beside_m]
    return web_m + math.fsum(parts)


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

    First order: 6.1 (4) or imperfections, 5.2 (7), whichever is larger. Of second order, where it is more slender than
    5.8.3.1 (1) allows, by nominal curvature, 5.8.8, with K_r = K_φ = 1 and c = 10. 0.7, 1.1 and 0.7 for A, B and C.
    """
    height = section.height_m
    eccentricity = max(height / 30.0, 0.02, _IMPERFECTION * buckling_m / 2.0)
    slenderness = buckling_m / (height / math.sqrt(12.0))
    relative = axial_n / (section.area_m2 * section.concrete.design_pa)
    if slenderness > 20.0 * 0.7 * 1.1 * 0.7 / math.sqrt(max(relative, 1e-9)):
        curvature = section.yield_pa / MODULUS_PA / (0.45 * (height - section.cover_to_axis_m))
        eccentricity += curvature * buckling_m**2 / 10.0
    return axial_n * eccentricity
