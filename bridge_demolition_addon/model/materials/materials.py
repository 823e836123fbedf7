"""Materials of the user's own, beside those that come with their sources."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import ClassVar

from ...engineering.elasticity.section_stiffness import ELASTIC_MODULI, ElasticModuli
from ...engineering.mechanics.strength import MATERIALS, NEWTON_PER_SQUARE_MILLIMETRE, Strength
from ..schema import DENSITY, Table, key

MODULUS = {"unit": "N/mm²", "above": 0, "at_most": 1e7}
"""Unit and limits of a modulus of elasticity."""

POISSON = {"at_least": 0, "at_most": 0.49}
"""Limits of Poisson's ratio."""

_STRENGTH = {"unit": "N/mm²", "above": 0}


@dataclass(frozen=True, slots=True, kw_only=True)
class Material(Table):
    """A material of your own, which `connections.material` and `connections.between.material` may name: strengths that
    were measured on this bridge, or that a study samples."""

    table: ClassVar[str] = "materials"

    name: str = key("What it is called, other than the materials that come with the add-on.")
    compression_n_mm2: float = key("Strength in compression.", **_STRENGTH)
    tension_n_mm2: float = key("Strength in tension.", **_STRENGTH)
    shear_n_mm2: float = key("Strength in shear, for the mean over a section.", **_STRENGTH)
    torsion_n_mm2: float = key(
        "Strength in torsion, for the shear stress at the edge of an uncracked section.", **_STRENGTH
    )
    bending_n_mm2: float = key("Strength in bending, for the stress at the edge of an uncracked section.", **_STRENGTH)
    elastic_modulus_n_mm2: float | None = key(
        "Modulus of elasticity. Needed where connections are elastic.", default=None, **MODULUS
    )
    poisson_ratio: float = key("Poisson's ratio, where connections are elastic.", default=0.2, **POISSON)
    density_kg_m3: float | None = key(
        "Density of all members that have none of their own, where it is that of `connections.material` and the bridge "
        "gives neither `density_kg_m3` nor `mass_kg`.",
        **DENSITY,
    )

    @property
    def strength(self) -> Strength:
        return Strength.in_n_mm2(
            self.compression_n_mm2, self.tension_n_mm2, self.shear_n_mm2, self.torsion_n_mm2, self.bending_n_mm2
        )

    @property
    def moduli(self) -> ElasticModuli | None:
        """Return how it deforms; None where that is not given."""
        if self.elastic_modulus_n_mm2 is None:
            return None
        return ElasticModuli(self.elastic_modulus_n_mm2 * NEWTON_PER_SQUARE_MILLIMETRE, self.poisson_ratio)


def check_materials(materials: Iterable[Material]) -> None:
    """Check that materials differ by name from those that are known."""
    for material in materials:
        if material.name in MATERIALS:
            raise material.unexpected("name", "a name that no other material has")


def strengths(materials: Iterable[Material]) -> Mapping[str, Strength]:
    """Return the strengths of all materials by name: those that are known, and the user's own."""
    return MATERIALS | {material.name: material.strength for material in materials}


def moduli(materials: Iterable[Material], name: str) -> ElasticModuli:
    own = {material.name: material for material in materials}
    if name not in own:
        return ELASTIC_MODULI[name]
    material_moduli = own[name].moduli
    if material_moduli is None:
        wanted = 'it with connections.stiffness "elastic", where no connections give their own'
        raise own[name].unexpected("elastic_modulus_n_mm2", wanted)
    return material_moduli
