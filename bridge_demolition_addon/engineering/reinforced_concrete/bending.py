"""Bars that a section needs in bending: rectangles and T-sections whose bars in tension yield."""

from __future__ import annotations

import math
from dataclasses import dataclass

from .materials import Concrete


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
    """Area of bars in tension, and depth of the neutral axis by that of the bars; both infinite where no area does."""

    area_m2: float
    neutral_axis: float


def tension_steel(
    moment_nm: float, shape: PressedShape, depth_m: float, concrete: Concrete, yield_pa: float
) -> TensionSteel:
    """Return the bars at a depth below the pressed edge with which a section resists a moment.

    Plane sections, a stress block, no concrete in tension, bars at their design strength: EN 1992-1-1:2004, 6.1 and
    3.1.7 (3). Of a T-section what the flange beside the web resists comes first, and the web resists the rest.
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
