"""Lengths, areas and masses in texts of the window: in feet and pounds where the scene shows imperial units."""

from __future__ import annotations

import bpy

from ..engineering.units import kilograms

_IMPERIAL = "IMPERIAL"
_DIGITS = 4
"""Significant digits of imperial units."""


def units_of_texts() -> str:
    """Return Blender's name for the system of units that texts have now."""
    return bpy.context.scene.unit_settings.system


def length_text(length_m: float, spec: str) -> str:
    """Return a length as text; in m with a format such as ``.2f``."""
    return _imperial("LENGTH", length_m) or f"{length_m:{spec}} m"


def area_text(area_m2: float, spec: str) -> str:
    """Return an area as text; in m² with a format such as ``.0f``."""
    return _imperial("AREA", area_m2) or f"{area_m2:{spec}} m²"


def mass_text(mass_kg: float) -> str:
    """Return a mass as text; in kg with blanks between thousands."""
    return _imperial("MASS", mass_kg) or kilograms(mass_kg)


def _imperial(category: str, value: float) -> str:
    """Return a value as Blender shows it in imperial units; empty where the scene shows others."""
    if units_of_texts() != _IMPERIAL:
        return ""
    return bpy.utils.units.to_string(_IMPERIAL, category, value, precision=_DIGITS)
