"""Triangles of elements as IfcOpenShell works them out, kept so that a crash costs no more than one element.

Bodies that it leaves open or unsound are worked out here: those extruded from profiles whose outlines say of their
parts that they run the other way than they do, which are put together by their ends; and solids swept along a curve
through given sections. Girders and decks on alignments are `IfcSectionedSolidHorizontal`: the profile's x lies to the
left of the curve, its y upwards (IFC 4.3, 8.8.3.35).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from manifold3d import CrossSection, FillRule, Manifold, triangulate

from ..engineering.geometry.mesh import TriangleMesh, joined_meshes
from ..engineering.geometry.solids import from_manifold
from ..engineering.geometry.vectors import length, transformed
from ..errors import GeometryError
from .alignments import Curve, curve_of, place_along
from .elements import Element
from .library import library
from .missing_references import CONTRADICTIONS, items_of
from .profiles import line_of, outline_of
from .source import IfcSource

CHORD_M = 0.001
"""Largest distance of the middle of a chord from its curve."""

FAILED = "its geometry cannot be worked out"


@dataclass(slots=True)
class KeptShapes:
    """What is known of the shapes of elements before they are worked out, and where they are kept.

    Attributes
    ----------
    folder
        Where shapes are kept for a process that goes on after a crash; None to keep none.
    failed
        Why elements have no shape, by their numbers in the file. Those in it at first are not tried.
    begins
        Called before each element, with how many are done, how many there are, and the element; with None after the
        last one.
    says
        Called with what is done once all shapes are known.
    """

    folder: Path | None = None
    failed: dict[int, str] = field(default_factory=dict)
    begins: Callable[[int, int, Element | None], None] = lambda _done, _total, _element: None
    says: Callable[[str], None] = lambda _text: None

    def load(self, number: int) -> TriangleMesh | None:
        """Return the shape that is kept of an element, by its number in the file."""
        path = self._path(number)
        if path is None or not path.exists():
            return None
        with np.load(path) as arrays:
            return TriangleMesh(arrays["vertices"], arrays["triangles"])

    def save(self, number: int, mesh: TriangleMesh) -> None:
        """Keep the shape of an element."""
        if path := self._path(number):
            np.savez(path, vertices=mesh.vertices, triangles=mesh.triangles)

    def _path(self, number: int) -> Path | None:
        return None if self.folder is None else self.folder / f"{number}.npz"


def shapes_of(source: IfcSource, elements: Iterable[Element], kept: KeptShapes) -> dict[int, TriangleMesh]:
    """Return the triangles of elements by the number that the file gives them, m, in the axes of the file.

    Elements without a shape are in `kept.failed`, with the reason.
    """
    wanted, shapes, settings = list(elements), {}, _settings()
    for done, element in enumerate(wanted):
        number = element.entity.id()
        if number in kept.failed:
            continue
        if number in source.unknown:
            kept.failed[number] = source.unknown[number]
            continue
        mesh = kept.load(number)
        if mesh is None:
            kept.begins(done, len(wanted), element)
            try:
                mesh = _own_or_none(source, element.entity) or _shape(element.entity, settings, source.scale)
            except CONTRADICTIONS:
                kept.failed[number] = "its geometry contradicts its schema"
                continue
            if mesh is None:
                kept.failed[number] = FAILED
                continue
            kept.save(number, mesh)
        shapes[number] = mesh
    kept.begins(len(wanted), len(wanted), None)
    return shapes


def _own_or_none(source: IfcSource, entity: Any) -> TriangleMesh | None:
    """Return a body that is worked out here, as the geometry library leaves its kind unsound."""
    for made in (swept_mesh, extruded_mesh):
        with suppress(GeometryError):  # it is of another kind
            return made(source, entity)
    return None


def single_shape(source: IfcSource, entity: Any) -> TriangleMesh | None:
    """Return the triangles of a product as the geometry library works them out; None where it finds none."""
    return _shape(entity, _settings(), source.scale)


def _settings() -> Any:
    settings = library("geom").settings()
    settings.set("weld-vertices", True)
    settings.set("mesher-linear-deflection", CHORD_M)
    return settings


def _shape(entity: Any, settings: Any, scale: float) -> TriangleMesh | None:
    """Return the triangles of an element; None where IfcOpenShell finds none.

    They are placed here, in double precision, so that elements far from the origin keep their digits.
    """
    try:
        shape = library("geom").create_shape(settings, entity)
    except RuntimeError:  # its text is the entity, without a reason
        return None
    triangles = np.array(shape.geometry.faces, dtype=np.int64).reshape(-1, 3)
    if not len(triangles):
        return None
    vertices = np.array(shape.geometry.verts, dtype=float).reshape(-1, 3)
    placing = np.array(shape.transformation.matrix, dtype=float).reshape(4, 4).T
    placed = transformed(placing[:3, :3], vertices) + placing[:3, 3]
    return TriangleMesh(placed * scale, triangles) if np.isfinite(placed).all() else None


def extruded_mesh(source: IfcSource, entity: Any) -> TriangleMesh:
    """Return the body of an element that is extruded from such profiles, in the axes of the file, m.

    A `GeometryError` says why there is none.
    """
    items = items_of(entity, "IfcSolidModel")
    if not items or not all(_is_misled(item) for item in items) or getattr(entity, "HasOpenings", None):
        raise GeometryError("is not extruded from an outline whose parts are put together here")
    placing = np.array(library("util.placement").get_local_placement(entity.ObjectPlacement), dtype=float)
    mesh = joined_meshes([_extruded(source, item) for item in items])
    placed = transformed(placing[:3, :3], mesh.vertices) + placing[:3, 3] * source.unit_m
    return TriangleMesh(placed, mesh.triangles)


def _is_misled(item: Any) -> bool:
    """Return whether all parts of an item's outline are said to run backwards, where these could not all do so."""
    if not item.is_a("IfcExtrudedAreaSolid") or not item.SweptArea.is_a("IfcArbitraryClosedProfileDef"):
        return False
    outer = item.SweptArea.OuterCurve
    return bool(
        outer.is_a("IfcCompositeCurve")
        and len(outer.Segments) > 1
        and not any(getattr(part, "SameSense", True) for part in outer.Segments)
    )


