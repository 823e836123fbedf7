# SPDX-License-Identifier: GPL-3.0-or-later
"""Voronoi fracture against volumes, areas and centres that are known without it."""

from functools import cache

import numpy as np
import pytest
import trimesh
from manifold3d import CrossSection, Manifold
from support.meshes import as_trimesh, is_closed, of_trimesh, rotation, turned

from bridge_demolition_addon.engineering.fracture.seeds import random_points
from bridge_demolition_addon.engineering.fracture.shards import Fracture, fracture, voronoi_cells
from bridge_demolition_addon.engineering.fracture.shared_faces import overlaps, touching_faces
from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh, joined_meshes, volumes_and_centres
from bridge_demolition_addon.engineering.geometry.repair import sewn
from bridge_demolition_addon.engineering.geometry.solids import (
    bodies,
    box,
    checked_solid,
    contains,
    from_manifold,
    to_manifold,
    union,
)
from bridge_demolition_addon.errors import GeometryError

pytestmark = pytest.mark.slow

# What the project promises for sums of volumes.
VOLUME = 1e-9
# Lengths of some metres after some dozens of operations of 2e-16 each.
ROUNDING = 1e-12


@cache
def solids() -> dict[str, TriangleMesh]:
    """Convex, concave, holed, hollow and separate solids, two of them turned so that no face is parallel to an axis."""
    comb = union([box([20, 1, 0.5]), *(box([0.2, 1, 3], [x, 0, 1.6]) for x in np.arange(-9.5, 10))])
    ring = from_manifold(Manifold.revolve(CrossSection.circle(1.0, 16).translate([3.0, 0.0]), 24))
    return {
        "slab": box([30, 12, 1]),
        "cylinder": of_trimesh(trimesh.creation.cylinder(1.0, 6.0)),
        "L": union([box([4, 1, 1]), box([1, 1, 4], [-1.5, 0, 1.5])]),
        "U": union([box([6, 2, 1]), box([1, 2, 4], [-2.5, 0, 1.5]), box([1, 2, 4], [2.5, 0, 1.5])]),
        "T pier": union([box([2, 1, 6], [0, 0, 3]), box([10, 1.5, 1], [0, 0, 6.5])]),
        "through hole": from_manifold(Manifold.cube([4, 4, 1], True) - Manifold.cube([2, 2, 3], True)),
        "hollow": from_manifold(Manifold.cube([4, 4, 2], True) - Manifold.cube([3.6, 3.6, 1.6], True)),
        "ring": turned(ring, 0.7, [3, 1, 2]),
        "comb": comb,
        "turned comb": turned(comb, 1.0, [1, 2, 3]),
        "two bodies": from_manifold(Manifold.cube([1, 1, 1]), Manifold.cube([2, 1, 1]).translate([5, 0, 0])),
    }


@cache
def shattered(name: str, count: int, seed: int = 0) -> Fracture:
    return fracture(checked_solid(solids()[name], name), count, seed)


def is_connected(shard: TriangleMesh) -> bool:
    return len(bodies(to_manifold(shard))) == 1


def unit_grid(counts: tuple[int, int, int]) -> np.ndarray:
    """Centres of unit cubes that fill a box with a corner at the origin."""
    return np.stack(np.meshgrid(*(np.arange(n) + 0.5 for n in counts), indexing="ij"), axis=-1).reshape(-1, 3)


@pytest.mark.parametrize("count", [2, 7, 40])
@pytest.mark.parametrize("name", solids())
def test_there_are_exactly_as_many_closed_connected_shards_as_asked_for(name: str, count: int) -> None:
    for seed in range(3):
        result = shattered(name, count, seed)
        assert len(result) == len(result.shards) == len(result.points) == count
        assert (result.volumes > 0).all()
        assert all(is_closed(shard) and is_connected(shard) for shard in result.shards)
        assert all(np.isfinite(shard.vertices).all() for shard in result.shards)


@pytest.mark.parametrize("count", [1, 7, 40])
@pytest.mark.parametrize("name", sorted(set(solids()) - {"two bodies"}))
def test_shards_add_up_to_the_solid(name: str, count: int) -> None:
    result, solid = shattered(name, count), solids()[name]
    assert result.volumes.sum() == pytest.approx(solid.volume, rel=VOLUME)
    # First moments add up as volumes do; relative to the size of the solid.
    centre = result.volumes @ result.centres / result.volumes.sum()
    assert np.allclose(centre, volumes_and_centres([solid])[1][0], rtol=0, atol=VOLUME * solid.longest_extent)


