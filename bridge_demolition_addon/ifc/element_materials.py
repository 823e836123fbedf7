"""What elements are made of: the material that the IFC file names, its density there, and its row in the table."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
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
    """What an element is made of.

    Attributes
    ----------
    name : str
        As the IFC file or the user calls it.
    density_kg_m3 : float
        Of the file, or of the table.
    row : MaterialRow
        Its row of the table.
    note : str
        What is not as it seems; empty for nothing.
    """

    name: str
    density_kg_m3: float
    row: MaterialRow
    note: str = ""


def substances(
    source: IfcSource, elements: Sequence[Element], table: MaterialTable, settings: ImportSettings
) -> list[Substance]:
    """Return what each element is made of."""
    if settings.material is not None and table.row(settings.material) is None:
        raise IfcError(f'material is "{settings.material}", which {_told(settings.materials)} does not know')
    reader = _Reader(source, table, settings.material)
    found = []
    unknown: dict[str, list[str]] = {}
    for element in elements:
        substance = reader.substance(element.entity)
        if isinstance(substance, str):
            unknown.setdefault(substance, []).append(element.facts.name)
        else:
            found.append(substance)
    if unknown:
        named = "; ".join(f"{name or 'no material'}: {_some(names)}" for name, names in unknown.items())
        raise IfcError(
            f"{source.path}: {_told(settings.materials)} does not know the materials of {named}. Say by --material "
            "concrete what such elements are, or write the table by bda import --write-materials FILE, add rows for "
            "these names, and give it by --materials FILE"
        )
    return found


def _told(path: Path | None) -> str:
    return str(path) if path else "the table of materials"


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
        """Return what an element is made of; the name of its material where that is not known, empty for none."""
        material = library("util.element").get_material(entity, should_skip_usage=True)
        parts = _parts_of(material)
        if not parts:
            if self.otherwise and (row := self.table.row(self.otherwise)):
                return Substance(self.otherwise, row.density_kg_m3, row, "the file gives no material")
            return ""
        found = [self._one(part) for part, _ in parts]
        known = [each for each in found if isinstance(each, Substance)]
        if not known:
            return found[0]
        shares = [share for _, share in parts if share is not None]
        if len(known) < len(found) or len(found) == 1 or len(shares) < len(parts):
            more = f"made of {len(found)} materials, of which {known[0].name} counts" if len(found) > 1 else ""
            note = "; ".join(each for each in (known[0].note, more) if each)
            return Substance(known[0].name, known[0].density_kg_m3, known[0].row, note)
        density = sum(each.density_kg_m3 * share for each, share in zip(known, shares, strict=True)) / sum(shares)
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
        given = self._density_of_file(material)
        if given is None:
            return Substance(name, row.density_kg_m3, row, note)
        if not LEAST_KG_M3 <= given <= MOST_KG_M3:
            unlikely = f"the file gives {given:.4g} kg/m³ for {name}, so the density is that of the table"
            return Substance(name, row.density_kg_m3, row, "; ".join(each for each in (note, unlikely) if each))
        return Substance(name, given, row, note)

    def _density_of_file(self, material: Any) -> float | None:
        """Return the density that the file gives a material, kg/m³."""
        psets = library("util.element").get_psets(material)
        values = [pset["MassDensity"] for pset in psets.values() if isinstance(pset.get("MassDensity"), int | float)]
        if not values and self.source.model.schema == "IFC2X3":
            general = self.source.model.by_type("IfcGeneralMaterialProperties")
            values = [each.MassDensity for each in general if each.Material == material and each.MassDensity]
        return float(values[0]) * _density_unit(self.source.model) if values else None


def _parts_of(material: Any) -> list[tuple[Any, float | None]]:
    """Return the materials that a material is made of, and the share of each where the file gives it."""
    if material is None:
        return []
    if material.is_a("IfcMaterial"):
        return [(material, 1.0)]
    if material.is_a("IfcMaterialLayerSet"):
        return [
            (material_layer.Material, material_layer.LayerThickness)
            for material_layer in material.MaterialLayers
            if material_layer.Material
        ]
    if material.is_a("IfcMaterialProfileSet"):
        return [
            (material_profile.Material, None)
            for material_profile in material.MaterialProfiles
            if material_profile.Material
        ]
    if material.is_a("IfcMaterialConstituentSet"):
        return [(each.Material, each.Fraction) for each in material.MaterialConstituents or () if each.Material]
    return [(each, None) for each in material.Materials]


def _density_unit(model: Any) -> float:
    """Return the kg/m³ in the file's unit of density; 1 where it gives none."""
    units = model.by_type("IfcProject")[0].UnitsInContext
    if not any(getattr(each, "UnitType", None) == "MASSDENSITYUNIT" for each in (units.Units if units else ())):
        return 1.0
    return library("util.unit").calculate_unit_scale(model, "MASSDENSITYUNIT") / _GRAMS