def _extruded(source: IfcSource, item: Any) -> TriangleMesh:
    unit_m, area = source.unit_m, item.SweptArea
    curves = [area.OuterCurve, *(area.InnerCurves if area.is_a("IfcArbitraryProfileDefWithVoids") else ())]
    outline = CrossSection([line_of(curve, unit_m, source.angle_rad) for curve in curves], FillRule.EvenOdd)
    x, y, z = item.ExtrudedDirection.DirectionRatios
    if outline.is_empty() or not z:
        raise GeometryError("is extruded from no area")
    size = float(np.sqrt(x * x + y * y + z * z))
    depth_m = float(item.Depth) * unit_m * z / size
    body = from_manifold(Manifold.extrude(outline, abs(depth_m)))
    up = body.vertices[:, 2:] * np.sign(depth_m)
    vertices = np.column_stack((body.vertices[:, :2] + up * (x / z, y / z), up))
    mesh = TriangleMesh(vertices, body.triangles if depth_m > 0.0 else body.triangles[:, ::-1])
    if item.Position is None:
        return mesh
    placing = np.array(library("util.placement").get_axis2placement(item.Position), dtype=float)
    return TriangleMesh(transformed(placing[:3, :3], mesh.vertices) + placing[:3, 3] * unit_m, mesh.triangles)


_CHORD_M = 0.005
"""Largest distance of the middle of a chord from the curve."""

_TRIED = 16

_LEAST_HEIGHT_M, _SAME_HEIGHT_M = 3.0, 0.05
"""Height of a curve from which on sections may have it too, and how far a corner of theirs may lie from it."""


def swept_mesh(source: IfcSource, entity: Any) -> TriangleMesh:
    """Return the body of an element that is swept through sections, in the axes of the file, m.

    A `GeometryError` says why there is none.
    """
    items = items_of(entity, "IfcSolidModel")
    if not items or not all(item.is_a("IfcSectionedSolidHorizontal") for item in items):
        raise GeometryError("is not swept through sections")
    if getattr(entity, "HasOpenings", None):
        raise GeometryError("has openings")
    placing = np.array(library("util.placement").get_local_placement(entity.ObjectPlacement), dtype=float)
    mesh = joined_meshes([_swept(source, item) for item in items])
    placed = transformed(placing[:3, :3], mesh.vertices) + placing[:3, 3] * source.unit_m
    return TriangleMesh(placed, mesh.triangles)


