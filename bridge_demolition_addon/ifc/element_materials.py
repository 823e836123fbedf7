"""Materials of elements: the name and density in the IFC file, and its row in the table that users can change."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from importlib.resources import files
from pathlib import Path
from typing import Any, ClassVar, Self

from ..engineering.mechanics.strength import MATERIALS, NEWTON_PER_SQUARE_MILLIMETRE
from ..errors import IfcError, OutputError, ScenarioError
from ..model.materials import MODULUS, Material
from ..model.schema import Table, given, key
from ..model.toml_tables import document_of_file, table_of_document, toml_document
from ..system.disk import whole_file, writing
from .elements import Element
from .library import library
from .missing_references import items_of
from .quantities import QuantityUnits, material_name, quantities_of, units_of
from .settings import ImportSettings, matches
from .source import IfcSource

_FILE = "materials.toml"
_STRENGTH = {"unit": "N/mm²", "above": 0}
_STRESSES = ("compression", "tension", "shear", "torsion", "bending")
_OWN = ("compression_n_mm2", "tension_n_mm2", "shear_n_mm2", "torsion_n_mm2", "bending_n_mm2")


@dataclass(frozen=True, slots=True, kw_only=True)
class MaterialRow(Table):
    """A material of an IFC file."""

    table: ClassVar[str] = "materials"

    name: str = key("Name in the IFC file; * stands for anything.")
    density_kg_m3: float = key("Density, where the IFC file gives none.", unit="kg/m³", above=0)
    strength: str | None = key("Material of the add-on with its strength.", default=None, choices=tuple(MATERIALS))
    compression_n_mm2: float | None = key("Strength in compression.", default=None, **_STRENGTH)
    tension_n_mm2: float | None = key("Strength in tension.", default=None, **_STRENGTH)
    shear_n_mm2: float | None = key("Strength in shear.", default=None, **_STRENGTH)
    torsion_n_mm2: float | None = key("Strength in torsion.", default=None, **_STRENGTH)
    bending_n_mm2: float | None = key("Strength in bending.", default=None, **_STRENGTH)
    elastic_modulus_n_mm2: float | None = key("Modulus of elasticity.", default=None, **MODULUS)

    @property
    def own(self) -> Material | None:
        """The material with the strengths of the row and its name; None without strengths."""
        if self.strength is not None:
            return None
        values = {name: getattr(self, name) for name in (*_OWN, "elastic_modulus_n_mm2")}
        return Material(name=self.name.replace("*", "").strip() or "own material", **values)

    @property
    def strength_name(self) -> str:
        """Name in a scenario of the material whose strength its connections have."""
        return self.strength or given(self.own).name

    def with_compression(self, name: str, compression_n_mm2: float) -> Self:
        """Return the row with another strength in compression, under the name of the material.

        The modulus of elasticity follows EN 1992-1-1:2004, table 3.1, by the mean strength, 8 N/mm² above the
        characteristic one. All else comes from bars, or is low anyway.
        """
        strength = MATERIALS[given(self.strength)]
        values = {
            f"{kind}_n_mm2": float(getattr(strength, f"{kind}_pa")) / NEWTON_PER_SQUARE_MILLIMETRE for kind in _STRESSES
        }
        modulus = 22_000.0 * ((compression_n_mm2 + 8.0) / 10.0) ** 0.3
        values |= {"compression_n_mm2": round(compression_n_mm2, 3), "elastic_modulus_n_mm2": round(modulus)}
        return replace(self, name=f"{name} {compression_n_mm2:.0f}", strength=None, **values)

    def _check_together(self) -> None:
        named = [name for name in (*_OWN, "elastic_modulus_n_mm2") if getattr(self, name) is not None]
        missing = [name for name in _OWN if getattr(self, name) is None]
        if self.strength is None and missing:
            raise ScenarioError(
                f'materials for "{self.name}": {missing[0]} is missing: expected strength, or all of {", ".join(_OWN)}'
            )
        if self.strength is not None and named:
            raise ScenarioError(f'materials for "{self.name}": strength and {named[0]} are given: expected one of them')


@dataclass(frozen=True, slots=True, kw_only=True)
class MaterialTable(Table):
    """Materials by name: the first that matches counts."""

    table: ClassVar[str] = "material_table"

    materials: tuple[MaterialRow, ...] = ()

    def row(self, name: str) -> MaterialRow | None:
        """Return the row of a material; None where the table has none."""
        return next((material for material in self.materials if matches(material.name, (name,))), None)


def material_table(path: Path | None = None) -> MaterialTable:
    """Return the user's table of materials, or the add-on's."""
    try:
        if path is None:
            return table_of_document(MaterialTable, toml_document(_text()))
        return table_of_document(MaterialTable, document_of_file(path, "a table of materials"))
    except ScenarioError as error:
        raise IfcError(f"{path}: {error}") from error


def write_material_table(path: Path) -> None:
    """Write the add-on's table of materials, for the user to change."""
    if path.exists():
        raise OutputError(f"{path}: exists already; give another name, or delete it")
    with writing(path), whole_file(path) as part:
        part.write_text(_text(), encoding="utf-8")


