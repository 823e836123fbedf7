# SPDX-License-Identifier: GPL-3.0-or-later
"""A bridge whose volumes and masses are worked out by hand, from IFC in each schema, unit and place."""

import math

import numpy as np
import pytest
from support.ifc_bridges import DECK_KG_M3, MASS_KG, SCHEMAS, STEEL_KG_M3, VOLUMES_M3, IfcBridge, whole_bridge

from bridge_demolition_addon.engineering.geometry.solids import bodies, to_manifold, union
from bridge_demolition_addon.errors import IfcError
from bridge_demolition_addon.ifc.bearings import free_motions
from bridge_demolition_addon.ifc.bridge import read_bridge
from bridge_demolition_addon.ifc.elements import Element
from bridge_demolition_addon.ifc.kinds import ElementFacts
from bridge_demolition_addon.ifc.placement import Placement
from bridge_demolition_addon.ifc.settings import ImportSettings

EXACT = 1e-6
"""Part of a volume: places have eight or more digits, and boxes no curves."""


def read(made, tmp_path, **settings):
    return read_bridge(made.written(tmp_path / "bridge.ifc"), ImportSettings(**settings))


def members(bridge):
    return [outcome.member for outcome in bridge.outcomes if outcome.member]


def volumes(bridge):
    found = {}
    for member in members(bridge):
        found[member.kind] = found.get(member.kind, 0.0) + member.volume_m3
    return found


def mass_kg(bridge):
    return sum(member.mass_kg for member in members(bridge))


def member(bridge, name):
    (found,) = (outcome.member for outcome in bridge.outcomes if outcome.facts.name == name)
    return found


@pytest.fixture(scope="module", params=SCHEMAS)
def schema(request):
    return request.param


@pytest.fixture(scope="module")
def bridge(schema, tmp_path_factory):
    return read(whole_bridge(schema=schema), tmp_path_factory.mktemp("ifc"))


def test_volumes_by_kind(bridge):
    assert volumes(bridge) == pytest.approx(VOLUMES_M3, rel=EXACT)


def test_mass_by_the_densities_of_table_and_file(bridge):
    assert mass_kg(bridge) == pytest.approx(MASS_KG, rel=EXACT)
    assert member(bridge, "Girder left").density_kg_m3 == STEEL_KG_M3
    assert member(bridge, "Carriageway").density_kg_m3 == DECK_KG_M3


def test_places(bridge):
    """x from the deck's beginning, half a metre before the first support; y from its middle; z from the footings."""
    assert member(bridge, "Carriageway").solid.bounds == pytest.approx(np.array([(0, -2, 4.4), (21, 2, 4.6)]), abs=1e-9)
    assert member(bridge, "Footing 1").solid.bounds == pytest.approx(np.array([(-1, -2.5, 0), (2, 2.5, 0.5)]), abs=1e-9)


def test_footings_are_held_and_nothing_else(bridge):
    assert [(support.member, support.face) for support in bridge.scenario.supports] == [("footing", "all")]


def test_bearings_are_of_what_they_lie_between(bridge, schema):
    rules = bridge.scenario.bearings
    lower = {"Abutment 1", "Crosshead", "Abutment 2"}
    expected = {(girder, below) for girder in ("Girder left", "Girder right") for below in lower}
    assert {rule.members for rule in rules} == expected
    for rule in rules:
        # Schemas without types of bearings leave them open: pinned at the first support, and moving at the others.
        is_roller = rule.members[1] != ("Crosshead" if schema == "IFC4X3" else "Abutment 1")
        assert rule.kind == ("rocker" if is_roller else "pinned")
    assert not any(rule.free for rule in bridge.scenario.connections.between)


def test_strengths_by_material(bridge):
    connections = bridge.scenario.connections
    assert connections.material == "reinforced concrete slab"
    assert [(rule.members, rule.material) for rule in connections.between if rule.material] == [
        (("girder", "girder"), "steel")
    ]


