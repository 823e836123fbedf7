# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids against shapes whose volume, centre and inside are known by heart."""

import numpy as np
import pytest
import trimesh
from manifold3d import Manifold
from support.meshes import is_closed, of_trimesh

from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh, volumes_and_centres
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

# A few hundred roundings of 2e-16 each, on numbers of the size of one.
ROUNDING = 1e-13


def hollow_box() -> TriangleMesh:
    return from_manifold(Manifold.cube([4, 4, 2], True) - Manifold.cube([3, 3, 1], True))


def test_a_box_has_its_size_its_place_and_looks_outwards() -> None:
    mesh = box([30.0, 12.0, 1.0], [5.0, 0.0, 7.5])
    assert np.allclose(mesh.bounds, [[-10, -6, 7], [20, 6, 8]], rtol=0, atol=0)
    assert is_closed(mesh)
    assert mesh.volume == pytest.approx(360.0, rel=ROUNDING)


@pytest.mark.parametrize("size", [[1, 0, 1], [1, -1, 1], [1, np.nan, 1], [1, np.inf, 1]])
def test_a_box_without_extent_is_refused(size: list[float]) -> None:
    with pytest.raises(GeometryError, match="positive edge lengths"):
        box(size)


def test_volumes_and_centres_agree_with_trimesh() -> None:
    meshes = [trimesh.creation.icosphere(3), trimesh.creation.cone(1.0, 2.0), trimesh.creation.torus(3.0, 1.0)]
    meshes[1].apply_translation([1000.0, -500.0, 20.0])
    volumes, centres = volumes_and_centres([of_trimesh(mesh) for mesh in meshes])
    # trimesh integrates about the origin and loses some digits 1 km away from it: 1e3^3 * 2e-16.
    assert np.allclose(volumes, [mesh.volume for mesh in meshes], rtol=1e-6)
    assert np.allclose(centres, [mesh.center_mass for mesh in meshes], rtol=0, atol=1e-5)


def test_the_volume_of_a_small_solid_far_away_keeps_its_digits() -> None:
    # The corners themselves are rounded to 1e4 * 1e-16 = 1e-12 m, on edges of 0.1 m.
    assert box([0.1, 0.1, 0.1], [1e4, 1e4, 1e4]).volume == pytest.approx(1e-3, rel=1e-10)


def test_volumes_of_no_meshes_are_empty() -> None:
    volumes, centres = volumes_and_centres([])
    assert volumes.shape == (0,) and centres.shape == (0, 3)


def test_a_union_counts_what_overlaps_once() -> None:
    # 4 + 4 - 1: an L of two bars that share a unit cube.
    corner = union([box([4, 1, 1]), box([1, 1, 4], [-1.5, 0, 1.5])])
    assert is_closed(corner)
    assert corner.volume == pytest.approx(7.0, rel=ROUNDING)


def test_a_union_of_boxes_that_stand_on_each_other_is_one_body() -> None:
    pier = union([box([2, 2, 6], [0, 0, 3]), box([8, 2, 1], [0, 0, 6.5])])
    assert len(bodies(to_manifold(pier))) == 1
    assert pier.volume == pytest.approx(40.0, rel=ROUNDING)


def test_a_union_of_nothing_is_refused() -> None:
    with pytest.raises(GeometryError, match="no solids"):
        union([])


def test_a_union_keeps_double_precision() -> None:
    # Not a single-precision number: through a float32 mesh its volume would be off by 1e-8.
    edge = 1.0 + 1e-9
    assert union([box([edge, 1, 1])]).volume == pytest.approx(edge, rel=ROUNDING)


def test_an_inside_out_solid_is_turned() -> None:
    mesh = box([1, 2, 3]).flipped()
    assert mesh.volume < 0
    assert checked_solid(mesh, "pier").volume == pytest.approx(6.0, rel=ROUNDING)


def test_a_sound_solid_passes_unchanged() -> None:
    mesh = hollow_box()
    checked = checked_solid(mesh, "box girder")
    assert np.array_equal(checked.vertices, mesh.vertices) and np.array_equal(checked.triangles, mesh.triangles)


