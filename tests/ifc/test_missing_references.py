# SPDX-License-Identifier: GPL-3.0-or-later
"""Schemas by the names that programs give them, and references that lead to nothing: what is read of each file."""

import re

import pytest
from support.ifc_bridges import CONCRETE_KG_M3, MASS_KG, STEEL_KG_M3, VOLUMES_M3, IfcBridge, whole_bridge

from bridge_demolition_addon.errors import IfcError
from bridge_demolition_addon.ifc.bridge import read_bridge
from bridge_demolition_addon.ifc.elements import elements_of
from bridge_demolition_addon.ifc.settings import ImportSettings
from bridge_demolition_addon.ifc.source import open_source, place_along_curves

EDITIONS = {
    "IFC2X3": ("IFC2X3_TC1", "IFC2X3_FINAL", "ifc2x3", " IFC2X3 "),
    "IFC4": ("IFC4_ADD1", "IFC4_ADD2", "IFC4_ADD2_TC1", "Ifc4", "IFC4 ADD2", "IFC2X4"),
    "IFC4X3": (
        *("IFC4X3", "IFC4X3_TC1", "IFC4X3_ADD1", "IFC4x3 Add2", "IFC4.3", "IFC4X3_RC1", "IFC4X3_RC4"),
        *("IFC4X3_DEV_62d5cb1b", "IFC4X1", "IFC4X2"),
    ),
}

GIRDER_KG = 0.5 * VOLUMES_M3["girder"] * STEEL_KG_M3 + 3 * (0.4 * 0.4 * 0.1) * CONCRETE_KG_M3
"""Of one girder, and of its three bearings, which lie under nothing without it."""


def changed(made, tmp_path, *changes):
    """A file in which texts are replaced, each of which has to be there."""
    text = made.written(tmp_path / "bridge.ifc").read_text()
    for pattern, new in changes:
        text, count = re.subn(pattern, new, text, count=1)
        assert count, pattern
    (tmp_path / "bridge.ifc").write_text(text)
    return tmp_path / "bridge.ifc"


def mass_kg(bridge):
    return sum(outcome.member.mass_kg for outcome in bridge.outcomes if outcome.member)


def test_of_statements_with_one_number_the_first_counts(tmp_path):
    """A relation of properties has the number of a point, and one of aggregates none that there can be."""
    text = whole_bridge().written(tmp_path / "bridge.ifc").read_text()
    point = re.search(r"#(\d+)=IFCCARTESIANPOINT", text)[1]
    relations = re.findall(r"#\d+(?==IFCRELASSOCIATES)", text)
    for relation, number in zip(relations, (point, "0"), strict=False):
        text = text.replace(f"{relation}=", f"#{number}=")
    (tmp_path / "bridge.ifc").write_text(text)
    read = read_bridge(tmp_path / "bridge.ifc", ImportSettings())
    assert len([outcome for outcome in read.outcomes if outcome.member]) == len(
        [
            outcome
            for outcome in read_bridge(whole_bridge().written(tmp_path / "whole.ifc"), ImportSettings()).outcomes
            if outcome.member
        ]
    )
    source = open_source(tmp_path / "bridge.ifc", ImportSettings())
    assert f"of statements with one number the first counts: #{point}, #0" in source.notes
    with pytest.raises(IfcError, match="of statements with one number the first counts"):
        open_source(tmp_path / "bridge.ifc", ImportSettings(strict=True))


@pytest.mark.parametrize("schema", EDITIONS)
def test_all_editions_of_a_schema_are_read(schema, tmp_path):
    text = IfcBridge(schema=schema).written(tmp_path / "bridge.ifc").read_text()
    for name in EDITIONS[schema]:
        (tmp_path / "bridge.ifc").write_text(re.sub(r"FILE_SCHEMA\(\('\w+'", f"FILE_SCHEMA(('{name}'", text))
        source = open_source(tmp_path / "bridge.ifc", ImportSettings())
        assert source.model.schema == schema
        assert f"the schema {name} is read as {source.model.schema_identifier}" in source.notes


def test_a_bridge_of_plain_ifc4x3_is_whole(tmp_path):
    path = changed(whole_bridge(), tmp_path, (r"'IFC4X3\w*'", "'IFC4X3'"))
    assert mass_kg(read_bridge(path, ImportSettings())) == pytest.approx(MASS_KG)