def test_what_is_left_out(bridge):
    left = {outcome.facts.name: outcome.why for outcome in bridge.outcomes if outcome.became == "left out"}
    assert left.keys() == {"Railing", "Tendon", "Bar", "Pile 1", "Pile 2"}
    assert all(left.values())


@pytest.mark.parametrize("unit", ["MILLI", "FOOT"])
def test_other_units(unit, tmp_path):
    bridge = read(whole_bridge(unit=unit), tmp_path)
    assert volumes(bridge) == pytest.approx(VOLUMES_M3, rel=EXACT)


def test_metre_in_american_spelling(tmp_path):
    path = whole_bridge(unit="MILLI").written(tmp_path / "bridge.ifc")
    text = path.read_text()
    assert ".METRE." in text
    path.write_text(text.replace(".METRE.", ".METER."))
    bridge = read_bridge(path, ImportSettings())
    assert volumes(bridge) == pytest.approx(VOLUMES_M3, rel=EXACT)
    assert any("METER" in note for note in bridge.notes)


def test_a_unit_that_the_user_tells_counts(tmp_path):
    """Centimetres for the file's metres: a bridge a hundredth as long, without the bearings' 0.096 m³."""
    made = IfcBridge().substructure().superstructure()
    bridge = read(made, tmp_path, unit="cm")
    assert sum(volumes(bridge).values()) == pytest.approx(1e-6 * (sum(VOLUMES_M3.values()) - 6 * 0.016), rel=1e-4)
    assert any("cm" in note for note in bridge.notes)


@pytest.mark.parametrize("turn_deg", [35.0, 90.0, -60.0])
def test_far_from_the_origin_and_turned(turn_deg, tmp_path):
    """As far off as in a file that was reported, 6581 km, where single precision keeps half a metre."""
    bridge = read(whole_bridge(offset_m=(4_500_000.0, 4_800_000.0, 312.0), turn_deg=turn_deg), tmp_path)
    assert volumes(bridge) == pytest.approx(VOLUMES_M3, rel=EXACT)
    bounds = member(bridge, "Carriageway").solid.bounds
    assert bounds == pytest.approx(np.array([(0, -2, 4.4), (21, 2, 4.6)]), abs=1e-6)
    assert member(bridge, "Footing 1").solid.bounds[:, 0] == pytest.approx((-1.0, 2.0), abs=1e-6)
    assert member(bridge, "Girder left").solid.bounds[:, 1] == pytest.approx((0.8, 1.2), abs=1e-6)
    assert bridge.ground_m == pytest.approx(312.0, abs=1e-6)


def test_a_road_that_leads_against_x_is_walked_from_its_other_end(tmp_path):
    bridge = read(whole_bridge(turn_deg=180.0), tmp_path)
    assert member(bridge, "Footing 3").solid.bounds[:, 0] == pytest.approx((-1.0, 2.0), abs=1e-6)
    assert member(bridge, "Girder left").solid.bounds[:, 1] == pytest.approx((-1.2, -0.8), abs=1e-6)


def test_the_ground_cuts_what_is_buried(tmp_path):
    """At 1 m: the footings and piles are gone, and of what stands on them half a metre."""
    bridge = read(whole_bridge(), tmp_path, ground_m=1.0)
    expected = dict(VOLUMES_M3)
    expected.pop("footing")
    expected["abutment"] -= 2 * 4.0 * 0.5
    expected["pier"] -= 0.5
    assert volumes(bridge) == pytest.approx(expected, rel=EXACT)
    assert member(bridge, "Column").solid.bounds[0, 2] == pytest.approx(0.0, abs=1e-9)
    assert not bridge.scenario.supports
    below = [outcome.facts.name for outcome in bridge.outcomes if outcome.why == "it lies below the ground"]
    assert below == ["Footing 1", "Footing 2", "Footing 3"]


def test_a_pier_with_nothing_under_it_is_held(tmp_path):
    bridge = read(whole_bridge(), tmp_path, without=("Footing 2",))
    assert [(support.member, support.face) for support in bridge.scenario.supports] == [
        ("footing", "all"),
        ("Column", "bottom"),
    ]
    assert any("Column ends 0.50 m above the ground" in note for note in bridge.notes)


