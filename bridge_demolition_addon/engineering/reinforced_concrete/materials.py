"""Concrete and reinforcing steel as designs take them: characteristic strengths, and what partial factors leave."""

from __future__ import annotations

from dataclasses import dataclass

from ..arithmetic import logarithm, power
from ..elasticity.steel_bars import Steel

PERMANENT_FACTOR = 1.35
VARIABLE_FACTOR = 1.5
"""γ_G and γ_Q: EN 1990:2002, table A1.2(B). Its annex A2 has 1.35 for road traffic: this is on the safe side."""

CONCRETE_FACTOR = 1.5
STEEL_FACTOR = 1.15
"""γ_c and γ_s, persistent and transient: EN 1992-1-1:2004, table 2.1N."""

LONG_TERM_FACTOR = 1.0
"""α_cc as EN 1992-1-1:2004, 3.1.6 (1) recommends; EN 1992-2 recommends 0.85."""

STEEL_DENSITY_KG_M3 = 7850.0
"""EN 1992-1-1:2004, 3.2.7 (3)."""

_MEGA = 1e6
_ORDINARY_N_MM2 = 50.0
"""Strength up to which concrete has the stress block of ordinary concrete."""

GRADES = {
    "B400B": Steel(400e6, 1.08, 0.05),
    "B400C": Steel(400e6, 1.15, 0.075),
    "B500A": Steel(500e6, 1.05, 0.025),
    "B500B": Steel(500e6, 1.08, 0.05),
    "B500C": Steel(500e6, 1.15, 0.075),
    "Grade 40": Steel(280e6, 420.0 / 280.0, 0.07),
    "Grade 60": Steel(420e6, 620.0 / 420.0, 0.05),
}
"""Yield strength, tensile over yield strength and strain under the largest force.

Classes A to C: EN 1992-1-1:2004, table C.1, least values. Grades 40 and 60: ASTM A615/A615M-04a, table 2, which bars of
bridges that are demolished now have; since 2018 Grade 60 has 550 N/mm². It gives no strain under the largest force:
taken is less than its elongation at fracture, 11 and 7 to 9 %, which has the necking in it.
"""


@dataclass(frozen=True, slots=True)
class Concrete:
    """Concrete of a characteristic strength in compression, f_ck."""

    strength_pa: float

    @property
    def design_pa(self) -> float:
        """f_cd: equation 3.15."""
        return LONG_TERM_FACTOR * self.strength_pa / CONCRETE_FACTOR

    @property
    def tension_pa(self) -> float:
        """f_ctm: table 3.1."""
        f_ck = self.strength_pa / _MEGA
        if f_ck <= _ORDINARY_N_MM2:
            return float(_MEGA * 0.3 * power(f_ck, 2.0 / 3.0))
        return float(_MEGA * 2.12 * logarithm(1.8 + 0.1 * f_ck))

    @property
    def block_depth(self) -> float:
        """λ, depth of the stress block over depth of the neutral axis: equations 3.19 and 3.20."""
        return 0.8 - max(self.strength_pa / _MEGA - _ORDINARY_N_MM2, 0.0) / 400.0

    @property
    def block_pa(self) -> float:
        """η f_cd, stress of the block: equations 3.21 and 3.22."""
        return self.design_pa * (1.0 - max(self.strength_pa / _MEGA - _ORDINARY_N_MM2, 0.0) / 200.0)

    @property
    def deepest_neutral_axis(self) -> float:
        """Largest x/d of a section that needs no bars in compression, and rotates enough: 5.5 (4) and 5.6.3 (2)."""
        return 0.45 if self.strength_pa <= _ORDINARY_N_MM2 * _MEGA else 0.35

    @property
    def crushing_strain(self) -> float:
        """ε_cu3: table 3.1."""
        f_ck = self.strength_pa / _MEGA
        return 0.0035 if f_ck <= _ORDINARY_N_MM2 else 0.0026 + 0.035 * (max(90.0 - f_ck, 0.0) / 100.0) ** 4


def design_yield_pa(steel: Steel) -> float:
    """Return f_yd: EN 1992-1-1:2004, 3.2.7 (2)."""
    return steel.yield_pa / STEEL_FACTOR
