# SPDX-License-Identifier: GPL-3.0-or-later
"""Convex hulls and projected areas against shapes whose shadows are known."""

from dataclasses import replace

import numpy as np
import pytest
from reference import blast as reference

from bridge_demolition_addon.engineering.blast.exposure import UPWARDS, lines_of_blast, projected_areas
from bridge_demolition_addon.engineering.geometry.hulls import convex_hulls
from bridge_demolition_addon.engineering.geometry.vectors import rotated, unit
from bridge_demolition_addon.errors import GeometryError

CUBE = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
BOX = CUBE * [2.0, 3.0, 5.0]
CORNER = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]) - 0.25
"""A tetrahedron with three faces of 1/2 m² along the planes of coordinates and one of √3/2, about its centre."""


def turned(axis, degrees):
    """Rotation matrix about a coordinate axis."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    matrix = np.eye(3)
    matrix[i, i] = matrix[j, j] = c
    matrix[i, j], matrix[j, i] = -s, s
    return matrix


def area(vertices, direction, rotation=None):
    """Projected area of one body along one direction of any length."""
    direction = np.asarray(direction, float) / np.linalg.norm(direction)
    rotations = np.eye(3)[None] if rotation is None else rotation[None]
    return projected_areas(convex_hulls([vertices]), rotations, direction[None, None]).item()


def test_a_cube_has_six_faces():
    hulls = convex_hulls([CUBE])
    assert len(hulls.areas) == 6
    assert hulls.areas.tolist() == [1.0] * 6
    assert hulls.offsets.tolist() == [0.5] * 6
    assert abs(hulls.normals).sum(axis=0).tolist() == [2.0, 2.0, 2.0]
    assert hulls.normals.sum(axis=0).tolist() == [0.0, 0.0, 0.0]
    assert hulls.radii == pytest.approx([np.sqrt(0.75)])


def test_faces_of_all_bodies_follow_each_other():
    hulls = convex_hulls([CUBE, CORNER, BOX])
    assert hulls.starts.tolist() == [0, 6, 10, 16]
    assert hulls.bodies.tolist() == [0] * 6 + [1] * 4 + [2] * 6
    assert hulls.areas[6:10].sum() == pytest.approx(1.5 + np.sqrt(3.0) / 2.0)
    assert len(hulls) == 3


def test_points_inside_and_doubled_change_no_hull():
    inside = np.concatenate((CUBE, CUBE, [[0.0, 0.1, 0.2], [0.5, 0.0, 0.0]]))
    assert convex_hulls([inside]).areas.sum() == pytest.approx(6.0)
    assert area(inside, [1.0, 1.0, 1.0]) == pytest.approx(np.sqrt(3.0))


@pytest.mark.parametrize("flat", [CUBE * [1, 1, 0], CUBE[:3], np.zeros((5, 3)), CUBE[:0], CUBE * np.nan])
def test_bodies_without_volume_are_refused(flat):
    with pytest.raises(GeometryError, match="body 1 has no volume"):
        convex_hulls([CUBE, flat])


@pytest.mark.parametrize(
    "vertices, direction, expected",
    [
        (CUBE, [1, 0, 0], 1.0),
        (CUBE, [0, 0, -1], 1.0),
        (CUBE, [1, 1, 0], np.sqrt(2.0)),
        (CUBE, [-1, 1, 1], np.sqrt(3.0)),
        (BOX, [1, 0, 0], 15.0),
        (BOX, [0, -1, 0], 10.0),
        (BOX, [1, 2, 2], (1 * 15 + 2 * 10 + 2 * 6) / 3.0),
        (CORNER, [1, 0, 0], 0.5),
        (CORNER, [0, 0, -1], 0.5),
        (CORNER, [1, 1, 1], np.sqrt(3.0) / 2.0),
        (CORNER, [1, -1, 0], 0.5 / np.sqrt(2.0)),
    ],
)
def test_shadows_of_known_shapes(vertices, direction, expected):
    # Sums of some faces, each rounded.
    assert area(vertices, direction) == pytest.approx(expected, rel=1e-14)


def test_the_area_follows_the_rotation():
    assert area(CUBE, [1, 0, 0], turned("z", 45.0)) == pytest.approx(np.sqrt(2.0))
    assert area(CUBE, [0, 0, 1], turned("z", 45.0)) == pytest.approx(1.0)
    # A quarter turn about z puts the side of 3 × 5 where that of 2 × 5 was.
    assert area(BOX, [1, 0, 0], turned("z", 90.0)) == pytest.approx(10.0)
    # Turned about x, the box shows 15 m² whatever the angle.
    assert area(BOX, [1, 0, 0], turned("x", 33.0)) == pytest.approx(15.0)
    # Turned by 30° about y, 2 × 3 × 5 shows 15 cos 30° + 6 sin 30° along x.
    assert area(BOX, [1, 0, 0], turned("y", 30.0)) == pytest.approx(15.0 * np.sqrt(0.75) + 3.0)


def random_bodies(count=40, charges=5, seed=3):
    random = np.random.default_rng(seed)
    hulls = convex_hulls([random.normal(size=(random.integers(4, 30), 3)) for _ in range(count)])
    rotations = np.linalg.qr(random.normal(size=(count, 3, 3)))[0]
    rotations *= np.sign(np.linalg.det(rotations))[:, None, None]
    directions = random.normal(size=(count, charges, 3))
    return hulls, rotations, directions / np.linalg.norm(directions, axis=2)[..., None]


def test_faces_turned_to_the_source_are_half_of_all():
    hulls, rotations, directions = random_bodies()
    # Faces of a closed surface add up to nothing: what faces the source is as much as what does not.
    normals = np.einsum("fij,fj->fi", rotations[hulls.bodies], hulls.normals)
    towards = np.maximum(-np.einsum("fi,fci->fc", normals, directions[hulls.bodies]), 0.0) * hulls.areas[:, None]
    facing = np.add.reduceat(towards, hulls.starts[:-1])
    np.testing.assert_allclose(facing, projected_areas(hulls, rotations, directions), rtol=1e-12)


@pytest.mark.parametrize("seed", range(3))
def test_areas_are_those_of_the_reference(seed):
    rng = np.random.default_rng(seed)
    hulls = convex_hulls([rng.normal(size=(count, 3)) for count in (4, 6, 20, 45, 300, 8, 12)])
    turns = rotated(np.tile(np.eye(3), (7, 1, 1)), rng.normal(size=(7, 3)))
    directions = unit(rng.normal(size=(7, 40, 3)))
    found = projected_areas(hulls, turns, directions)
    assert hulls.most_faces > 30
    np.testing.assert_array_equal(found, reference.projected_areas(hulls, turns, directions))


def test_hulls_that_do_not_fit_are_not_read():
    hulls, rotations, directions = random_bodies()
    with pytest.raises(ValueError, match="rotations has"):
        projected_areas(hulls, rotations[1:], directions)
    starts = hulls.starts.copy()
    starts[-1] += 1
    with pytest.raises(ValueError, match="rows that there are not"):
        projected_areas(replace(hulls, starts=starts), rotations, directions)


def test_all_bodies_together_are_all_bodies_one_by_one():
    hulls, rotations, directions = random_bodies()
    together = projected_areas(hulls, rotations, directions)
    for body in range(len(hulls)):
        faces = hulls.bodies == body
        normals = hulls.normals[faces] @ rotations[body].T
        for charge in range(directions.shape[1]):
            alone = 0.5 * (abs(normals @ directions[body, charge]) * hulls.areas[faces]).sum()
            assert together[body, charge] == pytest.approx(alone, rel=1e-13)


def test_the_mean_shadow_is_a_quarter_of_the_surface():
    # Cauchy 1832; 20 000 random directions scatter by about 1/√20000 of a spread of 10 %.
    random = np.random.default_rng(8)
    directions = random.normal(size=(1, 20_000, 3))
    directions /= np.linalg.norm(directions, axis=2)[..., None]
    mean = projected_areas(convex_hulls([BOX]), np.eye(3)[None], directions).mean()
    assert mean == pytest.approx(62.0 / 4.0, rel=0.005)


def test_lines_of_blast_go_from_each_source_to_each_body():
    sources, centres = np.array([[0.0, 0.0, 0.0], [3.0, 4.0, 0.0]]), np.array([[3.0, 0.0, 0.0], [3.0, 4.0, 12.0]])
    stand_offs, directions = lines_of_blast(sources, centres)
    assert stand_offs.tolist() == [[3.0, 4.0], [13.0, 12.0]]
    assert directions[0].tolist() == [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0]]
    assert directions[1, 1].tolist() == [0.0, 0.0, 1.0]
    np.testing.assert_allclose(directions[1, 0], np.array([3.0, 4.0, 12.0]) / 13.0, rtol=1e-15)


def test_a_charge_in_the_very_centre_pushes_upwards():
    stand_offs, directions = lines_of_blast(np.array([[1.0, 2.0, 3.0]]), np.array([[1.0, 2.0, 3.0], [1.0, 2.0, 2.0]]))
    assert stand_offs.tolist() == [[0.0], [1.0]]
    assert directions[0, 0].tolist() == UPWARDS.tolist()
    assert directions[1, 0].tolist() == [0.0, 0.0, -1.0]
    assert UPWARDS.tolist() == [0.0, 0.0, 1.0]  # not written into


def test_no_bodies_and_no_charges():
    none = convex_hulls([])
    assert projected_areas(none, np.zeros((0, 3, 3)), np.zeros((0, 2, 3))).shape == (0, 2)
    assert projected_areas(convex_hulls([CUBE]), np.eye(3)[None], np.zeros((1, 0, 3))).shape == (1, 0)
    stand_offs, directions = lines_of_blast(np.zeros((0, 3)), np.zeros((4, 3)))
    assert (stand_offs.shape, directions.shape) == ((4, 0), (4, 0, 3))
