"""Grades of structural steel: yield and ultimate strength by thickness, EN 1993-1-1:2005, table 3.1 (EN 10025-2)."""

from __future__ import annotations

from ..elasticity.section_stiffness import ElasticModuli

DENSITY_KG_M3 = 7850.0
"""Density of steel: EN 1991-1-1:2002, table A.4, 77 to 78.5 kN/m³."""

STEEL_MODULI = ElasticModuli(210e9, 0.3)
"""EN 1993-1-1:2005, 3.2.6."""

_THIN_M = 0.04

_MPA = 1e6

_STRENGTHS_MPA = {
    "S235": ((235.0, 360.0), (215.0, 360.0)),
    "S275": ((275.0, 430.0), (255.0, 410.0)),
    "S355": ((355.0, 490.0), (335.0, 470.0)),
    "S450": ((440.0, 550.0), (410.0, 550.0)),
}
"""Yield and ultimate strength up to 40 mm, and above that up to 80 mm (ibid.; S355 has 490 N/mm² since AC:2009)."""

GRADES = tuple(_STRENGTHS_MPA)


def strengths_pa(grade: str, thickness_m: float) -> tuple[float, float]:
    """Return yield and ultimate strength of a grade in a thickness."""
    thin, thick = _STRENGTHS_MPA[grade]
    yield_mpa, ultimate_mpa = thin if thickness_m <= _THIN_M else thick
    return _MPA * yield_mpa, _MPA * ultimate_mpa
