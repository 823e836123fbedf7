# SPDX-License-Identifier: GPL-3.0-or-later
"""Terrain as other programs write it: heights of a plane that are known, in their units, spellings and surfaces."""

import re
from dataclasses import replace

import numpy as np
import pytest
from support.checkout import ROOT
from support.ifc_bridges import IfcBridge
from support.terrain_files import (
    EASTING,
    HEIGHT,
    NORTHING,
    lattice,
    plane,
    triangles,
    write_asc,
    write_landxml,
    write_tif,
)

from bridge_demolition_addon.engineering.terrain.surface import Surface
from bridge_demolition_addon.errors import GeometryError, ScenarioError
from bridge_demolition_addon.model.scenario import Ground
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.terrain.files import read_terrain
from bridge_demolition_addon.model.terrain.placed import terrain_of

pytestmark = pytest.mark.slow

PLACE = [(33550, "d", 3, (1e-4, 1e-4, 0.0)), (33922, "d", 6, (0.0, 0.0, 0.0, 10.0, 53.0, 0.0))]
FOOT_M = 0.304800609601


def read(path, **settings):
    return read_terrain(str(path), Ground(file=str(path), **settings))


def test_one_of_several_surfaces_by_its_name(tmp_path):
    path = write_landxml(tmp_path / "a.xml", surfaces=2)
    read_2 = read(path, surface="GROUND*2")
    assert read_2.source.heights_at(np.array([[EASTING + 10.0, NORTHING]])) == pytest.approx(HEIGHT + 2.0)
    with pytest.raises(GeometryError, match=r"expected one; say which by ground\.surface"):
        read(path)
    with pytest.raises(GeometryError, match=r"holds 0 surfaces that ground\.surface = 'FG' names, of 'ground 1'"):
        read(path, surface="FG")


def test_a_file_in_feet_is_in_feet_as_it_says(tmp_path):
    """A point 100 units east is 30.48 m off, 20 units higher, and both are in US survey feet."""
    path = write_landxml(tmp_path / "a.xml", unit='<Imperial linearUnit="USSurveyFoot"/>')
    ground = Ground(file=str(path), origin=(EASTING, NORTHING, HEIGHT), bearing_deg=90.0)
    scenario = replace(read_scenario(ROOT / "examples" / "report_2019" / "i235_one_span.toml"), ground=ground)
    terrain = terrain_of(scenario)
    assert terrain.heights_at(np.array([[100.0 * FOOT_M, 0.0]])) == pytest.approx(20.0 * FOOT_M)
    assert terrain.notes == ("in USSurveyFoot, as it says: 0.3048006 m",)


def test_triangles_without_their_points_are_left_out_where_they_are_few(tmp_path):
    path = write_landxml(tmp_path / "a.xml")
    path.write_text(path.read_text().replace("</Faces>", "<F>1 2 99999</F></Faces>"))
    found = read(path)
    assert found.notes == ("1 of 3201 triangles name points that are not there: left out",)
    assert found.source.heights_at(np.array([[EASTING + 5.0, NORTHING]])) == pytest.approx(HEIGHT + 1.0)
    path.write_text(path.read_text().replace("</Faces>", "<F>7 8 88888</F>" * 100 + "</Faces>"))
    with pytest.raises(GeometryError, match=r"101 of 3301 triangles .* first number 3201, <F>1 2 99999</F>"):
        read(path)


@pytest.mark.parametrize("wrong", ["", "1 abc 3", "1 2", "1 2 nan", "1 2 3 4"])
def test_a_point_that_is_none_costs_its_triangles_and_not_the_file(wrong, tmp_path):
    """Point 1 is at a corner, of two triangles."""
    path = write_landxml(tmp_path / "a.xml")
    text = path.read_text()
    point = text[text.index('<P id="1">') : text.index("</P>")]
    path.write_text(text.replace(point, f'<P id="1">{wrong}').replace("</Faces>", "<F>1 2</F></Faces>"))
    found = read(path)
    lost = sum("1" in names.split() for names in re.findall("<F>(.*?)</F>", text)) + 1
    assert found.notes == (f"{lost} of 3201 triangles name points that are not there: left out",)
    assert found.source.heights_at(np.array([[EASTING + 5.0, NORTHING]])) == pytest.approx(HEIGHT + 1.0)


@pytest.mark.parametrize("no_data", ["nan", "-9999.0"])
def test_grids_whose_missing_heights_are_written_as_nan(no_data, tmp_path):
    path = tmp_path / "a.asc"
    path.write_text(f"ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value {no_data}\nnan 4 5\n1 2 3\n")
    heights = read(path).source.heights
    assert np.array_equal(heights, [[1.0, 2.0, 3.0], [np.nan, 4.0, 5.0]], equal_nan=True)


