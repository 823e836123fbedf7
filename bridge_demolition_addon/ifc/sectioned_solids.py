"""Solids swept along a curve through given sections, worked out here: the geometry library leaves them unsound.

Girders and decks on alignments are `IfcSectionedSolidHorizontal`. The profile's x lies to the left of the curve, its y
upwards (IFC 4.3, 8.8.3.35).
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
from manifold3d import triangulate

from ..engineering.geometry.mesh import TriangleMesh, joined_meshes
from ..engineering.geometry.vectors import length, transformed
from ..errors import GeometryError
from .alignments import Curve, curve_of, place_along
from .library import library
from .profiles import outline_of
from .representations import items_of
from .source import IfcSource

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
    """Return the corners (k, 3) of a section that is so far along, beside and above a curve, m."""
    frame, corners = curve.at(float(place[0])), profile + place[1:]
    return frame.point + corners[:, :1] * frame.left + corners[:, 1:] * frame.up


def _loft(rings: np.ndarray, first: np.ndarray, last: np.ndarray) -> TriangleMesh:
    """Return the closed mesh over rings (r, k, 3), each of which goes on to the next, with lids at both ends."""
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
