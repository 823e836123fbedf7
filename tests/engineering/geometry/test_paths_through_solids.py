# SPDX-License-Identifier: GPL-3.0-or-later
"""Where lines pass from solid to solid: boxes side by side, also along their edges and diagonals."""

import numpy as np
import pytest
import trimesh

from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh
from bridge_demolition_addon.engineering.geometry.solids import passages


def box(lowest, highest):
    mesh = trimesh.creation.box(np.subtract(highest, lowest))
    mesh.apply_translation(np.add(lowest, highest) / 2.0)
    return TriangleMesh(np.array(mesh.vertices), np.array(mesh.faces))


ROW = [box((x, -1.0, -1.0), (x + 1.0, 1.0, 1.0)) for x in (2.0, 0.0, 1.0)]
"""Three boxes along x, not in order."""


@pytest.mark.parametrize("beside", [0.0, 0.3, -1.0])
def test_a_row(beside):
    """Through the middle, where diagonals of triangles meet, beside it, and along an edge."""
    passed = passages(np.array([(0.0, beside, 0.0), (3.0, beside, 0.0)]), ROW)
    assert (passed.first.tolist(), passed.second.tolist()) == ([1, 2], [2, 0])
    assert passed.distances_m == pytest.approx([1.0, 2.0], abs=1e-5)
    assert passed.points_m[:, 0] == pytest.approx([1.0, 2.0], abs=1e-5)
    assert passed.directions == pytest.approx(np.array([(1.0, 0.0, 0.0)] * 2))
    assert passed.gap_m is None


def test_a_line_with_a_kink():
    path = np.array([(0.5, 0.0, 0.5), (1.5, 0.0, -0.5), (2.5, 0.0, 0.5)])
    passed = passages(path, ROW)
    assert passed.distances_m == pytest.approx([0.5 * np.sqrt(2.0), 1.5 * np.sqrt(2.0)], abs=1e-5)
    assert passed.directions[:, 2] == pytest.approx([-np.sqrt(0.5), np.sqrt(0.5)])


def test_a_line_that_comes_back():
    path = np.array([(0.5, 0.0, 0.0), (1.5, 0.0, 0.0), (1.5, 0.5, 0.0), (0.5, 0.5, 0.0)])
    passed = passages(path, ROW)
    assert (passed.first.tolist(), passed.second.tolist()) == ([1, 2], [2, 1])


@pytest.mark.parametrize(("last", "gap_m"), [(3.0, None), (3.5, 3.0)])
def test_where_it_leaves_all(last, gap_m):
    passed = passages(np.array([(0.0, 0.0, 0.0), (last, 0.0, 0.0)]), ROW)
    assert passed.gap_m == (None if gap_m is None else pytest.approx(gap_m, abs=1e-4))


def test_a_gap_in_between():
    passed = passages(np.array([(0.0, 0.0, 0.0), (3.0, 0.0, 0.0)]), [ROW[0], ROW[1]])
    assert passed.gap_m == pytest.approx(1.0, abs=1e-4)


def test_within_one():
    passed = passages(np.array([(0.2, 0.0, 0.0), (0.8, 0.0, 0.0)]), ROW)
    assert not len(passed.first)
