"""Surfaces of the ground of triangles: in LandXML 1.0 to 2.0, and in IFC, which a process of its own reads."""

from __future__ import annotations

import tempfile
from fnmatch import fnmatchcase
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.terrain.surface import Surface
from ...errors import GeometryError
from ...system.isolated import isolated
from ...system.reading import MEGABYTE, check_file
from .file_heights import FileHeights, note_on_lost

_MOST_BYTES = 300 * MEGABYTE

_CORNERS = 3

_POINTS = ("CgPoint", "P", "DataPoint")

_FEET = {"foot": 0.3048, "USSurveyFoot": 0.304800609601}
_METRES = {"millimeter": 0.001, "centimeter": 0.01, "kilometer": 1000.0}


def read_landxml(path: Path, name: str | None = None) -> FileHeights:
    """Read the one surface of a file, or the one with a name, with ``*`` for any letters."""
    check_file(path, _MOST_BYTES)
    try:
        root = ElementTree.parse(path).getroot()
    except (ElementTree.ParseError, UnicodeDecodeError) as error:
        raise GeometryError(f"cannot be read as LandXML: {error}") from error
    if _name(root) != "LandXML":
        raise GeometryError(f"is no LandXML: it begins with {_name(root)!r}")
    surfaces = [
        (surface, definition)
        for surface in root.iter()
        if _name(surface) == "Surface" and (definition := _child(surface, "Definition")) is not None
    ]
    names = ", ".join(repr(surface.get("name", "")) for surface, _ in surfaces)
    if name is not None:
        found = [one for one in surfaces if fnmatchcase(one[0].get("name", "").casefold(), name.casefold())]
        if len(found) != 1:
            raise GeometryError(
                f"holds {len(found)} surfaces that ground.surface = {name!r} names, of {names or 'none'}"
            )
        surfaces = found
    if not surfaces:
        points = sum(_name(element) in _POINTS for element in root.iter())
        what = f"holds {points} points, but no surface" if points else "holds no surface"
        raise GeometryError(
            f"{what}: expected one of triangles, a TIN; make one in the program that it was made with"
            f"{', or save the points as .xyz, between which triangles are made here' if points else ''}"
        )
    if len(surfaces) != 1:
        raise GeometryError(f"holds {len(surfaces)} surfaces, {names}: expected one; say which by ground.surface")
    mesh, notes = _triangles(surfaces[0][1])
    unit, unit_m = _unit(root)
    return FileHeights(Surface(mesh), unit_m, unit, notes)


def _triangles(definition: ElementTree.Element) -> tuple[TriangleMesh, tuple[str, ...]]:
    """Return the triangles of a surface, and notes on those that name points that are not there."""
    points, faces = _child(definition, "Pnts"), _child(definition, "Faces")
    if points is None or faces is None:
        known = sum(_name(element) in _POINTS for element in definition.iter())
        has = f"{known} points, but no triangles" if known else "no triangles"
        raise GeometryError(f"its surface has {has}: expected Pnts and Faces, as of a TIN")
    positions = {point.get("id"): place for point in points if (place := _place(point.text or ""))}
    rows = {name: row for row, name in enumerate(positions)}
    visible = [face for face in faces if face.get("i") != "1"]
    named = [(face.text or "").split() for face in visible]
    is_whole = [len(names) == _CORNERS and rows.keys() >= set(names) for names in named]
    lost = [number for number, whole in enumerate(is_whole, start=1) if not whole]
    first = f"number {lost[0]}, <F>{' '.join(named[lost[0] - 1])}</F>" if lost else ""
    notes = note_on_lost(len(lost), len(named), first)
    corners = [[rows[name] for name in names] for names, whole in zip(named, is_whole, strict=True) if whole]
    vertices, triangles = np.array(list(positions.values()), float), np.array(corners, np.int64)
    if not len(triangles):
        raise GeometryError("its surface has no triangles: expected three numbers in each P and each F")
    return TriangleMesh(vertices[:, [1, 0, 2]], triangles), notes


def _place(text: str) -> list[float] | None:
    """Return the three numbers of a point; None where it has others, so that its triangles lack it."""
    try:
        place = [float(value) for value in text.split()]
    except ValueError:
        return None
    return place if len(place) == _CORNERS and np.isfinite(place).all() else None


def _unit(root: ElementTree.Element) -> tuple[str, float]:
    """Return the unit of lengths of a file that is not in metres, and the metres in it."""
    for units in root.iter():
        if _name(units) not in ("Metric", "Imperial"):
            continue
        unit = units.get("linearUnit", "")
        metres = (_METRES | _FEET).get(unit)
        return (unit, metres) if metres is not None else ("", 1.0)
    return "", 1.0


def _child(element: ElementTree.Element, name: str) -> ElementTree.Element | None:
    return next((inner for inner in element if _name(inner) == name), None)


def _name(element: ElementTree.Element) -> str:
    return element.tag.rpartition("}")[2]


IFC_FILES = (".ifc",)

_MOST_IFC_BYTES = 2000 * MEGABYTE
_LIMIT_S = 600.0


def read_ifc_surface(path: Path, name: str | None) -> FileHeights:
    """Return the ground of a file, in metres: all elements that are ground, or the ones with a name.

    Where the file has a map conversion, it is in the map's coordinates.
    """
    check_file(path, _MOST_IFC_BYTES)
    with tempfile.TemporaryDirectory(prefix="bda-ground-") as folder:
        kept = Path(folder) / "ground.npz"
        # By its name: what reads IFC stands higher than the model.
        said = isolated("ifc.ground_program", {"path": str(path.absolute()), "name": name, "kept": str(kept)}, _LIMIT_S)
        if not said["surfaces"]:
            named = ", ".join(map(repr, said["others"][:5])) or "nothing with a surface"
            wanted = f"that is called {name!r}" if name else "that is ground"
            raise GeometryError(f"has no surface {wanted}: it has {named}; say which by ground.surface")
        with np.load(kept) as arrays:
            mesh = TriangleMesh(arrays["vertices"], arrays["triangles"])
    return FileHeights(Surface(mesh), notes=tuple(said["notes"]))
