# SPDX-License-Identifier: GPL-3.0-or-later
"""Bars of steel in IFC files: sections, axes, turns and grades as they were written, and what is none."""

import math

import numpy as np
import pytest
from support.ifc_bridges import SCHEMAS
from support.ifc_steel import CHS_168, HEB_200, IPE_300, SteelFile

from bridge_demolition_addon.engineering.steelwork.catalogue import section_named
from bridge_demolition_addon.ifc.bodies import bodies_of
from bridge_demolition_addon.ifc.element_materials import material_table, substances
from bridge_demolition_addon.ifc.elements import elements_of
from bridge_demolition_addon.ifc.placement import Placement
from bridge_demolition_addon.ifc.settings import ImportSettings
from bridge_demolition_addon.ifc.shapes import KeptShapes, shapes_of
from bridge_demolition_addon.ifc.source import open_source
from bridge_demolition_addon.ifc.steel_elements import grade_of, steel_elements

BEGIN, END = (1.0, 2.0, 3.0), (7.0, 2.0, 3.0)


def found(made, tmp_path):
    """Bars of a file by name, in its own axes, and why other elements of steel are none."""
    path, settings = made.written(tmp_path / "bars.ifc"), ImportSettings()
    source = open_source(path, settings)
    wanted = [element for element in elements_of(source, settings) if element.is_member]
    kept = KeptShapes()
    bodies = bodies_of(source, wanted, shapes_of(source, wanted, kept), kept, {}, strict=False)
    made_of = substances(source, wanted, material_table(), settings)
    placement = Placement(0.0, bodies.origin)
    result = steel_elements(source, wanted, bodies.solids, made_of, placement)
    names = {element.entity.id(): element.facts.name for element in wanted}
    bars = {}
    for number, bar in result.bars.items():
        bars[names[number]] = (bar, bar.begin_m + bodies.origin, bar.end_m + bodies.origin)
    return bars, {names[number]: why for number, why in result.refused.items()}


def alone(made, tmp_path):
    bars, refused = found(made, tmp_path)
    assert not refused
    (bar,) = bars.values()
    return bar


@pytest.mark.parametrize("schema", SCHEMAS)
@pytest.mark.parametrize(
    ("section", "name"),
    [
        (IPE_300, "IPE 300"),
        (("I", 300.0, 150.0, 7.1, 10.7), "IPE 300"),  # without its root radius, as many programs write it
        (("I", 900.0, 300.0, 12.0, 25.0), "I 900x300x12x25"),
        (("PG", 1200.0, 12.0, 400.0, 25.0, 500.0, 40.0), "PG 1200x12x400x25x500x40"),
        (("BOX", 400.0, 300.0, 12.0), "BOX 400x300x12x12"),
        (("RHS", 200.0, 100.0, 8.0), "RHS 200x100x8"),
        (("RHS", 100.0, 100.0, 5.0), "SHS 100x5"),
        (CHS_168, "CHS 168.3x8"),
        (("L", 150.0, 90.0, 12.0), "L 150x90x12"),
        (("U", 200.0, 75.0, 8.5, 11.5), "U 200x75x8.5x11.5"),
        (("T", 200.0, 150.0, 10.0, 15.0), "T 200x150x10x15"),
        (("FLAT", 100.0, 20.0), "FLAT 100x20"),
    ],
)
def test_profiles_with_sizes(schema, section, name, tmp_path):
    """The axis goes through the centre of the section, where the profile's origin is the middle of its box."""
    made = SteelFile(schema=schema, unit="MILLI")
    made.bar("Bar", section, BEGIN, END)
    bar, begin, end = alone(made, tmp_path)
    assert bar.section == name
    ring = np.concatenate(section_named(name).rings)
    middle = (ring.min(axis=0) + ring.max(axis=0)) / 2.0
    # Along x, the profile's x lies along the file's y, and its y along z.
    assert begin == pytest.approx((BEGIN[0], BEGIN[1] - middle[0], BEGIN[2] - middle[1]), abs=1e-6)
    assert end == pytest.approx((END[0], END[1] - middle[0], END[2] - middle[1]), abs=1e-6)
    assert bar.roll_deg == pytest.approx(0.0, abs=1e-6)
    assert bar.grade == "S355"