def test_girders_that_touch_nothing_are_told_of(tmp_path):
    bridge = read(whole_bridge(), tmp_path, without=("bearing", "Carriageway"), strict=True)
    assert any(
        "Girder left touches no other member (the nearest is Abutment" in note and "100.0 mm off" in note
        for note in bridge.notes
    )


def test_a_bearing_that_bears_nothing_is_left_out(tmp_path):
    made = whole_bridge()
    made.box("IfcBearing", "Spare", (0.4, 0.4, 0.1), (5.0, 0.0, 1.0), "SUPERSTRUCTURE")
    bridge = read(made, tmp_path)
    (spare,) = (outcome for outcome in bridge.outcomes if outcome.facts.name == "Spare")
    assert spare.became == "left out"
    assert spare.why == "nothing touches it from below"


@pytest.mark.parametrize("gap_m, joined", [(5e-9, True), (5e-5, True), (-0.01, True), (0.002, False)])
def test_a_bearing_a_little_above_or_in_what_it_lies_on(gap_m, joined, tmp_path):
    """Up to 0.1 mm above, or sunk into it, the two are one solid; further off it is left out, and that is said."""
    made = whole_bridge()
    (bearing,) = (element for element in made.file.by_type("IfcBearing") if element.Name == "Bearing 2 left")
    solid = bearing.Representation.Representations[0].Items[0]
    solid.Position.Location.Coordinates = (10.0, 1.0, 3.5 + gap_m)
    solid.Depth = 0.1 - gap_m
    bridge = read(made, tmp_path, strict=True)
    (found,) = (outcome for outcome in bridge.outcomes if outcome.facts.name == "Bearing 2 left")
    assert (found.became == "connection") == joined
    if joined:
        whole = union([member(bridge, "Crosshead").solid, found.mesh])
        assert len(bodies(to_manifold(whole))) == 1
        assert whole.volume == pytest.approx(1.0 * 4.0 * 0.6 + 0.4 * 0.4 * 0.1, abs=1e-8)
    else:
        assert found.why.startswith("nothing touches it from below; Crosshead is 2.0 mm off: close that gap")


def test_motions_that_a_bearing_gives_itself(tmp_path):
    """It slides along its own x axis, which lies across the road, and turns about its own y, along it."""
    made = whole_bridge()
    make = made.file.create_entity
    (bearing,) = (element for element in made.file.by_type("IfcBearing") if element.Name == "Bearing 1 left")
    at = make("IfcAxis2Placement3D", made.point(0.0, 1.0, 3.5), made.direction(0, 0, 1), made.direction(0, 1, 0))
    bearing.ObjectPlacement = make("IfcLocalPlacement", None, at)
    shape = made.solid((0.4, 0.4, 0.1), (0.0, 0.0, 0.0))
    bearing.Representation.Representations[0].Items = [shape]
    truths = {"DisplacementAccommodated": (True, False, False), "RotationAccommodated": (False, True, False)}
    given = [
        make("IfcPropertyListValue", name, None, [make("IfcBoolean", value) for value in values], None)
        for name, values in truths.items()
    ]
    pset = made.root("IfcPropertySet", "Pset_BearingCommon", HasProperties=given)
    made.root("IfcRelDefinesByProperties", None, RelatedObjects=[bearing], RelatingPropertyDefinition=pset)
    bridge = read(made, tmp_path)
    (rule,) = (
        between for between in bridge.scenario.connections.between if between.members == ("Girder left", "Abutment 1")
    )
    assert rule.free == ("move y", "turn x")


