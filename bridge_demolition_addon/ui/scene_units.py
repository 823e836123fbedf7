"""Lengths, areas, masses and forces in texts of the window: in feet, pounds and kips where the scene is imperial."""

from __future__ import annotations

import bpy

from ..display.contour_quantities import FORCES
from ..engineering.unit_systems import IMPERIAL, UnitSystem
from ..engineering.units import kilograms

_METRE, _SQUARE_METRE, _KILOGRAM, _KILONEWTON = (IMPERIAL[unit] for unit in ("m", "m²", "kg", "kN"))
"""Into feet, pounds and kips. Blender's own texts would be in stones and square yards, which engineers do not use."""

_N_PER_KN = 1000.0


def units_of_texts() -> UnitSystem:
    """Return the system of units of texts now: the window's scene decides."""
    return UnitSystem.IMPERIAL if bpy.context.scene.unit_settings.system == "IMPERIAL" else UnitSystem.METRIC


def length_text(length_m: float, spec: str) -> str:
    """Return a length as text; in m with a format such as ``.2f``."""
    return f"{_METRE.converted(length_m):.4g} ft" if _is_imperial() else f"{length_m:{spec}} m"


def area_text(area_m2: float, spec: str) -> str:
    """Return an area as text; in m² with a format such as ``.0f``."""
    return f"{_SQUARE_METRE.converted(area_m2):.4g} sq ft" if _is_imperial() else f"{area_m2:{spec}} m²"


def mass_text(mass_kg: float) -> str:
    """Return a mass as text, with blanks between thousands."""
    return f"{_KILOGRAM.converted(mass_kg):,.0f} lb".replace(",", " ") if _is_imperial() else kilograms(mass_kg)


def force_text(force_n: float) -> str:
    """Return a force as text with four digits, in the unit that a colour bar would have, or in kips."""
    if _is_imperial():
        return f"{_KILONEWTON.converted(force_n / _N_PER_KN):.4g} {_KILONEWTON.unit}"
    unit = FORCES.of(abs(force_n))
    return f"{force_n / unit.size:.4g} {unit.name}"


def _is_imperial() -> bool:
    return units_of_texts() is UnitSystem.IMPERIAL