@pytest.mark.parametrize(
    ("solid", "volume"),
    [
        (box([30, 12, 1]), 360.0),
        (union([box([4, 1, 1]), box([1, 1, 4], [-1.5, 0, 1.5])]), 7.0),
        (of_trimesh(trimesh.creation.cylinder(1.0, 6.0, sections=6)), 6.0 * 1.5 * np.sqrt(3.0)),
        (of_trimesh(trimesh.creation.icosahedron()), 2.5361507101204095),
    ],
    ids=["slab", "L", "hexagonal prism", "icosahedron"],
)
def test_volumes_against_formulas(solid: TriangleMesh, volume: float) -> None:
    assert fracture(solid, 25, seed=3).volumes.sum() == pytest.approx(volume, rel=VOLUME)


@pytest.mark.parametrize("name", solids())
def test_one_shard_per_body_returns_the_solid(name: str) -> None:
    count = 2 if name == "two bodies" else 1
    result = shattered(name, count)
    assert len(result.faces) == 0
    assert np.allclose(np.sort(result.volumes)[-1], 2.0 if count == 2 else solids()[name].volume, rtol=VOLUME)
    # The shards reach exactly as far as the solid.
    vertices = np.concatenate([shard.vertices for shard in result.shards])
    assert np.allclose([vertices.min(axis=0), vertices.max(axis=0)], solids()[name].bounds, rtol=0, atol=ROUNDING)


@pytest.mark.parametrize("name", ["slab", "ring", "turned comb"])
def test_the_same_seed_gives_the_same_shards_bit_for_bit(name: str) -> None:
    one, again = (fracture(solids()[name], 60, seed=5) for _ in range(2))
    for field in ("volumes", "centres", "points"):
        assert np.array_equal(getattr(one, field), getattr(again, field))
    for field in ("pairs", "areas", "centres", "normals"):
        assert np.array_equal(getattr(one.faces, field), getattr(again.faces, field))
    for shard, other in zip(one.shards, again.shards, strict=True):
        assert np.array_equal(shard.vertices, other.vertices) and np.array_equal(shard.triangles, other.triangles)
    assert not np.array_equal(one.points, fracture(solids()[name], 60, seed=6).points)


def test_the_arrays_have_the_promised_shapes_and_types() -> None:
    result = shattered("L", 7)
    shard, faces = result.shards[0], result.faces
    assert shard.vertices.dtype == np.float64 and shard.triangles.dtype == np.int64
    assert shard.vertices.shape[1:] == shard.triangles.shape[1:] == (3,)
    assert result.volumes.shape == (7,) and result.centres.shape == result.points.shape == (7, 3)
    k = len(faces)
    assert faces.pairs.shape == (k, 2) and faces.areas.shape == (k,)
    assert faces.centres.shape == faces.normals.shape == (k, 3)
    assert (faces.pairs[:, 0] < faces.pairs[:, 1]).all()
    assert np.array_equal(faces.pairs, np.unique(faces.pairs, axis=0))


def test_a_cube_cut_by_two_points() -> None:
    # The plane halfway between x = -0.3 and x = 0.1 is x = -0.1 of a unit cube.
    result = voronoi_cells(box([1, 1, 1]), [[-0.3, 0.2, 0.1], [0.1, 0.2, 0.1]])
    assert np.allclose(result.volumes, [0.4, 0.6], rtol=0, atol=ROUNDING)
    assert np.allclose(result.centres, [[-0.3, 0, 0], [0.2, 0, 0]], rtol=0, atol=ROUNDING)
    assert result.faces.pairs.tolist() == [[0, 1]]
    assert np.allclose(result.faces.areas, [1.0], rtol=0, atol=ROUNDING)
    assert np.allclose(result.faces.centres, [[-0.1, 0, 0]], rtol=0, atol=ROUNDING)
    assert np.allclose(result.faces.normals, [[1, 0, 0]], rtol=0, atol=ROUNDING)


