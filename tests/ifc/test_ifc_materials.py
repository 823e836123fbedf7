# SPDX-License-Identifier: GPL-3.0-or-later
"""What elements are made of: by the table, the user's own table, and the file."""

import pytest
from support.ifc_bridges import VOLUMES_M3, IfcBridge, whole_bridge

from bridge_demolition_addon.errors import IfcError, OutputError
from bridge_demolition_addon.ifc.bridge import read_bridge
from bridge_demolition_addon.ifc.element_materials import material_table, write_material_table
from bridge_demolition_addon.ifc.settings import ImportSettings


def read(made, tmp_path, **settings):
    return read_bridge(made.written(tmp_path / "bridge.ifc"), ImportSettings(**settings))


@pytest.mark.parametrize(
    "name, density, strength",
    [
        ("Concrete, Cast-in-Place gray", 2550.0, "reinforced concrete slab"),
        ("Stahlbeton C35/45", 2550.0, "reinforced concrete slab"),
        ("C50/60", 2550.0, "reinforced concrete slab"),
        ("Mass concrete", 2450.0, "concrete"),
        ("STRUCTURAL STEEL", 7850.0, "steel"),
        ("S355J2+N", 7850.0, "steel"),
        ("Brick, common", 1850.0, "masonry"),
        ("Naturstein", 2750.0, "masonry"),
        ("Maçonnerie de pierre", 2750.0, "masonry"),
    ],
)
def test_the_table(name, density, strength):
    row = material_table().row(name)
    assert (row.density_kg_m3, row.strength_name) == (density, strength)


@pytest.mark.parametrize("name", ["Marzipan", "Glass200", ""])
def test_the_table_does_not_guess(name):
    assert material_table().row(name) is None


def test_the_table_is_written_to_be_changed(tmp_path):
    path = tmp_path / "mine.toml"
    write_material_table(path)
    assert material_table(path) == material_table()
    with pytest.raises(OutputError, match=r"mine\.toml: exists already"):
        write_material_table(path)


OWN = """
[[materials]]
name = "C30/*"
density_kg_m3 = 2300.0
compression_n_mm2 = 38.0
tension_n_mm2 = 2.9
shear_n_mm2 = 0.5
torsion_n_mm2 = 2.9
bending_n_mm2 = 2.9
elastic_modulus_n_mm2 = 33000.0

[[materials]]
name = "*"
density_kg_m3 = 2000.0
strength = "masonry"
"""


def test_a_table_of_the_users_own(tmp_path):
    (tmp_path / "own.toml").write_text(OWN)
    bridge = read(whole_bridge(), tmp_path, materials=tmp_path / "own.toml")
    masses = {}
    for outcome in bridge.outcomes:
        if outcome.member:
            masses[outcome.member.kind] = masses.get(outcome.member.kind, 0.0) + outcome.member.mass_kg
    assert masses["pier"] == pytest.approx(VOLUMES_M3["pier"] * 2300.0, rel=1e-6)
    assert masses["girder"] == pytest.approx(VOLUMES_M3["girder"] * 2000.0, rel=1e-6)
    scenario = bridge.scenario
    assert [(material.name, material.compression_n_mm2) for material in scenario.materials] == [("C30/", 38.0)]
    assert scenario.connections.material == "C30/"
    assert {(rule.members, rule.material) for rule in scenario.connections.between if rule.material} == {
        (("girder", "girder"), "masonry"),
        (("deck", "deck"), "masonry"),
    }


@pytest.mark.parametrize(
    "text, message",
    [
        ('[[materials]]\nname = "A"\ndensity_kg_m3 = -1.0\nstrength = "steel"', "density_kg_m3 is -1.0"),
        ('[[materials]]\nname = "A"\ndensity_kg_m3 = 1.0', 'materials for "A": compression_n_mm2 is missing'),
        ('[[materials]]\nname = "A"\ndensity_kg_m3 = 1.0\nstrength = "jelly"', 'strength is "jelly"'),
        (OWN.replace("bending_n_mm2 = 2.9", 'strength = "steel"'), "strength and compression_n_mm2 are given"),
        ("density", "not a TOML file"),
    ],
)
def test_a_wrong_table_is_refused_by_its_name(text, message, tmp_path):
    path = tmp_path / "own.toml"
    path.write_text(text)
    with pytest.raises(IfcError) as refused:
        material_table(path)
    assert str(refused.value).startswith(f"{path}: ")
    assert message in str(refused.value)


def test_elements_without_a_material_are_refused_until_the_user_says_which(tmp_path):
    made = whole_bridge(has_materials=False)
    with pytest.raises(IfcError, match=r"no material: Footing 1, .* and 5 more\. Say by --material"):
        read(made, tmp_path, strict=True)
    assumed = read(made, tmp_path)
    assert {outcome.member.density_kg_m3 for outcome in assumed.outcomes if outcome.member} == {2550.0}
    assert "the file gives no material: taken for concrete" in {outcome.why for outcome in assumed.outcomes}
    bridge = read(made, tmp_path, material="concrete")
    assert {outcome.member.density_kg_m3 for outcome in bridge.outcomes if outcome.member} == {2550.0}


def test_a_material_that_the_table_does_not_know(tmp_path):
    made = IfcBridge().superstructure().substructure()
    made.box("IfcBeam", "Stringer", (1, 1, 1), (10.0, 0.0, 8.0), "DECK", material=made.material("Oak"))
    with pytest.raises(IfcError, match="does not know the materials of Oak: Stringer"):
        read(made, tmp_path, strict=True)
    with pytest.raises(IfcError, match='material is "oak", which the table of materials does not know'):
        read(made, tmp_path, material="oak")