@pytest.mark.parametrize("roll_deg", [0.0, 30.0, 90.0, -60.0])
@pytest.mark.parametrize("end", [(7.0, 2.0, 3.0), (4.0, 6.0, 9.0), (1.0, 2.0, 9.0), (1.0, -5.0, 3.0)])
@pytest.mark.parametrize("section", [IPE_300, ("L", 150.0, 90.0, 12.0)])
def test_the_roll_is_the_one_that_was_written(section, end, roll_deg, tmp_path):
    made = SteelFile()
    made.bar("Bar", section, BEGIN, end, roll_deg=roll_deg)
    bar, _, _ = alone(made, tmp_path)
    assert bar.roll_deg == pytest.approx(roll_deg, abs=1e-6)
    assert bar.along == pytest.approx(np.subtract(end, BEGIN) / math.dist(BEGIN, end), abs=1e-9)


def test_a_turned_and_moved_profile_turns_and_moves_the_bar(tmp_path):
    made = SteelFile()
    make = made.file.create_entity
    at = make("IfcCartesianPoint", (0.1, 0.2))
    position = make("IfcAxis2Placement2D", at, make("IfcDirection", (0.0, 1.0)))
    body = made.swept(made.profile(*IPE_300, position=position), BEGIN, END)
    made.element("IfcBeam", "Bar", body, "SUPERSTRUCTURE", material=made.steel())
    bar, begin, _ = alone(made, tmp_path)
    assert bar.section == "IPE 300"
    assert abs(bar.roll_deg) == pytest.approx(90.0, abs=1e-6)
    assert begin == pytest.approx((1.0, 2.1, 3.2), abs=1e-6)


def test_a_mirrored_angle_has_its_leg_on_the_other_side(tmp_path):
    made = SteelFile()
    make = made.file.create_entity
    plain = made.profile("L", 150.0, 90.0, 12.0)
    origin = make("IfcCartesianPoint", (0.0, 0.0))
    to = make(
        "IfcCartesianTransformationOperator2D",
        make("IfcDirection", (-1.0, 0.0)),
        make("IfcDirection", (0.0, 1.0)),
        origin,
        1.0,
    )
    profile = make("IfcDerivedProfileDef", "AREA", None, plain, to, None)
    made.element("IfcMember", "Bar", made.swept(profile, BEGIN, END), "SUPERSTRUCTURE", material=made.steel())
    bar, begin, _ = alone(made, tmp_path)
    # Its upright leg of 150 mm is at the profile's right; an angle of 90 x 150 turned by 90° has it there.
    assert bar.section == "L 90x150x12"
    # Centre of L 150 x 90 x 12 from its corner: (12·150·6 + 12·78·51) / 2736 = 21.4 mm, so 23.6 mm from the middle.
    assert begin[1] - 2.0 == pytest.approx(0.045 - 0.0213947, abs=1e-6)


def test_outlines_of_lines_are_recognised(tmp_path):
    made = SteelFile(unit="MILLI")
    for name, across in (("HEA 200", 0.0), ("BOX 400x300x10x20", 1.0), ("CHS 168.3x8", 2.0)):
        begin, end = (0.0, across, 5.0), (6.0, across, 5.0)
        if name.startswith("CHS"):
            angles = np.linspace(0.0, 2.0 * math.pi, 48, endpoint=False)
            circle = np.column_stack((np.cos(angles), np.sin(angles)))
            rings = [0.08415 * circle, 0.07615 * circle]
        else:
            rings = section_named(name).rings
        body = made.swept(made.outline(rings), begin, end)
        made.element("IfcBeam", name, body, "SUPERSTRUCTURE", material=made.steel())
    bars, refused = found(made, tmp_path)
    assert not refused
    assert {name: bar.section for name, (bar, _, _) in bars.items()} == {name: name for name in bars}
    assert bars["HEA 200"][1] == pytest.approx((0.0, 0.0, 5.0), abs=1e-6)


