# SPDX-License-Identifier: GPL-3.0-or-later
"""A bridge of two spans that is written as IFC, with volumes and masses that are worked out by hand.

All members are boxes. Along the file's x axis stand an abutment at 0 m, a pier at 10 m and an abutment at 20 m, each on
a footing; on them lie bearings, two girders of 21 m, and the deck.
"""

import math
from dataclasses import dataclass, field
from pathlib import Path

import ifcopenshell

SCHEMAS = ("IFC2X3", "IFC4", "IFC4X3")

CONCRETE_KG_M3, STEEL_KG_M3 = 2550.0, 7850.0
"""Of the table of materials, for C30/37 and S355."""

DECK_KG_M3 = 2400.0
"""That the file gives for the deck's concrete."""

VOLUMES_M3 = {
    "footing": 3 * (3.0 * 5.0 * 0.5),
    "abutment": 2 * (1.0 * 4.0 * 3.0 + 2 * 0.4 * 0.4 * 0.1),  # with two bearings each
    "pier": 1.0 * 1.0 * 2.4,
    "pier cap": 1.0 * 4.0 * 0.6 + 2 * 0.4 * 0.4 * 0.1,  # with two bearings
    "girder": 2 * (21.0 * 0.4 * 0.8),
    "deck": 21.0 * 4.0 * 0.2,
}

MASS_KG = (
    sum(volume for kind, volume in VOLUMES_M3.items() if kind not in ("girder", "deck")) * CONCRETE_KG_M3
    + VOLUMES_M3["girder"] * STEEL_KG_M3
    + VOLUMES_M3["deck"] * DECK_KG_M3
)

UNITS_M = {"METRE": 1.0, "MILLI": 0.001, "FOOT": 0.3048}