def _text() -> str:
    return files(__package__).joinpath(_FILE).read_text(encoding="utf-8")


LEAST_KG_M3, MOST_KG_M3 = 50.0, 25_000.0
"""Densities that a building material has, from rigid foam to beyond lead; others are in another unit."""

_GRAMS = 1000.0
_LISTED = 5

_WEAKEST_N_MM2, _STRONGEST_N_MM2 = 5.0, 250.0
"""Strengths in compression that concrete has, from old mass concrete to that of ultra-high strength."""

_CONCRETES = ("concrete", "reinforced concrete column", "reinforced concrete slab", "reinforced concrete wall")

_ROLLED = (
    *("IfcIShapeProfileDef", "IfcLShapeProfileDef", "IfcUShapeProfileDef", "IfcTShapeProfileDef"),
    *("IfcCShapeProfileDef", "IfcZShapeProfileDef", "IfcRectangleHollowProfileDef", "IfcCircleHollowProfileDef"),
)
"""Profiles that steel is rolled in."""


@dataclass(frozen=True, slots=True)
class ElementMaterial:
    """Material of an element: its name in the file or of the user's, its density in the file or table, and its row.

    The note says what the import has assumed.
    """

    name: str
    density_kg_m3: float
    row: MaterialRow
    note: str = ""
    is_by_file: bool = False
    """Whether the file gives the material its density."""


def substances(
    source: IfcSource, elements: Sequence[Element], table: MaterialTable, settings: ImportSettings
) -> dict[int, ElementMaterial]:
    """Return the material of each element by its number in the file.

    One that the table does not know is refused where this is strict. Elsewhere it is the material that the user says,
    and otherwise steel for rolled profiles, soil for fill and concrete for all else.
    """
    table_name = str(settings.materials) if settings.materials else "the table of materials"
    if settings.material is not None and table.row(settings.material) is None:
        raise IfcError(f'material is "{settings.material}", which {table_name} does not know')
    reader = _Reader(source, table, settings.material)
    known: dict[int, ElementMaterial] = {}
    unknown: dict[str, list[str]] = {}
    for element in elements:
        substance = _material_by_user(element, table, table_name, settings) or reader.substance(element)
        if isinstance(substance, str) and not settings.strict and element.kind != "bearing":
            substance = _assumed(element, substance, table) or substance
        if isinstance(substance, ElementMaterial):
            known[element.entity.id()] = _weighed(substance, element, reader.units)
        elif element.kind != "bearing":  # which becomes part of what it lies on
            unknown.setdefault(substance, []).append(element.facts.name)
    if unknown:
        named = "; ".join(f"{name or 'no material'}: {_some(names)}" for name, names in unknown.items())
        raise IfcError(
            f"{source.path}: {table_name} does not know the materials of {named}. Say by --material "
            "concrete what such elements are, or write the table by bda import --write-materials FILE, add rows for "
            "these names, and give it by --materials FILE"
        )
    return known


def _material_by_user(
    element: Element, table: MaterialTable, table_name: str, settings: ImportSettings
) -> ElementMaterial | None:
    """Return the material that the user says an element has; None where the user says none."""
    for pattern, name in settings.materials_of:
        if matches(pattern, element.names):
            row = table.row(name)
            if row is None:
                raise IfcError(f'material of "{pattern}" is "{name}", which {table_name} does not know')
            return ElementMaterial(name, row.density_kg_m3, row, "its material is as the user says", is_by_file=True)
    return None


def _assumed(element: Element, name: str, table: MaterialTable) -> ElementMaterial | None:
    """Return the material that an element of an unknown one is taken to have; None where the table lacks that too."""
    usual = "soil" if element.kind == "fill" else "concrete"
    assumed = "steel" if has_rolled_profile(element.entity) else usual
    row = table.row(assumed)
    if row is None:
        return None
    note = f"{name} is not known, taken for {assumed}" if name else f"the file gives no material: taken for {assumed}"
    return ElementMaterial(name or assumed, row.density_kg_m3, row, note)


def has_rolled_profile(entity: Any) -> bool:
    """Return whether the body of an element is swept from a profile that steel is rolled in."""
    profiles = (getattr(item, "SweptArea", None) for item in items_of(entity))
    return any(profile is not None and any(profile.is_a(name) for name in _ROLLED) for profile in profiles)


