# SPDX-License-Identifier: GPL-3.0-or-later
"""Terrain in every format that is read: one plane, whose heights are known everywhere."""

from dataclasses import replace

import numpy as np
import pytest
from support.scenarios import I235
from support.terrain_files import (
    EASTING,
    HEIGHT,
    NORTHING,
    plane,
    write_asc,
    write_landxml,
    write_obj,
    write_tif,
    write_xyz,
)

from bridge_demolition_addon.errors import GeometryError, ScenarioError
from bridge_demolition_addon.model.scenario import Ground, Site
from bridge_demolition_addon.model.terrain.placed import terrain_of

pytestmark = pytest.mark.slow

ORIGIN = (EASTING + 50.0, NORTHING + 50.0, HEIGHT + 12.5)
"""The middle of the files, at whose height the plane is: 0.2 × 50 + 0.05 × 50 = 12.5."""

FORMATS = {
    "grid": ("a.asc", write_asc),
    "grid by corners": (
        "a.asc",
        lambda path: write_asc(
            path,
            header={
                "xllcenter": None,
                "yllcenter": None,
                "xllcorner": EASTING - 1.25,
                "yllcorner": NORTHING - 1.25,
            },
        ),
    ),
    "points on a grid": ("a.xyz", write_xyz),
    "points with a header": ("a.csv", lambda path: write_xyz(path, separator=";", header="# of a drone\nE;N;H\n")),
    "scattered points": ("a.txt", lambda path: write_xyz(path, scattered=True)),
    "LandXML": ("a.xml", write_landxml),
    "TIFF of fractions": ("a.tif", lambda path: write_tif(path, kind="float64")),
    "TIFF of whole numbers": ("a.tiff", lambda path: write_tif(path, lambda x, y: np.rint(plane(x, y)), kind="uint32")),
}


def scenario_on(path, **settings):
    return replace(I235, ground=Ground(**{"file": str(path), "origin": ORIGIN} | settings))


def heights_of(scenario, *places):
    return terrain_of(scenario).heights_at(np.array(places, float))


@pytest.mark.parametrize("name", FORMATS)
def test_every_format_gives_the_heights_of_the_plane(tmp_path, name):
    file, write = FORMATS[name]
    positions = np.random.default_rng(3).uniform(-45.0, 45.0, (200, 2))
    found = heights_of(scenario_on(write(tmp_path / file)), *positions)
    # Bilinear and linear interpolation are exact on a plane; whole numbers are rounded by up to 0.5.
    tolerance = 0.5 if "whole" in name else 1e-6
    np.testing.assert_allclose(found, 0.2 * positions[:, 0] + 0.05 * positions[:, 1], atol=tolerance)


def test_a_mesh_gives_the_heights_of_its_triangles(tmp_path):
    path = write_obj(tmp_path / "a.obj")
    assert heights_of(scenario_on(path, origin=(50.0, 50.0, 12.5)), (3.0, -7.0)) == pytest.approx([0.25])


@pytest.mark.parametrize(
    "bearing, east, north",
    [(90.0, (1, 0), (0, 1)), (0.0, (0, -1), (1, 0)), (180.0, (0, 1), (-1, 0)), (45.0, (0.5**0.5, -(0.5**0.5)), None)],
)
def test_the_x_axis_points_where_the_bearing_says(tmp_path, bearing, east, north):
    """A road that runs north goes up by 1 in 20, and to its left, in the west, the ground falls by 1 in 5."""
    path = write_asc(tmp_path / "a.asc")
    slope = heights_of(scenario_on(path, bearing_deg=bearing), (10, 0), (0, 10)) / 10
    north = (0.5**0.5, 0.5**0.5) if north is None else north
    expected = [0.2 * east[axis] + 0.05 * north[axis] for axis in (0, 1)]
    np.testing.assert_allclose(slope, expected, atol=1e-9)


