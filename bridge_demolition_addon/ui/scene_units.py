"""Lengths, areas and masses in texts of the window: in feet and pounds where the scene shows imperial units."""

from __future__ import annotations

import bpy

from ..engineering.units import kilograms

_FOOT_M, _POUND_KG = 0.3048, 0.45359237
"""By the agreement of 1959. Blender's own texts would be in stones and square yards, which engineers do not use."""


def units_of_texts() -> str:
    """Return Blender's name for the system of units that texts have now."""
    return bpy.context.scene.unit_settings.system


def length_text(length_m: float, spec: str) -> str:
    """Return a length as text; in m with a format such as ``.2f``."""
    return f"{length_m / _FOOT_M:.4g} ft" if _is_imperial() else f"{length_m:{spec}} m"


def area_text(area_m2: float, spec: str) -> str:
    """Return an area as text; in m² with a format such as ``.0f``."""
    return f"{area_m2 / _FOOT_M**2:.4g} sq ft" if _is_imperial() else f"{area_m2:{spec}} m²"


def mass_text(mass_kg: float) -> str:
    """Return a mass as text, with blanks between thousands."""
    return f"{mass_kg / _POUND_KG:,.0f} lb".replace(",", " ") if _is_imperial() else kilograms(mass_kg)


def _is_imperial() -> bool:
    return units_of_texts() == "IMPERIAL"
