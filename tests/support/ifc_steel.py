# SPDX-License-Identifier: GPL-3.0-or-later
"""Bars of steel that are written as IFC: extruded profiles from point to point, with cut ends, mapped, or as faces."""

import math
from dataclasses import dataclass

import numpy as np
from support.ifc_bridges import IfcBridge

from bridge_demolition_addon.engineering.steelwork.bars import bar_axes

IPE_300 = ("I", 300.0, 150.0, 7.1, 10.7, 15.0)
HEB_200 = ("I", 200.0, 200.0, 9.0, 15.0, 18.0)
HEA_200 = ("I", 190.0, 200.0, 6.5, 10.0, 18.0)
CHS_168 = ("CHS", 168.3, 8.0)


@dataclass
class SteelFile(IfcBridge):
    """An IFC file of bars of steel, and of what they stand on."""

    def profile(self, shape, *sizes_mm, position=None):
        """A profile of a shape with sizes in mm: those of the catalogue, and a radius for some."""
        make, mm = self.file.create_entity, 1e-3 / self.metre
        s = [mm * size for size in sizes_mm]
        head = ("AREA", f"{shape} profile", position or self.flat())
        if shape == "I":
            return make("IfcIShapeProfileDef", *head, s[1], s[0], s[2], s[3], *s[4:5])
        if shape == "PG":
            if self.schema == "IFC2X3":
                return make("IfcAsymmetricIShapeProfileDef", *head, s[4], s[0], s[1], s[5], None, s[2], s[3])
            return make("IfcAsymmetricIShapeProfileDef", *head, s[4], s[0], s[1], s[5], None, s[2], s[3])
        if shape in ("RHS", "BOX"):
            radii = (s[2], 1.5 * s[2]) if shape == "RHS" else ()
            return make("IfcRectangleHollowProfileDef", *head, s[1], s[0], s[2], *radii)
        if shape == "CHS":
            return make("IfcCircleHollowProfileDef", *head, s[0] / 2.0, s[1])
        if shape == "L":
            return make("IfcLShapeProfileDef", *head, s[0], s[1], s[2])
        if shape in ("U", "T"):
            return make(f"Ifc{shape}ShapeProfileDef", *head, s[0], s[1], s[2], s[3])
        return make("IfcRectangleProfileDef", *head, s[1], s[0])

    def outline(self, rings_m):
        """A profile of polylines: an outer one, and holes."""
        make = self.file.create_entity
        lines = []
        for ring in rings_m:
            points = [make("IfcCartesianPoint", tuple(map(float, point / self.metre))) for point in ring]
            lines.append(make("IfcPolyline", [*points, points[0]]))
        if len(lines) == 1:
            return make("IfcArbitraryClosedProfileDef", "AREA", None, lines[0])
        return make("IfcArbitraryProfileDefWithVoids", "AREA", None, lines[0], lines[1:])

    def swept(self, profile, begin_m, end_m, roll_deg=0.0):
        """A profile along a line, its y axis as upright as that of a bar without roll, turned by that about the bar."""
        begin, end = np.array(begin_m, float), np.array(end_m, float)
        axes = bar_axes(begin, end, math.radians(roll_deg))
        make = self.file.create_entity
        at = make("IfcAxis2Placement3D", self.point(*begin), self.direction(*axes[:, 0]), self.direction(*axes[:, 1]))
        depth = float(np.linalg.norm(end - begin)) / self.metre
        return make("IfcExtrudedAreaSolid", profile, at, self.direction(0, 0, 1), depth)

    def cut(self, solid, point_m, away):
        """A body without what lies beyond a plane, on the side of a direction."""
        make = self.file.create_entity
        at = make("IfcAxis2Placement3D", self.point(*point_m), self.direction(*away))
        half = make("IfcHalfSpaceSolid", make("IfcPlane", at), False)
        return make("IfcBooleanClippingResult", "DIFFERENCE", solid, half)

    def mapped(self, solid, shift_m, axes=None):
        """A body of another place."""
        make = self.file.create_entity
        inner = make("IfcShapeRepresentation", self.context, "Body", "SweptSolid", [solid])
        origin = make("IfcAxis2Placement3D", self.point(0.0, 0.0, 0.0))
        source = make("IfcRepresentationMap", origin, inner)
        x, y, z = (self.direction(*axis) for axis in (np.eye(3) if axes is None else np.array(axes).T))
        to = make("IfcCartesianTransformationOperator3D", x, y, self.point(*shift_m), 1.0, z)
        return make("IfcMappedItem", source, to)

    def steel(self, name="S355J2"):
        """The steel of that name, the same each time."""
        known = [found for found in self.file.by_type("IfcMaterial") if found.Name == name]
        return known[0] if known else self.material(name)

    def bar(self, name, section, begin_m, end_m, *, kind="IfcMember", roll_deg=0.0, steel="S355J2", cuts=()):
        """A bar of a section, as `profile` takes it, from point to point; cuts are points and directions."""
        body = self.swept(self.profile(*section), begin_m, end_m, roll_deg)
        for point, away in cuts:
            body = self.cut(body, point, away)
        shape_type = "Clipping" if cuts else "SweptSolid"
        return self.element(kind, name, body, "SUPERSTRUCTURE", material=self.steel(steel), shape_type=shape_type)


def warren_truss(panels=8, panel_m=4.0, height_m=3.0):
    """Places on the plane of a Warren truss without posts, and its bars: chords from node to node, and diagonals."""
    places = {f"L{number}": (number * panel_m, 0.0) for number in range(panels + 1)}
    places |= {f"U{number}": ((number + 0.5) * panel_m, height_m) for number in range(panels)}
    bars = {f"L{number}-L{number + 1}": (f"L{number}", f"L{number + 1}") for number in range(panels)}
    bars |= {f"U{number}-U{number + 1}": (f"U{number}", f"U{number + 1}") for number in range(panels - 1)}
    bars |= {f"L{number}-U{number}": (f"L{number}", f"U{number}") for number in range(panels)}
    bars |= {f"U{number}-L{number + 1}": (f"U{number}", f"L{number + 1}") for number in range(panels)}
    return places, bars


def truss_file(schema="IFC4", short_m=0.2, above_m=5.0, **options):
    """A Warren truss: one upper chord and one lower of HEB 200 over all panels, diagonals of tubes, cut short."""
    made = SteelFile(schema=schema, **options)
    places, bars = warren_truss()
    at = {name: np.array((x, 0.0, above_m + z)) for name, (x, z) in places.items()}
    made.bar("Lower chord", HEB_200, at["L0"], at["L8"], kind="IfcBeam")
    made.bar("Upper chord", HEB_200, at["U0"], at["U7"], kind="IfcBeam")
    for name, (one, other) in bars.items():
        if one[0] != other[0]:
            way = (at[other] - at[one]) / np.linalg.norm(at[other] - at[one])
            made.bar(name, CHS_168, at[one] + short_m * way, at[other] - short_m * way)
    return made