def test_layers_weigh_by_their_thickness(tmp_path):
    """15 cm of concrete and 5 cm of steel: (0.15 × 2550 + 0.05 × 7850) / 0.2 = 3875 kg/m³."""
    made = IfcBridge().substructure().superstructure()
    make = made.file.create_entity
    layers = [
        make("IfcMaterialLayer", made.material(name), thickness, None)
        for name, thickness in (("Steel", 0.05), ("Concrete", 0.15))
    ]
    (slab,) = made.file.by_type("IfcSlab")
    slab.HasAssociations[0].RelatingMaterial = make("IfcMaterialLayerSet", layers)
    (deck,) = (outcome for outcome in read(made, tmp_path).outcomes if outcome.member and outcome.member.kind == "deck")
    assert deck.member.density_kg_m3 == pytest.approx(3875.0)
    assert deck.substance.row.strength == "reinforced concrete slab"


def test_of_materials_without_shares_the_first_that_is_known_counts(tmp_path):
    made = IfcBridge().substructure().superstructure()
    (slab,) = made.file.by_type("IfcSlab")
    slab.HasAssociations[0].RelatingMaterial = made.file.create_entity(
        "IfcMaterialList", [made.material(name) for name in ("Paint", "Concrete", "Steel")]
    )
    (deck,) = (outcome for outcome in read(made, tmp_path).outcomes if outcome.member and outcome.member.kind == "deck")
    assert deck.member.density_kg_m3 == 2550.0
    assert "made of 3 materials, of which Concrete counts" in deck.why


def test_a_density_in_another_unit(tmp_path):
    """Tonnes by cubic metre, as a derived unit: 2.4 of them are 2400 kg/m³."""
    made = IfcBridge().substructure().superstructure()
    make = made.file.create_entity
    tonne = make("IfcSIUnit", None, "MASSUNIT", "MEGA", "GRAM")
    metre = make("IfcSIUnit", None, "LENGTHUNIT", None, "METRE")
    elements = [make("IfcDerivedUnitElement", tonne, 1), make("IfcDerivedUnitElement", metre, -3)]
    units = made.project.UnitsInContext
    units.Units = [*units.Units, make("IfcDerivedUnit", elements, "MASSDENSITYUNIT", None)]
    (slab,) = made.file.by_type("IfcSlab")
    slab.HasAssociations[0].RelatingMaterial = made.material("Concrete", 2.4)
    (deck,) = (outcome for outcome in read(made, tmp_path).outcomes if outcome.member and outcome.member.kind == "deck")
    assert deck.member.density_kg_m3 == pytest.approx(2400.0)


def test_a_density_that_no_material_has_does_not_count(tmp_path):
    made = IfcBridge().substructure().superstructure()
    (slab,) = made.file.by_type("IfcSlab")
    slab.HasAssociations[0].RelatingMaterial = made.material("Concrete", 2.4)
    (deck,) = (outcome for outcome in read(made, tmp_path).outcomes if outcome.member and outcome.member.kind == "deck")
    assert deck.member.density_kg_m3 == 2550.0
    assert "the file gives 2.4 kg/m³ for Concrete" in deck.why


def test_an_unknown_material_of_a_rolled_profile_is_taken_for_steel(tmp_path):
    made = IfcBridge().substructure().superstructure()
    girder = made.file.by_type("IfcBeam")[-1]
    profile = made.file.create_entity("IfcIShapeProfileDef", "AREA", None, made.flat(), 0.4, 0.8, 0.02, 0.03)
    girder.Representation.Representations[0].Items[0].SweptArea = profile
    girder.HasAssociations[0].RelatingMaterial = made.material("Unobtainium")
    (found,) = (o for o in read(made, tmp_path).outcomes if o.facts.global_id == girder.GlobalId)
    assert found.member.density_kg_m3 == 7850.0
    assert "Unobtainium is not known, taken for steel" in found.why


def test_strength_and_mass_that_the_file_gives_count(tmp_path):
    """69 MPa in compression; 8.4 m³ of deck that weigh 20.16 t by the file have 2400 kg/m³."""
    made = IfcBridge().substructure().superstructure()
    make = made.file.create_entity
    (slab,) = made.file.by_type("IfcSlab")
    concrete = made.material("C70 concrete")
    value = make("IfcPropertySingleValue", "CompressiveStrength", None, make("IfcPressureMeasure", 69e6), None)
    make("IfcMaterialProperties", "Pset_MaterialConcrete", None, [value], concrete)
    slab.HasAssociations[0].RelatingMaterial = concrete
    known = [
        make("IfcQuantityVolume", "NetVolume", None, None, 8.4),
        make("IfcQuantityWeight", "NetWeight", None, None, 20160.0),
    ]
    pset = made.root("IfcElementQuantity", "Qto_SlabBaseQuantities", Quantities=known)
    made.root("IfcRelDefinesByProperties", None, RelatedObjects=[slab], RelatingPropertyDefinition=pset)
    bridge = read(made, tmp_path)
    (deck,) = (outcome for outcome in bridge.outcomes if outcome.member and outcome.member.kind == "deck")
    assert deck.member.density_kg_m3 == pytest.approx(2400.0)
    (material,) = bridge.scenario.materials
    assert material.compression_n_mm2 == pytest.approx(69.0)
    # EN 1992-1-1, table 3.1: 22 GPa × (77 MPa / 10 MPa)^0.3
    assert material.elastic_modulus_n_mm2 == pytest.approx(22_000.0 * 7.7**0.3, rel=1e-4)
