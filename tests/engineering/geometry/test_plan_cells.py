# SPDX-License-Identifier: GPL-3.0-or-later
"""Cells that an area touches, against their intersections with it by Manifold."""

import numpy as np
import pytest
from manifold3d import CrossSection

from bridge_demolition_addon.engineering.geometry.plan_areas import PlanCells, outlines, united

RING = CrossSection.square((10.0, 10.0)) - CrossSection.square((5.0, 3.0)).translate((2.0, 4.0))


def cell_areas(cells, area):
    """How much of an area lies in each cell."""
    xs, ys = cells.xs_m, cells.ys_m
    cell = CrossSection.square((cells.side_m, cells.side_m))
    return np.array([[(cell.translate((x, y)) ^ area).area() for x in xs[:-1]] for y in ys[:-1]])


def random_area(generator):
    """Some slabs and discs with holes in them."""
    parts = [
        CrossSection.square(generator.uniform(0.2, 9.0, 2).tolist(), True)
        .rotate(generator.uniform(0.0, 360.0))
        .translate(generator.uniform(-8.0, 8.0, 2).tolist())
        for _ in range(5)
    ]
    holes = [CrossSection.circle(generator.uniform(0.3, 2.0)).translate(generator.uniform(-8.0, 8.0, 2).tolist())]
    return united(parts) - united(holes)


@pytest.mark.parametrize("seed", range(8))
def test_touched_cells_are_those_that_the_area_covers_a_part_of(seed):
    area = random_area(np.random.default_rng(seed))
    low, high = np.array(area.bounds()).reshape(2, 2)
    cells = PlanCells.over(low, high, 40)
    touched, covered = cells.touched(outlines(area)), cell_areas(cells, area)
    # Manifold rounds corners to some 1e-7 m: what is covered by less is neither checked as in nor as out.
    assert touched[covered > 1e-5].all()
    assert not touched[covered == 0.0].any()


def test_cells_beside_an_area_that_ends_at_their_lines_are_not_touched():
    cells = PlanCells(1.0, -1, -1, 12, 12)
    touched = cells.touched(outlines(RING))
    expected = np.zeros((12, 12), bool)
    expected[1:11, 1:11] = True
    expected[5:8, 3:8] = False
    assert np.array_equal(touched, expected)


@pytest.mark.parametrize("shift", [0.5, -0.25, 0.001])
def test_a_line_that_is_crossed_by_little_is_crossed(shift):
    cells = PlanCells(1.0, -2, -2, 14, 14)
    touched = cells.touched(outlines(RING.translate((shift, shift))))
    assert np.array_equal(touched, cell_areas(cells, RING.translate((shift, shift))) > 0.0)


def test_something_smaller_than_a_cell_touches_its_cell():
    cells = PlanCells(1.0, 0, 0, 3, 2)
    speck = np.array([(1.4, 0.2), (1.5, 0.2), (1.45, 0.3)])
    assert cells.touched([speck]).tolist() == [[False, True, False], [False, False, False]]
    assert not cells.touched([]).any()


def test_cells_are_as_small_as_their_number_allows():
    cells = PlanCells.over(np.array([-3.14, 2.0]), np.array([36.0, 9.99]), 200)
    assert (cells.side_m, cells.columns, cells.rows) == (0.2, 196, 40)
    assert cells.xs_m[0] == pytest.approx(-3.2) and cells.xs_m[-1] == pytest.approx(36.0)
    assert cells.ys_m[[0, -1]] == pytest.approx([2.0, 10.0])


def test_an_area_that_no_plan_shows_is_refused():
    with pytest.raises(ValueError, match="too large for a plan"):
        PlanCells.over(np.zeros(2), np.array([1e7, 1.0]), 200)


def test_the_area_of_cells_is_theirs():
    cells = PlanCells(0.5, -1, -1, 12, 12)
    chosen = cells.touched(outlines(RING.scale((0.5, 0.5))))
    area = cells.area_of(chosen)
    assert area.area() == pytest.approx(0.25 * RING.area())
    assert len(outlines(area)) == 2
    assert cells.area_of(np.zeros((12, 12), bool)).is_empty()