def _swept(source: IfcSource, solid: Any) -> TriangleMesh:
    unit_m = source.unit_m
    curve = curve_of(solid.Directrix, unit_m)
    profiles = [outline_of(profile, unit_m, source.angle_rad) for profile in solid.CrossSections]
    places = [place_along(getattr(position, "Location", position), unit_m) for position in solid.CrossSectionPositions]
    if len(profiles) < 2 or len(places) != len(profiles) or len({len(profile) for profile in profiles}) != 1:
        raise GeometryError("has sections with different numbers of corners")
    places = _without_heights(curve, profiles, places)
    rings = []
    for (first, start), (second, end) in pairwise(zip(profiles, places, strict=True)):
        stations = _stations(curve, float(start[0]), float(end[0]))
        for share in (stations - start[0]) / (end[0] - start[0]):
            rings.append(_ring(curve, first + share * (second - first), start + share * (end - start)))
    rings.append(_ring(curve, profiles[-1], places[-1]))
    return _loft(np.array(rings), profiles[0], profiles[-1])


def _without_heights(curve: Curve, profiles: list[np.ndarray], places: list[np.ndarray]) -> list[np.ndarray]:
    """Return where sections are, lower by the curve where they already have its heights.

    Some programs write decks with heights of the map in their sections, along a curve that has them too. Then each
    section has a corner at the height of the curve, and none anywhere near 0.
    """
    heights = [float(curve.at(float(place[0])).point[2]) for place in places]
    both = [
        height > _LEAST_HEIGHT_M
        and float(np.abs(profile[:, 1] - height).min()) <= _SAME_HEIGHT_M
        and float(profile[:, 1].min()) > 0.5 * height
        for profile, height in zip(profiles, heights, strict=True)
    ]
    if not all(both):
        return places
    return [place - (0.0, 0.0, height) for place, height in zip(places, heights, strict=True)]


def _ring(curve: Curve, profile: np.ndarray, place: np.ndarray) -> np.ndarray:
    """Return the corners (k, 3) of a section at a distance along, across and above a curve, m."""
    frame, corners = curve.at(float(place[0])), profile + place[1:]
    return frame.point + corners[:, :1] * frame.left + corners[:, 1:] * frame.up


def _loft(rings: np.ndarray, first: np.ndarray, last: np.ndarray) -> TriangleMesh:
    """Return the closed mesh over consecutive rings (r, k, 3), with lids at both ends."""
    count, corners = rings.shape[:2]
    here = np.arange(corners)
    ahead = np.roll(here, -1)
    sides = [
        np.concatenate(
            [
                np.column_stack((low + here, low + ahead, low + corners + ahead)),
                np.column_stack((low + here, low + corners + ahead, low + corners + here)),
            ]
        )
        for low in range(0, (count - 1) * corners, corners)
    ]
    lids = [_lid(first)[:, ::-1], _lid(last) + (count - 1) * corners]
    mesh = TriangleMesh(rings.reshape(-1, 3), np.concatenate([*sides, *lids]).astype(np.int64))
    return mesh if mesh.volume >= 0.0 else mesh.flipped()


def _lid(profile: np.ndarray) -> np.ndarray:
    """Return triangles (t, 3) of a profile that has been made anticlockwise."""
    return np.asarray(triangulate([np.ascontiguousarray(profile)]), dtype=np.int64).reshape(-1, 3)


def _stations(curve: Curve, start: float, end: float) -> np.ndarray:
    """Return distances from one section to before the next, with chords that stay near the curve."""
    if not end > start:
        raise GeometryError("has sections that do not follow each other")
    if len(curve.corners_m):
        return np.append(start, curve.corners_m[(curve.corners_m > start) & (curve.corners_m < end)])
    ways = np.array([curve.at(float(along)).along for along in np.linspace(start, end, _TRIED)])
    turned = float(length(np.diff(ways, axis=0)).sum())
    count = max(1, math.ceil(math.sqrt((end - start) * turned / (8.0 * _CHORD_M))))
    return start + (end - start) * np.arange(count) / count
