"""Soils: how stiff they are under a footing, what they carry, and how they resist sliding."""

from __future__ import annotations

from dataclasses import dataclass

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