def test_ends_that_are_cut_count_at_their_middle(tmp_path):
    """6 m, cut at 45° through a point 0.5 m before the end of the axis, and square 0.2 m behind its beginning."""
    made = SteelFile()
    cuts = [((6.5, 2.0, 3.0), (1.0, 0.0, 1.0)), ((1.2, 2.0, 3.0), (-1.0, 0.0, 0.0))]
    made.bar("Bar", IPE_300, BEGIN, END, cuts=cuts)
    bar, begin, end = alone(made, tmp_path)
    # The square of the section's radius of gyration, 0.125², by twice the length moves both ends by 1.5 mm.
    assert begin == pytest.approx((1.2, 2.0, 3.0), abs=2e-3)
    assert end == pytest.approx((6.5, 2.0, 3.0), abs=2e-3)
    assert bar.section == "IPE 300"


def test_mapped_bodies_stand_where_they_are_mapped_to(tmp_path):
    made = SteelFile(unit="MILLI")
    body = made.swept(made.profile(*HEB_200), (0.0, 0.0, 0.0), (4.0, 0.0, 0.0))
    turned = np.array([(0.0, -1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)])
    item = made.mapped(body, (1.0, 2.0, 3.0), turned)
    made.element("IfcBeam", "Bar", item, "SUPERSTRUCTURE", material=made.steel(), shape_type="MappedRepresentation")
    bar, begin, end = alone(made, tmp_path)
    assert bar.section == "HEB 200"
    assert begin == pytest.approx((1.0, 2.0, 3.0), abs=1e-6)
    assert end == pytest.approx((1.0, 6.0, 3.0), abs=1e-6)


def test_bodies_of_faces_are_bars_along_their_longest_edges(tmp_path):
    """As programs write bars that are cut or joined: faces alone."""
    made = SteelFile()
    make = made.file.create_entity
    ring = section_named("I 900x300x12x25").rings[0]
    points = [made.point(x, y, z) for x in (1.0, 9.0) for y, z in ring]
    count = len(ring)

    def face(*corners):
        loop = make("IfcPolyLoop", [points[corner] for corner in corners])
        return make("IfcFace", [make("IfcFaceOuterBound", loop, True)])

    sides = [face(row, (row + 1) % count, count + (row + 1) % count, count + row) for row in range(count)]
    faces = [face(*reversed(range(count))), face(*range(count, 2 * count)), *sides]
    body = make("IfcFacetedBrep", make("IfcClosedShell", faces))
    made.element("IfcBeam", "Girder", body, "SUPERSTRUCTURE", material=made.steel(), shape_type="Brep")
    bar, begin, end = alone(made, tmp_path)
    assert bar.section == "I 900x300x12x25"
    assert bar.roll_deg % 180.0 == pytest.approx(0.0, abs=1e-6)
    assert begin == pytest.approx((1.0, 0.0, 0.0), abs=1e-6)
    assert end == pytest.approx((9.0, 0.0, 0.0), abs=1e-6)


@pytest.mark.parametrize("schema", ["IFC4", "IFC4X3"])
def test_a_profile_of_the_material_is_that_of_a_body_of_faces(schema, tmp_path):
    """It lies across the z axis of the element's placement; the body is a union, which says nothing of a profile."""
    made = SteelFile(schema=schema)
    make = made.file.create_entity
    profile = made.profile("L", 150.0, 90.0, 12.0)
    row = make("IfcMaterialProfile", Name="L", Material=made.steel("S235"), Profile=profile)
    usage = make("IfcMaterialProfileSetUsage", make("IfcMaterialProfileSet", MaterialProfiles=[row]), 5)
    at = make("IfcAxis2Placement3D", made.point(0.0, 0.0, 1.0))
    body = make("IfcExtrudedAreaSolid", profile, at, made.direction(0, 0, 1), 6.0)
    twice = make("IfcBooleanResult", "UNION", body, body)
    made.element("IfcColumn", "Post", twice, "SUPERSTRUCTURE", material=usage, shape_type="CSG")
    bar, begin, end = alone(made, tmp_path)
    assert (bar.section, bar.grade) == ("L 150x90x12", "S235")
    assert abs(end - begin) == pytest.approx((0.0, 0.0, 6.0), abs=1e-5)  # by the area of a section in micrometres


