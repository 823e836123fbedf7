"""What property sets say of an element: volume, mass, type and material, as its authoring program wrote them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from .library import library

_VOLUMES = ("netvolume", "volume", "grossvolume")
_MASSES = ("netweight", "weight", "mass", "grossweight")
"""Names of quantities, the one that counts first."""

_WORDS = ("type", "label", "classification", "category", "family", "element type")
_MATERIALS = ("material", "materiale", "werkstoff", "matériau", "materiaal")

_LEAST_M3 = 1e-6
_GRAMS = 1000.0

PropertySets = Mapping[str, Mapping[str, Any]]


@dataclass(frozen=True, slots=True)
class Quantities:
    """Volume and mass of an element by its authoring program; None where that does not say."""

    volume_m3: float | None = None
    mass_kg: float | None = None

    @property
    def density_kg_m3(self) -> float | None:
        """Mass over volume; None where one is not known."""
        return self.mass_kg / self.volume_m3 if self.mass_kg and self.volume_m3 else None


@dataclass(frozen=True, slots=True)
class QuantityUnits:
    """Cubic metres and kilograms in the units of a file."""

    volume_m3: float = 1.0
    mass_kg: float = 1.0


def units_of(model: Any) -> QuantityUnits:
    """Return the units of quantities in a file, 1 m³ and 1 kg where it gives none."""
    units = model.by_type("IfcProject")[0].UnitsInContext
    kinds = {getattr(unit, "UnitType", None) for unit in (units.Units if units else ())}
    scale = library("util.unit").calculate_unit_scale
    volume = scale(model, "VOLUMEUNIT") if "VOLUMEUNIT" in kinds else 1.0
    return QuantityUnits(volume, _mass_unit(units.Units if units else ()))


def _mass_unit(units: Any) -> float:
    """Return the kilograms in the file's unit of mass.

    An `IfcSIUnit` of mass is a gram with a prefix. Programs that write GRAM without one mean kilograms: no bridge is
    weighed in grams.
    """
    for unit in units:
        if getattr(unit, "UnitType", None) == "MASSUNIT" and unit.is_a("IfcSIUnit") and unit.Prefix:
            return float(library("util.unit").get_prefix_multiplier(unit.Prefix)) / _GRAMS
    return 1.0


def quantities_of(psets: PropertySets, units: QuantityUnits) -> Quantities:
    """Return volume and mass of an element; sets of quantities, which are not rounded for reading, come first."""
    ordered = sorted(psets.items(), key=lambda item: not _is_of_quantities(item[0]))
    volume = _number(ordered, _VOLUMES)
    mass = _number(ordered, _MASSES)
    volume_m3 = volume * units.volume_m3 if volume else None
    return Quantities(
        volume_m3 if volume_m3 and volume_m3 > _LEAST_M3 else None, mass * units.mass_kg if mass else None
    )


def words_of(psets: PropertySets) -> str:
    """Return what property sets call an element: its type, label or classification."""
    texts = (
        value
        for pset in psets.values()
        for name, value in pset.items()
        if isinstance(value, str) and (name.casefold() in _WORDS or name.casefold().endswith("_label"))
    )
    return " ".join(dict.fromkeys(texts))


def material_name(psets: PropertySets) -> str:
    """Return the name of a material that stands in property sets, where no IfcMaterial does; empty without one."""
    for pset in psets.values():
        for name, value in pset.items():
            if isinstance(value, str) and name.casefold() in _MATERIALS and value.strip():
                return value.strip()
    return ""


def _is_of_quantities(name: str) -> bool:
    return name.startswith("Qto_") or name == "BaseQuantities"


def _number(psets: list[tuple[str, Mapping[str, Any]]], names: tuple[str, ...]) -> float | None:
    for _, pset in psets:
        plain = {key.casefold(): value for key, value in pset.items()}
        for name in names:
            value = plain.get(name)
            if isinstance(value, int | float) and not isinstance(value, bool) and value > 0.0:
                return float(value)
    return None