@dataclass
class IfcBridge:
    """An IFC file in the making: a bridge, or parts of it.

    Attributes
    ----------
    schema, unit
        Schema of the file, and its unit of length, one of `UNITS_M`; None for no unit.
    offset_m, turn_deg
        Where the bridge's beginning is in the file, and by how much it is turned there.
    has_materials
        Whether its elements have materials.
    """

    schema: str = "IFC4X3"
    unit: str | None = "METRE"
    offset_m: tuple[float, float, float] = (0.0, 0.0, 0.0)
    turn_deg: float = 0.0
    has_materials: bool = True
    file: ifcopenshell.file = field(init=False)

    def __post_init__(self):
        self.file = ifcopenshell.file(schema=self.schema)
        make = self.file.create_entity
        self.metre = UNITS_M[self.unit or "METRE"]
        origin = make("IfcAxis2Placement3D", self.point(0.0, 0.0, 0.0))
        self.context = make("IfcGeometricRepresentationContext", None, "Model", 3, 1e-6, origin)
        units = [self._length()] if self.unit else []
        assigned = make("IfcUnitAssignment", [*units, make("IfcSIUnit", None, "PLANEANGLEUNIT", None, "RADIAN")])
        self.project = self.root("IfcProject", "Test", RepresentationContexts=[self.context], UnitsInContext=assigned)
        self.place = self._placement()
        self.site = self.root("IfcSite", "Site", ObjectPlacement=None)
        self.bridge = self.root("IfcBridge" if self.is_newest else "IfcBuilding", "Two spans")
        self.aggregate(self.project, self.site)
        self.aggregate(self.site, self.bridge)
        self.parts = {}

    @property
    def is_newest(self):
        return self.schema == "IFC4X3"

    @property
    def owner(self):
        """The owner of all, which IFC2X3 asks for."""
        if self.schema != "IFC2X3":
            return None
        found = self.file.by_type("IfcOwnerHistory")
        if found:
            return found[0]
        make = self.file.create_entity
        someone = make("IfcPersonAndOrganization", make("IfcPerson"), make("IfcOrganization", None, "Test"))
        program = make("IfcApplication", someone.TheOrganization, "1", "Test", "test")
        return make("IfcOwnerHistory", someone, program, None, "ADDED", None, None, None, 0)

    def root(self, kind, name, **attributes):
        guid = ifcopenshell.guid.new()
        return self.file.create_entity(kind, GlobalId=guid, OwnerHistory=self.owner, Name=name, **attributes)

    def point(self, *position_m):
        return self.file.create_entity("IfcCartesianPoint", tuple(coordinate / self.metre for coordinate in position_m))

    def direction(self, *ratios):
        return self.file.create_entity("IfcDirection", tuple(float(ratio) for ratio in ratios))

    def aggregate(self, whole, *parts):
        self.root("IfcRelAggregates", None, RelatingObject=whole, RelatedObjects=list(parts))

    def part(self, kind):
        """The part of the bridge of a kind: of its own class in IFC4X3, a storey of that name elsewhere."""
        if kind not in self.parts:
            if self.is_newest:
                made = self.root("IfcBridgePart", kind.title(), PredefinedType=kind)
            else:
                made = self.root("IfcBuildingStorey", kind.title())
            self.aggregate(self.bridge, made)
            self.parts[kind] = made
        return self.parts[kind]

    def solid(self, size_m, position_m):
        """An upright box: its size, and the middle of its underside."""
        make = self.file.create_entity
        profile = make(
            "IfcRectangleProfileDef", "AREA", None, self.flat(), size_m[0] / self.metre, size_m[1] / self.metre
        )
        at = make("IfcAxis2Placement3D", self.point(*position_m), self.direction(0, 0, 1), self.direction(1, 0, 0))
        return make("IfcExtrudedAreaSolid", profile, at, self.direction(0, 0, 1), size_m[2] / self.metre)

    def element(self, kind, name, shape, part, *, predefined=None, material=None, shape_type="SweptSolid"):
        """An element of a class, with a shape; returns it."""
        make = self.file.create_entity
        body = make("IfcShapeRepresentation", self.context, "Body", shape_type, [shape])
        made = self.root(
            kind,
            name,
            ObjectPlacement=self.place,
            Representation=make("IfcProductDefinitionShape", None, None, [body]),
        )
        if predefined and self.is_newest:
            made.PredefinedType = predefined
        where = self.part(part)
        self.root("IfcRelContainedInSpatialStructure", None, RelatedElements=[made], RelatingStructure=where)
        if material is not None and self.has_materials:
            self.root("IfcRelAssociatesMaterial", None, RelatedObjects=[made], RelatingMaterial=material)
        return made

    def box(self, kind, name, size_m, position_m, part, **more):
        return self.element(kind, name, self.solid(size_m, position_m), part, **more)

    def material(self, name, density_kg_m3=None):
        make = self.file.create_entity
        made = make("IfcMaterial", name)
        if density_kg_m3 is not None and self.schema == "IFC2X3":
            make("IfcGeneralMaterialProperties", made, None, None, density_kg_m3)
        elif density_kg_m3 is not None:
            value = make("IfcMassDensityMeasure", density_kg_m3)
            given = make("IfcPropertySingleValue", "MassDensity", None, value, None)
            make("IfcMaterialProperties", "Pset_MaterialCommon", None, [given], made)
        return made

    def substructure(self):
        """Footings, abutments, the pier and its cap."""
        concrete = self.material("C30/37")
        for number, along in enumerate((0.0, 10.0, 20.0), start=1):
            size, position = (3.0, 5.0, 0.5), (along, 0.0, 0.0)
            self.box("IfcFooting", f"Footing {number}", size, position, "FOUNDATION", material=concrete)
        for number, along in enumerate((0.0, 20.0), start=1):
            size, position = (1.0, 4.0, 3.0), (along, 0.0, 0.5)
            self.box("IfcWall", f"Abutment {number}", size, position, "ABUTMENT", material=concrete)
        self.box("IfcColumn", "Column", (1.0, 1.0, 2.4), (10.0, 0.0, 0.5), "PIER", material=concrete)
        cap = (1.0, 4.0, 0.6), (10.0, 0.0, 2.9), "PIER"
        self.box("IfcBeam", "Crosshead", *cap, predefined="PIERCAP", material=concrete)
        return self

    def bearings(self):
        """Two at each support, rockers on the pier and rollers beside: in IFC4X3 of a class, elsewhere by name."""
        for number, (along, predefined) in enumerate(((0.0, "ROLLER"), (10.0, "ROCKER"), (20.0, "ROLLER")), start=1):
            for side, across in (("right", -1.0), ("left", 1.0)):
                kind = "IfcBearing" if self.is_newest else "IfcBuildingElementProxy"
                size, position = (0.4, 0.4, 0.1), (along, across, 3.5)
                self.box(kind, f"Bearing {number} {side}", size, position, "SUPERSTRUCTURE", predefined=predefined)
        return self

    def superstructure(self):
        """Girders and deck."""
        steel, concrete = self.material("S355"), self.material("Concrete of the deck", DECK_KG_M3)
        for side, across in (("right", -1.0), ("left", 1.0)):
            size, position = (21.0, 0.4, 0.8), (10.0, across, 3.6)
            self.box("IfcBeam", f"Girder {side}", size, position, "SUPERSTRUCTURE", material=steel)
        self.box("IfcSlab", "Carriageway", (21.0, 4.0, 0.2), (10.0, 0.0, 4.4), "DECK", material=concrete)
        return self

    def fittings(self):
        """What is no member: a railing, a tendon, a bar, and piles."""
        self.box("IfcRailing", "Railing", (21.0, 0.05, 1.0), (10.0, 1.9, 4.6), "DECK")
        self.box("IfcTendon", "Tendon", (20.0, 0.05, 0.05), (10.0, 1.0, 4.0), "SUPERSTRUCTURE")
        self.box("IfcReinforcingBar", "Bar", (20.0, 0.02, 0.02), (10.0, 0.0, 4.5), "DECK")
        for number, across in enumerate((-1.0, 1.0), start=1):
            self.box("IfcPile", f"Pile {number}", (0.5, 0.5, 8.0), (10.0, across, -8.0), "FOUNDATION")
        return self

    def map_conversion(self, name, easting, northing, turn_deg=0.0, scale=None):
        """Coordinates of the file's origin in a map, in its own unit, metres, and the direction of the x axis there."""
        make = self.file.create_entity
        unit = make("IfcSIUnit", None, "LENGTHUNIT", None, "METRE")
        system = make("IfcProjectedCRS", Name=name, MapUnit=unit)
        turn = math.radians(turn_deg)
        kept = dict(XAxisAbscissa=math.cos(turn), XAxisOrdinate=math.sin(turn), Scale=scale or self.metre)
        make(
            "IfcMapConversion",
            SourceCRS=self.context,
            TargetCRS=system,
            Eastings=easting,
            Northings=northing,
            OrthogonalHeight=0.0,
            **kept,
        )
        return self

    def written(self, path: Path) -> Path:
        self.file.write(str(path))
        return path

    def flat(self):
        make = self.file.create_entity
        return make("IfcAxis2Placement2D", make("IfcCartesianPoint", (0.0, 0.0)))

    def _length(self):
        make = self.file.create_entity
        if self.unit != "FOOT":
            prefix = None if self.unit == "METRE" else self.unit
            return make("IfcSIUnit", None, "LENGTHUNIT", prefix, "METRE")
        exponents = make("IfcDimensionalExponents", 1, 0, 0, 0, 0, 0, 0)
        metre = make("IfcSIUnit", None, "LENGTHUNIT", None, "METRE")
        factor = make("IfcMeasureWithUnit", make("IfcLengthMeasure", self.metre), metre)
        return make("IfcConversionBasedUnit", exponents, "LENGTHUNIT", "FOOT", factor)

    def _placement(self):
        make = self.file.create_entity
        turn = math.radians(self.turn_deg)
        along = self.direction(math.cos(turn), math.sin(turn), 0.0)
        at = make("IfcAxis2Placement3D", self.point(*self.offset_m), self.direction(0, 0, 1), along)
        return make("IfcLocalPlacement", None, at)


def whole_bridge(**options):
    """The whole bridge, with what is left out of it."""
    return IfcBridge(**options).substructure().bearings().superstructure().fittings()
