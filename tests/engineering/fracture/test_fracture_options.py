# SPDX-License-Identifier: GPL-3.0-or-later
"""Options of the fracture: volumes stay exact, and each does what it says."""

import numpy as np
import pytest
import trimesh
from manifold3d import Manifold
from support.meshes import as_trimesh

from bridge_demolition_addon.engineering.fracture.gaps import with_gaps
from bridge_demolition_addon.engineering.fracture.options import (
    FractureOptions,
    PointDensity,
    Recursion,
    density_around,
    painted_density,
)
from bridge_demolition_addon.engineering.fracture.seeds import random_points
from bridge_demolition_addon.engineering.fracture.shards import fracture, voronoi_cells
from bridge_demolition_addon.engineering.geometry.mesh import volumes_and_centres
from bridge_demolition_addon.engineering.geometry.overlap import overlaps
from bridge_demolition_addon.engineering.geometry.solids import bodies, box, contains, from_manifold, to_manifold, union
from bridge_demolition_addon.errors import GeometryError

pytestmark = pytest.mark.slow

# What the project promises for sums of volumes.
VOLUME = 1e-9

SOLIDS = {
    "slab": box([12, 6, 0.5]),
    "L": union([box([4, 1, 1]), box([1, 1, 4], [-1.5, 0, 1.5])]),
    "tube": from_manifold(Manifold.cube([8, 2, 2], True) - Manifold.cube([9, 1.4, 1.4], True)),
}
OPTIONS = {
    "density": FractureOptions(density=density_around([[1, 0, 0]], [2], [20])),
    "noise": FractureOptions(noise=0.7),
    "stretch": FractureOptions(stretch=(4, 1, 0.5)),
    "recursion": FractureOptions(recursion=Recursion(0.4, 3)),
    "all": FractureOptions(density_around([[1, 0, 0]], [2], [20]), 0.5, (1, 3, 1), Recursion(0.5, 4, 1e-6)),
}


def volumes_of(shards):
    return volumes_and_centres(shards)[0]


@pytest.mark.parametrize("option", OPTIONS)
@pytest.mark.parametrize("name", SOLIDS)
def test_volumes_are_exact_with_every_option(name, option):
    result = fracture(SOLIDS[name], 40, seed=2, options=OPTIONS[option])
    assert result.volumes.sum() == pytest.approx(SOLIDS[name].volume, rel=VOLUME)
    assert (result.volumes > 0).all()
    assert len(overlaps(result.shards)) == 0
    for shard in result.shards:
        assert len(bodies(to_manifold(shard))) == 1
    # The surface of all shards is the solid's and both sides of all common faces, but for the smallest.
    surface = sum(trimesh.triangles.area(shard.corners).sum() for shard in result.shards)
    assert surface == pytest.approx(as_trimesh(SOLIDS[name]).area + 2 * result.faces.areas.sum(), rel=1e-7)
    assert (result.faces.pairs[:, 0] < result.faces.pairs[:, 1]).all()
    assert np.array_equal(result.faces.pairs, np.unique(result.faces.pairs, axis=0))


@pytest.mark.parametrize("option", OPTIONS)
def test_the_same_seed_gives_the_same_shards(option):
    one, again, other = (fracture(SOLIDS["L"], 25, seed=seed, options=OPTIONS[option]) for seed in (1, 1, 2))
    assert np.array_equal(one.volumes, again.volumes)
    assert one.volumes.shape != other.volumes.shape or not np.array_equal(one.volumes, other.volumes)


def test_options_that_say_nothing_change_nothing():
    plain = fracture(SOLIDS["L"], 25, seed=1)
    same = fracture(SOLIDS["L"], 25, seed=1, options=FractureOptions(stretch=(1, 1, 1), recursion=Recursion(0.0, 4)))
    assert np.array_equal(plain.volumes, same.volumes) and np.array_equal(plain.points, same.points)


def test_stretched_cells_of_two_points():
    # Between (0, 0) and (2, 2) the cut stands at right angles to (2/4, 2/1) in the squeezed space (x / 2, y):
    # x / 2 * 1 + y * 2 = const, through the middle (1, 1): x / 4 + y = 5 / 4... with weights 1 / stretch²: x/4 + y.
    solid = box([4, 4, 1], [1, 1, 0])
    result = voronoi_cells(solid, [[0, 0, 0], [2, 2, 0]], options=FractureOptions(stretch=(2, 1, 1)))
    normal = np.array([0.25, 1, 0]) / np.hypot(0.25, 1)
    np.testing.assert_allclose(result.faces.normals, [normal], atol=1e-12)
    np.testing.assert_allclose(result.volumes, [8, 8], rtol=1e-12)
    # From x = -1 to 3 the cut runs over its whole length: 4 m times the slope's.
    np.testing.assert_allclose(result.faces.areas, [4 * np.hypot(1, 0.25)], rtol=1e-12)


def test_stretch_lengthens_shards_by_as_much():
    lengths = {}
    for stretch in (1.0, 3.0):
        shards = fracture(box([30, 30, 30]), 300, seed=5, options=FractureOptions(stretch=(stretch, 1, 1))).shards
        sizes = np.array([np.ptp(shard.vertices, axis=0) for shard in shards])
        lengths[stretch] = np.median(sizes[:, 0] / np.sqrt(sizes[:, 1] * sizes[:, 2]))
    # Cells at the sides are cut off, so somewhat less than 3.
    assert lengths[3.0] / lengths[1.0] == pytest.approx(3, rel=0.15)


