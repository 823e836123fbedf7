# SPDX-License-Identifier: GPL-3.0-or-later
"""Connections between unit cubes on a grid, whose neighbours, faces and distances can be counted by hand."""

from itertools import product

import numpy as np
import pytest
from support.meshes import moved, together, turned

from bridge_demolition_addon.engineering.fracture.shared_faces import touching_faces
from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.engineering.structure.connections import (
    GROUND,
    Connections,
    connect,
    foundations,
    joined,
    limited,
    neighbours_by_centre,
    neighbours_by_count,
    neighbours_by_face,
    neighbours_by_vertex,
)

# Coordinates of a few metres in double precision.
ROUNDING = 1e-12

GRID = np.array(list(product(range(3), repeat=3)), float)
"""Centres of 27 unit cubes: 3 x 2 x 9 = 54 pairs share a face, 3 x 24 = 72 only an edge, 4 x 8 = 32 only a corner."""


def cubes(centres):
    return [box((1.0, 1.0, 1.0), centre) for centre in centres]


def line(count):
    return np.column_stack((np.arange(count, dtype=float), np.zeros((count, 2))))


def connected_by_face(shards, centres, limit=100):
    faces = touching_faces(shards)
    return connect(centres, faces, *neighbours_by_face(faces), limit)


def lengths(centres, pairs):
    return np.linalg.norm(centres[pairs[:, 1]] - centres[pairs[:, 0]], axis=1)


@pytest.mark.parametrize("radius, count", [(0.99, 0), (1.0, 54), (1.42, 54 + 72), (1.74, 54 + 72 + 32), (10, 27 * 13)])
def test_neighbours_by_centre_in_a_grid(radius, count):
    pairs, distances = neighbours_by_centre(GRID, radius)
    assert len({tuple(pair) for pair in pairs.tolist()}) == len(pairs) == count
    assert (pairs[:, 0] < pairs[:, 1]).all()
    np.testing.assert_allclose(distances, lengths(GRID, pairs), atol=ROUNDING)


def test_neighbours_by_centre_of_more_shards_than_one_block_takes():
    # 2500 x 2500 distances are more than are computed at once.
    pairs, distances = neighbours_by_centre(line(2500), 1.0)
    assert pairs.tolist() == [[index, index + 1] for index in range(2499)]
    assert (distances == 1.0).all()


@pytest.mark.parametrize("radius", (0.0, 0.1, 0.35, 1.0, 20.0))
def test_neighbours_by_vertex_are_those_of_comparing_all_vertices(radius):
    generator = np.random.default_rng(5)
    sizes, positions = generator.uniform(0.05, 0.4, (150, 3)), generator.uniform(-1.0, 1.0, (150, 3))
    shards = [box(size, position) for size, position in zip(sizes, positions, strict=True)]
    corners = np.array([shard.vertices for shard in shards])
    differences = corners[:, None, :, None] - corners[None, :, None, :]
    apart = np.linalg.norm(differences, axis=4).min(axis=(2, 3))
    first, second = np.nonzero(np.triu(apart <= radius, 1))
    pairs, distances = neighbours_by_vertex(shards, radius)
    np.testing.assert_array_equal(pairs, np.column_stack((first, second)))
    np.testing.assert_allclose(distances, apart[first, second], atol=ROUNDING)


def test_neighbours_by_count_in_a_line():
    # At 0, 1, 3, 6 and 10 m: the nearest of each is the one before, and the first one's is the second.
    centres = line(5)
    centres[:, 0] = (0, 1, 3, 6, 10)
    pairs, distances = neighbours_by_count(centres, 1)
    assert pairs.tolist() == [[0, 1], [1, 2], [2, 3], [3, 4]]
    assert distances.tolist() == [1.0, 2.0, 3.0, 4.0]
    # With two, the one at 6 m takes those at 3 and 10, and the one at 10 m those at 6 and 3.
    assert neighbours_by_count(centres, 2)[0].tolist() == [[0, 1], [0, 2], [1, 2], [2, 3], [2, 4], [3, 4]]


@pytest.mark.parametrize("count", (4, 5, 1000))
def test_neighbours_by_count_of_few_shards_are_all(count):
    pairs, _ = neighbours_by_count(np.random.default_rng(0).random((5, 3)), count)
    assert pairs.tolist() == [[i, j] for i in range(5) for j in range(i + 1, 5)]


