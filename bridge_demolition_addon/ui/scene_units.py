"""Lengths, areas and masses in texts of the window: in feet and pounds where the scene shows imperial units."""

from __future__ import annotations

import bpy

from ..engineering.unit_systems import IMPERIAL
from ..engineering.units import kilograms

_METRE, _SQUARE_METRE, _KILOGRAM = (IMPERIAL[unit] for unit in ("m", "m²", "kg"))
"""Into feet and pounds. Blender's own texts would be in stones and square yards, which engineers do not use."""


def units_of_texts() -> str:
    """Return Blender's name for the system of units that texts have now."""
    return bpy.context.scene.unit_settings.system


def length_text(length_m: float, spec: str) -> str:
    """Return a length as text; in m with a format such as ``.2f``."""
    return f"{_METRE.converted(length_m):.4g} ft" if _is_imperial() else f"{length_m:{spec}} m"


def area_text(area_m2: float, spec: str) -> str:
    """Return an area as text; in m² with a format such as ``.0f``."""
    return f"{_SQUARE_METRE.converted(area_m2):.4g} sq ft" if _is_imperial() else f"{area_m2:{spec}} m²"


def mass_text(mass_kg: float) -> str:
    """Return a mass as text, with blanks between thousands."""
    return f"{_KILOGRAM.converted(mass_kg):,.0f} lb".replace(",", " ") if _is_imperial() else kilograms(mass_kg)


def _is_imperial() -> bool:
    return units_of_texts() == "IMPERIAL"
