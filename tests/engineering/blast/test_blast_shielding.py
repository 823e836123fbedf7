# SPDX-License-Identifier: GPL-3.0-or-later
"""Shielding: walls, gaps and rows of boxes, and rays walked point by point."""

import numpy as np
import pytest
from support.long_cases import long_but

from bridge_demolition_addon.engineering.blast import exposure
from bridge_demolition_addon.engineering.blast.exposure import visible_shares
from bridge_demolition_addon.engineering.geometry.hulls import convex_hulls

CUBE = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
WALL = CUBE * [0.2, 6.0, 6.0]


def upright(count):
    return np.tile(np.eye(3), (count, 1, 1))


def shares(bodies, centres, sources, rotations=None):
    centres = np.array(centres, float)
    rotations = upright(len(bodies)) if rotations is None else rotations
    return visible_shares(convex_hulls(bodies), centres, rotations, np.array(sources, float).reshape(-1, 3)).tolist()


def test_a_wall_hides_what_is_behind_it():
    # A wall at x = 2, a cube behind it and one beside it.
    centres = [[2, 0, 0], [5, 0, 0], [5, 9, 0]]
    assert shares([WALL, CUBE, CUBE], centres, [-9, 0.7, 0]) == [[1.0], [0.0], [1.0]]


def test_a_post_hides_only_what_is_right_behind_it():
    # Of nine rays to the wall the post stops the one to the middle; the others end 1.5 m to the sides.
    post = CUBE * [0.5, 0.5, 1.0]
    assert shares([post, WALL], [[2, 0, 0], [5, 0, 0]], [-20, 0, 0]) == [[1.0], [pytest.approx(8.0 / 9.0)]]


def test_an_edge_hides_half():
    # The wall covers y < 0: of nine rays, four end at y = -0.25, four at 0.25, and one at 0.01 in the middle.
    centres = [[2.0, -3.0, 0.0], [5.0, 0.01, 0.0]]
    assert shares([WALL, CUBE], centres, [-500.0, 0.0, 0.0])[1] == [pytest.approx(5.0 / 9.0)]


def test_each_charge_sees_for_itself():
    found = shares([WALL, CUBE], [[2, 0, 0], [5, 0, 0]], [[0, 0, 0], [9, 0, 0], [5, 7, 0]])
    assert found[1] == [0.0, 1.0, 1.0]
    # Seen from behind, the cube covers the middle of the wall and no more.
    assert found[0] == [1.0, pytest.approx(8.0 / 9.0), 1.0]


def test_the_first_of_a_row_of_touching_cubes_hides_the_others():
    centres = [[x, 0, 0] for x in range(6)]
    assert shares([CUBE] * 6, centres, [-30, 0, 0]) == [[1.0]] + [[0.0]] * 5


def test_a_ray_between_touching_cubes_is_free():
    # Between two rows of cubes that touch at y = 0 the ray to the middle grazes all and enters none.
    centres = [[x, y, 0] for x in range(4) for y in (-0.5, 0.5)] + [[8, 0, 0]]
    assert shares([CUBE] * 9, centres, [-3, 0, 0])[-1] == [pytest.approx(1.0 / 9.0)]
    assert shares([CUBE] * 9, centres, [-3, 0.01, 0])[-1] == [0.0]


def test_the_body_around_a_charge_hides_nothing():
    centres = [[0, 0, 0], [2, 0, 0], [4, 0, 0]]
    for source in ([0.1, 0.1, 0.0], [0.0, 0.0, 0.0], [0.5, 0.0, 0.0]):
        assert shares([CUBE] * 3, centres, source) == [[1.0], [1.0], [0.0]]


def test_shields_turn_with_their_rotation():
    # Turned by a right angle about z, the wall lies along the rays, and 2 m off them.
    quarter = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    centres = [[2, 2, 0], [5, 0, 0]]
    assert shares([WALL, CUBE], centres, [-9, 0, 0])[1] == [0.0]
    assert shares([WALL, CUBE], centres, [-9, 0, 0], np.array([quarter, np.eye(3)]))[1] == [1.0]


def test_targets_turn_with_their_rotation():
    # A beam of 8 m behind a wall of 6 m: along the wall it is hidden, along the rays and upright it looks out.
    beam = CUBE * [0.2, 8.0, 0.2]
    about_x = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
    low_wall = CUBE * [0.2, 6.0, 1.0]
    centres = [[2, 0, 0], [3, 0, 0]]
    assert shares([low_wall, beam], centres, [-50, 0, 0])[1] == [0.0]
    upright_beam = np.array([np.eye(3), about_x])
    assert shares([low_wall, beam], centres, [-50, 0, 0], upright_beam)[1] == [pytest.approx(8.0 / 9.0)]


def test_what_lies_behind_the_target_or_the_charge_hides_nothing():
    centres = [[5, 0, 0], [9, 0, 0], [-3, 0, 0]]
    assert shares([CUBE, WALL, WALL], centres, [0, 0, 0])[0] == [1.0]


def walked(bodies, centres, rotations, source):
    """The same by looking at 4000 points of every ray."""
    hulls = convex_hulls(bodies)
    parts = np.linspace(0.0, 1.0, 4001)[:, None]
    result = []
    for body, centre in enumerate(centres):
        ends = [centre] + [centre + 0.5 * rotations[body] @ vertex for vertex in _hull_vertices(hulls, body)]
        rays = [source + parts * (end - source) for end in ends]
        free = [
            not any(_enters(hulls, centres, rotations, ray, other) for other in _others(body, bodies)) for ray in rays
        ]
        result.append(np.mean(free))
    return result


def _others(body, bodies):
    return [other for other in range(len(bodies)) if other != body]


def _hull_vertices(hulls, body):
    return hulls.vertices[hulls.vertex_starts[body] : hulls.vertex_starts[body + 1]]


def _enters(hulls, centres, rotations, points, body):
    faces = hulls.bodies == body
    local = (points - centres[body]) @ rotations[body]
    outside_by = (local @ hulls.normals[faces].T - hulls.offsets[faces]).max(axis=1)
    return outside_by[0] > 0.0 and (outside_by <= -1e-3).any()


@pytest.mark.slow
@pytest.mark.parametrize("at_once", long_but([70], [70, 10_000, 1_000_000]))
def test_random_bodies_against_rays_walked_point_by_point(at_once, monkeypatch):
    monkeypatch.setattr(exposure, "PAIRS_AT_ONCE", at_once)
    random = np.random.default_rng(12)
    count = 14
    bodies = [random.normal(size=(10, 3)) for _ in range(count)]
    bodies = [vertices - vertices.mean(axis=0) for vertices in bodies]
    centres = random.uniform(-5.0, 5.0, (count, 3))
    rotations = np.linalg.qr(random.normal(size=(count, 3, 3)))[0]
    rotations *= np.sign(np.linalg.det(rotations))[:, None, None]
    sources = np.array([[0.0, 0.0, 0.0], [-12.0, 0.0, 3.0], centres[4] + 0.01])
    found = visible_shares(convex_hulls(bodies), centres, rotations, sources)
    expected = np.column_stack([walked(bodies, centres, rotations, source) for source in sources])
    assert found == pytest.approx(expected)
    assert 0.2 < found.mean() < 0.8


def test_no_bodies_and_no_charges():
    assert shares([], np.zeros((0, 3)), [0, 0, 0]) == []
    assert shares([CUBE], [[0, 0, 0]], []) == [[]]
