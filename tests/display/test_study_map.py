# SPDX-License-Identifier: GPL-3.0-or-later
"""Map and limit of a study on the ground of a view."""

import numpy as np
import pytest
from manifold3d import CrossSection

from bridge_demolition_addon.display.colour_scale import ColourMap, colours
from bridge_demolition_addon.display.ground_lines import OPACITY, map_triangles, outline_lines
from bridge_demolition_addon.engineering.statistics.probability_map import probability_map

SQUARE = np.array([(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)])


def areas(triangles):
    first, second, third = (triangles[corner::3, :2] for corner in range(3))
    a, b = second - first, third - first
    return (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2.0


def test_triangles_cover_the_cells_that_were_hit_with_the_colour_of_their_share():
    found = probability_map([[SQUARE], [SQUARE], [np.add(SQUARE, (2.0, 0.0))], []], 0.95)
    triangles, tints = map_triangles(found)
    covered = areas(triangles)
    assert (covered > 0.0).all()  # seen from above
    assert covered.sum() == pytest.approx(np.count_nonzero(found.hits) * found.cells.side_m**2)
    inside = (triangles[:, 0] < 1.9) & (triangles[:, 0] > 0.1)
    np.testing.assert_allclose(tints[inside, :3], np.tile(colours(ColourMap.VIRIDIS, [0.5]), (inside.sum(), 1)))
    beyond = triangles[:, 0] > 2.3
    np.testing.assert_allclose(tints[beyond, :3], np.tile(colours(ColourMap.VIRIDIS, [0.25]), (beyond.sum(), 1)))
    assert (tints[:, 3] == OPACITY).all()


def test_lines_go_around_an_area_and_its_holes():
    area = CrossSection.square((10.0, 10.0)) - CrossSection.square((2.0, 2.0)).translate((4.0, 4.0))
    lines = outline_lines(area).reshape(-1, 2, 3)
    assert np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1).sum() == pytest.approx(40.0 + 8.0)
    assert outline_lines(CrossSection()).shape == (0, 3)
