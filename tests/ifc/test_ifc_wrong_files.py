# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that are broken, or no bridge: what is wrong is said, and what to do."""

import ifcopenshell.util.element
import pytest
from support.ifc_bridges import IfcBridge, whole_bridge

from bridge_demolition_addon.errors import IfcError
from bridge_demolition_addon.ifc.bridge import read_bridge
from bridge_demolition_addon.ifc.settings import ImportSettings
from bridge_demolition_addon.ifc.source import naming_contradictions


@pytest.fixture(scope="module")
def text(tmp_path_factory):
    return whole_bridge().written(tmp_path_factory.mktemp("ifc") / "bridge.ifc").read_text()


def refused(path, **settings):
    with pytest.raises(IfcError) as found:
        read_bridge(path, ImportSettings(**settings))
    message = str(found.value)
    assert message.startswith(f"{path}: ")
    return message.removeprefix(f"{path}: ")


@pytest.mark.parametrize(
    "content, message",
    [
        ("", "is no IFC file, which begins with ISO-10303-21; export one, or meshes as OBJ or STL"),
        ("solid cube", "is no IFC file"),
        ("PK\x03\x04", "is packed; unpack it"),
        ("<?xml version='1.0'?><ifc/>", "is XML; save it as a STEP file"),
        ("ISO-10303-21;\nEND-ISO-10303-21;", "is of no schema"),
    ],
)
def test_no_ifc(content, message, tmp_path):
    path = tmp_path / "bridge.ifc"
    path.write_text(content)
    assert message in refused(path)


def test_no_file_and_a_folder(tmp_path):
    assert refused(tmp_path / "none.ifc") == "no such file"
    assert refused(tmp_path) == "is a directory"


@pytest.mark.parametrize("share", [0.5, 0.99])
def test_a_file_that_is_cut_short(share, text, tmp_path):
    path = tmp_path / "bridge.ifc"
    path.write_text(text[: int(share * len(text))])
    assert "is cut short, as END-ISO-10303-21; is missing at its end; copy or export it again" in refused(path)


def test_a_schema_that_is_not_known(text, tmp_path):
    path = tmp_path / "bridge.ifc"
    path.write_text(text.replace("'IFC4X3", "'IFC9X3"))
    assert "is of the schema IFC9X3" in refused(path)


def test_classes_that_later_schemas_do_not_have_are_named(text, tmp_path):
    """IfcOrientationExpression is of IFC4X1 alone: what is placed by it has no shape, which is said with its name."""
    label = text.split("FILE_SCHEMA(('")[1].split("'")[0]
    older = text.replace(f"'{label}'", "'IFC4X1'").replace(
        "ENDSEC;\nEND-", "#99999=IFCORIENTATIONEXPRESSION($,$);\nENDSEC;\nEND-"
    )
    (tmp_path / "bridge.ifc").write_text(older)
    notes = read_bridge(tmp_path / "bridge.ifc", ImportSettings()).notes
    assert (
        "IFC4X3_ADD2 has no IFCORIENTATIONEXPRESSION: they are left out, and what is placed along these has no shape"
        in notes
    )
    bodiless = older.replace("IFCEXTRUDEDAREASOLID(", "IFCORIENTATIONEXPRESSION(")
    (tmp_path / "bridge.ifc").write_text(bodiless)
    assert "as later schemas have no IFCORIENTATIONEXPRESSION; export it as IFC4X3" in refused(tmp_path / "bridge.ifc")


def test_no_project(text, tmp_path):
    path = tmp_path / "bridge.ifc"
    path.write_text("\n".join(line for line in text.splitlines() if "IFCPROJECT(" not in line))
    assert "has no IfcProject" in refused(path)


def test_no_unit_of_length_until_the_user_says_it(tmp_path):
    path = whole_bridge(unit=None).written(tmp_path / "bridge.ifc")
    assert "has no unit of length that is known; say which it is, one of m, cm, mm, ft, in, by --unit" in refused(
        path, strict=True
    )
    bridge = read_bridge(path, ImportSettings(unit="m"))
    assert bridge.scenario.geometry


