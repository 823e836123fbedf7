"""Surfaces of triangles in LandXML 1.0 to 2.0, whose points are northing, easting and height, in this order."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.terrain.surface import Surface
from ...errors import GeometryError
from ...system.reading import MEGABYTE, check_file

_MOST_BYTES = 300 * MEGABYTE

_FEET = {"foot": 0.3048, "USSurveyFoot": 0.304800609601}
_METRES = {"millimeter": 0.001, "centimeter": 0.01, "kilometer": 1000.0}


def read_landxml(path: Path, scale: float) -> Surface:
    """Read the one surface of a file; `scale` is what the user takes for metres in one unit of it."""
    check_file(path, _MOST_BYTES)
    try:
        root = ElementTree.parse(path).getroot()
    except (ElementTree.ParseError, UnicodeDecodeError) as error:
        raise GeometryError(f"cannot be read as LandXML: {error}") from error
    if _name(root) != "LandXML":
        raise GeometryError(f"is no LandXML: it begins with {_name(root)!r}")
    _check_units(root, scale)
    surfaces = [
        (surface, definition)
        for surface in root.iter()
        if _name(surface) == "Surface" and (definition := _child(surface, "Definition")) is not None
    ]
    if len(surfaces) != 1:
        names = ", ".join(repr(surface.get("name", "")) for surface, _ in surfaces)
        problem = f"holds {len(surfaces)} surfaces, {names}" if surfaces else "holds no surface"
        raise GeometryError(f"{problem}: expected one; export it alone")
    return Surface(_triangles(surfaces[0][1]))


def _triangles(definition: ElementTree.Element) -> TriangleMesh:
    points, faces = _child(definition, "Pnts"), _child(definition, "Faces")
    if points is None or faces is None:
        raise GeometryError("its surface has no triangles: expected Pnts and Faces, as of a TIN")
    try:
        positions = {point.get("id"): [float(value) for value in (point.text or "").split()] for point in points}
        rows = {name: row for row, name in enumerate(positions)}
        visible = [face for face in faces if face.get("i") != "1"]
        corners = [[rows[name] for name in (face.text or "").split()] for face in visible]
        vertices, triangles = np.array(list(positions.values()), float), np.array(corners, np.int64)
    except (KeyError, ValueError) as error:
        raise GeometryError(f"its surface is damaged: a point or triangle is none ({error})") from error
    if not len(triangles) or vertices.ndim != 2 or vertices.shape[1] != 3 or triangles.shape[1] != 3:
        raise GeometryError("its surface has no triangles: expected three numbers in each P and each F")
    return TriangleMesh(vertices[:, [1, 0, 2]], triangles)


def _check_units(root: ElementTree.Element, scale: float) -> None:
    for units in root.iter():
        if _name(units) not in ("Metric", "Imperial"):
            continue
        unit = units.get("linearUnit", "")
        metres = (_METRES | _FEET).get(unit)
        if metres is not None and scale == 1.0:
            raise GeometryError(f"is in {unit}: set ground.scale to {metres:.12g}")
        return


def _child(element: ElementTree.Element, name: str) -> ElementTree.Element | None:
    return next((inner for inner in element if _name(inner) == name), None)


def _name(element: ElementTree.Element) -> str:
    return element.tag.rpartition("}")[2]