def test_classes_that_a_schema_does_not_have_are_named(tmp_path):
    path = changed(whole_bridge(), tmp_path, (r"'IFC4X3\w*'", "'IFC4'"))
    assert any(
        note.startswith("IFC4 has no IFCBEARING, IFCBRIDGE") for note in open_source(path, ImportSettings()).notes
    )


def test_relations_to_nothing_are_absent(tmp_path):
    """Of five parts one has no material, one its properties and one its bridge: $, a missing line, or another class.

    A footing without its material is concrete, as the others are, and the girder is not named by a wrong set.
    """
    made = whole_bridge()
    girder = next(one for one in made.file.by_type("IfcBeam") if one.Name == "Girder left")
    make = made.file.create_entity
    named = make("IfcPropertySingleValue", "Volume", None, make("IfcVolumeMeasure", 6.72), None)
    nameless = make("IfcPropertySingleValue", None, None, make("IfcVolumeMeasure", 5.0), None)
    given = made.root("IfcPropertySet", "Sizes", HasProperties=[named, nameless])
    for pset in (given, None):
        made.root("IfcRelDefinesByProperties", None, RelatedObjects=[girder], RelatingPropertyDefinition=pset)
    made.root("IfcRelDefinesByType", None, RelatedObjects=[girder], RelatingType=None)
    path = changed(
        made,
        tmp_path,
        (r"(IFCRELASSOCIATESMATERIAL\([^#]*\(#\d+\)),#\d\d\)", r"\1,$)"),
        (r"(IFCRELASSOCIATESMATERIAL\([^#]*\(#\d+\)),#\d\d\)", r"\1,#99999)"),
        (r"(IFCRELASSOCIATESMATERIAL\([^#]*\(#\d+\)),#\d\d\)", r"\1,#3)"),
        (r"(IFCRELCONTAINEDINSPATIALSTRUCTURE\([^#]*)\(#\d+\)", r"\1$"),
        (r"(IFCRELAGGREGATES\([^#]*#\d+,)\(#\d+\)", r"\1(#88888)"),
    )
    bridge = read_bridge(path, ImportSettings())
    assert mass_kg(bridge) == pytest.approx(MASS_KG)
    (note,) = (note for note in bridge.notes if "leads to nothing" in note)
    for said in ("3 IfcRelAssociatesMaterial", "1 IfcRelDefinesByProperties", "1 IfcPropertySingleValue"):
        assert said in note
    (left,) = (outcome for outcome in bridge.outcomes if outcome.facts.name == "Girder left")
    assert left.file_volume_m3 == pytest.approx(21.0 * 0.4 * 0.8)
    with pytest.raises(IfcError, match=r"leads to nothing, .* counts as absent: .*; export it again"):
        read_bridge(path, ImportSettings(strict=True))


def test_values_that_are_null_cost_what_they_say(tmp_path):
    """A unit of mass without a name, a representation of another class, and a header without its name of a file."""
    made = whole_bridge()
    slab = made.file.by_type("IfcSlab")[0].Representation.id()
    path = changed(
        made,
        tmp_path,
        (r"FILE_NAME\([^;]*;\n", ""),
        (r"(IFCSIUNIT\(\*,)\.PLANEANGLEUNIT\.", r"\1$"),
        (rf"(#{slab}=IFCPRODUCTDEFINITIONSHAPE\(\$,\$,\()#\d+", rf"\1#{made.site.id()}"),
    )
    source = open_source(path, ImportSettings())
    assert "1 IfcSIUnit" in source.notes[-1]
    (left,) = (one for one in elements_of(source, ImportSettings()) if one.facts.name == "Carriageway")
    assert left.why_left_out == "it has no body"


def test_a_shape_whose_line_is_missing_is_left_out(tmp_path):
    """The profile of a girder: the rest of the bridge is whole, without the girder's 6.72 m³ of steel."""
    made = whole_bridge()
    girder = next(one for one in made.file.by_type("IfcBeam") if one.Name == "Girder left")
    solid = girder.Representation.Representations[0].Items[0].id()
    path = changed(made, tmp_path, (rf"#{solid}=IFCEXTRUDEDAREASOLID\(#\d+", f"#{solid}=IFCEXTRUDEDAREASOLID(#99999"))
    bridge = read_bridge(path, ImportSettings())
    (left,) = (outcome for outcome in bridge.outcomes if outcome.facts.name == "Girder left")
    assert left.why.startswith("it needs line #99999, which is missing or of an unknown class; its mass is not known")
    assert mass_kg(bridge) == pytest.approx(MASS_KG - GIRDER_KG)
    with pytest.raises(IfcError, match=r"Girder left \(IfcBeam #\d+\): it needs line #99999"):
        read_bridge(path, ImportSettings(strict=True))