def test_no_elements(tmp_path):
    path = IfcBridge().written(tmp_path / "bridge.ifc")
    assert "has no element that is a member of a bridge, no elements" in refused(path)


def test_only_what_bears_nothing(tmp_path):
    path = IfcBridge().fittings().written(tmp_path / "bridge.ifc")
    assert "has no element that is a member of a bridge, IfcPile, IfcRailing" in refused(path)


def test_no_deck_or_no_piers(tmp_path):
    lower = IfcBridge().substructure().written(tmp_path / "lower.ifc")
    message = refused(lower)
    assert "has no element that carries the road, of the kinds deck, girder, arch, but abutment, footing" in message
    upper = IfcBridge().superstructure().written(tmp_path / "upper.ifc")
    message = refused(upper, strict=True)
    assert "that stands on the ground, of the kinds pier, abutment, wall, wing wall, footing, but deck" in message
    assert "--kind 'NAME=pier'" in message


def test_geometry_that_fails_is_named_and_can_be_left_out(tmp_path):
    made = whole_bridge()
    concrete = made.material("Concrete")
    flat = made.solid((2.0, 2.0, 1.0), (5.0, 0.0, 5.0))
    flat.Depth = 0.0
    made.element("IfcBeam", "Broken", flat, "DECK", material=concrete)
    path = made.written(tmp_path / "bridge.ifc")
    message = refused(path, strict=True)
    assert message.startswith("the geometry of Broken (IfcBeam #")
    assert "--without NAME" in message
    for settings in (ImportSettings(without=("Broken",), strict=True), ImportSettings()):
        bridge = read_bridge(path, settings)
        assert "Broken" not in {mesh.name for mesh in bridge.scenario.geometry}
    (broken,) = (outcome for outcome in bridge.outcomes if outcome.facts.name == "Broken")
    assert broken.why == "its geometry cannot be worked out; its mass is not known, and missing"


def test_an_open_solid_is_refused_by_its_name(tmp_path):
    """A box without four of its sides: what is left are two squares that lie apart."""
    made = whole_bridge()
    corners = [(x, y, z) for z in (5.0, 6.0) for x, y in ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))]
    points = made.file.create_entity("IfcCartesianPointList3D", corners)
    faces = [(1, 3, 2), (1, 4, 3), (5, 6, 7), (1, 2, 6), (2, 3, 7)]
    mesh = made.file.create_entity("IfcTriangulatedFaceSet", points, None, False, faces)
    open_beam = made.element(
        "IfcBeam", "Open", mesh, "DECK", material=made.material("Steel"), shape_type="Tessellation"
    )
    message = refused(made.written(tmp_path / "bridge.ifc"), strict=True)
    assert message.startswith(f"Open (IfcBeam #{open_beam.id()}): not closed")
    assert message.endswith("Or leave it out by --without NAME")


def test_a_ground_above_the_bridge(tmp_path):
    path = whole_bridge().written(tmp_path / "bridge.ifc")
    with pytest.raises(
        IfcError, match=r"the ground at 9 m would cover the bridge, which reaches from 0\.00 m to 4\.60 m"
    ):
        read_bridge(path, ImportSettings(ground_m=9.0))


def test_a_file_that_contradicts_its_schema(tmp_path):
    """Properties that point at nothing, as the reader itself takes them: it is said where, and not in its words."""
    made = IfcBridge()
    related = made.root("IfcRelDefinesByProperties", None, RelatedObjects=[made.bridge])
    with pytest.raises(IfcError) as found, naming_contradictions(tmp_path):
        ifcopenshell.util.element.get_psets(made.bridge)
    said = f"contradicts its schema in IfcRelDefinesByProperties #{related.id()}; check it with a validator of IFC"
    assert said in str(found.value)


def test_errors_that_are_not_the_files_are_not_taken_for_it(tmp_path):
    with pytest.raises(TypeError, match="no fault of the file"), naming_contradictions(tmp_path):
        raise TypeError("no fault of the file")