@pytest.mark.parametrize("turn", [0.0, 1.0])
def test_a_grid_of_points_gives_unit_cubes(turn: float) -> None:
    # Eight cells meet in every corner of the grid and many planes touch others' edges: nothing is in general position.
    solid = turned(box([4, 3, 2], [2, 1.5, 1]), turn, [1, 2, 3])
    result = voronoi_cells(solid, unit_grid((4, 3, 2)) @ rotation(turn, [1, 2, 3]).T)
    assert np.allclose(result.volumes, 1.0, rtol=0, atol=ROUNDING)
    assert np.allclose(result.centres, result.points, rtol=0, atol=ROUNDING)
    # Faces between neighbours along each axis: 3*3*2 + 4*2*2 + 4*3*1.
    assert len(result.faces) == 46
    assert np.allclose(result.faces.areas, 1.0, rtol=0, atol=ROUNDING)
    first, second = result.points[result.faces.pairs].transpose(1, 0, 2)
    assert np.allclose(result.faces.centres, (first + second) / 2, rtol=0, atol=ROUNDING)
    assert np.allclose(result.faces.normals, second - first, rtol=0, atol=ROUNDING)


def test_points_on_a_sphere_share_a_corner_in_its_centre() -> None:
    # All 150 planes go through one point: far more than the nearest few neighbours matter.
    points = np.random.default_rng(2).normal(size=(150, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    result = voronoi_cells(box([2.5, 2.5, 2.5]), points)
    assert result.volumes.sum() == pytest.approx(2.5**3, rel=VOLUME)
    # The centre is a corner of every shard, where 150 planes meet to within rounding.
    closest = [np.linalg.norm(shard.vertices, axis=1).min() for shard in result.shards]
    assert max(closest) < 1e-9

    # A point in the centre has all of them, at the same distance, as neighbours.
    around_a_core = voronoi_cells(box([2.5, 2.5, 2.5]), np.vstack([points, np.zeros((1, 3))]))
    assert (around_a_core.faces.pairs[:, 1] == 150).sum() == 150
    assert around_a_core.volumes.sum() == pytest.approx(2.5**3, rel=VOLUME)


@pytest.mark.parametrize("count", [150, 1500])
def test_in_a_convex_solid_every_place_is_in_the_shard_of_the_nearest_point(count: int) -> None:
    result = shattered("slab", count)
    generator = np.random.default_rng(1)
    for index in generator.choice(count, 40, replace=False):
        shard = result.shards[index]
        weights = generator.dirichlet(np.ones(len(shard.vertices)), 20)
        inside = weights @ shard.vertices
        nearest = np.linalg.norm(inside[:, None] - result.points[None], axis=2).argmin(axis=1)
        assert (nearest == index).all()


@pytest.mark.parametrize("name", ["T pier", "ring", "hollow", "turned comb"])
def test_shards_of_a_concave_solid_do_not_overlap_and_leave_no_gap(name: str) -> None:
    result, solid = shattered(name, 40), solids()[name]
    inside = random_points(solid, 200, np.random.default_rng(9))
    owners = sum(contains(shard, inside).astype(int) for shard in result.shards)
    assert (owners == 1).all()


@pytest.mark.parametrize("name", solids())
def test_every_shard_holds_its_own_point(name: str) -> None:
    result = shattered(name, 40)
    meshes = result.shards
    assert all(contains(mesh, point)[0] for mesh, point in zip(meshes, result.points, strict=True))


@pytest.mark.parametrize("name", ["slab", "cylinder"])
def test_the_faces_of_each_shard_close_it(name: str) -> None:
    result, solid = shattered(name, 40), solids()[name]
    faces = result.faces
    vectors = faces.areas[:, None] * faces.normals
    total = np.zeros((len(result), 3))
    np.add.at(total, faces.pairs[:, 0], vectors)
    np.add.at(total, faces.pairs[:, 1], -vectors)
    middle = volumes_and_centres([solid])[1][0]
    for index, shard in enumerate(result.shards):
        corners = shard.corners
        area_vectors = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
        # Of a convex solid, the shard's triangles in the surface are those that lie in a plane of the solid.
        height = np.einsum("tij,fj->tif", corners - middle, as_trimesh(solid).face_normals)
        plane = np.einsum("fj,fj->f", solid.corners[:, 0] - middle, as_trimesh(solid).face_normals)
        # Cut corners lie in the surface to within rounding; shards are some decimetres thick.
        in_surface = (np.abs(height - plane) < 1e-9).all(axis=1).any(axis=1)
        # Faces below the least area, some 1e-10 m², are left out of the sum.
        assert np.allclose(total[index] + area_vectors[in_surface].sum(axis=0), 0, rtol=0, atol=1e-8)


@pytest.mark.parametrize("name", ["slab", "U", "T pier", "through hole", "hollow", "ring", "comb"])
def test_the_surface_of_the_shards_is_the_solid_and_both_sides_of_all_faces(name: str) -> None:
    result = shattered(name, 40)
    surface = sum(trimesh.triangles.area(shard.corners).sum() for shard in result.shards)
    # Sums of some thousand areas; faces below the least area count on one side only.
    assert surface == pytest.approx(as_trimesh(solids()[name]).area + 2 * result.faces.areas.sum(), rel=1e-9)


@pytest.mark.parametrize("name", ["slab", "T pier", "turned comb"])
def test_normals_are_unit_vectors_from_the_first_shard_into_the_second(name: str) -> None:
    result = shattered(name, 40)
    faces = result.faces
    assert np.allclose(np.linalg.norm(faces.normals, axis=1), 1, rtol=0, atol=ROUNDING)
    whole = result.faces.areas > 1e-3
    # A millimetre to either side of a face's centre, where faces are large and plane enough for it to lie on them.
    for row in np.flatnonzero(whole)[:25]:
        sides = faces.centres[row] + np.outer([-1e-3, 1e-3], faces.normals[row])
        for shard_index, position in zip(faces.pairs[row], sides, strict=True):
            shard = result.shards[shard_index]
            if name == "slab":
                assert contains(shard, position)[0]
    if name == "slab":
        first, second = result.points[faces.pairs].transpose(1, 0, 2)
        towards = (second - first) / np.linalg.norm(second - first, axis=1)[:, None]
        # Normals of narrow faces are a difference of nearly equal numbers.
        assert np.allclose(faces.normals[whole], towards[whole], rtol=0, atol=1e-9)


def test_loose_pieces_go_to_the_neighbour_with_the_largest_common_area() -> None:
    # A U lies on its back: the left point is nearer to the tip of the right leg than the point at the foot of that leg.
    u = union([box([6, 2, 1]), box([1, 2, 8], [-2.5, 0, 3.5]), box([1, 2, 8], [2.5, 0, 3.5])])
    left_high, foot = [-2.5, 0.0, 7.0], [2.5, 0.0, 0.0]
    result = voronoi_cells(u, [left_high, foot])
    assert len(result) == 2 and all(is_connected(shard) for shard in result.shards)
    # The right leg's tip, cut off by the plane between the two, hangs on the leg and so belongs to the foot.
    tip = np.array([2.5, 0.0, 7.4])
    assert np.linalg.norm(tip - left_high) < np.linalg.norm(tip - foot)
    owner = [bool(contains(shard, tip)[0]) for shard in result.shards]
    assert owner == [False, True]
    assert result.volumes.sum() == pytest.approx(u.volume, rel=VOLUME)


def test_points_are_drawn_evenly_from_the_volume() -> None:
    # An L with 4 m³ in the foot and 3 m³ in the leg: of 20 000 points 4/7 in the foot, give or take four deviations.
    points = random_points(solids()["L"], 20_000, np.random.default_rng(0))
    assert contains(solids()["L"], points).all()
    in_foot = (points[:, 2] < 0.5).mean()
    assert in_foot == pytest.approx(4 / 7, abs=4 * np.sqrt(4 / 7 * 3 / 7 / 20_000))


def test_each_body_gets_a_point_however_small() -> None:
    solid = from_manifold(Manifold.cube([10, 10, 10]), Manifold.cube([0.01, 0.01, 0.01]).translate([20, 0, 0]))
    for seed in range(5):
        result = fracture(solid, 2, seed)
        assert np.allclose(np.sort(result.volumes), [1e-6, 1e3], rtol=VOLUME)


@pytest.mark.parametrize("count", [0, -3])
def test_no_shards_are_refused(count: int) -> None:
    with pytest.raises(GeometryError, match="at least one"):
        fracture(box([1, 1, 1]), count)


def test_fewer_shards_than_bodies_are_refused() -> None:
    with pytest.raises(GeometryError, match="2 separate bodies"):
        fracture(solids()["two bodies"], 1)


@pytest.mark.parametrize(
    ("points", "reason"),
    [
        (np.zeros((0, 3)), "at least one point"),
        ([[0, 0, 0], [0.1, 0, 0], [0, 0, 0]], "Points 0 and 2 coincide"),
        ([[0, 0, 0], [5, 0, 0]], "1 of 2 points lie outside the solid, the first is 1"),
    ],
    ids=["none", "two alike", "outside"],
)
def test_points_that_cannot_be_used_are_refused(points: np.ndarray, reason: str) -> None:
    with pytest.raises(GeometryError, match=reason):
        voronoi_cells(box([1, 1, 1]), points)


def test_a_body_without_a_point_is_refused() -> None:
    with pytest.raises(GeometryError, match="holds none of the points"):
        voronoi_cells(solids()["two bodies"], [[0.2, 0.5, 0.5], [0.8, 0.5, 0.5]])


def test_an_open_solid_is_refused() -> None:
    solid = box([1, 1, 1])
    with pytest.raises(GeometryError, match="not a closed solid"):
        fracture(TriangleMesh(solid.vertices, solid.triangles[1:]), 3)


def test_boxes_that_stand_partly_on_each_other() -> None:
    # A deck from x = 1 to 9 and y = -1 to 3 on a cap from x = 0 to 4 and y = 0 to 2: 3 m by 2 m, around (2.5, 1).
    cap, deck = box([4, 2, 1], [2, 1, 0.5]), box([8, 4, 1], [5, 1, 1.5])
    faces = touching_faces([deck, cap])
    assert faces.pairs.tolist() == [[0, 1]]
    assert np.allclose(faces.areas, [6.0], rtol=0, atol=ROUNDING)
    assert np.allclose(faces.centres, [[2.5, 1.0, 1.0]], rtol=0, atol=ROUNDING)
    assert np.allclose(faces.normals, [[0, 0, -1]], rtol=0, atol=ROUNDING)


def test_corner_on_edge_contact_of_turned_boxes() -> None:
    # A unit square turned by 45° on a larger one whose edge halves it: half of it, its centroid √2/6 from the edge.
    square = turned(box([1, 1, 1], [0, 0, 1.5]), np.pi / 4, [0, 0, 1])
    faces = touching_faces([box([4, 4, 1], [2, 0, 0.5]), square])
    assert np.allclose(faces.areas, [0.5], rtol=0, atol=ROUNDING)
    assert np.allclose(faces.centres, [[np.sqrt(2) / 6, 0, 1]], rtol=0, atol=ROUNDING)
    assert np.allclose(faces.normals, [[0, 0, 1]], rtol=0, atol=ROUNDING)


@pytest.mark.parametrize(
    ("gap", "touches"), [(0.0, True), (0.9e-3, True), (-0.9e-3, True), (1.1e-3, False), (-1.1e-3, False)]
)
def test_the_tolerance_counts_gaps_and_overlaps_alike(gap: float, touches: bool) -> None:
    faces = touching_faces([box([1, 1, 1]), box([1, 1, 1], [0, 0, 1 + gap])], tolerance_m=1e-3)
    assert (len(faces) == 1) is touches
    assert np.allclose(faces.areas, 1.0, rtol=0, atol=ROUNDING)


@pytest.mark.parametrize(
    "place",
    [[1, 1, 0], [1, 1, 1], [3, 0, 0], [0.5, 0, 0]],
    ids=["along an edge", "in a corner", "apart", "inside each other"],
)
def test_what_does_not_lie_face_to_face_does_not_touch(place: list[float]) -> None:
    assert len(touching_faces([box([1, 1, 1]), box([1, 1, 1], place)])) == 0


def test_faces_in_one_plane_that_look_the_same_way_do_not_touch() -> None:
    assert len(touching_faces([box([1, 1, 1]), box([0.5, 0.5, 0.5], [0, 0, 0.25])])) == 0


def test_a_concave_body_is_touched_through_its_real_outline() -> None:
    # A lid on a frame of 4 m by 4 m with a hole of 2 m by 2 m.
    faces = touching_faces([solids()["through hole"], box([4, 4, 1], [0, 0, 1])])
    assert np.allclose(faces.areas, [12.0], rtol=0, atol=ROUNDING)
    assert np.allclose(faces.centres, [[0, 0, 0.5]], rtol=0, atol=ROUNDING)


def test_touching_on_several_planes_adds_up() -> None:
    # A unit cube in the corner of an L touches it below and behind.
    faces = touching_faces([solids()["L"], box([1, 1, 1], [-0.5, 0, 1])])
    assert np.allclose(faces.areas, [2.0], rtol=0, atol=ROUNDING)
    assert np.allclose(faces.normals, [[np.sqrt(0.5), 0, np.sqrt(0.5)]], rtol=0, atol=ROUNDING)


@pytest.mark.parametrize("turn", [0.0, 1.0])
def test_between_two_fractured_members_all_of_the_interface_is_found(turn: float) -> None:
    matrix = rotation(turn, [1, 2, 3])
    members = box([3, 9, 1], [0, 0, 0.5]), box([20, 8, 1], [4, 1, 1.5])
    cap, deck = (turned(member, turn, [1, 2, 3]) for member in members)
    below, above = fracture(cap, 60, seed=1), fracture(deck, 200, seed=2)
    member = np.repeat([0, 1], [len(below), len(above)])
    faces = touching_faces([*below.shards, *above.shards], member=member)
    # 3 m of the cap's width by y = -3 to 4.5; hundreds of patches, cut where members were turned to within 1e-15.
    assert faces.areas.sum() == pytest.approx(3 * 7.5, rel=VOLUME)
    centre = matrix @ [0, 0.75, 1]
    assert np.allclose(faces.areas @ faces.centres / faces.areas.sum(), centre, rtol=0, atol=1e-9)
    assert np.allclose(faces.normals, matrix[:, 2], rtol=0, atol=1e-9)
    assert (member[faces.pairs] == [0, 1]).all()


def test_touching_faces_finds_again_what_the_fracture_knows() -> None:
    result = shattered("T pier", 40)
    found = touching_faces(result.shards)
    # Slivers below the least area of a fracture may be found, too.
    real = found.areas > 1e-6
    assert np.array_equal(found.pairs[real], result.faces.pairs[result.faces.areas > 1e-6])
    assert np.allclose(found.areas[real], result.faces.areas[result.faces.areas > 1e-6], rtol=0, atol=1e-9)


@pytest.mark.parametrize("meshes", [[], [box([1, 1, 1])]], ids=["none", "one"])
def test_too_few_to_touch(meshes: list[TriangleMesh]) -> None:
    faces = touching_faces(meshes)
    assert len(faces) == 0 and faces.pairs.shape == (0, 2) and faces.normals.shape == (0, 3)


def test_overlaps_of_triangles_worked_out_by_hand() -> None:
    flat = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0]], dtype=float)
    inside = np.array([[1, 1, 0], [1, 2, 0], [2, 1, 0]], dtype=float)
    shifted = flat[::-1] + np.array([2, 0, 0])
    outside = flat[::-1] + np.array([5, 0, 0])
    areas, centres = overlaps(np.stack([flat] * 4), np.stack([inside, flat[::-1], shifted, outside]))
    assert np.allclose(areas, [0.5, 8, 2, 0], rtol=0, atol=ROUNDING)
    thirds = np.array([[4 / 3, 4 / 3, 0], [4 / 3, 4 / 3, 0], [8 / 3, 2 / 3, 0]])
    assert np.allclose(centres[:3], thirds, rtol=0, atol=ROUNDING)