def test_the_bearing_is_that_of_the_site_unless_another_is_given(tmp_path):
    scenario = scenario_on(write_asc(tmp_path / "a.asc"))
    there = replace(scenario, site=Site(latitude_deg=41.6, longitude_deg=-93.6, bearing_deg=0.0))
    assert heights_of(there, (10, 0)) == pytest.approx([0.5])
    assert heights_of(replace(there, ground=replace(there.ground, bearing_deg=90.0)), (10, 0)) == pytest.approx([2.0])


def test_feet_become_metres(tmp_path):
    """The same numbers as feet: the slopes stay, and all is 0.3048 times as far from the origin."""
    scenario = scenario_on(write_asc(tmp_path / "a.asc"), scale=0.3048)
    assert heights_of(scenario, (3.048, 0)) == pytest.approx([0.6096])
    assert np.isnan(heights_of(scenario, (16.0, 0)))  # the file ends 50 feet from the origin


def hole(x, y):
    return np.where((abs(x - ORIGIN[0]) < 3) & (abs(y - ORIGIN[1]) < 3), np.nan, plane(x, y))


@pytest.mark.parametrize(
    "file, write, settings",
    [
        ("a.asc", lambda path: write_asc(path, hole), {}),
        ("a.asc", lambda path: write_asc(path, hole, no_data=0, header={"NODATA_value": None}), {"no_data": 0.0}),
        ("a.tif", lambda path: write_tif(path, hole, no_data=-3.4028235e38), {}),
        ("a.tif", lambda path: write_tif(path, hole, kind="float64"), {}),
        ("a.tif", lambda path: write_tif(path, hole, kind="uint32", no_data=4294967295), {}),
        ("a.xyz", lambda path: write_xyz(path, hole), {}),
    ],
)
def test_no_data_is_no_height(tmp_path, file, write, settings):
    found = heights_of(scenario_on(write(tmp_path / file), **settings), (0, 0), (1, 1), (40, 40))
    assert np.isnan(found).tolist() == [True, True, False]


def test_a_pixel_that_is_a_point_is_not_moved(tmp_path):
    """Pixels as areas have their heights in their middles, half a pixel, 1.25 m, from the corner that is named."""
    path = write_tif(tmp_path / "a.tif", kind="float64", keys={1025: 2})
    # Half a pixel to the west and north of where it was: 0.2 × 1.25 higher, 0.05 × 1.25 higher.
    assert heights_of(scenario_on(path), (0, 0)) == pytest.approx([0.2 * 1.25 - 0.05 * 1.25])


def written(text):
    def write(path):
        path.write_text(text, encoding="utf-8")
        return path

    return write


def three_channels(path):
    import tifffile

    tifffile.imwrite(path, np.zeros((4, 4, 3), np.uint8), photometric="rgb")
    return path


