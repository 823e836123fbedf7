# SPDX-License-Identifier: GPL-3.0-or-later
"""Site plans: read back, and placed on earth as tables of the ellipsoid say."""

import json

import numpy as np
import pytest
from manifold3d import CrossSection

from bridge_demolition_addon.model.scenario import Site
from bridge_demolition_addon.report.site_plan import degrees, write_dxf, write_geojson

SQUARE = CrossSection.square((10.0, 4.0))
RING = CrossSection.square((10.0, 10.0)) - CrossSection.square((2.0, 2.0)).translate((4.0, 4.0))


def polylines(path):
    """Layer, closedness and corners of every polyline in a DXF file."""
    lines = path.read_bytes().decode("ascii").split("\r\n")
    pairs = [(lines[row].strip(), lines[row + 1]) for row in range(0, len(lines) - 1, 2)]
    found = []
    for code, value in pairs:
        if (code, value) == ("0", "POLYLINE"):
            found.append({"layer": None, "closed": None, "corners": [], "in vertex": False})
        elif code == "0" and found:
            found[-1]["in vertex"] = value == "VERTEX"
            if value == "VERTEX":
                found[-1]["corners"].append([0.0, 0.0])
        elif code == "8" and found and found[-1]["layer"] is None:
            found[-1]["layer"] = value
        elif code == "70" and found:
            found[-1]["closed"] = value == "1"
        elif code in ("10", "20") and found and found[-1]["in vertex"]:
            found[-1]["corners"][-1][int(code) // 10 - 1] = float(value)
    assert pairs[-1] == ("0", "EOF")
    return found


def test_dxf_has_closed_lines_in_metres(tmp_path):
    write_dxf(tmp_path / "plan.dxf", {"exclusion zone": SQUARE, "bridge": RING})
    square, *ring = polylines(tmp_path / "plan.dxf")
    assert (square["layer"], square["closed"]) == ("EXCLUSION_ZONE", True)
    assert sorted(square["corners"]) == [[0, 0], [0, 4], [10, 0], [10, 4]]
    assert [line["layer"] for line in ring] == ["BRIDGE", "BRIDGE"]  # outline and hole
    assert all(len(line["corners"]) == 4 and line["closed"] for line in ring)


def test_layers_have_names_that_release_12_allows(tmp_path):
    names = ["zone Straße <1> $2$", "zone Straße (1) 2", "probability above 5 %", "水", "a" * 40]
    write_dxf(tmp_path / "plan.dxf", dict.fromkeys(names, SQUARE))
    layers = [polyline["layer"] for polyline in polylines(tmp_path / "plan.dxf")]
    assert layers == ["ZONE_STRASSE_1_2", "ZONE_STRASSE_1_2_2", "PROBABILITY_ABOVE_5", "_4", "A" * 31]


@pytest.mark.parametrize(
    "latitude, north_m, east_m",
    # Lengths of a degree of latitude and of longitude on WGS 84 (NGA, length of a degree).
    [(0.0, 110_574, 111_320), (30.0, 110_852, 96_486), (60.0, 111_412, 55_800)],
)
def test_a_degree_is_as_long_as_tables_say(latitude, north_m, east_m):
    site = Site(latitude_deg=latitude, longitude_deg=10.0, bearing_deg=90.0)
    (east, north) = degrees(np.array([[100.0, 0.0], [0.0, 100.0]]), site)
    # 100 m to the east it is 1.4 mm nearer to the pole at 60°.
    assert east == pytest.approx((10.0 + 100.0 / east_m, latitude), abs=1.5e-8)
    assert north == pytest.approx((10.0, latitude + 100.0 / north_m), abs=1e-8)


@pytest.mark.parametrize(
    "bearing, x_goes, y_goes", [(0, "north", "west"), (90, "east", "north"), (180, "south", "east")]
)
def test_bearings_run_clockwise_from_north(bearing, x_goes, y_goes):
    site = Site(latitude_deg=0.0, longitude_deg=0.0, bearing_deg=bearing)
    directions = {"north": (0, 1), "south": (0, -1), "east": (1, 0), "west": (-1, 0)}
    for point, name in (((100.0, 0.0), x_goes), ((0.0, 100.0), y_goes)):
        (position,) = degrees(np.array([point]), site)
        np.testing.assert_allclose(position / np.abs(position).max(), directions[name], atol=1e-9)


def spherical_offset(latitude, east_m, north_m):
    """Longitude and latitude of a point on the tangent plane of a sphere, in degrees from those of the origin."""
    radius = 6_371_000.0
    phi = np.radians(latitude)
    x, z = np.array([np.cos(phi), np.sin(phi)]) * radius + np.array([-np.sin(phi), np.cos(phi)]) * north_m
    return np.degrees(np.arctan2(east_m, x)), np.degrees(np.arctan2(z, np.hypot(x, east_m))) - latitude


@pytest.mark.parametrize("latitude", [0.0, 60.0, 85.0, 89.0, -89.0])
def test_meridians_meet_towards_the_poles(latitude):
    east, north = 800.0, 600.0
    (position,) = degrees(np.array([[east, north]]), Site(latitude_deg=latitude, longitude_deg=0.0))
    # A sphere is not the ellipsoid: lengths of its degrees differ by up to 1 %, what is bent does not.
    assert position - (0.0, latitude) == pytest.approx(spherical_offset(latitude, east, north), rel=0.01)
    straight, _ = degrees(np.array([[1000.0, 0.0], [0.0, 0.0]]), Site(latitude_deg=latitude, longitude_deg=0.0))
    # To the side of a meridian the way east bends towards the pole: by d² tan(latitude) / 2 r.
    bend_m = (abs(latitude) - abs(straight[1])) * 111_694.0
    assert bend_m == pytest.approx(
        1000.0**2 * np.tan(np.radians(abs(latitude))) / (2 * 6_390_000.0), abs=0.02, rel=0.01
    )


@pytest.mark.parametrize("longitude", [179.9999, 180.0, -180.0, -179.9999])
@pytest.mark.parametrize("bearing", [90.0, 30.0])
@pytest.mark.parametrize("latitude", [-16.8, 66.0])
def test_an_area_across_the_date_line_stays_in_one_piece(tmp_path, longitude, bearing, latitude):
    area = CrossSection.square((200.0, 100.0), True)
    site = Site(latitude_deg=latitude, longitude_deg=longitude, bearing_deg=bearing)
    write_geojson(tmp_path / "plan.geojson", {"zone": area}, site)
    (feature,) = json.loads((tmp_path / "plan.geojson").read_text(encoding="utf-8"))["features"]
    ((ring,),) = feature["geometry"]["coordinates"]
    assert np.ptp(np.array(ring)[:, 0]) < 0.01
    x, y = (np.array(ring) * np.array([111_320.0 * np.cos(np.radians(latitude)), 111_320.0])).T
    covered = np.sum(x[:-1] * (y[1:] - y[0]) - x[1:] * (y[:-1] - y[0])) / 2.0
    assert covered == pytest.approx(200.0 * 100.0, rel=0.01)  # anticlockwise


def test_geojson_has_closed_rings_and_holes(tmp_path):
    two = RING + CrossSection.square((1.0, 1.0)).translate((50.0, 0.0))
    write_geojson(tmp_path / "plan.geojson", {"zone": two}, Site(latitude_deg=41.6, longitude_deg=-93.6))
    content = json.loads((tmp_path / "plan.geojson").read_text(encoding="utf-8"))
    (feature,) = content["features"]
    assert (content["type"], feature["geometry"]["type"]) == ("FeatureCollection", "MultiPolygon")
    assert feature["properties"] == {"name": "zone", "area_m2": 97.0}
    rings = sorted(len(part) for part in feature["geometry"]["coordinates"])
    assert rings == [1, 2]
    for part in feature["geometry"]["coordinates"]:
        for number, ring in enumerate(part):
            assert ring[0] == ring[-1]
            x, y = np.array(ring).T
            area = np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])
            assert (area > 0) == (number == 0)  # RFC 7946: outer rings anticlockwise, holes clockwise
        assert np.abs(np.array(part[0]) - (-93.6, 41.6)).max() < 0.001


def test_contour_lines_are_in_a_layer_of_their_own_at_their_heights(tmp_path):
    line = np.array([[[1.0, -2.0, 5.0], [3.5, 4.0, 5.0]]])
    write_dxf(tmp_path / "plan.dxf", {"bridge": SQUARE}, line)
    text = (tmp_path / "plan.dxf").read_text(encoding="ascii").split()
    start = text.index("LINE")
    assert text[start - 1 : start + 3] == ["0", "LINE", "8", "CONTOURS"]
    pairs = dict(zip(text[start + 3 : start + 15 : 2], map(float, text[start + 4 : start + 15 : 2]), strict=True))
    assert pairs == {"10": 1.0, "20": -2.0, "30": 5.0, "11": 3.5, "21": 4.0, "31": 5.0}
