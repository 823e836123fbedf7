"""Reinforcing bars: their law, how far a crack opens until they rupture, and straight ends that bond alone holds.

The law is bilinear: EN 1992-1-1:2004, 3.2.7 (2) a. It is meant for bars that are pulled along their axis. Across a
crack they are also pulled askew: their force then has the direction in which the sides of the crack have parted, and
the part that stays follows the force (J. C. Simo and T. J. R. Hughes, 1998, Computational Inelasticity, chapter 1).

All arrays have their components first and the bars last.

Beside a crack, bond takes stress off a bar, so that its strain is largest in the crack. The tension chord model takes
the bond stress for even: P. Marti, M. Alvarez, W. Kaufmann and V. Sigrist (1998), Tension chord model for structural
concrete, Structural Engineering International 8 (4), 287-298.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...errors import ScenarioError
from ..arithmetic import power
from ..arrays import FloatArray, IntArray
from .joint_rows import dot_products

MODULUS_PA = 200e9
"""Modulus of elasticity of reinforcing steel: EN 1992-1-1:2004, 3.2.7 (4)."""

YIELD_PA = 500e6
HARDENING = 1.08
RUPTURE_STRAIN = 0.05
"""Reinforcing steel B500B where no other is given: EN 1992-1-1:2004, table C.1, class B, at least these."""


@dataclass(frozen=True, slots=True)
class Steel:
    """Yielding, hardening and rupture of bars, whatever their number and length."""

    yield_pa: float = YIELD_PA  # f_y
    hardening: float = HARDENING  # tensile strength over yield strength, f_t / f_y
    rupture_strain: float = RUPTURE_STRAIN  # strain under the largest force, ε_u

    def __post_init__(self) -> None:
        if not (np.isfinite(self.yield_pa) and self.yield_pa > 0.0):
            raise ScenarioError(f"yield_pa of steel is {self.yield_pa}: expected a number above 0 (Pa)")
        if not (np.isfinite(self.hardening) and self.hardening >= 1.0):
            raise ScenarioError(f"hardening of steel is {self.hardening}: expected 1 or more")
        if not self.rupture_strain > self.yield_strain:
            raise ScenarioError(
                f"rupture_strain of steel is {self.rupture_strain}: expected more than {self.yield_strain:.3g}, at "
                "which it yields"
            )

    @property
    def yield_strain(self) -> float:
        """Strain at which it yields."""
        return self.yield_pa / MODULUS_PA


USUAL_STEEL = Steel()


@dataclass(frozen=True, slots=True, eq=False)
class SteelOfBars:
    """Steel of b bars that differ."""

    yield_strain: FloatArray  # (b,)
    hardening: FloatArray  # (b,), as in `Steel`
    rupture_strain: FloatArray  # (b,)

    @classmethod
    def alike(cls, steel: Steel, count: int) -> SteelOfBars:
        """Return that of bars of one steel."""
        return cls(*(np.full(count, value) for value in (steel.yield_strain, steel.hardening, steel.rupture_strain)))

    def __getitem__(self, which: IntArray) -> SteelOfBars:
        return SteelOfBars(self.yield_strain[which], self.hardening[which], self.rupture_strain[which])


@dataclass(frozen=True, slots=True, eq=False)
class Bars:
    """b bars across cracks."""

    yield_n: FloatArray  # (b,), forces at which they yield
    stiffness_n_m: FloatArray  # (b,), force by opening of the crack
    modulus_n_m: FloatArray  # (b,), growth of the yield force with the part of the opening that stays

    @classmethod
    def of(cls, yield_n: FloatArray, steel: Steel | SteelOfBars, elongation_m: FloatArray | float) -> Bars:
        """Return bars (b,) that rupture when a crack has opened so far."""
        at_yield_m = elongation_m * steel.yield_strain / steel.rupture_strain
        stiffness = yield_n / at_yield_m
        slope = (steel.hardening - 1.0) * yield_n / (elongation_m - at_yield_m)
        return cls(yield_n, stiffness, stiffness * slope / np.where(stiffness > 0.0, stiffness - slope, 1.0))

    @property
    def resists_n_m(self) -> FloatArray:
        """Force (b,) by which bars that yield fall short of elastic ones, by the part of their stretch that stays."""
        return np.where(self.stiffness_n_m > 0.0, self.stiffness_n_m + self.modulus_n_m, 1.0)

    def __getitem__(self, which: IntArray) -> Bars:
        return Bars(self.yield_n[which], self.stiffness_n_m[which], self.modulus_n_m[which])

    def times(self, shares: FloatArray) -> Bars:
        """Return the bars with shares (b,) of their area."""
        return Bars(shares * self.yield_n, shares * self.stiffness_n_m, shares * self.modulus_n_m)


@dataclass(frozen=True, slots=True, eq=False)
class BarResponse:
    """Forces and deformations of b bars that are stretched."""

    forces_n: FloatArray  # (3, b), along the stretch; they pull its ends together
    slips_m: FloatArray  # (3, b), part of the stretch that stays
    flows_m: FloatArray  # (b,), length of the path on which that came
    directions: FloatArray  # (3, b), of the forces
    across_n_m: FloatArray  # (b,), growth of the force with a stretch across its direction
    along_n_m: FloatArray  # (b,), and along it

    @property
    def tangents_n_m(self) -> FloatArray:
        """Derivatives (3, 3, b) of the forces by the stretch."""
        tangents: FloatArray = (self.along_n_m - self.across_n_m) * (self.directions[:, None] * self.directions)
        tangents[[0, 1, 2], [0, 1, 2]] += self.across_n_m
        return tangents


def bar_response(bars: Bars, stretches_m: FloatArray, slips_m: FloatArray, flows_m: FloatArray) -> BarResponse:
    """Return what bars do under stretches (3, b), after slips (3, b) that came on ways of a length (b,)."""
    trial = bars.stiffness_n_m * (stretches_m - slips_m)
    size = np.sqrt(dot_products(trial, trial))
    flow = np.maximum(size - bars.yield_n - bars.modulus_n_m * flows_m, 0.0) / bars.resists_n_m
    less = bars.stiffness_n_m * flow
    direction = np.divide(trial, size, out=np.zeros_like(trial), where=size > 0.0)
    share = 1.0 - np.divide(less, size, out=np.zeros_like(size), where=size > 0.0)
    along = np.where(flow > 0.0, bars.modulus_n_m / bars.resists_n_m, 1.0)
    return BarResponse(
        _shortened(trial, size, less),
        slips_m + flow * direction,
        flows_m + flow,
        direction,
        bars.stiffness_n_m * share,
        bars.stiffness_n_m * along,
    )


def _shortened(vectors: FloatArray, sizes: FloatArray, less: FloatArray) -> FloatArray:
    """Vectors (3, b) of some sizes (b,) that are shorter by `less` (b,)."""
    shorter: FloatArray = (1.0 - np.divide(less, sizes, out=np.zeros_like(sizes), where=sizes > 0.0)) * vectors
    return shorter


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


_BOND = 2.25
"""Bond strength of ribbed bars in good bond conditions by the tensile strength of concrete: ibid., equation 8.2, for
bars up to 32 mm. With the mean strength instead of the design value, as everywhere here, it has no factor of safety."""


def anchorage_length_m(diameter_m: float, yield_pa: float, tensile_pa: float) -> float:
    """Return the length in which bond takes up the yield stress of a bar: ibid., equation 8.3."""
    return 0.25 * diameter_m * yield_pa / (_BOND * tensile_pa)


def anchored_shares(from_end_m: FloatArray, length_m: float) -> FloatArray:
    """Return the parts (k,) of their yield force that bars resist so far (k,) from their ends: bond is even."""
    shares: FloatArray = np.clip(from_end_m / length_m, 0.0, 1.0)
    return shares
