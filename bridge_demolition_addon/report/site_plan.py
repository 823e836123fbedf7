"""Areas for a site plan: as DXF in local metres, and as GeoJSON where it is known where on earth the bridge is."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from manifold3d import CrossSection

from ..core.results.footprint import outlines
from ..core.scenario import Site

EQUATOR_M = 6_378_137.0
"""Half the larger axis of the WGS 84 ellipsoid."""

FLATTENING = 1.0 / 298.257223563
"""Flattening of the WGS 84 ellipsoid."""

_SQUARED_ECCENTRICITY = FLATTENING * (2.0 - FLATTENING)

_NEAR_180 = math.radians(10.0)
"""Difference of longitude from that meridian from which on no bridge reaches it."""

_CLOSED = 1


def write_dxf(path: Path, layers: Mapping[str, CrossSection]) -> None:
    """Write areas as closed polylines, one layer each, in metres and in the scenario's own axes.

    The format is that of AutoCAD release 12, which everything reads.
    """
    lines = ["0", "SECTION", "2", "HEADER", "9", "$ACADVER", "1", "AC1009", "0", "ENDSEC"]
    lines += ["0", "SECTION", "2", "ENTITIES"]
    for name, area in layers.items():
        for ring in outlines(area):
            layer = name.upper().replace(" ", "_")
            lines += ["0", "POLYLINE", "8", layer, "66", "1", "70", str(_CLOSED), "10", "0", "20", "0", "30", "0"]
            for x, y in ring:
                lines += ["0", "VERTEX", "8", layer, "10", f"{x:.4f}", "20", f"{y:.4f}", "30", "0"]
            lines += ["0", "SEQEND", "8", layer]
    lines += ["0", "ENDSEC", "0", "EOF"]
    path.write_text("\n".join(lines) + "\n", encoding="ascii", newline="\r\n")


def write_geojson(path: Path, layers: Mapping[str, CrossSection], site: Site) -> None:
    """Write areas as GeoJSON (RFC 7946), one feature each, in degrees of longitude and latitude, WGS 84."""
    features = [
        {
            "type": "Feature",
            "properties": {"name": name, "area_m2": round(area.area(), 2)},
            "geometry": {"type": "MultiPolygon", "coordinates": _polygons(area, site)},
        }
        for name, area in layers.items()
    ]
    text = json.dumps({"type": "FeatureCollection", "features": features}, indent=1)
    path.write_text(text + "\n", encoding="utf-8")


def degrees(points_m: np.ndarray, site: Site) -> np.ndarray:
    """Longitude and latitude (p, 2) in degrees of points (p, 2) in the scenario's axes, m.

    Points are on the plane that touches the ellipsoid in the origin, and are told of by what lies below them there: a
    kilometre away, distances are kept within a millimetre. Longitudes beyond 180° go on counting.

    References
    ----------
    B. R. Bowring (1976), Transformation from spatial to geographical coordinates, Survey Review 23, 323-327.
    """
    # x points to the bearing, y to the left of it.
    bearing = math.radians(site.bearing_deg)
    east = points_m[:, 0] * math.sin(bearing) - points_m[:, 1] * math.cos(bearing)
    north = points_m[:, 0] * math.cos(bearing) + points_m[:, 1] * math.sin(bearing)
    # From the earth's centre: outwards to the origin's meridian, east of it, and along the axis.
    latitude = math.radians(site.latitude_deg)
    outwards = _axis_distance_m(latitude) - north * math.sin(latitude)
    axial = (1.0 - _SQUARED_ECCENTRICITY) * _normal_m(latitude) * math.sin(latitude) + north * math.cos(latitude)
    from_axis = np.hypot(outwards, east)
    polar_m = EQUATOR_M * (1.0 - FLATTENING)
    reduced = np.arctan2(axial * EQUATOR_M, from_axis * polar_m)
    found = np.arctan2(
        axial + _SQUARED_ECCENTRICITY / (1.0 - _SQUARED_ECCENTRICITY) * polar_m * np.sin(reduced) ** 3,
        from_axis - _SQUARED_ECCENTRICITY * EQUATOR_M * np.cos(reduced) ** 3,
    )
    return np.column_stack([site.longitude_deg + np.degrees(np.arctan2(east, outwards)), np.degrees(found)])


def _normal_m(latitude: float) -> float:
    """Length of the vertical from the ellipsoid to the earth's axis, at a latitude in radians."""
    return EQUATOR_M / math.sqrt(1.0 - _SQUARED_ECCENTRICITY * math.sin(latitude) ** 2)


def _axis_distance_m(latitude: float) -> float:
    """Distance of the ellipsoid from the earth's axis, at a latitude in radians."""
    return _normal_m(latitude) * math.cos(latitude)


def _polygons(area: CrossSection, site: Site) -> list[Any]:
    """Coordinates of every separate part: its outline, then its holes."""
    parts = []
    beyond = _beyond_180(area, site)
    turn = math.copysign(360.0, site.longitude_deg)
    for side, shift in ((area - beyond, 0.0), (area ^ beyond, turn)):
        for part in () if side.is_empty() else side.decompose():  # nothing would decompose into an empty part
            rings = sorted(outlines(part), key=lambda ring: -_signed_area(ring))
            closed = [np.vstack([ring, ring[:1]]) for ring in rings]
            parts.append([(degrees(ring, site) - (shift, 0.0)).round(8).tolist() for ring in closed])
    return parts


def _beyond_180(area: CrossSection, site: Site) -> CrossSection:
    """What lies beyond the meridian of 180°, around an area and in the scenario's axes.

    GeoJSON wants areas that cross that meridian cut there (RFC 7946, 3.1.9). In the plane it is a straight line.
    """
    side = math.copysign(1.0, site.longitude_deg)
    angle = math.radians(180.0 - abs(site.longitude_deg))
    if area.is_empty() or angle > _NEAR_180:
        return CrossSection()
    room = 2.0 * float(np.abs(area.bounds()).max())
    latitude = math.radians(site.latitude_deg)
    norths = np.array([-room, room])
    near = side * (_axis_distance_m(latitude) - norths * math.sin(latitude)) * math.tan(angle)
    far = near + side * (2.0 * room + np.abs(near).max())
    corners = np.column_stack([np.append(near, far[::-1]), np.append(norths, norths[::-1])])
    bearing = math.radians(site.bearing_deg)
    axes = np.array([[math.sin(bearing), -math.cos(bearing)], [math.cos(bearing), math.sin(bearing)]])
    return CrossSection([(corners @ axes)[:: -int(side)]])


def _signed_area(ring: np.ndarray) -> float:
    after = np.roll(ring, -1, axis=0)
    return float(np.sum(ring[:, 0] * after[:, 1] - after[:, 0] * ring[:, 1])) / 2.0
