"""Bolts at the end of a steel bar: what they resist in shear, and the section that their holes leave.

Bolts of EN ISO 898-1 that are not preloaded, in the holes of EN 1090-2. No partial factors: γ_M2 = 1. Their pattern is
given by the distances of EN 1993-1-8, figure 3.1.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, replace

from ...errors import ScenarioError
from .resistance import GRADES
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

_USUAL_MM = {"p1": 70, "p2": 70, "e1": 40, "e2": 40}

_ROUNDING = 1e-9

_SIZE = r"[0-9]{1,4}(?:\.[0-9]{1,2})?"

_FORM = re.compile(
    r"(?P<count>[1-9][0-9]?[0-9]?) M(?P<diameter>[0-9]+) (?P<grade>[0-9]+\.[0-9])"
    r"(?: in (?P<lines>[1-9][0-9]?) lines?)?(?P<double> in double shear)?(?:, (?P<pattern>.+))?"
)

_PATTERN = re.compile(
    rf"(?:p1 (?P<p1>{_SIZE}), )?(?:p2 (?P<p2>{_SIZE}), )?e1 (?P<e1>{_SIZE}), e2 (?P<e2>{_SIZE}), "
    rf"gusset (?P<gusset>{_SIZE})(?: (?P<grade>S[0-9]+))?"
)

_LEAST_BY_HOLE = {"e1": 1.2, "e2": 1.2, "p1": 2.2, "p2": 2.4}
"""Least distances by the diameter of the holes: EN 1993-1-8:2005, table 3.3."""

RUPTURE_M = 8.6e-3
"""By how far a joint of bolts has opened, in shear and bearing, as they rupture: 0.34 in, A325 bolts of 3/4 in.

S. F. Crawford and G. L. Kulak, 1971, Eccentrically loaded bolted connections, Journal of the Structural Division
97(ST3), 765-783. AISC's manual takes it for all sizes.
"""

WELDED = "welded"
"""In place of bolts: a joint as strong as the bar."""


@dataclass(frozen=True, slots=True)
class BoltPattern:
    """Where bolts of a gusset lie: in rows across the bar, one behind the other, and in lines along it.

    Attributes
    ----------
    pitch_m, gauge_m : float
        Distances p1 of rows and p2 of lines; 0 where there is one.
    end_m, edge_m : float
        Distances e1 of the last row from the end of the plates, and e2 of the outer lines from their edges.
    gusset_m : float
        Thickness of the gusset; in double shear of each of two.
    gusset_grade : str or None
        Its grade; None for the bar's.
    """

    rows: int
    lines: int
    pitch_m: float
    gauge_m: float
    end_m: float
    edge_m: float
    gusset_m: float
    gusset_grade: str | None

    @property
    def half_m(self) -> tuple[float, float]:
        """From its middle to the bolts of its corners, along the bar and across it."""
        return 0.5 * (self.rows - 1) * self.pitch_m, 0.5 * (self.lines - 1) * self.gauge_m

    @property
    def polar_m2(self) -> float:
        """Sum of the squares of the bolts' distances from the middle."""
        along = self.lines * self.pitch_m * self.pitch_m * self.rows * (self.rows * self.rows - 1)
        across = self.rows * self.gauge_m * self.gauge_m * self.lines * (self.lines * self.lines - 1)
        return (along + across) / 12.0


@dataclass(frozen=True, slots=True)
class Bolts:
    """Bolts at one end of a bar.

    Attributes
    ----------
    lines : int
        Lines of bolts along the bar: the number of holes in a section across it.
    planes : int
        Planes of shear of each bolt.
    pattern : BoltPattern or None
        Where they lie; None where only their number is known.
    """

    count: int
    diameter_mm: int
    grade: str
    lines: int
    planes: int
    pattern: BoltPattern | None = None

    @property
    def ultimate_pa(self) -> float:
        """Strength f_ub of the bolts."""
        return _GRADES[self.grade][0] * _MPA

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

    Their pattern may stand behind them: ``, p1 70, p2 60, e1 40, e2 45, gusset 12 S275``.

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
    bolts = Bolts(count, diameter, grade, lines, 2 if found["double"] else 1)
    return replace(bolts, pattern=_pattern(text, found["pattern"], bolts)) if found["pattern"] else bolts


def _pattern(text: str, given: str, bolts: Bolts) -> BoltPattern:
    """Return the pattern of bolts by its distances in mm."""
    found, rows = _PATTERN.fullmatch(given), bolts.count // bolts.lines
    if rows * bolts.lines != bolts.count:
        raise ScenarioError(f'bolts "{text}" are {bolts.count} in {bolts.lines} lines: expected as many in each line')
    wanted = {"p1": rows > 1, "p2": bolts.lines > 1, "e1": True, "e2": True}
    if not found or any((found[name] is not None) != is_wanted for name, is_wanted in wanted.items()):
        names = ", ".join(f"{name} {size}" for name, size in _USUAL_MM.items() if wanted[name])
        raise ScenarioError(
            f'bolts "{text}": expected distances in mm and the gusset behind the bolts, such as "{names}, gusset 12 '
            'S355", where p1 is that of rows and p2 that of lines where there are several'
        )
    sizes = {name: _MM * float(found[name] or 0.0) for name in wanted}
    for name, least in _LEAST_BY_HOLE.items():
        if wanted[name] and sizes[name] < least * bolts.hole_m * (1.0 - _ROUNDING):
            raise ScenarioError(
                f'bolts "{text}": {name} is {found[name]} mm: expected at least {least * bolts.hole_m / _MM:.1f} mm, '
                f"{least} times the diameter of the hole"
            )
    if found["grade"] and found["grade"] not in GRADES:
        raise ScenarioError(f'bolts "{text}": the gusset is of {found["grade"]}: expected one of {", ".join(GRADES)}')
    gusset_m = _MM * float(found["gusset"])
    if gusset_m <= 0.0:
        raise ScenarioError(f'bolts "{text}": the gusset is {found["gusset"]} mm thick: expected more than 0')
    return BoltPattern(rows, bolts.lines, sizes["p1"], sizes["p2"], sizes["e1"], sizes["e2"], gusset_m, found["grade"])