@pytest.mark.parametrize("is_shared, is_line", [(True, True), (False, True), (True, False)])
def test_a_place_in_a_missing_line(is_shared, is_line, tmp_path):
    """What all is placed in moved all alike; what one alone is placed in could be anywhere."""
    made = whole_bridge()
    girder = next(one for one in made.file.by_type("IfcBeam") if one.Name == "Girder left")
    place = made.place
    if not is_shared:
        at = made.file.create_entity("IfcAxis2Placement3D", made.point(0.0, 0.0, 0.0))
        girder.ObjectPlacement = place = made.file.create_entity("IfcLocalPlacement", None, at)
    start = rf"#{place.id()}=IFCLOCALPLACEMENT\("
    change = (rf"({start})\$", r"\1#99999") if is_line else (rf"({start}\$,)#\d+", r"\1$")
    path = changed(made, tmp_path, change)
    bridge = read_bridge(path, ImportSettings())
    said = (
        f"all that has a shape is placed in #{99999 if is_line else place.id()}, which is missing, and counts as absent"
    )
    assert (said in bridge.notes) == is_shared
    missing_kg = 0.0 if is_shared else GIRDER_KG
    assert mass_kg(bridge) == pytest.approx(MASS_KG - missing_kg)


ALONG = {
    "whole": ((0.0, 0.0), (1.0, 0.0), 100.0),
    "a point of one coordinate": ((0.0,), (1.0, 0.0), 100.0),
    "a direction of one ratio": ((0.0, 0.0), (1.0,), 100.0),
    "a segment without a length": ((0.0, 0.0), (1.0, 0.0), None),
}


@pytest.mark.parametrize("lacking", ALONG)
def test_what_stands_along_an_alignment_that_contradicts_its_schema(lacking):
    """30 m along a line from the origin: at (30, 0), by its plan or else by the position that the file gives beside."""
    make = (made := IfcBridge()).file.create_entity
    start, way, long_m = ALONG[lacking]
    plan = make("IfcAxis2Placement2D", make("IfcCartesianPoint", start), make("IfcDirection", way))
    segment = make("IfcCurveSegment", "CONTINUOUS", plan, make("IfcLengthMeasure", 0.0))
    segment.ParentCurve = make("IfcLine")
    if long_m:
        segment.SegmentLength = make("IfcLengthMeasure", long_m)
    curve = make("IfcCompositeCurve", [segment], False)
    point = make("IfcPointByDistanceExpression", make("IfcLengthMeasure", 30.0), None, None, None, curve)
    given = make("IfcAxis2Placement3D", make("IfcCartesianPoint", (30.0, 0.0, 0.0)))
    at = make("IfcLinearPlacement", None, make("IfcAxis2PlacementLinear", point), given)
    sign = made.root("IfcSign", "Sign", ObjectPlacement=at)
    place_along_curves(made.file, 1.0)
    assert sign.ObjectPlacement.is_a("IfcLocalPlacement")
    assert sign.ObjectPlacement.RelativePlacement.Location.Coordinates == pytest.approx((30.0, 0.0, 0.0))


def test_positions_that_are_things_of_another_kind(tmp_path):
    text = whole_bridge().written(tmp_path / "bridge.ifc").read_text()
    (shape,) = re.search(r"(#\d+)=IFCPRODUCTDEFINITIONSHAPE", text).groups()
    text, count = re.subn(r"(IFCEXTRUDEDAREASOLID\(#\d+,)#\d+", rf"\1{shape}", text)
    assert count
    (tmp_path / "bridge.ifc").write_text(text)
    bridge = read_bridge(tmp_path / "bridge.ifc", ImportSettings())
    assert 0.0 < mass_kg(bridge) < MASS_KG  # the library leaves such positions out, and bodies lie within each other