def test_overlaps_of_random_triangles_agree_with_the_boolean_engine() -> None:
    generator = np.random.default_rng(4)
    first, second = generator.random((2, 50, 3, 2))

    def counter_clockwise(triangles: np.ndarray) -> np.ndarray:
        spans = triangles[:, 1:] - triangles[:, :1]
        clockwise = spans[:, 0, 0] * spans[:, 1, 1] < spans[:, 0, 1] * spans[:, 1, 0]
        return np.where(clockwise[:, None, None], triangles[:, ::-1], triangles)

    first, second = counter_clockwise(first), counter_clockwise(second)
    level = np.zeros((50, 3, 1))
    areas, _ = overlaps(np.concatenate([first, level], axis=2), np.concatenate([second[:, ::-1], level], axis=2))
    expected = [(CrossSection([a]) ^ CrossSection([b])).area() for a, b in zip(first, second, strict=True)]
    # The engine's plane polygons are rounded to 1e-8.
    assert np.allclose(areas, expected, rtol=0, atol=1e-7)


def test_sewing_joins_rims_whose_corners_differ() -> None:
    # Two unit cubes on each other; the upper one's lower face has one more corner, in the middle of an edge, and is cut
    # 1e-11 m higher.
    lower = box([1, 1, 1])
    upper = of_trimesh(as_trimesh(box([1, 1, 1], [0, 0, 1 + 1e-11])).subdivide_to_size(0.8))
    both = joined_meshes([lower, upper])
    patch = (np.abs(both.corners[..., 2] - 0.5) < 1e-9).all(axis=1)
    joined = sewn(both, patch, tolerance_m=1e-9)
    assert is_closed(joined)
    assert len(bodies(to_manifold(joined))) == 1
    assert joined.volume == pytest.approx(2.0, abs=1e-10)
