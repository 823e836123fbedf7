"""Materials of elements: the name and density in the IFC file, and the row in the table of materials."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from ..errors import IfcError
from .elements import Element
from .library import library
from .materials import MaterialRow, MaterialTable
from .settings import ImportSettings
from .source import IfcSource

LEAST_KG_M3, MOST_KG_M3 = 50.0, 25_000.0
"""Densities that a building material has, from rigid foam to beyond lead; others are in another unit."""

_GRAMS = 1000.0
_LISTED = 5


@dataclass(frozen=True, slots=True)
class Substance:
    """Material of an element: its name in the file or of the user's, its density in the file or table, and its row.

    The note says what the import has assumed.
    """

    name: str
    density_kg_m3: float
    row: MaterialRow
    note: str = ""


def substances(
    source: IfcSource, elements: Sequence[Element], table: MaterialTable, settings: ImportSettings
) -> list[Substance]:
    """Return the material of each element."""
    table_name = str(settings.materials) if settings.materials else "the table of materials"
    if settings.material is not None and table.row(settings.material) is None:
        raise IfcError(f'material is "{settings.material}", which {table_name} does not know')
    reader = _Reader(source, table, settings.material)
    known = []
    unknown: dict[str, list[str]] = {}
    for element in elements:
        substance = reader.substance(element.entity)
        if isinstance(substance, str):
            unknown.setdefault(substance, []).append(element.facts.name)
        else:
            known.append(substance)
    if unknown:
        named = "; ".join(f"{name or 'no material'}: {_some(names)}" for name, names in unknown.items())
        raise IfcError(
            f"{source.path}: {table_name} does not know the materials of {named}. Say by --material "
            "concrete what such elements are, or write the table by bda import --write-materials FILE, add rows for "
            "these names, and give it by --materials FILE"
        )
    return known


def _some(names: Sequence[str]) -> str:
    more = f" and {len(names) - _LISTED} more" if len(names) > _LISTED else ""
    return ", ".join(names[:_LISTED]) + more


@dataclass(frozen=True, slots=True)
class _Reader:
    """Reads the materials of elements."""

    source: IfcSource
    table: MaterialTable
    otherwise: str | None

    def substance(self, entity: Any) -> Substance | str:
        """Return the material of an element; its name where the table lacks it, empty for no material."""
        material = library("util.element").get_material(entity, should_skip_usage=True)
        parts = _parts_of(material)
        if not parts:
            if self.otherwise and (row := self.table.row(self.otherwise)):
                return Substance(self.otherwise, row.density_kg_m3, row, "the file gives no material")
            return ""
        all_parts = [self._one(part) for part, _ in parts]
        known = [part for part in all_parts if isinstance(part, Substance)]
        if not known:
            return all_parts[0]
        shares = [share for _, share in parts if share is not None]
        if len(known) < len(parts) or len(parts) == 1 or len(shares) < len(parts):
            more = f"made of {len(parts)} materials, of which {known[0].name} counts" if len(parts) > 1 else ""
            return replace(known[0], note="; ".join(note for note in (known[0].note, more) if note))
        density = sum(part.density_kg_m3 * share for part, share in zip(known, shares, strict=True)) / sum(shares)
        main = known[shares.index(max(shares))]
        return Substance(main.name, density, main.row, f"the density is the mean of {len(known)} layers by thickness")

    def _one(self, material: Any) -> Substance | str:
        name = (material.Name or "").strip()
        row = self.table.row(name)
        note = ""
        if row is None and self.otherwise:
            row, note = self.table.row(self.otherwise), f"{name or 'its material'} is taken for {self.otherwise}"
        if row is None:
            return name or "a material without a name"
        density = self._density_of_file(material)
        if density is None:
            return Substance(name, row.density_kg_m3, row, note)
        if not LEAST_KG_M3 <= density <= MOST_KG_M3:
            unlikely = f"the file gives {density:.4g} kg/m³ for {name}, so the density is that of the table"
            return Substance(name, row.density_kg_m3, row, f"{note}; {unlikely}" if note else unlikely)
        return Substance(name, density, row, note)

    def _density_of_file(self, material: Any) -> float | None:
        """Return the density that the file gives a material, kg/m³."""
        psets = library("util.element").get_psets(material)
        values = [pset["MassDensity"] for pset in psets.values() if isinstance(pset.get("MassDensity"), int | float)]
        if not values and self.source.model.schema == "IFC2X3":
            general = self.source.model.by_type("IfcGeneralMaterialProperties")
            values = [row.MassDensity for row in general if row.Material == material and row.MassDensity]
        return float(values[0]) * _density_unit(self.source.model) if values else None


def _parts_of(material: Any) -> list[tuple[Any, float | None]]:
    """Return the materials that a material is made of, and the share of each where the file gives it."""
    if material is None:
        return []
    if material.is_a("IfcMaterial"):
        return [(material, 1.0)]
    if material.is_a("IfcMaterialLayerSet"):
        return [(layer.Material, layer.LayerThickness) for layer in material.MaterialLayers if layer.Material]
    if material.is_a("IfcMaterialProfileSet"):
        return [(profile.Material, None) for profile in material.MaterialProfiles if profile.Material]
    if material.is_a("IfcMaterialConstituentSet"):
        return [(part.Material, part.Fraction) for part in material.MaterialConstituents or () if part.Material]
    return [(part, None) for part in material.Materials]


def _density_unit(model: Any) -> float:
    """Return the kg/m³ in the file's unit of density; 1 where it gives none."""
    units = model.by_type("IfcProject")[0].UnitsInContext
    if not any(getattr(unit, "UnitType", None) == "MASSDENSITYUNIT" for unit in (units.Units if units else ())):
        return 1.0
    return library("util.unit").calculate_unit_scale(model, "MASSDENSITYUNIT") / _GRAMS
