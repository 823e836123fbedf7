"""The shaft of a blasted column that falls by the height of the zone and lands: is it crushed, does it buckle or tip?

Each of these is a bound by energy or momentum, of a shaft with flat ends of the section b by t, and of what it carries:

- **Crushing**: the load falls by h, and on by s as the end is crushed with a force f A: N (h + s) = f A s. A front that
  crushes on without an end takes N above f A (Z. P. Bažant and M. Verdure, J. Eng. Mech. 133 (2007) 308-319).
- **Buckling**: f A presses the shaft as it lands, over Euler's load with both ends hinged.
- **Leaning**: N passes through the section that it lands on, less a strip N / (f t) that it crushes.
- **Tipping**: a shaft that lands on an edge with v turns about it, ω = M v (b / 2) / I, goes over to the other edge,
  and over that one if what is left of ½ I ω² lifts its mass over it: G. W. Housner, Bull. Seismol. Soc. Am. 53 (1963)
  403-417, with the impact of a fall in the place of the ground's motion. Nothing holds its head. A slender shaft takes
  a fall of half its length, whatever the load and the section, if its own mass is small, of a third without a load.

With several zones these are bounds of each piece between them, under all that is above it.

Bars in the zone, which fold, take some of the energy: less is crushed, and it tips less.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..elasticity.section_stiffness import ELASTIC_MODULI
from ..units import STANDARD_GRAVITY_M_S2

_MODULUS_PA = ELASTIC_MODULI["concrete"].young_pa

_LEFT_OF_STRENGTH = 0.5
"""Of the strength at ends that explosive has loosened, as in compression of zones that are not thrown out."""


@dataclass(frozen=True, slots=True)
class LandingShaft:
    """A shaft that lands.

    Attributes
    ----------
    length_m : float
        From where it lands to its head.
    side_m, width_m : float
        Of its section, the smaller one first.
    load_n : float
        All that it presses with at rest where it lands.
    weight_n : float
        Its own part of that.
    strength_pa : float
        Of its concrete in compression.
    """

    length_m: float
    side_m: float
    width_m: float
    load_n: float
    weight_n: float
    strength_pa: float

    @property
    def crushing_n(self) -> tuple[float, float]:
        """Forces that crush its end: with what explosive leaves of the strength, and with all of it."""
        whole = self.strength_pa * self.side_m * self.width_m
        return _LEFT_OF_STRENGTH * whole, whole

    def crushed_m(self, falls_m: float) -> tuple[float, float]:
        """Return least and largest height that is crushed as it lands; infinite where its load crushes on and on."""
        most, least = (
            falls_m * self.load_n / (force - self.load_n) if force > self.load_n else math.inf
            for force in self.crushing_n
        )
        return least, most

    @property
    def lean_m(self) -> float:
        """How far its head may be off the middle of its foot while it stands; 0 where all of it is crushed."""
        return max(0.0, self.side_m / 2.0 - self.load_n / (2.0 * _LEFT_OF_STRENGTH * self.strength_pa * self.width_m))

    @property
    def buckles(self) -> bool:
        """Whether the force that crushes its end buckles it before."""
        inertia_m4 = self.width_m * self.side_m * self.side_m * self.side_m / 12.0
        euler_n = math.pi * math.pi * _MODULUS_PA * inertia_m4 / (self.length_m * self.length_m)
        return self.crushing_n[1] > euler_n

    @property
    def tips_from_m(self) -> float:
        """Least fall from which it tips over where it lands on an edge, and nothing holds its head."""
        mass_kg, shaft_kg = self.load_n / STANDARD_GRAVITY_M_S2, self.weight_n / STANDARD_GRAVITY_M_S2
        head_kg, side2, length2 = mass_kg - shaft_kg, self.side_m * self.side_m, self.length_m * self.length_m
        about_edge = head_kg * (length2 + side2 / 4.0) + shaft_kg * (length2 + side2) / 3.0
        centre_m = (head_kg + shaft_kg / 2.0) * self.length_m / mass_kg
        lifted_m = math.hypot(centre_m, self.side_m / 2.0) - centre_m
        kept = 1.0 - mass_kg * side2 / (2.0 * about_edge)
        return 4.0 * about_edge * lifted_m / (mass_kg * side2 * kept * kept) if kept > 0.0 else math.inf