def broken_solids() -> dict[str, tuple[TriangleMesh, str]]:
    sound = box([1, 1, 1])
    infinite = sound.vertices.copy()
    infinite[0, 0] = np.inf
    one_turned = sound.triangles.copy()
    one_turned[0] = one_turned[0, ::-1]
    flat = sound.vertices * [1, 1, 0]
    two = [Manifold.cube([1, 1, 1], True), Manifold.cube([1, 1, 1], True).translate([0.5, 0.5, 0.5])]
    apart = [two[0], two[0].translate([3, 0, 0])]
    small_turned = from_manifold(*apart).triangles.copy()
    small_turned[12:] = small_turned[12:, ::-1]
    shrunk = from_manifold(apart[0], apart[1].scale([0.5, 0.5, 0.5]))
    return {
        "no faces": (TriangleMesh(sound.vertices, np.zeros((0, 3), dtype=int)), "no faces"),
        "infinite": (TriangleMesh(infinite, sound.triangles), "not finite"),
        "open": (TriangleMesh(sound.vertices, sound.triangles[1:]), "not closed, 3 edges"),
        "one face doubled": (
            TriangleMesh(sound.vertices, np.vstack([sound.triangles, sound.triangles[:1]])),
            "odd number",
        ),
        "one face turned": (TriangleMesh(sound.vertices, one_turned), "some faces look inwards"),
        "flat": (TriangleMesh(flat, sound.triangles), "no volume"),
        "bodies overlap": (from_manifold(*two), "2 separate bodies overlap"),
        "one body inside out": (TriangleMesh(shrunk.vertices, small_turned), "inside out"),
    }


@pytest.mark.parametrize("name", broken_solids())
def test_what_cannot_be_cut_is_refused_with_its_name_and_reason(name: str) -> None:
    mesh, reason = broken_solids()[name]
    with pytest.raises(GeometryError, match=f"deck 3: .*{reason}"):
        checked_solid(mesh, "deck 3")


def test_the_boolean_engine_refuses_an_open_mesh() -> None:
    sound = box([1, 1, 1])
    with pytest.raises(GeometryError, match="pier: not a closed solid"):
        to_manifold(TriangleMesh(sound.vertices, sound.triangles[1:]), "pier")


def test_there_and_back_through_the_boolean_engine_keeps_every_digit() -> None:
    mesh = box([1 / 3, 1 / 7, 1 / 11], [1e-3, 2e-5, 3e-7])
    back = from_manifold(to_manifold(mesh))
    assert np.array_equal(np.unique(back.vertices, axis=0), np.unique(mesh.vertices, axis=0))


def test_a_cavity_belongs_to_the_body_around_it() -> None:
    ball_inside = Manifold.sphere(0.3, 24)
    solid = to_manifold(from_manifold(to_manifold(hollow_box()), ball_inside))
    found = bodies(solid)
    assert sorted(len(shells) for shells in found) == [1, 2]
    volumes = sorted(sum(shell.volume() for shell in shells) for shells in found)
    assert volumes == pytest.approx([ball_inside.volume(), 4 * 4 * 2 - 3 * 3 * 1], rel=ROUNDING)


@pytest.mark.slow
def test_contains_knows_holes_and_cavities() -> None:
    torus = of_trimesh(trimesh.creation.torus(3.0, 1.0))
    points = np.random.default_rng(0).uniform(-4, 4, (2_000, 3))
    distance = np.hypot(np.hypot(points[:, 0], points[:, 1]) - 3.0, points[:, 2])
    # trimesh's torus of 32 x 32 sides lies inside the round one, by at most (1 - cos(π/32)) * 4 m = 0.02 m.
    clear = np.abs(distance - 1.0) > 0.025
    assert np.array_equal(contains(torus, points)[clear], (distance < 1.0)[clear])

    assert contains(hollow_box(), np.array([[0, 0, 0], [1.8, 0, 0], [0, 0, 0.7], [3, 0, 0]])).tolist() == [
        False,
        True,
        True,
        False,
    ]
    assert contains(torus, np.zeros((0, 3))).shape == (0,)
