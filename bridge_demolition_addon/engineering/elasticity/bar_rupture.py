"""How far a crack opens until its bars rupture: their mean strain then, over the length in which a hinge yields.

Beside a crack, bond takes stress off a bar, so that its strain is largest in the crack. The tension chord model takes
the bond stress for even: P. Marti, M. Alvarez, W. Kaufmann and V. Sigrist (1998), Tension chord model for structural
concrete, Structural Engineering International 8 (4), 287-298.
"""

from __future__ import annotations

from ..arithmetic import power
from .steel_bars import MODULUS_PA, Steel

_BOND_ELASTIC, _BOND_YIELDING = 2.0, 1.0
"""Bond stress along bars that are elastic, and that yield, by the tensile strength of concrete (ibid.)."""

_MEAN_SPACING = 0.75
"""Mean spacing of cracks by the largest possible: it is between half and all of that (ibid.)."""

_HINGE_BY_DEPTH = 1.2
"""Length in which a hinge yields, by the depth of the section: EN 1992-1-1:2004, 5.6.3 (1)."""

_EFFECTIVE_BY_DEPTH_OF_BARS = 2.5
"""Depth of concrete that bars crack, by that of the bars below the edge: EN 1992-1-1:2004, 7.3.2 (3)."""


def tensile_strength_pa(compressive_pa: float) -> float:
    """Return the mean tensile strength of concrete up to C50/60: EN 1992-1-1:2004, table 3.1."""
    return float(0.30e6 * power(1e-6 * compressive_pa, 2.0 / 3.0))


def crack_spacing_m(diameter_m: float, area_m2: float, width_m: float, below_edge_m: float, depth_m: float) -> float:
    """Return the mean spacing of cracks across a layer of bars.

    The bars, of an area together, lie below the edge of a section with this width and depth. The largest spacing is
    that over which bond cracks the concrete about the bars again: d (1 - ρ) / (4 ρ) (Marti et al. 1998).
    """
    cracked_m2 = width_m * min(_EFFECTIVE_BY_DEPTH_OF_BARS * below_edge_m, 0.5 * depth_m)
    return spacing_of_ratio_m(diameter_m, area_m2 / cracked_m2)


def spacing_of_ratio_m(diameter_m: float, ratio: float) -> float:
    """Return the mean spacing of cracks across bars that are such a part of the area across them."""
    ratio = min(ratio, 0.5)
    return _MEAN_SPACING * diameter_m * (1.0 - ratio) / (2.0 * _BOND_ELASTIC * ratio)


def mean_strain_at_rupture(steel: Steel, diameter_m: float, spacing_m: float, tensile_pa: float) -> float:
    """Return the mean strain of bars between cracks, as they rupture in one of them."""
    half_m, yield_pa = 0.5 * spacing_m, steel.yield_pa
    strain, yield_strain = steel.rupture_strain, steel.yield_strain
    yielding_m = (steel.hardening - 1.0) * yield_pa * diameter_m / (4.0 * _BOND_YIELDING * tensile_pa)
    if half_m <= yielding_m:
        return strain - 0.5 * (strain - yield_strain) * half_m / yielding_m
    falls_by = 4.0 * _BOND_ELASTIC * tensile_pa / (diameter_m * MODULUS_PA)  # strain, in a length of 1 m
    elastic_m = min(half_m - yielding_m, yield_strain / falls_by)
    of_elastic = elastic_m * (yield_strain - 0.5 * falls_by * elastic_m)
    return (0.5 * (strain + yield_strain) * yielding_m + of_elastic) / half_m


def rupture_opening_m(mean_strain: float, depth_m: float) -> float:
    """Return the opening at which bars rupture in a section of a depth: all cracks of a hinge together are one here."""
    return mean_strain * _HINGE_BY_DEPTH * depth_m