def test_recursion_cuts_as_many_as_asked_for():
    first = fracture(SOLIDS["slab"], 30, seed=1)
    again = fracture(SOLIDS["slab"], 30, seed=1, options=FractureOptions(recursion=Recursion(0.5, 4)))
    assert len(again) == 15 + 15 * 4
    kept = [volume for volume in first.volumes if (again.volumes == volume).any()]
    assert len(kept) == 15
    smallest = float(np.sort(first.volumes)[-6])  # only the six largest are large enough
    large = fracture(SOLIDS["slab"], 30, seed=1, options=FractureOptions(recursion=Recursion(1.0, 2, smallest)))
    assert len(large) == 24 + 6 * 2
    assert (large.volumes < np.sort(first.volumes)[-7] * (1 + 1e-9)).sum() >= 24


def test_recursion_keeps_everything_connected():
    result = fracture(SOLIDS["tube"], 20, seed=3, options=FractureOptions(recursion=Recursion(0.6, 5)))
    label = np.arange(len(result))
    for _ in range(len(result)):
        for first, second in result.faces.pairs:
            label[[first, second]] = label[[first, second]].min()
    assert not label.any()


def test_noise_moves_given_points_and_keeps_them_inside():
    grid = np.stack(np.meshgrid(np.arange(-5.5, 6), np.arange(-2.5, 3), [0.0], indexing="ij"), axis=-1).reshape(-1, 3)
    size = np.cbrt(12 * 6 * 0.5 / len(grid))
    for noise in (0.1, 1.0):
        moved = voronoi_cells(SOLIDS["slab"], grid, seed=1, options=FractureOptions(noise=noise)).points
        apart = np.linalg.norm(moved - grid, axis=1)
        assert contains(SOLIDS["slab"], moved).all()
        assert 0.5 * noise * size < apart.max() <= noise * size


def test_density_around_a_place():
    density = density_around([[0, 0, 0], [10, 0, 0]], [2, 1], [5, 3])
    at = density.at(np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [5, 0, 0], [10, 0, 0.5]]))
    assert at.tolist() == [5, 3, 1, 1, 2] and density.largest == 5


def test_points_follow_the_density():
    # 9 times as dense in the left half of a bar as in the right one.
    halves = PointDensity(lambda points: np.where(points[:, 0] < 0, 9.0, 1.0), 9.0)
    points = random_points(box([2, 1, 1]), 10_000, np.random.default_rng(0), halves)
    # 0.9 of them, give or take four deviations.
    assert (points[:, 0] < 0).mean() == pytest.approx(0.9, abs=4 * np.sqrt(0.9 * 0.1 / 10_000))


def test_shards_are_smaller_near_the_place():
    options = FractureOptions(density=density_around([[-6, 0, 0]], [4], [30]))
    result = fracture(SOLIDS["slab"], 300, seed=1, options=options)
    near = np.linalg.norm(result.centres - [-6, 0, 0], axis=1) < 1
    far = np.linalg.norm(result.centres - [-6, 0, 0], axis=1) > 4
    assert np.median(result.volumes[near]) < np.median(result.volumes[far]) / 5


def test_painted_density():
    painted = painted_density([[0, 0, 0], [4, 0, 0]], [1, 0], 10)
    at = painted.at(np.array([[0, 0, 0], [4, 0, 0], [2, 0, 0], [1, 0, 0]]))
    # Inverse squares: in the middle half the paint, at a quarter 9 to 1.
    assert at == pytest.approx([10, 1, 5.5, 1 + 9 * 0.9], rel=1e-9)
    assert len(painted.at(np.zeros((0, 3)))) == 0
    for points, weights, factor in (
        ([], [], 2),
        ([[0, 0, 0]], [1, 1], 2),
        ([[0, 0, 0]], [1.5], 2),
        ([[0, 0, 0]], [1], 0),
    ):
        with pytest.raises(GeometryError):
            painted_density(points, weights, factor)


@pytest.mark.parametrize("name", SOLIDS)
def test_gaps_are_as_wide_as_asked_and_the_surface_stays(name):
    whole = fracture(SOLIDS[name], 30, seed=2)
    gap = 0.01
    apart = with_gaps(whole.shards, SOLIDS[name], gap)
    # To first order half a gap is lost on either side of every common face; edges where gaps meet count twice.
    lost = SOLIDS[name].volume - volumes_of(apart).sum()
    assert lost == pytest.approx(gap * whole.faces.areas.sum(), rel=0.05)
    vertices = np.concatenate([shard.vertices for shard in apart])
    np.testing.assert_allclose([vertices.min(axis=0), vertices.max(axis=0)], SOLIDS[name].bounds, atol=1e-9)
    for first, second in whole.faces.pairs:
        one, other = (to_manifold(apart[number]) for number in (first, second))
        # Coordinates of some metres; what is left over after a cut is rounded to 1e-9.
        assert one.min_gap(other, 1.0) >= gap - 1e-7


def test_a_gap_between_two_halves():
    halves = voronoi_cells(box([2, 1, 1]), [[-0.5, 0, 0], [0.5, 0, 0]])
    apart = with_gaps(halves.shards, box([2, 1, 1]), 0.1)
    np.testing.assert_allclose(volumes_of(apart), [0.95, 0.95], rtol=1e-9)
    np.testing.assert_allclose([apart[0].vertices[:, 0].max(), apart[1].vertices[:, 0].min()], [-0.05, 0.05], atol=1e-9)


def test_no_gap_changes_nothing():
    shards = fracture(SOLIDS["L"], 5).shards
    assert all(one is other for one, other in zip(with_gaps(shards, SOLIDS["L"], 0.0), shards, strict=True))


def test_gaps_that_leave_nothing_are_refused():
    with pytest.raises(GeometryError, match="Nothing is left of shard 0 with gaps of 1 m"):
        with_gaps(fracture(box([1, 1, 1]), 8, seed=1).shards, box([1, 1, 1]), 1.0)
