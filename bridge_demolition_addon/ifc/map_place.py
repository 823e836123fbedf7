"""Where a bridge lies on its map and on earth: by its map conversion, or by latitude and longitude of its IfcSite."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from pymap3d import enu2geodetic, geodetic2enu

from ..engineering.map_grids import grid_of_epsg
from ..model.scenario import Ground, Site
from .library import library
from .placement import Placement
from .source import IfcSource

_STEP_M = 10.0
"""Distance along the road over which its bearing is measured."""

_MOST_SCALE = 0.01
"""How far the scale of a map may be from 1: that of a grid is within a thousandth."""

_GROUND = ("IfcGeographicElement", "IfcGeotechnicalStratum", "IfcGeomodel", "IfcSite", "IfcEarthworksElement")
"""Classes that are ground."""

_HALF_ZONE_M, _POLE_M = 400_000.0, 10_000_000.0
"""How far a UTM zone reaches from its middle, and to the north, with room to spare."""


def on_map(source: IfcSource, points_m: np.ndarray) -> np.ndarray | None:
    """Return positions (n, 3) of a file in its map, m; None where it has no map conversion.

    A scale far from the units' own, as some programs write it, does not count.
    """
    conversion = library("util.geolocation").get_helmert_transformation_parameters(source.model)
    if conversion is None:
        return None
    map_unit_m = _map_unit(source)
    factor = conversion.scale * map_unit_m / source.unit_m
    if abs(factor - 1.0) > _MOST_SCALE:
        factor = 1.0
    turn = math.atan2(conversion.xao, conversion.xaa)
    x, y = factor * points_m[:, 0], factor * points_m[:, 1]
    east = conversion.e * map_unit_m + math.cos(turn) * x - math.sin(turn) * y
    north = conversion.n * map_unit_m + math.sin(turn) * x + math.cos(turn) * y
    return np.column_stack((east, north, points_m[:, 2] + conversion.h * map_unit_m))


def ground_of(source: IfcSource, placement: Placement) -> tuple[Ground | None, list[str]]:
    """Return where a scenario lies in its file's ground and map, and a note; None where the file has neither.

    `ground.file` may then be the IFC file itself, or another terrain in the same map.
    """
    along = np.array((math.cos(placement.angle_rad), math.sin(placement.angle_rad), 0.0))
    points = np.array([placement.origin_m, placement.origin_m + _STEP_M * along])
    mapped = on_map(source, points)
    has_ground = any(is_ground(product) for product in source.model.by_type("IfcProduct") if product.Representation)
    if mapped is None and not has_ground:
        return None, []
    origin, ahead = points if mapped is None else mapped
    east, north = (ahead - origin)[:2]
    ground = Ground(
        origin=tuple(round(float(value), 4) for value in origin),
        bearing_deg=round(math.degrees(math.atan2(east, north)) % 360.0, 6),
    )
    if not has_ground:
        return ground, []
    by = "of the file" if mapped is None else "of its map"
    note = f'the file has ground: ground.file = "{source.path.name}" puts it under the bridge, in the coordinates {by}'
    return ground, [note]


def is_ground(product: Any) -> bool:
    """Return whether a product is ground: a site where it has a shape of its own."""
    return any(product.is_a(kind) for kind in _kinds(product))


def _kinds(product: Any) -> Iterator[str]:
    for kind in _GROUND:
        try:
            product.is_a(kind)
        except RuntimeError:  # a class that the schema does not have
            continue
        yield kind


def site_of(source: IfcSource, placement: Placement) -> tuple[Site | None, str]:
    """Return the site of a bridge if the file gives it, and a text on its source, or why there is none."""
    by_map, why = _by_map(source, placement)
    if by_map:
        return by_map, why
    by_site = _by_site(source, placement)
    if by_site:
        return by_site, f"{why}; by latitude and longitude of its site, which many programs fill in by themselves"
    return None, f"{why}, and no latitude and longitude of its site"


def _by_map(source: IfcSource, placement: Placement) -> tuple[Site | None, str]:
    location = library("util.geolocation")
    conversion = location.get_helmert_transformation_parameters(source.model)
    if conversion is None:
        return None, "the file has no map conversion"
    name = _reference_system(source.model)
    grid = grid_of_epsg(name)
    if grid is None:
        return None, f"its map conversion is to {name or 'no reference system'}, of which only UTM zones are known"
    map_unit_m = _map_unit(source)
    turn = math.atan2(conversion.xao, conversion.xaa)
    # The scale goes from the file's unit to the map's: 0.001 from mm to m. Its difference from 1 is the grid's.
    factor = conversion.scale * map_unit_m / source.unit_m
    along = np.array((math.cos(placement.angle_rad), math.sin(placement.angle_rad)))
    points = []
    for distance_m in (0.0, _STEP_M):
        x, y = (placement.origin_m[:2] + distance_m * along) * factor
        easting_m = conversion.e * map_unit_m + math.cos(turn) * x - math.sin(turn) * y
        northing_m = conversion.n * map_unit_m + math.sin(turn) * x + math.cos(turn) * y
        if not (abs(easting_m - 500_000.0) <= _HALF_ZONE_M and 0.0 <= northing_m <= _POLE_M):
            return None, f"its map conversion leads out of {name}, to {easting_m:.0f} m, {northing_m:.0f} m"
        points.append(grid.place_on_earth(easting_m, northing_m))
    (latitude, longitude), (next_latitude, next_longitude) = points
    east, north, _ = geodetic2enu(next_latitude, next_longitude, 0.0, latitude, longitude, 0.0)
    return _site(latitude, longitude, math.degrees(math.atan2(east, north))), f"by its map conversion to {name}"


def _reference_system(model: Any) -> str:
    if model.schema != "IFC2X3":
        systems = model.by_type("IfcCoordinateReferenceSystem")
        return (systems[0].Name or "") if systems else ""
    psets = library("util.element").get_psets(model.by_type("IfcProject")[0])
    return str(psets.get("ePSet_ProjectedCRS", {}).get("Name") or "")


def _map_unit(source: IfcSource) -> float:
    """Return the metres in the map's unit; the file's unit where the map gives none."""
    if source.model.schema != "IFC2X3":
        for system in source.model.by_type("IfcProjectedCRS"):
            if system.MapUnit:
                return float(library("util.unit").get_unit_scale(system.MapUnit))
    return source.unit_m


def _by_site(source: IfcSource, placement: Placement) -> Site | None:
    """Return the site by `IfcSite`, with latitude and longitude at the origin of its own placement."""
    for site in source.model.by_type("IfcSite"):
        if not site.RefLatitude or not site.RefLongitude:
            continue
        latitude, longitude = _degrees(site.RefLatitude), _degrees(site.RefLongitude)
        if not (abs(latitude) <= 89.0 and abs(longitude) <= 180.0 and (latitude or longitude)):
            continue
        north_rad = math.radians(library("util.geolocation").get_true_north(source.model))
        of_site = np.zeros(3)
        if site.ObjectPlacement and site.ObjectPlacement.is_a("IfcLocalPlacement"):
            matrix = library("util.placement").get_local_placement(site.ObjectPlacement)
            of_site = np.array(matrix)[:3, 3] * source.unit_m
        x, y = (placement.origin_m - of_site)[:2]
        # True north is turned anticlockwise by north_rad from the file's y axis.
        east = math.cos(north_rad) * x + math.sin(north_rad) * y
        north = -math.sin(north_rad) * x + math.cos(north_rad) * y
        latitude, longitude, _ = enu2geodetic(east, north, 0.0, latitude, longitude, 0.0)
        bearing = 90.0 - math.degrees(placement.angle_rad - north_rad)
        return _site(float(latitude), float(longitude), bearing)
    return None


def _degrees(parts: tuple[int, ...]) -> float:
    """Return an angle of degrees, minutes, seconds and millionths of a second, each with its sign."""
    degrees, minutes, seconds, millionths = (*parts, 0)[:4]
    return degrees + minutes / 60.0 + (seconds + millionths * 1e-6) / 3600.0


def _site(latitude: float, longitude: float, bearing: float) -> Site:
    return Site(
        latitude_deg=round(latitude, 8), longitude_deg=round(longitude, 8), bearing_deg=round(bearing % 360.0, 6)
    )
