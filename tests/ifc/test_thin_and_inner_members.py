# SPDX-License-Identifier: GPL-3.0-or-later
"""Members that are too thin, too far away or within others: left out with their mass, and by every name they have."""

import pytest
from support.ifc_bridges import MASS_KG, STEEL_KG_M3, IfcBridge, whole_bridge

from bridge_demolition_addon.engineering.geometry.mesh import joined_meshes
from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.errors import IfcError
from bridge_demolition_addon.ifc.bridge import read_bridge
from bridge_demolition_addon.ifc.elements import elements_of
from bridge_demolition_addon.ifc.folder import write_bridge
from bridge_demolition_addon.ifc.settings import ImportSettings
from bridge_demolition_addon.ifc.source import open_source


def face_set(made, mesh):
    """A mesh in metres as triangles of a file."""
    make = made.file.create_entity
    points = make("IfcCartesianPointList3D", (mesh.vertices / made.metre).tolist())
    return make("IfcTriangulatedFaceSet", points, None, True, (mesh.triangles + 1).tolist())


def outcomes(bridge, name):
    return [outcome for outcome in bridge.outcomes if outcome.facts.name == name]


@pytest.mark.parametrize("unit", ["METRE", "FOOT"])
def test_what_is_too_thin_or_too_far_is_left_out_with_its_mass(unit, tmp_path):
    """A grillage's beams of 1 mm, in the deck and beside it, and a plate 20 km away: 10 m · 1 m · 1 mm · 7850 kg/m³."""
    made = whole_bridge(unit=unit)
    steel = made.material("S355")
    made.box("IfcBeam", "Dummy", (10.0, 1.0, 0.001), (10.0, 0.0, 4.5), "SUPERSTRUCTURE", material=steel)
    made.box("IfcBeam", "Dummy", (10.0, 1.0, 0.001), (10.0, 0.0, 6.5), "SUPERSTRUCTURE", material=steel)
    made.box("IfcPlate", "Stray", (1.0, 1.0, 0.1), (20_000.0, 0.0, 4.5), "ABUTMENT", material=steel)
    path = made.written(tmp_path / "bridge.ifc")
    bridge = read_bridge(path, ImportSettings())
    write_bridge(bridge, tmp_path / "made")
    assert [one.why for one in outcomes(bridge, "Dummy")] == [
        "it is 1 mm thick, too thin for a member; 78.5 kg are missing"
    ] * 2
    (stray,) = outcomes(bridge, "Stray")
    assert stray.why.startswith("it reaches 2e+04 m from the beginning of the bridge; 785 kg are missing")
    assert sum(one.member.mass_kg for one in bridge.outcomes if one.member) == pytest.approx(MASS_KG)
    with pytest.raises(IfcError, match=r"Dummy \(IfcBeam #\d+\) is 1 mm thick.*; Dummy .*; Stray .*--without NAME"):
        read_bridge(path, ImportSettings(strict=True))


def test_a_flange_within_the_deck_leaves_its_room_to_it(tmp_path):
    """Plates of 20 m · 0.5 m · 30 mm in the deck, as a second body of a girder that comes first, and as an element."""
    made = IfcBridge().substructure().bearings()
    steel = made.material("S355")
    flange = (20.0, 0.5, 0.03)
    for side, across in (("right", -1.0), ("left", 1.0)):
        bodies = [box((21.0, 0.4, 0.8), (10.0, across, 4.0)), box(flange, (10.0, across, 4.5))]
        shape = face_set(made, joined_meshes(bodies if side == "right" else bodies[:1]))
        made.element("IfcBeam", f"Girder {side}", shape, "SUPERSTRUCTURE", material=steel, shape_type="Tessellation")
    concrete = made.material("Concrete of the deck", 2400.0)
    made.box("IfcSlab", "Carriageway", (21.0, 4.0, 0.2), (10.0, 0.0, 4.4), "DECK", material=concrete)
    bridge = read_bridge(made.written(tmp_path / "bridge.ifc"), ImportSettings())
    write_bridge(bridge, tmp_path / "made")
    member, part = outcomes(bridge, "Girder right")
    assert member.member.volume_m3 == pytest.approx(21.0 * 0.4 * 0.8)
    missing_t = 20.0 * 0.5 * 0.03 * STEEL_KG_M3 / 1e3
    assert part.why == f"members before it take all of its room; {missing_t:.3f} t are missing"
    assert sum(one.member.mass_kg for one in bridge.outcomes if one.member) == pytest.approx(MASS_KG)


def test_an_element_is_left_out_by_every_name_it_has(tmp_path):
    """Two beams of one name, with signs that stand for others in patterns: by member, part, number, title."""
    made = whole_bridge()
    for along in (5.0, 15.0):
        made.box("IfcBeam", "Beam [1]  x", (1.0, 1.0, 1.0), (along, 0.0, 5.0), "SUPERSTRUCTURE")
    source = open_source(made.written(tmp_path / "bridge.ifc"), ImportSettings())
    first, second = (one for one in elements_of(source, ImportSettings()) if one.facts.name == "Beam [1]  x")
    for name, expected in (
        ("Beam [1]  x", [first, second]),
        ("Beam [1] x", [first]),
        ("Beam [1] x 2", [second]),
        ("Beam [1] x 2 part 3", [second]),
        (f"#{second.facts.number}", [second]),
        (first.title, [first]),
    ):
        left = [one for one in elements_of(source, ImportSettings(without=(name,))) if "left out" in one.why_left_out]
        assert [one.facts.number for one in left] == [one.facts.number for one in expected], name
