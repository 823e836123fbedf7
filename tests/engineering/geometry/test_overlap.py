# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids that overlap by volumes known by hand."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.fracture.shards import fracture
from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh
from bridge_demolition_addon.engineering.geometry.overlap import hulls, overlaps, separated
from bridge_demolition_addon.engineering.geometry.solids import bodies, box, to_manifold, union
from bridge_demolition_addon.errors import GeometryError

ROUNDING = 1e-12


def test_overlapping_pairs_and_their_volumes_largest_first():
    meshes = [box([2, 2, 2], position) for position in ([0, 0, 0], [1.5, 0, 0], [9, 0, 0], [0, 1, 1.2])]
    found = overlaps(meshes)
    assert found.pairs.tolist() == [[0, 1], [0, 3], [1, 3]]
    assert found.volumes == pytest.approx([0.5 * 2 * 2, 2 * 1 * 0.8, 0.5 * 1 * 0.8], rel=ROUNDING)


@pytest.mark.parametrize("count", [1, 0])
def test_nothing_to_compare(count):
    found = overlaps([box([1, 1, 1])] * count)
    assert len(found) == 0 and found.pairs.shape == (0, 2)


def test_the_tolerance_is_a_part_of_the_smaller_one():
    meshes = [box([10, 10, 10]), box([1, 1, 1], [5.49, 0, 0])]  # 0.01 m³ of 1 m³ in the large one
    assert len(overlaps(meshes, tolerance=0.011)) == 0
    assert len(overlaps(meshes, tolerance=0.009)) == 1


def test_shards_of_one_solid_do_not_overlap():
    concave = union([box([4, 1, 1]), box([1, 1, 4], [-1.5, 0, 1.5])])
    assert len(overlaps(fracture(concave, 60, seed=3).shards)) == 0


def test_hulls_overlap_where_the_shards_do_not():
    # A cube in the corner of an L: the L's hull reaches over it to the line from its toe to its head.
    corner = union([box([4, 1, 1]), box([1, 1, 4], [-1.5, 0, 1.5])])
    shards = [corner, box([1, 1, 1], [-0.5, 0, 1])]
    assert len(overlaps(shards)) == 0
    found = overlaps(hulls(shards))
    assert found.pairs.tolist() == [[0, 1]] and found.volumes == pytest.approx([1], rel=ROUNDING)


def test_an_open_mesh_cannot_be_compared():
    opened = TriangleMesh(box([1, 1, 1]).vertices, box([1, 1, 1]).triangles[:-1])
    with pytest.raises(GeometryError, match="Mesh 1: not a closed solid"):
        overlaps([box([1, 1, 1]), opened])


def test_later_solids_lose_what_they_have_in_common_with_earlier_ones():
    solids = [box([2, 2, 2]), box([2, 2, 2], [1.5, 0, 0]), box([2, 2, 2], [9, 0, 0]), box([6, 1, 1], [1, 0, 0])]
    cut, removed = separated(solids, ["a", "b", "c", "d"])
    # The last is 6 m long from x = -2; the first two take it from -1 to 2.5.
    assert removed == pytest.approx([0, 2, 0, 3.5], abs=ROUNDING)
    assert [solid.volume for solid in cut] == pytest.approx([8, 6, 8, 2.5], rel=ROUNDING)
    assert cut[0] is solids[0] and cut[2] is solids[2]
    assert len(overlaps(cut)) == 0


def test_solids_that_only_touch_stay_as_they_are():
    solids = [box([1, 1, 1], [x, 0, 0]) for x in range(3)]
    cut, removed = separated(solids, ["a", "b", "c"])
    assert all(one is other for one, other in zip(cut, solids, strict=True)) and not removed.any()


def test_a_solid_inside_another_is_refused():
    with pytest.raises(GeometryError, match=r"^bearing: lies wholly inside members before it"):
        separated([box([2, 2, 2]), box([1, 1, 1])], ["pier", "bearing"])
    with pytest.raises(GeometryError, match=r"^bearing, bolt: lie wholly inside members before them"):
        separated([box([2, 2, 2]), box([1, 1, 1]), box([3, 1, 1]), box([0.1] * 3)], ["pier", "bearing", "bar", "bolt"])


def test_films_between_a_solid_and_its_copy_in_single_precision_are_not_left():
    deck = box([9.1, 4.3, 0.4], [100.7, -2.1, 3.3])
    copy = TriangleMesh(deck.vertices.astype(np.float32).astype(float), deck.triangles)
    with pytest.raises(GeometryError, match=r"^deck again: lies wholly inside members before it"):
        separated([deck, copy], ["deck", "deck again"])
    wider = union([copy, box([2, 2, 2], [103.0, -2.1, 4.4])])
    cut, _ = separated([deck, wider], ["deck", "deck and block"])
    assert len(bodies(to_manifold(cut[1]))) == 1
    block_above_deck_m3 = 2 * 2 * (5.4 - 3.5)
    assert cut[1].volume == pytest.approx(block_above_deck_m3, rel=1e-5)  # coordinates have seven digits