def test_shards_with_their_centres_in_one_place_are_connected_upwards():
    # A cube in the hollow of a larger one: no face is shared where there is a gap all around.
    hollow = together(box((3.0, 3.0, 3.0)), box((2.0, 2.0, 2.0)))
    shards, centres = [hollow, box((1.0, 1.0, 1.0))], np.zeros((2, 3))
    connections = connect(centres, touching_faces(shards), *neighbours_by_centre(centres, 0.1), 5)
    assert connections.pairs.tolist() == [[0, 1]]
    assert connections.areas.tolist() == [0.0]
    assert connections.normals.tolist() == [[0.0, 0.0, 1.0]]
    assert connections.points.tolist() == [[0.0, 0.0, 0.0]]


def test_neighbours_by_vertex_in_a_grid_are_all_that_touch():
    pairs, distances = neighbours_by_vertex(cubes(GRID), 0.5)
    assert len(pairs) == 54 + 72 + 32
    assert distances.tolist() == [0.0] * len(pairs)
    assert (lengths(GRID, pairs) < 1.74).all()


@pytest.mark.parametrize("radius, apart", [(0.5, {1: 0.0}), (1.0, {1: 0.0, 2: 1.0}), (2.5, {1: 0.0, 2: 1.0, 3: 2.0})])
def test_neighbours_by_vertex_in_a_line(radius, apart):
    # Between cubes that lie k places apart there is room for k - 1 cubes.
    pairs, distances = neighbours_by_vertex(cubes(line(6)), radius)
    expected = {(i, i + k): distance for k, distance in apart.items() for i in range(6 - k)}
    assert dict(zip(map(tuple, pairs.tolist()), distances.tolist(), strict=True)) == expected


def test_boxes_that_come_near_while_their_vertices_do_not():
    # A small cube on the middle of a large slab: 0 m between the boxes, sqrt(4.5² + 4.5² + 0) between vertices.
    slab, cube = box((10.0, 10.0, 1.0), (0.0, 0.0, -0.5)), box((1.0, 1.0, 1.0), (0.0, 0.0, 0.5))
    assert len(neighbours_by_vertex([slab, cube], 6.3)[0]) == 0
    pairs, distances = neighbours_by_vertex([slab, cube], 6.4)
    assert pairs.tolist() == [[0, 1]]
    assert distances == pytest.approx([40.5**0.5], abs=ROUNDING)


def test_connections_by_face_in_a_grid():
    connections = connected_by_face(cubes(GRID), GRID)
    first, second = GRID[connections.pairs].swapaxes(0, 1)
    assert len(connections) == 54
    # Neighbours in a grid of unit cubes: 1 m² half-way between the centres, at right angles to the way across.
    np.testing.assert_allclose(connections.areas, 1.0, atol=ROUNDING)
    np.testing.assert_allclose(connections.points, (first + second) / 2.0, atol=ROUNDING)
    np.testing.assert_allclose(connections.normals, second - first, atol=ROUNDING)


def test_a_connection_sits_in_the_middle_of_the_shared_face():
    # The cube stands on the slab's corner, so that the face lies far from half-way between the centres.
    slab, cube = box((4.0, 4.0, 1.0), (0.0, 0.0, -0.5)), box((1.0, 2.0, 3.0), (1.5, 1.0, 1.5))
    connections = connected_by_face([slab, cube], np.array([[0.0, 0.0, -0.5], [1.5, 1.0, 1.5]]))
    assert connections.pairs.tolist() == [[0, 1]]
    assert connections.areas == pytest.approx([2.0], abs=ROUNDING)
    np.testing.assert_allclose(connections.points, [[1.5, 1.0, 0.0]], atol=ROUNDING)
    np.testing.assert_allclose(connections.normals, [[0.0, 0.0, 1.0]], atol=ROUNDING)


def test_neighbours_that_share_no_face_are_connected_half_way():
    centres = line(3)
    connections = connect(centres, touching_faces(cubes(centres)), *neighbours_by_vertex(cubes(centres), 1.0), 9)
    assert connections.pairs.tolist() == [[0, 1], [0, 2], [1, 2]]
    assert connections.areas == pytest.approx([1.0, 0.0, 1.0], abs=ROUNDING)
    np.testing.assert_allclose(connections.points[:, 0], [0.5, 1.0, 1.5], atol=ROUNDING)
    np.testing.assert_allclose(connections.normals, [[1.0, 0.0, 0.0]] * 3, atol=ROUNDING)


