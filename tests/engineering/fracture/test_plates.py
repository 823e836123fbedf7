# SPDX-License-Identifier: GPL-3.0-or-later
"""Plates are cut through their thickness, and nothing else is taken for a plate."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.fracture.options import FractureOptions, through_thickness
from bridge_demolition_addon.engineering.fracture.shards import fracture
from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh
from bridge_demolition_addon.engineering.geometry.solids import box, from_manifold, to_manifold


def skewed(solid: TriangleMesh) -> TriangleMesh:
    """A solid whose ends are skewed by 30°."""
    along, across, upwards = solid.vertices.T
    return TriangleMesh(np.column_stack([along + across * np.tan(np.radians(30.0)), across, upwards]), solid.triangles)


def channel() -> TriangleMesh:
    """A trough: thin walls around what is open."""
    whole, inside = to_manifold(box([20.0, 8.0, 2.0])), to_manifold(box([20.0, 7.0, 2.0])).translate([0.0, 0.0, 0.5])
    return from_manifold(whole - inside)


@pytest.mark.parametrize(
    ("solid", "thickness"),
    [
        (box([13.0, 3.7, 0.6]), 2),
        (box([0.8, 11.0, 6.0]), 0),
        (skewed(box([20.0, 10.0, 0.8])), 2),
        (box([0.7, 0.7, 5.0]), None),
        (box([1.2, 3.7, 0.7]), None),
        (channel(), None),
    ],
    ids=["slab", "wall", "skewed slab", "column", "pier cap", "trough"],
)
def test_slabs_and_walls_are_plates(solid, thickness):
    stretch = through_thickness(solid)
    assert (None if stretch is None else int(np.argmax(stretch))) == thickness


def test_shards_of_a_plate_stand_in_columns_of_its_whole_thickness():
    slab = box([13.0, 3.7, 0.6])
    cut = fracture(slab, 60, 3, FractureOptions(through_plates=True))
    heights = [np.ptp(shard.vertices[:, 2]) for shard in cut.shards]
    np.testing.assert_allclose(heights, 0.6, atol=1e-9)
    # A cell is stretched a hundred times: its sides are out of plumb by a hundredth of what they were.
    np.testing.assert_allclose(cut.faces.normals[:, 2], 0.0, atol=0.05)
    assert sum(cut.volumes) == pytest.approx(13.0 * 3.7 * 0.6)


def test_a_stretch_that_is_given_comes_first():
    slab = box([13.0, 3.7, 0.6])
    even = fracture(slab, 60, 3)
    given = fracture(slab, 60, 3, FractureOptions(stretch=(1.0, 1.0, 1.0), through_plates=True))
    np.testing.assert_array_equal(given.centres, even.centres)
