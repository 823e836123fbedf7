"""Areas for a site plan, from a charge plan, and their files: DXF in local metres, GeoJSON in degrees.

Predicted debris comes from a run or a study. Fragments are known within a factor of 2, and no safety distance.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from manifold3d import CrossSection
from pymap3d import enu2geodetic

from ..engineering.drilled_charges.fragments import Ranges
from ..engineering.geometry.plan_areas import outlines, signed_area, united
from ..engineering.geometry.solids import to_manifold
from ..errors import GeometryError, ScenarioError
from ..model.bridge.preparation import prepared_members
from ..model.debris.zones import widened, widened_around
from ..model.scenario import Scenario, Site
from ..model.structure.charge_plan import charge_plan
from ..model.structure.zone_fragments import fragment_areas, zone_areas
from ..system.disk import write_whole_text

_CLOSED = 1
_MOST_LETTERS = 31

CONTOUR_LAYER, NOTE_LAYER = "CONTOURS", "NOTE"

_NOTE_HEIGHT = 0.02
"""Height of the letters of a note, of the width of all areas."""


def write_areas(
    areas: Mapping[str, CrossSection],
    site: Site | None,
    dxf: Path,
    geojson: Path,
    contours_m: np.ndarray | None = None,
    note: str = "",
) -> list[Path]:
    """Write areas for a site plan, and return the files; in degrees only where the site is known.

    Both files hold a note with the areas.
    """
    write_dxf(dxf, areas, contours_m, note)
    if site is None:
        return [dxf]
    write_geojson(geojson, areas, site, note)
    return [dxf, geojson]


def write_dxf(
    path: Path, layers: Mapping[str, CrossSection], contours_m: np.ndarray | None = None, note: str = ""
) -> None:
    """Write areas as closed polylines, one layer each, in metres and in the scenario's own axes.

    Contour lines of the ground (s, 2, 3) have a layer of their own, each at its height, and so has a note, below all
    areas. Format: AutoCAD release 12, which everything reads.
    """
    lines = ["0", "SECTION", "2", "HEADER", "9", "$ACADVER", "1", "AC1009", "0", "ENDSEC"]
    lines += ["0", "SECTION", "2", "ENTITIES"]
    for layer, area in zip(_layer_names(layers), layers.values(), strict=True):
        for ring in outlines(area):
            lines += ["0", "POLYLINE", "8", layer, "66", "1", "70", str(_CLOSED), "10", "0", "20", "0", "30", "0"]
            for x, y in ring:
                lines += ["0", "VERTEX", "8", layer, "10", f"{x:.4f}", "20", f"{y:.4f}", "30", "0"]
            lines += ["0", "SEQEND", "8", layer]
    for ends in [] if contours_m is None else contours_m:
        lines += ["0", "LINE", "8", CONTOUR_LAYER]
        for number, position in enumerate(ends):
            for axis, value in enumerate(position, start=1):
                lines += [f"{axis}{number}", f"{value:.4f}"]
    if note:
        low_x, low_y, high_x, _ = np.array([area.bounds() for area in layers.values()]).reshape(-1, 4).T
        x, y, height = low_x.min(), low_y.min(), _NOTE_HEIGHT * (high_x.max() - low_x.min())
        lines += ["0", "TEXT", "8", NOTE_LAYER, "10", f"{x:.4f}", "20", f"{y - 2.0 * height:.4f}", "30", "0"]
        lines += ["40", f"{height:.4f}", "1", note]
    lines += ["0", "ENDSEC", "0", "EOF"]
    write_whole_text(path, "\n".join(lines) + "\n", encoding="ascii", newline="\r\n")


def _layer_names(names: Iterable[str]) -> list[str]:
    """Return names as release 12 may have them, of 31 letters, digits, hyphens and underlines, each another."""
    layers: list[str] = []
    for number, name in enumerate(names, start=1):
        layer = re.sub(r"[^A-Z0-9-]+", "_", name.upper()).strip("_")[:_MOST_LETTERS]
        layers.append(f"{layer[: _MOST_LETTERS - 4]}_{number}" if layer in layers or not layer else layer)
    return layers


def write_geojson(path: Path, layers: Mapping[str, CrossSection], site: Site, note: str = "") -> None:
    """Write areas as GeoJSON (RFC 7946), one feature each, in degrees of longitude and latitude, WGS 84."""
    features = [
        {
            "type": "Feature",
            "properties": {"name": name, "area_m2": round(area.area(), 2), **({"note": note} if note else {})},
            "geometry": {"type": "MultiPolygon", "coordinates": _polygons(area, site)},
        }
        for name, area in layers.items()
    ]
    text = json.dumps({"type": "FeatureCollection", "features": features}, indent=1)
    write_whole_text(path, text + "\n")


def degrees(points_m: np.ndarray, site: Site) -> np.ndarray:
    """Return longitude and latitude (p, 2), degrees, of what lies below points (p, 2) of the scenario, m.

    The points lie on the plane that touches the ellipsoid in the origin; a kilometre away, distances are kept within a
    millimetre. Longitudes count on beyond 180°, so that an area across that meridian stays in one piece.
    """
    # x points to the bearing, y to the left of it.
    bearing = math.radians(site.bearing_deg)
    east = points_m[:, 0] * math.sin(bearing) - points_m[:, 1] * math.cos(bearing)
    north = points_m[:, 0] * math.cos(bearing) + points_m[:, 1] * math.sin(bearing)
    latitudes, longitudes, _ = enu2geodetic(east, north, 0.0, site.latitude_deg, site.longitude_deg, 0.0)
    turns = np.round((site.longitude_deg - longitudes) / 360.0)
    return np.column_stack([longitudes + 360.0 * turns, latitudes])


def _polygons(area: CrossSection, site: Site) -> list[Any]:
    """Return the coordinates of every separate part: its outline, then its holes."""
    parts = []
    for part in () if area.is_empty() else area.decompose():  # nothing would decompose into an empty part
        rings = sorted(outlines(part), key=lambda ring: -signed_area(ring))
        parts.append([degrees(np.vstack([ring, ring[:1]]), site).round(8).tolist() for ring in rings])
    return parts


def charge_areas(scenario: Scenario) -> dict[str, CrossSection]:
    """Return all areas of the charge plan of a scenario by their names, the largest first."""
    members = prepared_members(scenario).members
    plan = charge_plan(scenario, members)
    bridge = united([to_manifold(member.solid, member.name).project() for member in members])
    drop = {} if scenario.exclusion is None else {"designed drop": widened(bridge, scenario.exclusion.designed_drop_m)}
    own = drop | {"bridge": bridge} | zone_areas(plan.zones)
    return fragment_areas(plan.zones, plan.flyrock) | cordon_area(scenario, bridge) | own


def areas_of_fragments(scenario: Scenario | None, limits: Ranges | None = None) -> dict[str, CrossSection]:
    """Return areas of fragments of a run's scenario; nothing without blast zones, or without files of its members.

    Where there are limits of a study, all zones have these.
    """
    if scenario is None or not scenario.blast_zones:
        return {}
    try:
        plan = charge_plan(scenario, prepared_members(scenario).members)
    except (GeometryError, ScenarioError):
        return {}  # the chapter with the charge plan says why
    flown = plan.flyrock
    if limits is not None:
        flown = tuple(None if of is None else replace(of, sampled=limits) for of in flown)
    return fragment_areas(plan.zones, flown)


def cordon_area(scenario: Scenario | None, bridge: CrossSection) -> dict[str, CrossSection]:
    """Return what is kept clear around the plan of a bridge, by its name; nothing where the scenario does not say."""
    if scenario is None or scenario.exclusion is None or scenario.exclusion.cordon_m is None:
        return {}
    return {"cordon": widened_around(bridge, scenario.exclusion.cordon_m)}