def _weighed(substance: ElementMaterial, element: Element, units: QuantityUnits) -> ElementMaterial:
    """Return a material with the density by the mass and volume that the file gives the element itself."""
    density = quantities_of(element.psets, units).density_kg_m3
    if density is None or not LEAST_KG_M3 <= density <= MOST_KG_M3 or substance.is_by_file:
        return substance
    note = f"its density is its mass over its volume in the file, {density:.0f} kg/m³"
    return replace(substance, density_kg_m3=density, note="; ".join(filter(None, (substance.note, note))))


def _some(names: Sequence[str]) -> str:
    more = f" and {len(names) - _LISTED} more" if len(names) > _LISTED else ""
    return ", ".join(names[:_LISTED]) + more


@dataclass(frozen=True)
class _Reader:
    """Reads the materials of elements."""

    source: IfcSource
    table: MaterialTable
    otherwise: str | None

    @cached_property
    def units(self) -> QuantityUnits:
        """Units of quantities in the file."""
        return units_of(self.source.model)

    def substance(self, element: Element) -> ElementMaterial | str:
        """Return the material of an element; its name where the table lacks it, empty for no material."""
        parts = _parts_of(self._material(element))
        if not parts and (name := material_name(element.psets)):
            row = self.table.row(name)
            if row is None:
                return name
            return ElementMaterial(name, row.density_kg_m3, row, f"its properties give {name} as its material")
        if not parts:
            if self.otherwise and (row := self.table.row(self.otherwise)):
                return ElementMaterial(self.otherwise, row.density_kg_m3, row, "the file gives no material")
            return ""
        all_parts = [self._one(part) for part, _ in parts]
        known = [part for part in all_parts if isinstance(part, ElementMaterial)]
        if not known:
            return all_parts[0]
        shares = [share for _, share in parts if share is not None]
        if len(known) < len(parts) or len(parts) == 1 or len(shares) < len(parts):
            more = f"made of {len(parts)} materials, of which {known[0].name} counts" if len(parts) > 1 else ""
            return replace(known[0], note="; ".join(note for note in (known[0].note, more) if note))
        by_thickness = math.fsum(part.density_kg_m3 * share for part, share in zip(known, shares, strict=True))
        density = by_thickness / math.fsum(shares)
        main = known[shares.index(max(shares))]
        return ElementMaterial(
            main.name, density, main.row, f"the density is the mean of {len(known)} layers by thickness"
        )

    def _material(self, element: Element) -> Any:
        """Return the material of an element, or else of the smallest assembly that has it as a part and has one."""
        wholes = (self.source.model.by_id(number) for number in element.wholes)
        for entity in (element.entity, *(whole for whole in wholes if whole.is_a("IfcElement"))):
            if material := library("util.element").get_material(entity, should_skip_usage=True):
                return material
        return None

    def _one(self, material: Any) -> ElementMaterial | str:
        name = (material.Name or "").strip()
        category = (getattr(material, "Category", None) or "").strip()
        row = self.table.row(name) or (self.table.row(category) if category else None)
        note = ""
        if row is None and self.otherwise:
            row, note = self.table.row(self.otherwise), f"{name or 'its material'} is taken for {self.otherwise}"
        if row is None:
            return name or "a material without a name"
        if (strength := self._strength_of_file(material)) and row.strength in _CONCRETES:
            row = row.with_compression(name, strength)
            more = f"its strength in compression is that of the file, {strength:.1f} N/mm²"
            note = f"{note}; {more}" if note else more
        density = self._density_of_file(material)
        if density is None:
            return ElementMaterial(name, row.density_kg_m3, row, note)
        if not LEAST_KG_M3 <= density <= MOST_KG_M3:
            unlikely = f"the file gives {density:.4g} kg/m³ for {name}, so the density is that of the table"
            return ElementMaterial(name, row.density_kg_m3, row, f"{note}; {unlikely}" if note else unlikely)
        return ElementMaterial(name, density, row, note, is_by_file=True)

    def _strength_of_file(self, material: Any) -> float | None:
        """Return the compressive strength that the file gives a concrete, N/mm², if it is one that concrete has."""
        psets = library("util.element").get_psets(material)
        values = [pset.get("CompressiveStrength") for pset in psets.values()]
        pressures = [float(value) * self._pressure_unit for value in values if isinstance(value, int | float)]
        return next((value for value in pressures if _WEAKEST_N_MM2 <= value <= _STRONGEST_N_MM2), None)

    @cached_property
    def _pressure_unit(self) -> float:
        """Return the N/mm² in the file's unit of pressure, Pa where it gives none."""
        units = self.source.model.by_type("IfcProject")[0].UnitsInContext
        if not any(getattr(unit, "UnitType", None) == "PRESSUREUNIT" for unit in (units.Units if units else ())):
            return 1e-6
        return float(library("util.unit").calculate_unit_scale(self.source.model, "PRESSUREUNIT")) * 1e-6

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
