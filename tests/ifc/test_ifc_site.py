# SPDX-License-Identifier: GPL-3.0-or-later
"""Where on earth a bridge lies."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.ifc_bridges import IfcBridge
from support.long_cases import long_but

from bridge_demolition_addon.ifc.bridge import read_bridge
from bridge_demolition_addon.ifc.settings import ImportSettings
from bridge_demolition_addon.model.terrain.placed import terrain_of

CN_TOWER_DEG = (43 + 38 / 60 + 33.24 / 3600, -(79 + 23 / 60 + 13.7 / 3600))
"""Published, with 17T 630084 m E, 4833438 m N, each to its last digit: 1e-5° are a metre."""


def site_of(made, tmp_path):
    bridge = read_bridge(made.written(tmp_path / "bridge.ifc"), ImportSettings())
    return bridge.scenario.site, bridge.site_source


def plain(**options):
    return IfcBridge(**options).substructure().superstructure()


@pytest.mark.parametrize("unit", ["METRE", "MILLI"])
def test_by_map_conversion_to_utm(unit, tmp_path):
    """The bridge begins there, 1 km along x from what is converted; grid north is 1.61° × sin 43.6° east of north."""
    turn = math.radians(30.0)
    origin = 630_084.0 - 1000.0 * math.cos(turn), 4_833_438.0 - 1000.0 * math.sin(turn)
    made = plain(unit=unit, offset_m=(1000.5, 0.0, 0.0)).map_conversion("EPSG:32617", *origin, 30.0)
    site, source = site_of(made, tmp_path)
    assert (site.latitude_deg, site.longitude_deg) == pytest.approx(CN_TOWER_DEG, abs=2e-5)
    convergence = (CN_TOWER_DEG[1] + 81.0) * math.sin(math.radians(CN_TOWER_DEG[0]))
    assert site.bearing_deg == pytest.approx(90.0 - 30.0 + convergence, abs=1e-3)
    assert source == "by its map conversion to EPSG:32617"


def test_a_bridge_that_is_turned_and_moved_in_its_file(tmp_path):
    """Its begin is 100 m along its own direction, 50° from the file's x axis: so much further on the grid, × 0.9998."""
    turn = math.radians(50.0)
    begin = (100.5 * math.cos(turn), 100.5 * math.sin(turn), 0.0)
    near, _ = site_of(plain(offset_m=(0.5, 0.0, 0.0)).map_conversion("EPSG:32617", 630_000.0, 4_833_000.0), tmp_path)
    made = plain(offset_m=begin, turn_deg=50.0).map_conversion("EPSG:32617", 630_000.0, 4_833_000.0)
    far, _ = site_of(made, tmp_path)
    assert far.bearing_deg == pytest.approx(near.bearing_deg - 50.0, abs=2e-3)
    metres_north = (far.latitude_deg - near.latitude_deg) * 111_110.0
    metres_east = (far.longitude_deg - near.longitude_deg) * 111_413.0 * math.cos(math.radians(near.latitude_deg))
    assert math.hypot(metres_north, metres_east) == pytest.approx(100.0, rel=3e-3)  # of a sphere
    assert math.degrees(math.atan2(metres_east, metres_north)) == pytest.approx(far.bearing_deg, abs=0.3)


def test_by_the_sites_own_place_with_true_north(tmp_path):
    """North is 20° anticlockwise from the file's y axis, so the road along x leads 110° from north."""
    made = plain(offset_m=(0.5, 0.0, 0.0))
    made.site.RefLatitude, made.site.RefLongitude = (48, 51, 30, 0), (-2, -17, -40, -200_000)
    turn = math.radians(20.0)
    made.context.TrueNorth = made.file.create_entity("IfcDirection", (-math.sin(turn), math.cos(turn)))
    site, source = site_of(made, tmp_path)
    assert site.latitude_deg == pytest.approx(48.0 + 51.0 / 60.0 + 30.0 / 3600.0, abs=1e-8)
    assert site.longitude_deg == pytest.approx(-(2.0 + 17.0 / 60.0 + 40.2 / 3600.0), abs=1e-8)
    assert site.bearing_deg == pytest.approx(110.0, abs=1e-6)
    assert "no map conversion; by latitude and longitude of its site" in source


@pytest.mark.parametrize(
    "name, easting, why",
    [
        ("EPSG:28992", 155_000.0, "to EPSG:28992, of which only UTM zones are known"),
        ("EPSG:32617", 5e9, "leads out of EPSG:32617"),
    ],
)
def test_a_map_that_is_not_known_gives_no_site(name, easting, why, tmp_path):
    site, source = site_of(plain().map_conversion(name, easting, 463_000.0), tmp_path)
    assert site is None
    assert why in source


@pytest.mark.parametrize("unit", long_but(["MILLI"], ["METRE", "MILLI"]))
@pytest.mark.parametrize("has_map", [True, False])
def test_ground_in_the_file_of_a_bridge_lies_under_it(has_map, unit, tmp_path):
    """A plane that rises by 1 in 100 along the road and 1 in 50 across it, from 1 m below the bridge's beginning."""
    made = IfcBridge(unit=unit, offset_m=(300.0, 200.0, 40.0), turn_deg=30.0).substructure().superstructure()
    corners = [(x, y, -1.0 + 0.01 * x + 0.02 * y) for x, y in ((-50, -40), (80, -40), (80, 40), (-50, 40))]
    points = [[value / made.metre for value in corner] for corner in corners]
    make = made.file.create_entity
    mesh = make("IfcTriangulatedFaceSet", make("IfcCartesianPointList3D", points))
    mesh.CoordIndex = [(1, 2, 3), (1, 3, 4)]
    made.element("IfcGeographicElement", "Terrain", mesh, "DECK", shape_type="Tessellation")
    if has_map:
        made.map_conversion("EPSG:32617", 630_084.0, 4_833_438.0, 25.0)
    path = made.written(tmp_path / "bridge.ifc")
    bridge = read_bridge(path, ImportSettings())
    assert any('ground.file = "bridge.ifc"' in note for note in bridge.notes)
    scenario = replace(bridge.scenario, ground=replace(bridge.scenario.ground, file=str(path)))
    positions = np.array([[0.5, 0.0], [10.5, 1.5], [20.5, -3.0]])
    along, across = positions[:, 0] - 0.5, positions[:, 1]  # the bridge begins 0.5 m before its first footing's middle
    heights = terrain_of(scenario).heights_at(positions)
    assert heights == pytest.approx(-1.0 + 0.01 * along + 0.02 * across, abs=2e-3)
