"""Law of reinforcing bars: elastic up to their yield force, then with hardening, and elastic again when unloaded.

The law is bilinear: EN 1992-1-1:2004, 3.2.7 (2) a. It is meant for bars that are pulled along their axis. Across a
crack they are also pulled askew: their force then has the direction in which the sides of the crack have parted, and
the part that stays follows the force (J. C. Simo and T. J. R. Hughes, 1998, Computational Inelasticity, chapter 1).

All arrays have their components first and the bars last.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...errors import ScenarioError
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


def bar_forces(bars: Bars, stretches_m: FloatArray, slips_m: FloatArray, flows_m: FloatArray) -> FloatArray:
    """Return the forces (3, b) of `bar_response` alone."""
    trial = bars.stiffness_n_m * (stretches_m - slips_m)
    size = np.sqrt(dot_products(trial, trial))
    flow = np.maximum(size - bars.yield_n - bars.modulus_n_m * flows_m, 0.0) / bars.resists_n_m
    return _shortened(trial, size, bars.stiffness_n_m * flow)


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
