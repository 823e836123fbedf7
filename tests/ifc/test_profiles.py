# SPDX-License-Identifier: GPL-3.0-or-later
"""Outlines whose parts are said to run backwards and do not follow each other: areas by hand."""

import math
from itertools import pairwise

import ifcopenshell
import pytest

from bridge_demolition_addon.engineering.geometry.plan_areas import signed_area
from bridge_demolition_addon.ifc.profiles import outline_of
from bridge_demolition_addon.ifc.shapes import extruded_mesh
from bridge_demolition_addon.ifc.source import IfcSource


@pytest.fixture
def file():
    return ifcopenshell.file(schema="IFC4X3")


def slot(file):
    """A slot of 600 mm with round ends, 250 mm between their centres, in pieces that do not follow each other."""
    make = file.create_entity

    def point(x, y):
        return make("IfcCartesianPoint", (float(x), float(y)))

    def arc(height, start, end):
        circle = make("IfcCircle", make("IfcAxis2Placement2D", point(0, height)), 300.0)
        trims = [[make("IfcParameterValue", angle)] for angle in (start, end)]
        return make("IfcTrimmedCurve", circle, *trims, False, "PARAMETER")

    curves = [
        arc(-950, math.pi, 0.0),
        make("IfcPolyline", [point(300, -950), point(300, -1200)]),
        make("IfcPolyline", [point(-300, -950), point(-300, -1200)]),
        arc(-1200, 0.0, math.pi),
    ]
    parts = [make("IfcCompositeCurveSegment", "CONTINUOUS", False, curve) for curve in curves]
    return make("IfcCompositeCurve", parts, None)


def test_parts_of_an_outline_are_put_together_by_their_ends(file):
    """A circle of 0.3 m and a rectangle of 0.6 × 0.25 m; chords are up to 1 mm off, on 1.9 m of arc."""
    profile = file.create_entity("IfcArbitraryClosedProfileDef", "AREA", None, slot(file))
    area = float(signed_area(outline_of(profile, 0.001, 1.0)))
    assert area == pytest.approx(math.pi * 0.09 + 0.6 * 0.25, abs=0.0019)


def test_a_plate_is_extruded_with_its_hole(file, tmp_path):
    """20 mm of a frame of 2 × 2 m around the slot, along x of the element, with the profile's y upwards."""
    make = file.create_entity
    corners = [(-1000.0, -2000.0), (1000.0, -2000.0), (1000.0, 0.0), (-1000.0, 0.0)]
    ends = [*corners, corners[0]]
    sides = [
        make("IfcPolyline", [make("IfcCartesianPoint", one), make("IfcCartesianPoint", other)])
        for one, other in pairwise(ends)
    ]
    outer = make("IfcCompositeCurve", [make("IfcCompositeCurveSegment", "CONTINUOUS", False, s) for s in sides], None)
    profile = make("IfcArbitraryProfileDefWithVoids", "AREA", None, outer, [slot(file)])
    x, y, z = (make("IfcDirection", way) for way in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)))
    at = make("IfcAxis2Placement3D", make("IfcCartesianPoint", (5000.0, 0.0, 0.0)), x, y)
    solid = make("IfcExtrudedAreaSolid", profile, at, z, 20.0)
    body = make("IfcShapeRepresentation", None, "Body", "SweptSolid", [solid])
    plate = make("IfcPlate", Representation=make("IfcProductDefinitionShape", None, None, [body]))
    mesh = extruded_mesh(IfcSource(tmp_path / "a.ifc", file, 1.0, 0.001), plate)
    assert mesh.volume == pytest.approx(0.02 * (4.0 - math.pi * 0.09 - 0.15), abs=0.02 * 0.0019)
    assert mesh.bounds.ravel() == pytest.approx([5.0, -1.0, -2.0, 5.02, 1.0, 0.0], abs=1e-9)
