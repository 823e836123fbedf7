"""Density and strength of materials by name: a table that the user can change."""

from dataclasses import dataclass, replace
from importlib.resources import files
from pathlib import Path
from typing import ClassVar, Self

from ..engineering.mechanics.strength import MATERIALS, NEWTON_PER_SQUARE_MILLIMETRE
from ..errors import IfcError, OutputError, ScenarioError
from ..model.materials import MODULUS, Material
from ..model.schema import Table, given, key
from ..model.toml_tables import document_of_file, table_of_document, toml_document
from ..system.disk import whole_file, writing
from .settings import matches

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

        The modulus of elasticity is that of EN 1992-1-1:2004, table 3.1, by the mean strength, 8 N/mm² above the
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
    """Return the user's table of materials, or that of the add-on."""
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
