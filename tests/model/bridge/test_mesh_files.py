# SPDX-License-Identifier: GPL-3.0-or-later
"""Members from mesh files: formats, places, repair, overlap, and the model that is made of them."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from manifold3d import Manifold
from support.long_cases import long_but
from support.meshes import as_trimesh, turned
from support.scenarios import I235

from bridge_demolition_addon.cli.check import scenario_facts
from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh, triangle_areas_and_normals
from bridge_demolition_addon.engineering.geometry.solids import box, from_manifold, union
from bridge_demolition_addon.errors import GeometryError, ScenarioError
from bridge_demolition_addon.model.bridge.member import Member
from bridge_demolition_addon.model.bridge.mesh_files import geometry_members, placed_mesh
from bridge_demolition_addon.model.bridge.preparation import extent, ground_half_size, prepared_members, surface_height
from bridge_demolition_addon.model.scenario import Ball, Geometry, Scenario
from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_from_text, scenario_text
from bridge_demolition_addon.model.structure.model import build_model

pytestmark = pytest.mark.slow

# Files keep single precision of some metres.
SINGLE_M = 1e-6

# An L of 7 m³ with its foot on the ground: 4 m along x, 1 m across, its leg 4 m high at the left.
L_SHAPE = union([box([4, 1, 1], [0, 0, 0.5]), box([1, 1, 4], [-1.5, 0, 2])])


@pytest.fixture
def file_of(tmp_path):
    def write(solid=L_SHAPE, name="part.obj"):
        path = tmp_path / name
        as_trimesh(solid).export(path)
        return str(path)

    return write


def member_of(path, **values):
    return Geometry(**({"name": "part", "file": path, "density_kg_m3": 2400} | values))


@pytest.mark.parametrize("suffix", long_but(["obj", "stl"], ["stl", "obj", "ply"]))
def test_formats_give_the_same_member(file_of, suffix):
    (member,), notes = geometry_members([member_of(file_of(name=f"part.{suffix}"), kind="pier")])
    assert (member.name, member.kind, notes) == ("part", "pier", ())
    assert member.volume_m3 == pytest.approx(7, rel=SINGLE_M)
    assert member.mass_kg == pytest.approx(7 * 2400, rel=SINGLE_M)
    np.testing.assert_allclose(member.solid.bounds, [[-2, -0.5, 0], [2, 0.5, 4]], atol=SINGLE_M)


@pytest.mark.long
def test_a_glb_file_gives_vertices_of_its_own_precision_wherever_they_are_placed(tmp_path):
    """The product that places them has other last bits on other processors."""
    scene = trimesh.Scene()
    scene.add_geometry(as_trimesh(L_SHAPE), transform=trimesh.transformations.rotation_matrix(0.3, [1, 2, 3]))
    path = tmp_path / "part.glb"
    path.write_bytes(scene.export(file_type="glb"))
    vertices = placed_mesh(member_of(str(path))).vertices
    assert (vertices == vertices.astype(np.float32)).all()


def test_a_glb_file_has_y_up_and_transforms_of_its_own(tmp_path):
    scene = trimesh.Scene()
    standing = as_trimesh(turned(L_SHAPE, -np.pi / 2, [1, 0, 0]))  # z up to y up
    scene.add_geometry(standing, transform=trimesh.transformations.translation_matrix([10, 0, 0]))
    path = tmp_path / "part.GLB"
    path.write_bytes(scene.export(file_type="glb"))
    (member,), _ = geometry_members([member_of(str(path))])
    np.testing.assert_allclose(member.solid.bounds, [[8, -0.5, 0], [12, 0.5, 4]], atol=1e-5)


def test_scale_turn_and_place(file_of):
    mesh = placed_mesh(member_of(file_of(), scale=0.5, rotation_deg=90, position_m=[10, 20, 1]))
    # Half as large, x now along y.
    np.testing.assert_allclose(mesh.bounds, [[9.75, 19, 1], [10.25, 21, 3]], atol=SINGLE_M)
    assert mesh.volume == pytest.approx(7 / 8, rel=SINGLE_M)


@pytest.mark.parametrize("angle_deg", [-90.0, 90.0, 180.0, 270.0, -450.0])
def test_right_angles_are_exact(file_of, angle_deg):
    """Coordinates of a mesh are those of before, with other signs and on other axes, to the last bit."""
    for more in ({"rotation_deg": angle_deg}, {"tilt_deg": [angle_deg, 0]}, {"tilt_deg": [0, angle_deg]}):
        turned_mesh = placed_mesh(member_of(file_of(), **more))
        assert set(np.abs(turned_mesh.vertices).ravel()) <= set(np.abs(L_SHAPE.vertices).ravel())


def test_all_that_is_wrong_is_said_at_once_by_files(file_of):
    thin = member_of(file_of(name="thin.obj"), scale=1e-4)
    deep = member_of(file_of(name="deep.obj"), name="foot", position_m=[0, 0, -1])
    with pytest.raises(
        GeometryError, match=r"thin\.obj: part: is 0\.0001 m thick.* \S+deep\.obj: foot: reaches 1 m below"
    ):
        geometry_members([thin, deep])


def test_mass_gives_the_density(file_of):
    (member,), _ = geometry_members([member_of(file_of(), density_kg_m3=None, mass_kg=14_000)])
    assert member.density_kg_m3 == pytest.approx(2000, rel=SINGLE_M)


def test_files_of_the_same_name_become_one_solid(file_of):
    beside = member_of(file_of(), position_m=[3.5, 0, 0])
    (member,), _ = geometry_members([member_of(file_of()), beside])
    # Both have 0.5 m of the foot in common, where the leg of the second stands on it.
    assert member.volume_m3 == pytest.approx(14 - 0.5, rel=SINGLE_M)
    with pytest.raises(ScenarioError, match="expected the same kind and density_kg_m3"):
        geometry_members([member_of(file_of()), replace(beside, density_kg_m3=2500)])


def test_a_broken_file_is_repaired_and_that_is_said(file_of):
    _, normals = triangle_areas_and_normals(L_SHAPE.corners)
    opened = TriangleMesh(L_SHAPE.vertices, L_SHAPE.triangles[normals[:, 2] < 0.9])
    (member,), notes = geometry_members([member_of(file_of(opened))])
    assert member.volume_m3 == pytest.approx(7, rel=SINGLE_M)
    assert notes == ("part: closed 2 holes",)


@pytest.mark.parametrize(
    "content, name, error, text",
    [
        (None, "missing.stl", ScenarioError, "no such file"),
        (
            b"",
            "part.dwg",
            ScenarioError,
            "expected a file that ends in .stl, .obj, .ply or .glb; export it as one of these",
        ),
        (b"solid nothing", "part.stl", GeometryError, "part.stl"),
        (b"v 0,5 0 0\nf 1 1 1\n", "part.obj", GeometryError, "cannot be read as OBJ: it is damaged, or of another"),
        (b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "part.obj", GeometryError, "part.obj"),
        pytest.param(
            b"glTF but not really", "part.glb", GeometryError, "cannot be read as GLB", marks=pytest.mark.long
        ),
        pytest.param(
            b"ply\nformat binary_little_endian 1.0\nend_header\n",
            "part.ply",
            GeometryError,
            "part.ply",
            marks=pytest.mark.long,
        ),
    ],
)
def test_files_that_are_not_meshes_are_refused(tmp_path, content, name, error, text):
    path = tmp_path / name
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(error) as refusal:
        geometry_members([member_of(str(path))])
    said = str(refusal.value)
    assert text in said and said.count(name) <= 1 and "out of bounds" not in said


def test_what_reaches_into_the_ground_is_refused(file_of):
    with pytest.raises(GeometryError, match=r"part: reaches 0.5 m below the ground"):
        geometry_members([member_of(file_of(), position_m=[0, 0, -0.5])])


@pytest.mark.parametrize(
    "values, text",
    [
        (
            {"position_m": [448_000.0, 4_606_000.0, 280.0]},
            r"part: reaches 4.606e\+06 m from the origin; bring it within",
        ),
        ({"position_m": [9e7, 0.0, 0.0]}, r"part: reaches 9e\+07 m from the origin"),
        ({"scale": 1e4}, r"part: reaches 4e\+04 m from the origin"),
        ({"scale": 1e-4}, r"part: is 0.0001 m thick; expected at least 0.001 m"),
    ],
)
def test_what_single_precision_cannot_place_is_refused(file_of, values, text):
    with pytest.raises(GeometryError, match=text):
        geometry_members([member_of(file_of(), **values)])


def scenario_of(*tables, **values):
    return replace(I235, bridge=None, ball=None, geometry=tables, **values)


def test_without_bridge_the_model_is_what_the_files_say(file_of):
    model = build_model(scenario_of(member_of(file_of())))
    assert len(model.shards) == 200
    assert model.masses_kg.sum() == pytest.approx(7 * 2400, rel=SINGLE_M)


def test_a_member_beside_the_bridge_is_cut_where_the_bridge_is(file_of):
    # A block of 2 m on the middle of the span, from 5.05 m upwards: the deck, 5.3 to 5.55 m, goes through it.
    block = member_of(file_of(box([2, 2, 2], [0, 0, 1])), name="ballast", position_m=[6.5, 0, 5.05], density_kg_m3=1800)
    prepared = prepared_members(replace(I235, geometry=[block]))
    assert prepared.members[-1].volume_m3 == pytest.approx(8 - 2 * 2 * 0.25, rel=SINGLE_M)
    assert prepared.notes == ("ballast: 1 m³ cut off, as members before it take that room",)
    model = build_model(replace(I235, geometry=[block]))
    assert model.masses_kg.sum() == pytest.approx(107_000 + 7 * 1800, rel=SINGLE_M)


def test_names_of_members_differ(file_of):
    with pytest.raises(ScenarioError, match='two members are called "deck"'):
        prepared_members(replace(I235, geometry=[member_of(file_of(), name="deck")]))
    with pytest.raises(ScenarioError, match='the member "pier" has the name of a kind, that of pier 1'):
        prepared_members(replace(I235, geometry=[member_of(file_of(), name="pier", kind="wall")]))


def test_a_scenario_needs_a_bridge_or_geometry():
    with pytest.raises(ScenarioError, match=r"bridge is missing: expected a table, .* \[\[geometry\]\]"):
        replace(I235, bridge=None)


def test_height_under_the_ball(file_of):
    scenario = scenario_of(member_of(file_of()))
    members = prepared_members(scenario).members
    assert surface_height(scenario, members, (-1.5, 0.2)) == pytest.approx(4, abs=SINGLE_M)
    assert surface_height(scenario, members, (1.0, 0.2)) == pytest.approx(1, abs=SINGLE_M)
    with pytest.raises(GeometryError, match=r"No member lies under \[5.0, 0.0\]"):
        surface_height(scenario, members, (5.0, 0.0))
    # Of a bridge and more, whichever is higher.
    both = replace(I235, geometry=[member_of(file_of(), name="rubble", position_m=[6.5, 0, 5.55])])
    members = prepared_members(both).members
    assert surface_height(both, members, (8.0, 0.0)) == pytest.approx(6.55, abs=SINGLE_M)
    assert surface_height(both, members, (1.0, 0.0)) == pytest.approx(5.55, abs=SINGLE_M)
    assert surface_height(I235, members, (1.0, 0.0)) == pytest.approx(5.55, abs=1e-12)


def test_height_of_a_slope():
    corners = [[0, 0, 0], [4, 0, 0], [0, 3, 0], [4, 3, 0], [4, 0, 2], [4, 3, 2]]
    wedge = from_manifold(Manifold.hull_points(np.array(corners, dtype=float)))
    scenario = scenario_of(Geometry(name="wedge", file="none.obj", density_kg_m3=10))
    height = surface_height(scenario, [Member("wedge", "member", wedge, 1.0)], (3.0, 1.0))
    assert height == pytest.approx(1.5, abs=1e-12)


def test_extent_and_ground(file_of):
    far = member_of(file_of(), position_m=[100, 0, 0])
    members = prepared_members(scenario_of(far)).members
    np.testing.assert_allclose(extent(members), [[98, -0.5, 0], [102, 0.5, 4]], atol=1e-5)
    # The ground is around the origin and reaches the far end, with ten times the height around it.
    assert ground_half_size(members, 5.0) == pytest.approx(np.hypot(102, 0.5) + 90, rel=1e-6)


def test_paths_start_from_the_scenario_file(tmp_path, file_of, monkeypatch, capsys):
    file_of(name="part.obj")
    text = scenario_text(scenario_of(member_of("part.obj")))
    assert scenario_from_text(text).geometry[0].file == "part.obj"
    (tmp_path / "scenario.toml").write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path.parent)
    scenario = read_scenario(tmp_path.name + "/scenario.toml")
    assert scenario.geometry[0].file == str((tmp_path / "part.obj").resolve())
    assert main(["check", f"{tmp_path.name}/scenario.toml"]) == 0
    assert "part                        7.000 m³     16.800 t" in capsys.readouterr().out


def test_check_says_what_was_repaired_and_cut(file_of):
    block = member_of(file_of(box([2, 2, 2], [0, 0, 1])), name="ballast", position_m=[6.5, 0, 5.05])
    lines = [" ".join(line.split()) for line in scenario_facts(replace(I235, geometry=[block]))]
    assert "ballast 1 m³ cut off, as members before it take that room" in lines
    assert "overlapping shards no pairs, by more than 1e-06 of the smaller one" in lines


def test_the_ball_may_aim_beside_the_deck_where_there_is_geometry(file_of):
    ball = Ball(mass_kg=1e3, diameter_m=1, target_m=[-1.5, 0], drop_height_m=1)
    scenario = replace(scenario_of(member_of(file_of())), ball=ball)
    assert isinstance(scenario, Scenario)
    assert len(prepared_members(scenario).members) == 1
    with pytest.raises(GeometryError, match="No member lies under"):
        prepared_members(replace(scenario, ball=replace(ball, target_m=[9.0, 0.0])))


@pytest.fixture
def of_many(tmp_path):
    """A pier of 2 m³ and a deck of 12 m³ in one file, by name."""

    def written(suffix):
        scene = trimesh.Scene()
        for name, size, middle in (("Pier.001", (1, 1, 2), (0, 0, 1)), ("Deck", (6, 2, 1), (3, 0, 2.5))):
            at = np.eye(4)
            at[:3, 3] = middle
            scene.add_geometry(trimesh.creation.box(size), node_name=name, geom_name=f"{name} mesh", transform=at)
        if suffix == ".glb":
            upright = trimesh.transformations.rotation_matrix(-np.pi / 2.0, (1, 0, 0))
            scene.apply_transform(upright)  # y up, as GLB has it
            (tmp_path / "bridge.glb").write_bytes(scene.export(file_type="glb"))
        else:
            (tmp_path / "bridge.obj").write_text(_objects_text(scene))
        return tmp_path / f"bridge{suffix}"

    return written


def _objects_text(scene):
    lines, first = ["# two objects"], 1
    for name in scene.graph.nodes_geometry:
        at, mesh_name = scene.graph[name]
        mesh = scene.geometry[mesh_name].copy().apply_transform(at)
        lines += [f"o {name}", *("v {} {} {}".format(*point) for point in mesh.vertices.tolist()), f"g {name} concrete"]
        lines += ["f {} {} {}".format(*face) for face in (mesh.faces + first).tolist()]
        first += len(mesh.vertices)
    return "\n".join(lines)


@pytest.mark.parametrize("suffix", [".obj", ".glb"])
def test_one_object_of_a_file_with_many_is_a_member(of_many, suffix):
    file = of_many(suffix)
    volumes = {None: 14.0, "Deck": 12.0, "pier*": 2.0, "*": 14.0}
    if suffix == ".obj":
        volumes["deck concrete"] = 12.0  # a group
    for part, volume_m3 in volumes.items():
        table = Geometry(name="own", file=str(file), part=part, density_kg_m3=2500.0)
        ((member,), _) = geometry_members([table])
        assert member.volume_m3 == pytest.approx(volume_m3, rel=SINGLE_M), part
    deck = Geometry(name="own", file=str(file), part="Deck", density_kg_m3=2500.0)
    ((member,), _) = geometry_members([deck])
    assert member.solid.bounds == pytest.approx(np.array([[0.0, -1.0, 2.0], [6.0, 1.0, 3.0]]), abs=1e-6)
    with pytest.raises(GeometryError, match=r'has no object "Cap", which geometry\.part names; it has .*Pier\.001'):
        geometry_members([replace(deck, part="Cap")])


def test_a_file_without_named_objects_has_no_part():
    with pytest.raises(ScenarioError, match=r'geometry\.part is "Deck": expected none of a file that ends in \.stl'):
        Geometry(name="own", file="a.stl", part="Deck", density_kg_m3=2500.0)