def test_limit_keeps_the_nearest():
    # Three places at 0, 2 and 3 m.
    pairs, distances = np.array([[0, 1], [0, 2], [1, 2]]), np.array([2.0, 3.0, 1.0])
    assert limited(pairs, distances, 1, 3).tolist() == [[1, 2]]
    assert sorted(limited(pairs, distances, 2, 3).tolist()) == pairs.tolist()


def test_limit_among_equals_does_not_depend_on_their_order():
    pairs, distances = neighbours_by_centre(GRID, 1.8)
    shuffled = np.random.default_rng(3).permutation(len(pairs))
    kept = limited(pairs, distances.round(9), 5, 27)
    assert limited(pairs[shuffled], distances[shuffled].round(9), 5, 27).tolist() == kept.tolist()


def test_limit_holds_and_leaves_out_no_pair_without_need():
    pairs, distances = neighbours_by_centre(GRID, 1.8)
    kept = limited(pairs, distances, 4, 27)
    counts = np.bincount(kept.ravel(), minlength=27)
    assert counts.max() == 4
    left_out = {tuple(pair) for pair in pairs.tolist()} - {tuple(pair) for pair in kept.tolist()}
    assert left_out
    assert all(counts[list(pair)].max() == 4 for pair in left_out)


def test_foundations_of_cubes_on_and_above_the_ground():
    centres = GRID + 0.5
    standing = foundations(cubes(centres))
    assert standing.pairs.tolist() == [
        [index, GROUND] for index in range(0, 27, 3)
    ]  # every third is in the lowest layer
    np.testing.assert_allclose(standing.areas, 1.0, atol=ROUNDING)
    np.testing.assert_allclose(standing.points, centres[::3] * (1, 1, 0), atol=ROUNDING)
    assert standing.normals.tolist() == [[0, 0, -1]] * 9


def test_foundation_of_a_shard_on_two_feet_is_between_them():
    # Feet of 1 and 3 m² at x = 0 and 4 m: the centre of the standing area is 3/4 of the way.
    feet = [box((1.0, 1.0, 2.0), (0.0, 0.0, 1.0)), box((1.0, 3.0, 2.0), (4.0, 0.0, 1.0))]
    standing = foundations([together(*feet)])
    assert standing.areas == pytest.approx([4.0], abs=ROUNDING)
    np.testing.assert_allclose(standing.points, [[3.0, 0.0, 0.0]], atol=ROUNDING)


@pytest.mark.parametrize("height, count", [(0.0, 1), (1e-7, 1), (9e-4, 1), (-9e-4, 1), (2e-3, 0), (-2e-3, 0)])
def test_a_shard_stands_on_the_ground_within_a_millimetre(height, count):
    assert len(foundations([box((1.0, 1.0, 1.0), (0.0, 0.0, 0.5 + height))])) == count


def test_a_shard_on_its_edge_does_not_stand():
    tilted = turned(box((1.0, 1.0, 1.0)), np.pi / 4, (1, 0, 0))
    assert len(foundations([moved(tilted, (0.0, 0.0, -tilted.bounds[0, 2]))])) == 0


def shapes(connections):
    return [array.shape for array in (connections.pairs, connections.points, connections.areas, connections.normals)]


@pytest.mark.parametrize("centres", [np.zeros((0, 3)), np.array([[5.0, 5.0, 5.0]]), line(2) * 10], ids=len)
def test_shards_without_neighbours_give_empty_arrays_of_the_right_shape(centres):
    shards, empty = cubes(centres), [(0, 2), (0, 3), (0,), (0, 3)]
    faces = touching_faces(shards)
    for neighbours in (
        neighbours_by_face(faces),
        neighbours_by_centre(centres, 1.0),
        neighbours_by_vertex(shards, 1.0),
        neighbours_by_count(centres[:1], 3),
    ):
        between = connect(centres, faces, *neighbours, 5)
        assert shapes(between) == empty
        assert between.pairs.dtype.kind == "i"
    assert shapes(foundations(cubes(centres + 5.0))) == empty


def test_joined_keeps_order_and_rows_together():
    first, second = connected_by_face(cubes(line(3)), line(3)), foundations(cubes(line(2) + 0.5))
    both = joined([first, second])
    assert len(both) == 4
    assert both.pairs.tolist() == [[0, 1], [1, 2], [0, GROUND], [1, GROUND]]
    assert both.normals[[0, 3]].tolist() == [[1, 0, 0], [0, 0, -1]]
    nothing = Connections(np.zeros((0, 2), int), np.zeros((0, 3)), np.zeros(0), np.zeros((0, 3)))
    assert joined([both, nothing]).pairs.tolist() == both.pairs.tolist()