def test_a_bearing_along_an_alignment_is_free_as_its_type_is():
    made = IfcBridge()
    value = made.file.create_entity("IfcBoolean", True)
    given = made.file.create_entity("IfcPropertyListValue", "RotationAccommodated", None, [value] * 3, None)
    pset = made.root("IfcPropertySet", "Pset_BearingCommon", HasProperties=[given])
    at = made.file.create_entity("IfcLinearPlacement")
    bearing = made.root("IfcBearing", "B", PredefinedType="ROLLER", ObjectPlacement=at)
    made.root("IfcRelDefinesByProperties", None, RelatedObjects=[bearing], RelatingPropertyDefinition=pset)
    facts = ElementFacts(name="B", global_id="0", classes=("IfcBearing",), predefined="ROLLER")
    free, source = free_motions(Element(bearing, facts, "bearing"), Placement(0.0, np.zeros(3)))
    assert free == ("move x", "turn y")
    assert "its own axes follow an alignment" in source


def test_openings_are_cut_out(tmp_path):
    """A hole of 2 m × 1 m through a deck of 0.2 m."""
    made = whole_bridge()
    (slab,) = made.file.by_type("IfcSlab")
    hole = made.box("IfcOpeningElement", "Hole", (2.0, 1.0, 1.0), (4.0, 0.0, 4.0), "DECK")
    made.file.remove(hole.ContainedInStructure[0])
    made.root("IfcRelVoidsElement", None, RelatingBuildingElement=slab, RelatedOpeningElement=hole)
    bridge = read(made, tmp_path)
    assert volumes(bridge)["deck"] == pytest.approx(VOLUMES_M3["deck"] - 2.0 * 1.0 * 0.2, rel=EXACT)
    assert "Hole" not in {outcome.facts.name for outcome in bridge.outcomes}


@pytest.mark.parametrize("encoding", ["utf-8", "latin-1"])
def test_names_with_letters_that_the_standard_has_no_plain_form_for(encoding, tmp_path):
    path = whole_bridge().written(tmp_path / "bridge.ifc")
    path.write_bytes(path.read_text().replace("'Carriageway'", "'Überbau'").encode(encoding))
    assert "Überbau" in {mesh.name for mesh in read_bridge(path, ImportSettings()).scenario.geometry}


def test_names_that_are_alike_or_mean_a_kind_get_numbers(tmp_path):
    made = whole_bridge()
    for element in made.file.by_type("IfcColumn"):
        element.Name = "deck"
    for element in made.file.by_type("IfcFooting"):
        element.Name = "F"
    names = [member.name for member in members(read(made, tmp_path))]
    assert {"deck 2", "F", "F 2", "F 3"} <= set(names)
    assert "deck" not in names


def test_a_round_column_has_the_volume_of_its_polygon(tmp_path):
    """Chords leave the circle of 0.6 m by at most 1 mm: less than 2/3 of 1 mm / 0.6 m of its area, twice, is lost."""
    made = whole_bridge()
    profile = made.file.create_entity("IfcCircleProfileDef", "AREA", None, made.flat(), 0.6)
    (column,) = made.file.by_type("IfcColumn")
    column.Representation.Representations[0].Items[0].SweptArea = profile
    volume = member(read(made, tmp_path), "Column").volume_m3
    circle = math.pi * 0.6**2 * 2.4
    assert circle * (1.0 - 2.0 * 0.001 / 0.6) < volume < circle


def test_the_kind_is_told_where_the_file_does_not_say_it(tmp_path):
    made = whole_bridge()
    made.box(
        "IfcBuildingElementProxy", "Object 7", (1, 1, 1), (30.0, 0.0, 0.0), "DECK", material=made.material("Steel")
    )
    made.file.by_type("IfcBuildingElementProxy")[0].ContainedInStructure[0].RelatingStructure = made.bridge
    assert "pier" in {member.kind for member in members(read(made, tmp_path, kinds=(("object*", "pier"),)))}
    left = [outcome for outcome in read(made, tmp_path).outcomes if outcome.facts.name == "Object 7"]
    assert "--kind" in left[0].why


def test_a_name_that_no_element_has(tmp_path):
    with pytest.raises(IfcError, match=r'has no element "Arch": expected a name, a class .*; it has Footing 1, '):
        read(whole_bridge(), tmp_path, without=("Arch",))
