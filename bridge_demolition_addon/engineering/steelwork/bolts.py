"""Bolts at the end of a steel bar: what they resist in shear, and the section that their holes leave.

Bolts of EN ISO 898-1 that are not preloaded, in the holes of EN 1090-2. No partial factors: γ_M2 = 1.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from ...errors import ScenarioError
from .sections import SteelSection

_MM, _MM2, _MPA = 1e-3, 1e-6, 1e6

_STRESSED_MM2 = {12: 84.3, 14: 115.0, 16: 157.0, 18: 192.0, 20: 245.0, 22: 303.0, 24: 353.0, 27: 459.0} | {
    30: 561.0,
    33: 694.0,
    36: 817.0,
}
"""Tensile stress area A_s by diameter in mm, of coarse threads: EN ISO 898-1:2013, table 4."""

_GRADES = {
    "4.6": (400.0, 0.6),
    "4.8": (400.0, 0.5),
    "5.6": (500.0, 0.6),
    "5.8": (500.0, 0.5),
    "6.8": (600.0, 0.5),
    "8.8": (800.0, 0.6),
    "10.9": (1000.0, 0.5),
}
"""Strength f_ub in N/mm² (EN 1993-1-8:2005, table 3.1) and α_v with threads in the plane of shear (table 3.4)."""

_CLEARANCES_MM = ((14, 1.0), (24, 2.0), (math.inf, 3.0))
"""Holes are wider than bolts by so much, up to diameters in mm: normal round holes, EN 1090-2:2018, table 11."""

_NET = 0.9
"""Of A_net f_u: EN 1993-1-1:2005, equation 6.7."""

_USUAL_LINES = 2

_FORM = re.compile(
    r"(?P<count>[1-9][0-9]?[0-9]?) M(?P<diameter>[0-9]+) (?P<grade>[0-9]+\.[0-9])"
    r"(?: in (?P<lines>[1-9][0-9]?) lines?)?(?P<double> in double shear)?"
)

WELDED = "welded"
"""In place of bolts: a joint as strong as the bar."""


@dataclass(frozen=True, slots=True)
class Bolts:
    """Bolts at one end of a bar.

    Attributes
    ----------
    lines : int
        Lines along the bar in which they lie: so many holes are in a section across it.
    planes : int
        Planes of shear of each bolt.
    """

    count: int
    diameter_mm: int
    grade: str
    lines: int
    planes: int

    @property
    def shear_n(self) -> float:
        """What all of them resist in shear: Σ α_v f_ub A_s, EN 1993-1-8:2005, table 3.4, threads in the plane."""
        strength_mpa, share = _GRADES[self.grade]
        return self.count * self.planes * share * strength_mpa * _MPA * _STRESSED_MM2[self.diameter_mm] * _MM2

    @property
    def hole_m(self) -> float:
        """Diameter of a hole."""
        clearance_mm = next(more for largest, more in _CLEARANCES_MM if self.diameter_mm <= largest)
        return _MM * (self.diameter_mm + clearance_mm)

    def net_area_m2(self, section: SteelSection) -> float:
        """Return what holes leave of a section whose holes all lie in its thickest part, which is on the safe side."""
        return section.area_m2 - self.lines * self.hole_m * section.thickest_m

    def net_section_n(self, section: SteelSection, ultimate_pa: float) -> float:
        """Return what that section resists in tension: 0.9 A_net f_u, EN 1993-1-1:2005, equation 6.7."""
        return _NET * self.net_area_m2(section) * ultimate_pa

    def resistance_n(self, section: SteelSection, ultimate_pa: float) -> float:
        """Return the axial force that the end resists: by its bolts or by its net section, whichever is less."""
        return min(self.shear_n, self.net_section_n(section, ultimate_pa))


def bolts_named(text: str) -> Bolts | None:
    """Return bolts such as ``8 M20 8.8`` or ``8 M20 8.8 in 4 lines in double shear``; None of what is welded.

    Raises
    ------
    ScenarioError
        It is no such text, or there is no such bolt.
    """
    if text == WELDED:
        return None
    found = _FORM.fullmatch(text)
    if not found:
        raise ScenarioError(
            f'bolts "{text}": expected their number, size and grade, such as "8 M20 8.8", with " in 4 lines" and '
            f'" in double shear" behind it where they are, or "{WELDED}"'
        )
    diameter, grade, count = int(found["diameter"]), found["grade"], int(found["count"])
    if diameter not in _STRESSED_MM2:
        sizes = ", ".join(f"M{size}" for size in _STRESSED_MM2)
        raise ScenarioError(f'bolts "{text}" are M{diameter}: expected one of {sizes}')
    if grade not in _GRADES:
        raise ScenarioError(f'bolts "{text}" are of grade {grade}: expected one of {", ".join(_GRADES)}')
    lines = int(found["lines"] or min(count, _USUAL_LINES))
    if lines > count:
        raise ScenarioError(f'bolts "{text}" are {count} in {lines} lines: expected no more lines than bolts')
    return Bolts(count, diameter, grade, lines, 2 if found["double"] else 1)
