# SPDX-License-Identifier: GPL-3.0-or-later
"""Neighbours found in the cells of a grid are those that comparing all with all finds."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.geometry.proximity import (
    blocks,
    boxes_that_meet,
    nearest_points,
    points_within,
)


def uniform(count):
    return np.random.default_rng(count).uniform(-5.0, 5.0, (count, 3))


def clustered():
    """Two dense clusters of different size far apart, and points alone between them."""
    generator = np.random.default_rng(2)
    clusters = [generator.normal(0.0, 0.01, (200, 3)), generator.normal(1000.0, 1.0, (100, 3))]
    return np.concatenate((*clusters, generator.uniform(0.0, 1000.0, (50, 3))))


PLACES = {
    "none": np.zeros((0, 3)),
    "one": np.ones((1, 3)),
    "two": uniform(2),
    "in space": uniform(400),
    "in a plane": uniform(300) * (1, 1, 0),
    "in a line": uniform(300) * (0, 1, 0),
    "in one place": np.full((50, 3), 7.0),
    "in a grid": np.array(np.meshgrid(*[np.arange(7.0)] * 3)).reshape(3, -1).T,
    "far from the origin": uniform(300) + 1e6,
    "clustered": clustered(),
}


def all_distances(points):
    return np.linalg.norm(points[:, None] - points[None], axis=2)


@pytest.mark.parametrize("radius", (0.0, 1e-9, 0.5, 1.0, 3.0, 1e4))
@pytest.mark.parametrize("points", PLACES.values(), ids=PLACES)
def test_points_within(points, radius):
    apart = all_distances(points)
    expected = np.argwhere(np.triu(apart <= radius, 1))
    pairs, distances = points_within(points, radius)
    np.testing.assert_array_equal(pairs, expected)
    np.testing.assert_array_equal(distances, apart[tuple(expected.T)])


@pytest.mark.parametrize("count", (1, 2, 8, 30, 1000))
@pytest.mark.parametrize("points", PLACES.values(), ids=PLACES)
def test_nearest_points(points, count):
    apart = all_distances(points)
    np.fill_diagonal(apart, np.inf)
    expected = np.argsort(apart, axis=1, kind="stable")[:, : min(count, max(len(points) - 1, 0))]
    indices, distances = nearest_points(points, count)
    np.testing.assert_array_equal(indices, expected)
    np.testing.assert_array_equal(distances, np.take_along_axis(apart, expected, axis=1))


@pytest.mark.parametrize("distance", (0.0, 0.2, 5.0))
@pytest.mark.parametrize("largest", (0.01, 0.5, 8.0))
@pytest.mark.parametrize("points", PLACES.values(), ids=PLACES)
def test_boxes_that_meet(points, largest, distance):
    # Sizes over three powers of ten, so that some boxes reach into many cells.
    sizes = largest * 10.0 ** np.random.default_rng(1).uniform(-3.0, 0.0, points.shape)
    lower, upper = points - sizes / 2.0, points + sizes / 2.0
    reach = (lower[:, None] <= upper[None] + distance).all(axis=2)
    expected = np.argwhere(np.triu(reach & reach.T, 1))
    found = boxes_that_meet(lower, upper, distance)
    np.testing.assert_array_equal(found, expected)


def test_one_box_around_thousands_meets_them_all_and_no_more():
    points = np.array(np.meshgrid(*[np.arange(14.0)] * 3)).reshape(3, -1).T
    lower, upper = np.vstack(([-1.0] * 3, points)), np.vstack(([15.0] * 3, points + 0.5))
    assert boxes_that_meet(lower, upper).tolist() == [[0, box] for box in range(1, 1 + 14**3)]


@pytest.mark.parametrize("counts", ([], [5], [5_000_000], [10] * 7, [3_000_000, 1, 1, 3_000_000], [1_000_000] * 9))
def test_blocks_take_every_row_once_and_in_order(counts):
    parts = list(blocks(np.array(counts, int)))
    assert [row for part in parts for row in range(part.start, part.stop)] == list(range(len(counts)))
    assert all(sum(counts[part]) <= 2_000_000 or part.stop - part.start == 1 for part in parts)