def test_what_is_no_bar_says_why(tmp_path):
    made = SteelFile()
    make = made.file.create_entity
    made.bar("Bar", IPE_300, BEGIN, END)
    made.bar("Stub", IPE_300, (0.0, 5.0, 3.0), (0.5, 5.0, 3.0))
    made.bar("Block", ("FLAT", 800.0, 400.0), (0.0, 8.0, 3.0), (5.0, 8.0, 3.0))
    notch = [((3.0, 11.0, 3.0), (0.0, 0.0, 1.0))]
    made.bar("Half", IPE_300, (0.0, 11.0, 3.0), (6.0, 11.0, 3.0), cuts=notch)
    oblique = made.swept(made.profile(*IPE_300), (0.0, 14.0, 3.0), (6.0, 14.0, 3.0))
    oblique.ExtrudedDirection = made.direction(0.3, 0.0, 1.0)
    made.element("IfcBeam", "Oblique", oblique, "SUPERSTRUCTURE", material=made.steel())
    rod = make("IfcCircleProfileDef", "AREA", None, made.flat(), 0.05)
    made.element("IfcBeam", "Rod", made.swept(rod, (0, 17, 3), (6, 17, 3)), "SUPERSTRUCTURE", material=made.steel())
    made.bar("Concrete", ("FLAT", 100.0, 20.0), (0.0, 20.0, 3.0), (5.0, 20.0, 3.0), steel="C30/37")
    bars, refused = found(made, tmp_path)
    assert bars.keys() == {"Bar"}
    assert refused == {
        "Stub": "is 0.50 m long, no more than 2 times as long as its section",
        "Block": "is a block, 0.8 x 0.4 m thick",
        "Half": refused["Half"],
        "Oblique": "is extruded at an angle to its profile",
        "Rod": "has a profile of the kind IfcCircleProfileDef",
    }
    assert "another outline than IPE 300, by 150 mm" in refused["Half"]


def test_a_cambered_girder_is_no_bar(tmp_path):
    """40 mm higher in the middle than at its ends, as two halves that meet at an angle."""
    made = SteelFile()
    make = made.file.create_entity
    ring = section_named("I 900x300x12x25").rings[0]
    stations = [(0.0, 0.0), (5.0, 0.04), (10.0, 0.0)]
    points = [made.point(x, y, z + up) for x, up in stations for y, z in ring]
    count = len(ring)

    def face(*corners):
        loop = make("IfcPolyLoop", [points[corner] for corner in corners])
        return make("IfcFace", [make("IfcFaceOuterBound", loop, True)])

    sides = [
        face(first + row, first + (row + 1) % count, first + count + (row + 1) % count, first + count + row)
        for first in (0, count)
        for row in range(count)
    ]
    faces = [face(*reversed(range(count))), face(*range(2 * count, 3 * count)), *sides]
    body = make("IfcFacetedBrep", make("IfcClosedShell", faces))
    made.element("IfcBeam", "Girder", body, "SUPERSTRUCTURE", material=made.steel(), shape_type="Brep")
    bars, refused = found(made, tmp_path)
    assert not bars
    # Along the half that it is taken to run, the other one falls by twice 40 mm.
    assert "is not straight, or reaches 80 mm beside I 900" in refused["Girder"]


@pytest.mark.parametrize(
    ("name", "grade"),
    [
        ("S355J2+N", "S355"),
        ("Steel, S 235 JR", "S235"),
        ("STEEL/S275", "S275"),
        ("Fe510", "S355"),
        ("Fe 360 B", "S235"),
        ("St 52-3", "S355"),
        ("ST37", "S235"),
        ("S460", None),
        ("Q345", None),
        ("steel", None),
        ("S3550", None),
    ],
)
def test_grades_by_the_name_of_the_material(name, grade):
    """EN 10025:1990 and DIN 17100 with the names that took their place: EN 10027-1, and national forewords."""
    assert grade_of(name) == grade
