"""Footings on soil: springs, and their resistance in a sub-step, in the equations of the elastic structure.

Each part of a footing's area is a spring. It presses by stiffness, area and settlement, and never pulls: E. Winkler
(1867), Die Lehre von der Elastizität und Festigkeit. At the largest pressure that the soil resists, it settles for
good. Along the ground it holds up to its friction, by the pressure at the beginning of the sub-step, and slides beyond
it.

All arrays have their components first.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .arrays import BoolArray, FloatArray, IntArray
from .core.calls import call
from .elasticity.springs import PressedSprings, SpringPositions, SpringsOfConnections
from .elasticity.substep import Places


@dataclass(frozen=True, slots=True, eq=False)
class SoilSprings:
    """Springs under f footings, at p positions."""

    rows: IntArray  # (f,), connection of each footing with the ground, in ascending order
    footings: IntArray  # (p,), footing of each spring, in ascending order
    places_m: FloatArray  # (p, 3), position as the bridge was built
    areas_m2: FloatArray  # (p,), parts of the area
    stiffness_n_m3: FloatArray  # (f,), pressure by settlement
    horizontal_n_m3: FloatArray  # (f,), shear by slip
    capacity_pa: FloatArray  # (f,), largest pressure, which may be infinite
    friction: FloatArray  # (f,), largest shear by pressure


class Footings(SpringsOfConnections):
    """All footings of a structure of n bodies, which has connections between bodies `first` and `second` (m,).

    Each footing's connection, of `rows` (f,), has the ground as one body. Positions (3, n) and rotations (3, 3, n) are
    of the bridge as built, `moves` (n,) is False for bodies that never move.
    """

    def __init__(
        self,
        springs: SoilSprings,
        first: IntArray,
        second: IntArray,
        moves: BoolArray,
        positions_m: FloatArray,
        rotations: FloatArray,
    ):
        of, one, other = springs.footings, first[springs.rows], second[springs.rows]
        standing = np.where(moves[one], one, other)
        positions = SpringPositions.built(of, springs.places_m, (one, other), standing, positions_m, rotations)
        areas = springs.areas_m2
        horizontal_n_m = areas * springs.horizontal_n_m3[of]
        soil = PressedSprings(
            areas * springs.stiffness_n_m3[of],
            np.stack((horizontal_n_m, horizontal_n_m)),
            areas * springs.capacity_pa[of],
            springs.friction[of],
            np.zeros(len(of), bool),
            np.zeros(len(of)),
        )
        super().__init__(springs.rows, positions, soil)

    def update_plastic_state(self, positions_m: FloatArray, rotations: FloatArray) -> None:
        """Take over, before a sub-step, how far springs have settled or slid for good."""
        call("bda_soil_settle", self.core, Places.of(positions_m, rotations))


PRESSURE_BY_STIFFNESS_M = 0.025
"""Settlement at the ultimate bearing pressure, by which J. E. Bowles (1996), equation 9-9, takes stiffness from that:
k = 40 q, with k in kN/m³ and q in kPa."""

HORIZONTAL_SHARE = 0.8
"""Horizontal over vertical stiffness of a rigid circular footing on an elastic half-space, 2 (1 - ν) / (2 - ν), with
Poisson's ratio ν = 1/3: F. E. Richart, J. R. Hall and R. D. Woods (1970), Vibrations of Soils and Foundations, table
10-13."""


@dataclass(frozen=True, slots=True)
class Soil:
    """A class of soil."""

    stiffness_n_m3: float  # pressure by settlement: modulus of subgrade reaction
    friction: float  # of concrete cast on it

    @property
    def capacity_pa(self) -> float:
        """Pressure that it carries, by its stiffness."""
        return PRESSURE_BY_STIFFNESS_M * self.stiffness_n_m3


SOILS = {
    "loose sand": Soil(10.4e6, 0.40),
    "medium dense sand": Soil(44.8e6, 0.50),
    "dense sand": Soil(96e6, 0.55),
    "clayey medium dense sand": Soil(56e6, 0.40),
    "silty medium dense sand": Soil(36e6, 0.40),
    "medium clay": Soil(18e6, 0.30),
    "stiff clay": Soil(36e6, 0.35),
}
"""Classes to start from where nothing was measured.

Stiffness: the middle of the range in J. E. Bowles (1996), Foundation Analysis and Design, 5th edition, table 9-1; his
clays that carry up to 200 kPa, and from 200 to 800 kPa. Most ranges go from half of it to one and a half times, that of
medium dense sand from a fifth to 1.8 times. Friction: NAVFAC DM-7.02 (1986), chapter 3, table 1, mass concrete on soil.
"""
