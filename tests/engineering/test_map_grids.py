# SPDX-License-Identifier: GPL-3.0-or-later
"""Places of map grids against published ones."""

import pytest

from bridge_demolition_addon.engineering.map_grids import TransverseMercator, grid_of_epsg


def test_the_worked_example_of_epsg():
    """EPSG Guidance Note 7-2, transverse Mercator: the British grid on the ellipsoid of Airy 1830.

    The note gives metres to two decimals: 5 mm are 4.5e-8 degrees of latitude and 7.1e-8 of longitude there.
    """
    grid = TransverseMercator(-2.0, 49.0, 0.9996012717, 400_000.0, -100_000.0, 6_377_563.396, 299.32496)
    latitude, longitude = grid.place_on_earth(577_274.99, 69_740.50)
    assert latitude == pytest.approx(50.5, abs=1e-7)
    assert longitude == pytest.approx(0.5, abs=1.2e-7)


def test_the_cn_tower_in_utm():
    """43° 38' 33.24" north, 79° 23' 13.7" west is 17T 630084 m E, 4833438 m N, each to its last digit."""
    latitude, longitude = grid_of_epsg("EPSG:32617").place_on_earth(630_084.0, 4_833_438.0)
    assert latitude == pytest.approx(43 + 38 / 60 + 33.24 / 3600, abs=1e-5)
    assert longitude == pytest.approx(-(79 + 23 / 60 + 13.7 / 3600), abs=2e-5)


def test_the_south_mirrors_the_north():
    north = grid_of_epsg("EPSG:32617").place_on_earth(630_084.0, 4_833_438.0)
    south = grid_of_epsg("EPSG:32717").place_on_earth(630_084.0, 10_000_000.0 - 4_833_438.0)
    assert south == pytest.approx((-north[0], north[1]), abs=1e-12)


def test_the_middle_of_a_zone_keeps_its_longitude():
    assert grid_of_epsg("epsg:25832").place_on_earth(500_000.0, 0.0) == pytest.approx((0.0, 9.0), abs=1e-12)


@pytest.mark.parametrize("name, middle", [("EPSG:7856", 153.0), ("EPSG:28356", 153.0), ("EPSG:26910", -123.0)])
def test_zones_of_other_datums(name, middle):
    assert grid_of_epsg(name).central_meridian_deg == middle


@pytest.mark.parametrize("name", ["EPSG:28992", "EPSG:7801", "EPSG:32661", "EPSG:32600", "WGS 84", ""])
def test_what_is_no_utm_zone_is_not_known(name):
    assert grid_of_epsg(name) is None