def test_decimal_commas_in_grids_and_points(tmp_path):
    path = write_asc(tmp_path / "a.asc")
    path.write_text(path.read_text().replace(".", ","))
    assert read(path).source.heights_at(np.array([[EASTING + 5.0, NORTHING]])) == pytest.approx(HEIGHT + 1.0)
    (tmp_path / "a.xyz").write_text("0,5;0,5;1,25\n1,5;0,5;2,25\n0,5;1,5;3,25\n1,5;1,5;4,25\n")
    assert read(tmp_path / "a.xyz").source.heights.tolist() == [[1.25, 2.25], [3.25, 4.25]]
    (tmp_path / "b.csv").write_text("0,0,1\n1,0,2\n0,1,3\n1,1,4\n")  # commas that part whole numbers stay what they are
    assert read(tmp_path / "b.csv").source.heights.tolist() == [[1.0, 2.0], [3.0, 4.0]]


def test_a_grid_in_degrees_is_called_so(tmp_path):
    """A step of 0.3 seconds of arc at 10° east and 59° north, as national elevation models have it."""
    for step, place, is_refused in ((0.0000833, (10.1, 59.1), True), (0.001, (448200.0, 4607100.0), False)):
        (tmp_path / "a.asc").write_text(
            f"ncols 2\nnrows 2\nxllcorner {place[0]}\nyllcorner {place[1]}\ncellsize {step}\n1 2\n3 4\n"
        )
        if is_refused:
            with pytest.raises(GeometryError, match="that is in degrees; project it"):
                read(tmp_path / "a.asc")
        else:
            assert read(tmp_path / "a.asc").source.heights.tolist() == [[3.0, 4.0], [1.0, 2.0]]


def test_points_with_numbers_and_codes_are_read_by_the_names_of_their_columns(tmp_path):
    """As total stations write them: a number, easting, northing, height and a code; without names it is refused."""
    rows = ["1,10.0,20.0,1.5,GR", "2,11.0,20.0,2.5,KERB 1", "3,10.0,21.0,3.5,", "4,11.0,21.0,4.5,GR"]
    (tmp_path / "a.csv").write_text("\n".join(["id,Easting,Northing,Height,code", *rows]))
    assert read(tmp_path / "a.csv").source.heights.tolist() == [[1.5, 2.5], [3.5, 4.5]]
    (tmp_path / "b.csv").write_text("\n".join(["Nr;Y;X;H", "1;20,0;10,0;1,5", "2;20,0;11,0;2,5", "3;21,0;10,0;3,5"]))
    assert read(tmp_path / "b.csv").source.points[0].tolist() == [10.0, 20.0, 1.5]
    (tmp_path / "c.csv").write_text("\n".join(rows))
    with pytest.raises(GeometryError, match="name the columns x, y and z in a first line"):
        read(tmp_path / "c.csv")
    (tmp_path / "d.xyz").write_text("\n".join(" ".join(row.split(",")[:4]) for row in rows))
    with pytest.raises(GeometryError, match="its first column counts the points"):
        read(tmp_path / "d.xyz")


def test_a_tiff_in_degrees_or_without_a_place_is_called_so(tmp_path):
    with pytest.raises(GeometryError, match="is in degrees"):
        read(write_tif(tmp_path / "a.tif", tags=[*PLACE, (34735, "H", 8, (1, 1, 0, 1, 2048, 0, 1, 4326))]))
    import tifffile

    matrix = np.diag((100.0, 100.0, 0.0, 1.0)).ravel().tolist()
    tifffile.imwrite(tmp_path / "b.tif", np.ones((3, 4), np.float32), extratags=[(34264, 12, 16, matrix, True)])
    with pytest.raises(GeometryError, match="does not say where it lies"):
        read(tmp_path / "b.tif")


def write_las(path, points, classes, scale=0.001):
    import laspy

    header = laspy.LasHeader(point_format=1, version="1.2")
    header.offsets, header.scales = np.floor(points.min(axis=0)), np.full(3, scale)
    cloud = laspy.LasData(header)
    cloud.x, cloud.y, cloud.z = points.T
    cloud.classification = classes
    cloud.write(path)
    return path


@pytest.mark.parametrize("ending", [".las", ".laz"])
@pytest.mark.parametrize("has_classes", [True, False])
def test_of_a_point_cloud_the_ground_counts(ending, has_classes, tmp_path):
    """Points of the plane, and others 3 m above all of them, which are a wood: of class 5, or of none."""
    x, y = (grid.ravel() for grid in lattice())
    ground = np.column_stack((x, y, plane(x, y)))
    points = np.concatenate([ground + np.array((0.0, 0.0, 3.0)), ground])
    classes = np.repeat((5, 2) if has_classes else (0, 0), len(ground))
    found = read(write_las(tmp_path / f"a{ending}", points, classes))
    assert found.source.heights_at(np.array([[EASTING + 7.0, NORTHING + 8.0]])) == pytest.approx(HEIGHT + 1.8, abs=2e-3)
    assert bool(found.notes) == (not has_classes)


