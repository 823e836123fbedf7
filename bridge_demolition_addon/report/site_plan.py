"""Areas for a site plan: as DXF in local metres, and as GeoJSON where it is known where on earth the bridge is."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from manifold3d import CrossSection

from ..core.plan import outlines
from ..core.scenario import Site

EQUATOR_M = 6_378_137.0
"""Half the larger axis of the WGS 84 ellipsoid."""

FLATTENING = 1.0 / 298.257223563
"""Flattening of the WGS 84 ellipsoid."""

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

    On the plane that touches the ellipsoid in the origin: a kilometre from there it is a decimetre off, less than any
    survey of an exclusion zone.
    """
    bearing = math.radians(site.bearing_deg)
    # x points to the bearing, y to the left of it.
    east = points_m[:, 0] * math.sin(bearing) - points_m[:, 1] * math.cos(bearing)
    north = points_m[:, 0] * math.cos(bearing) + points_m[:, 1] * math.sin(bearing)
    latitude = math.radians(site.latitude_deg)
    squared_eccentricity = FLATTENING * (2.0 - FLATTENING)
    root = 1.0 - squared_eccentricity * math.sin(latitude) ** 2
    meridian_m = EQUATOR_M * (1.0 - squared_eccentricity) / root**1.5
    parallel_m = EQUATOR_M / math.sqrt(root) * math.cos(latitude)
    return np.column_stack(
        [site.longitude_deg + np.degrees(east / parallel_m), site.latitude_deg + np.degrees(north / meridian_m)]
    )


def _polygons(area: CrossSection, site: Site) -> list[Any]:
    """Coordinates of every separate part: its outline, then its holes."""
    parts = []
    for part in area.decompose():
        rings = sorted(outlines(part), key=lambda ring: -_signed_area(ring))
        closed = [np.vstack([ring, ring[:1]]) for ring in rings]
        parts.append([degrees(ring, site).round(8).tolist() for ring in closed])
    return parts


def _signed_area(ring: np.ndarray) -> float:
    after = np.roll(ring, -1, axis=0)
    return float(np.sum(ring[:, 0] * after[:, 1] - after[:, 0] * ring[:, 1])) / 2.0
