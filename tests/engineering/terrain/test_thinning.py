# SPDX-License-Identifier: GPL-3.0-or-later
"""Few triangles for many heights: they cover the site without gaps, and stay within the tolerance."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.geometry.mesh import triangle_areas_and_normals
from bridge_demolition_addon.engineering.geometry.vectors import cross_2d
from bridge_demolition_addon.engineering.terrain.raster import contour_lines
from bridge_demolition_addon.engineering.terrain.surface import Surface
from bridge_demolition_addon.engineering.terrain.thinning import Grid, thinned

CELLS, STEP = 64, 0.5


def grid_of(height, cells=CELLS):
    empty = Grid(np.array([-10.0, 5.0]), STEP, np.zeros((cells + 1, cells + 1)))
    x, y = empty.places().T
    return Grid(empty.low, STEP, height(x, y).reshape(cells + 1, cells + 1))


def none_kept(grid):
    return np.zeros(grid.heights.shape, bool)


SHAPES = {
    "hills": lambda x, y: 2.0 * np.sin(x / 4) + np.cos(y / 5),
    "a wall": lambda x, y: np.where(x > 3.3, 4.0, 0.0),
    "noise": lambda x, y: np.random.default_rng(5).random(len(x)),
    "flat": lambda x, y: 7.0 + 0.0 * x,
}


@pytest.mark.parametrize("tolerance", [0.5, 0.05])
@pytest.mark.parametrize("name", SHAPES)
def test_triangles_cover_the_site_and_keep_to_the_tolerance(name, tolerance):
    grid = grid_of(SHAPES[name])
    mesh = thinned(grid, tolerance, none_kept(grid), 8.0)
    found = Surface(mesh).heights_at(grid.places())
    assert np.abs(found - grid.heights.ravel()).max() <= tolerance + 1e-12
    corners = mesh.corners
    areas = cross_2d(corners[:, 1, :2] - corners[:, 0, :2], corners[:, 2, :2] - corners[:, 0, :2]) / 2.0
    assert (areas > 0.0).all()  # all look up, and none lies on another as they add up to the site
    assert areas.sum() == pytest.approx((CELLS * STEP) * (CELLS * STEP), rel=1e-12)


def test_no_two_triangles_meet_at_a_gap():
    """Every side but those at the border belongs to two triangles, once in each direction."""
    grid = grid_of(SHAPES["hills"])
    mesh = thinned(grid, 0.05, none_kept(grid), 8.0)
    sides = mesh.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2).tolist()
    assert len(set(map(tuple, sides))) == len(sides)
    alone = {tuple(side) for side in sides} - {tuple(side[::-1]) for side in sides}
    ends = mesh.vertices[np.array(sorted(alone))][..., :2]
    low, high = grid.low, grid.low + CELLS * STEP
    assert ((ends == low) | (ends == high)).all(axis=1).any(axis=1).all()


def test_a_plane_needs_no_more_triangles_than_the_longest_side_asks_for():
    grid = grid_of(lambda x, y: 0.3 * x - 0.1 * y)
    # 32 m in squares of 8 m: 4 × 4 squares of two triangles.
    assert len(thinned(grid, 0.01, none_kept(grid), 8.0).triangles) == 32


def test_what_is_kept_is_exact():
    grid = grid_of(SHAPES["noise"])
    kept = none_kept(grid)
    kept[17, 5:9] = True
    found = Surface(thinned(grid, 10.0, kept, 100.0)).heights_at(grid.places()).reshape(grid.heights.shape)
    np.testing.assert_allclose(found[17, 5:9], grid.heights[17, 5:9], atol=1e-12)


def test_a_surface_has_the_height_of_its_highest_triangle_and_none_beside_it():
    from bridge_demolition_addon.engineering.geometry.solids import box

    surface = Surface(box((2.0, 2.0, 1.0), (0.0, 0.0, 4.0)))
    found = surface.heights_at(np.array([[0.3, -0.7], [1.0, 1.0], [1.1, 0.0], [-50.0, 0.0]]))
    np.testing.assert_array_equal(found, [4.5, 4.5, np.nan, np.nan])
    # In each step of a flight they are asked for, of tens of thousands of triangles.
    assert surface.bounds is surface.bounds
    np.testing.assert_array_equal(surface.bounds, [[-1.0, -1.0], [1.0, 1.0]])
    assert triangle_areas_and_normals(surface.mesh.corners)[0].sum() == pytest.approx(16.0)


def test_contour_lines_are_where_a_plane_has_their_height():
    """A plane that rises by 1 in 4 over 32 m: 8 m of height, every metre of it, at multiples of 4 m along x."""
    grid = grid_of(lambda x, y: 0.25 * (x + 10.0) + 0.5)
    lines = contour_lines(thinned(grid, 0.01, none_kept(grid), 8.0).corners)
    np.testing.assert_allclose(lines[..., 2], 0.25 * (lines[..., 0] + 10.0) + 0.5, atol=1e-12)
    assert set(np.unique(lines[..., 2].round(9))) == set(np.arange(1.0, 9.0))
    # Each runs across the whole site, 32 m.
    lengths = np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1)
    assert lengths.sum() == pytest.approx(8 * CELLS * STEP)
    assert not len(contour_lines(thinned(grid_of(SHAPES["flat"]), 0.01, none_kept(grid), 8.0).corners))
