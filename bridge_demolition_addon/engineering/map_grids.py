"""Grids of maps: positions on earth of transverse Mercator coordinates, such as UTM."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class TransverseMercator:
    """A transverse Mercator projection of an ellipsoid, GRS 1980 unless given; WGS 84 differs from it by 0.1 mm."""

    central_meridian_deg: float
    latitude_of_origin_deg: float = 0.0
    scale: float = 0.9996  # on the central meridian
    false_easting_m: float = 500_000.0  # coordinates of the axes' crossing
    false_northing_m: float = 0.0
    semi_major_axis_m: float = 6_378_137.0
    inverse_flattening: float = 298.257222101

    def place_on_earth(self, easting_m: float, northing_m: float) -> tuple[float, float]:
        """Return latitude and longitude in degrees.

        L. Krüger's series in the third flattening, to its fourth power: C. Karney (2011), Transverse Mercator with an
        accuracy of a few nanometers, Journal of Geodesy 85, 475-485, equations 12, 35 and 36; from the conformal to the
        geographic latitude equations 7 to 9, by fixed-point iteration.
        """
        northing = (northing_m - self.false_northing_m) / self.scale + self._rectifying_m(self.latitude_of_origin_deg)
        xi = whole_xi = northing / self._rectifying_radius_m
        eta = whole_eta = (easting_m - self.false_easting_m) / self.scale / self._rectifying_radius_m
        for multiple, beta in zip(_MULTIPLES, self._betas, strict=True):
            xi -= beta * math.sin(multiple * whole_xi) * math.cosh(multiple * whole_eta)
            eta -= beta * math.cos(multiple * whole_xi) * math.sinh(multiple * whole_eta)
        conformal = math.asin(math.sin(xi) / math.cosh(eta))
        longitude = math.atan2(math.sinh(eta), math.cos(xi))
        return math.degrees(self._geographic(conformal)), self.central_meridian_deg + math.degrees(longitude)

    @property
    def _third_flattening(self) -> float:
        flattening = 1.0 / self.inverse_flattening
        return flattening / (2.0 - flattening)

    @property
    def _eccentricity(self) -> float:
        flattening = 1.0 / self.inverse_flattening
        return math.sqrt(flattening * (2.0 - flattening))

    @property
    def _rectifying_radius_m(self) -> float:
        n = self._third_flattening
        return self.semi_major_axis_m / (1.0 + n) * (1.0 + n**2 / 4.0 + n**4 / 64.0)

    @property
    def _betas(self) -> tuple[float, float, float, float]:
        n = self._third_flattening
        return (
            n / 2.0 - 2.0 / 3.0 * n**2 + 37.0 / 96.0 * n**3 - 1.0 / 360.0 * n**4,
            n**2 / 48.0 + n**3 / 15.0 - 437.0 / 1440.0 * n**4,
            17.0 / 480.0 * n**3 - 37.0 / 840.0 * n**4,
            4397.0 / 161280.0 * n**4,
        )

    def _rectifying_m(self, latitude_deg: float) -> float:
        """Return the distance from the equator along the meridian, m, by the same series forwards."""
        n = self._third_flattening
        xi = math.atan(self._conformal_tangent(math.tan(math.radians(latitude_deg))))
        alphas = (
            n / 2.0 - 2.0 / 3.0 * n**2 + 5.0 / 16.0 * n**3 + 41.0 / 180.0 * n**4,
            13.0 / 48.0 * n**2 - 3.0 / 5.0 * n**3 + 557.0 / 1440.0 * n**4,
            61.0 / 240.0 * n**3 - 103.0 / 140.0 * n**4,
            49561.0 / 161280.0 * n**4,
        )
        terms = (alpha * math.sin(multiple * xi) for multiple, alpha in zip(_MULTIPLES, alphas, strict=True))
        return self._rectifying_radius_m * (xi + sum(terms))

    def _conformal_tangent(self, tangent: float) -> float:
        e = self._eccentricity
        sigma = math.sinh(e * math.atanh(e * tangent / math.hypot(1.0, tangent)))
        return tangent * math.hypot(1.0, sigma) - sigma * math.hypot(1.0, tangent)

    def _geographic(self, conformal_rad: float) -> float:
        """Return the latitude of a conformal latitude; each pass leaves a 150th of the error of the one before."""
        e, latitude = self._eccentricity, conformal_rad
        isometric = math.asinh(math.tan(conformal_rad))
        for _ in range(_PASSES):
            latitude = math.atan(math.sinh(isometric + e * math.atanh(e * math.sin(latitude))))
        return latitude


_MULTIPLES = (2, 4, 6, 8)
_PASSES = 8

_UTM_NORTH = {"326": (1, 60), "258": (28, 38), "269": (1, 23)}
_UTM_SOUTH = {"327": (1, 60), "283": (46, 59), "78": (46, 59)}
"""Beginnings of the EPSG codes of UTM zones, with the first and the last zone: WGS 84, ETRS89 and NAD83 in the north;
WGS 84, GDA94 and GDA2020 (MGA) in the south. The number of the zone follows. All lie within 2 m of WGS 84."""


def grid_of_epsg(name: str) -> TransverseMercator | None:
    """Return the UTM zone of a reference system's name, such as ``EPSG:25832``; None for all that is no UTM zone."""
    match = re.fullmatch(r"(?:urn:ogc:def:crs:)?EPSG:{1,2}(\d+)", name.strip(), flags=re.IGNORECASE)
    if not match:
        return None
    code = match.group(1)
    for zones, false_northing_m in ((_UTM_NORTH, 0.0), (_UTM_SOUTH, 10_000_000.0)):
        for beginning, (first, last) in zones.items():
            zone = code.removeprefix(beginning)
            if code.startswith(beginning) and len(zone) == 2 and first <= int(zone) <= last:
                return TransverseMercator(6.0 * int(zone) - 183.0, false_northing_m=false_northing_m)
    return None