def test_a_damaged_cloud_is_said_to_be(tmp_path):
    (tmp_path / "a.las").write_bytes(b"LASF" + bytes(40))
    with pytest.raises(ScenarioError, match=r"a\.las.*cannot be read"):
        read(tmp_path / "a.las")


TIN = """ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('','2026-11-28T09:00:00',(''),(''),'','','');
FILE_SCHEMA(('IFC4X3'));
ENDSEC;
DATA;
#1=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);
#2=IFCUNITASSIGNMENT((#1));
#6=IFCPROJECT('1vvWDd8fD7mQnRzmdCxpb1',$,'Ground',$,$,$,$,$,#2);
#10=IFCCARTESIANPOINTLIST3D(((9.,9.,9.),(0.,0.,1.),(8.,0.,1.),(8.,8.,3.),(0.,8.,3.)),$);
#11=IFCTRIANGULATEDFACESET(#10,$,.F.,({0}),(2,3,4,5,77));
#12=IFCSHAPEREPRESENTATION($,'Body','Tessellation',(#11));
#13=IFCPRODUCTDEFINITIONSHAPE($,$,(#12));
#14=IFCGEOGRAPHICELEMENT('1vvWDd8fD7mQnRzmdCxpb4',$,'Terrain',$,$,$,#13,$,.TERRAIN.);
ENDSEC;
END-ISO-10303-21;
"""


def test_triangles_of_ifc_without_their_points_are_left_out_where_they_are_few(tmp_path):
    """z = 1 + y / 4, by points that a list picks out; wrong rows name one too many, none, and one that is not in it."""
    path = tmp_path / "ground.ifc"
    path.write_text(TIN.format("(1,2,3),(1,3,4),(3,4,6),(0,1,2),(3,4,5)"))
    found = read(path)
    assert "3 of 5 triangles name points that are not there: left out" in found.notes
    assert found.source.heights_at(np.array([[3.0, 2.0], [3.0, 6.0]])) == pytest.approx([1.5, 2.5])
    path.write_text(TIN.format("(1,2,3),(3,4,6),(0,1,2),(3,4,5),(1,2)"))
    with pytest.raises(ScenarioError, match="damaged: 4 of 5 triangles name points that are not there, first number 2"):
        read(path)


def test_ifc_ground_without_a_unit_is_in_that_of_its_points(tmp_path):
    """A list of points is all that it has: they are in metres; a thousand times as large, in millimetres."""
    path = tmp_path / "ground.ifc"
    text = TIN.format("(1,2,3),(1,3,4)").replace("#1=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);\n", "").replace("(#1)", "()")
    path.write_text(text)
    assert "the file has no unit of length that is known: taken for m" in read(path).notes
    assert read(path).source.heights_at(np.array([[3.0, 2.0]])) == pytest.approx(1.5)
    points = "(9.,9.,9.),(0.,0.,1.),(8.,0.,1.),(8.,8.,3.),(0.,8.,3.)"
    path.write_text(text.replace(points, points.replace(".", "000.")))
    assert read(path).source.heights_at(np.array([[3.0, 2.0]])) == pytest.approx(1.5)


@pytest.mark.long
def test_the_ground_of_an_ifc_file_is_where_its_map_has_it(tmp_path):
    """A network of the plane, placed from a corner; the map conversion turns it by a quarter: x becomes north."""
    x, y = (grid.ravel() for grid in lattice())
    made = IfcBridge()
    points = np.column_stack((x - EASTING, y - NORTHING, plane(x, y))).tolist()
    make = made.file.create_entity
    mesh = make("IfcTriangulatedIrregularNetwork", make("IfcCartesianPointList3D", points), None, False)
    mesh.CoordIndex = (triangles() + 1).tolist()
    mesh.Flags = [0] * len(triangles())
    made.element("IfcGeographicElement", "Terrain", mesh, "DECK", shape_type="Tessellation")
    made.map_conversion("EPSG:25832", EASTING, NORTHING, turn_deg=90.0)
    path = made.written(tmp_path / "ground.ifc")
    found = read(path)
    assert isinstance(found.source, Surface)
    position = np.array([[EASTING - 4.0, NORTHING + 10.0]])  # 10 m along x, 4 m along y
    assert found.source.heights_at(position) == pytest.approx(HEIGHT + 0.2 * 10.0 + 0.05 * 4.0)
    with pytest.raises(GeometryError, match="has no surface that is called 'Lake': it has 'Terrain'"):
        read(path, surface="Lake")