BROKEN = {
    "no such file": ("a.asc", lambda path: path, "no such file"),
    "another kind": ("a.dem", written("x"), "expected a file that ends in one of"),
    "no cell size": ("a.asc", lambda path: write_asc(path, header={"cellsize": None}), "has no cellsize"),
    "no place": ("a.asc", lambda path: write_asc(path, header={"xllcenter": None}), "has no xllcorner"),
    "too few": ("a.asc", lambda path: write_asc(path, header={"nrows": 40}), r"holds 1681 heights: expected 40 rows"),
    "negative cells": ("a.asc", lambda path: write_asc(path, header={"cellsize": -2.5}), "expected more than 0"),
    "words": (
        "a.asc",
        written("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 x\n"),
        "a height is 'x', which is no number",
    ),
    "not declared": (
        "a.asc",
        lambda path: write_asc(path, hole, no_data=-32768, header={"NODATA_value": -1}),
        "no_data",
    ),
    "only two columns": ("a.xyz", written("1 2\n3 4\n5 6\n"), "expected lines of x, y and z"),
    "ragged": ("a.xyz", written("1 2 3\n3 4\n5 6 7\n"), "expected 3 numbers in each line"),
    "words for numbers": (
        "a.xyz",
        written("1 2 3\n3 4 x5\n5 6 7\n"),
        "lines of x, y and z, found 'x5', which is no number",
    ),
    "words in columns": (
        "a.csv",
        written("x,y,z,code\n1,2,3,a\n3,4,b,a\n5,6,7,a\n"),
        "z, found 'b', which is no number",
    ),
    "short lines": ("a.csv", written("x,y,z\n1,2,3\n3,4\n5,6,7\n"), "expected columns of x, y and z in each line"),
    "a line": ("a.xyz", written("0 0 1\n1 1 1\n2 2 1\n3 3 1\n"), "lie on a line"),
    "no points": ("a.xyz", written("x y z\n"), "expected lines of x, y and z"),
    "no XML": ("a.xml", written("<LandXML>"), "cannot be read as LandXML"),
    "another XML": ("a.xml", written("<svg/>"), "begins with 'svg'"),
    "no surface": ("a.xml", written("<LandXML/>"), "holds no surface"),
    "points alone": (
        "a.xml",
        written("<LandXML><CgPoints><CgPoint>1 2 3</CgPoint><CgPoint>4 5 6</CgPoint></CgPoints></LandXML>"),
        "holds 2 points, but no surface: .* or save the points as .xyz",
    ),
    "points of a surface alone": (
        "a.xml",
        written("<LandXML><Surface><Definition><Pnts><P>1 2 3</P></Pnts></Definition></Surface></LandXML>"),
        "its surface has 1 points, but no triangles",
    ),
    "two surfaces": ("a.xml", lambda path: write_landxml(path, surfaces=2), "'ground 1', 'ground 2': expected one"),
    "no TIFF": ("a.tif", written("no picture"), "cannot be read as TIFF"),
    "a picture": ("a.tif", three_channels, "no height model: expected one value a pixel"),
    "a grey picture": (
        "a.tif",
        lambda path: write_tif(path, values=np.zeros((41, 41)), kind="uint8"),
        "as pictures have",
    ),
    "no place on a map": ("a.tif", lambda path: write_tif(path, tags=()), "does not say where it lies"),
    "degrees": ("a.tif", lambda path: write_tif(path, keys={1024: 2}), "is in degrees"),
    "heights in feet": ("a.tif", lambda path: write_tif(path, keys={4099: 9002}), "another unit than distances"),
    "infinite": ("a.tif", lambda path: write_tif(path, lambda x, y: plane(x, y) * np.nan), "has no data at all"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_what_cannot_be_read_is_said(tmp_path, name):
    file, write, message = BROKEN[name]
    with pytest.raises((GeometryError, ScenarioError), match=message) as raised:
        terrain_of(scenario_on(write(tmp_path / file)))
    assert file in str(raised.value)


def test_huge_files_are_refused_before_they_are_read(tmp_path):
    path = tmp_path / "a.asc"
    with path.open("wb") as file:
        file.truncate(600_000_000)  # a hole on the disk
    with pytest.raises(ScenarioError, match=r"has 600\.0 MB: expected at most 500 MB"):
        terrain_of(scenario_on(path))


def test_a_tiff_of_too_many_heights_is_refused_before_they_are_unpacked(tmp_path, monkeypatch):
    from bridge_demolition_addon.model.terrain import geotiff

    monkeypatch.setattr(geotiff, "MOST_HEIGHTS", 1000)
    with pytest.raises(GeometryError, match="holds 1681 heights: expected at most 1000; cut the site out"):
        terrain_of(scenario_on(write_tif(tmp_path / "a.tif")))


def test_a_file_that_was_changed_is_read_again(tmp_path):
    path = tmp_path / "a.asc"
    first = heights_of(scenario_on(write_asc(path)), (0, 0))
    second = heights_of(scenario_on(write_asc(path, lambda x, y: plane(x, y) + 1.25)), (0, 0))
    assert (first.item(), second.item()) == pytest.approx((0.0, 1.25), abs=1e-9)
