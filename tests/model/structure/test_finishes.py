# SPDX-License-Identifier: GPL-3.0-or-later
"""What the faces of shards look like, by areas that are known from the size of the member."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.fracture.gaps import with_gaps
from bridge_demolition_addon.engineering.fracture.shards import fracture
from bridge_demolition_addon.engineering.geometry.mesh import triangle_areas_and_normals
from bridge_demolition_addon.engineering.geometry.solids import box, difference
from bridge_demolition_addon.model.bridge.member import Member
from bridge_demolition_addon.model.structure.finishes import Finish, finishes

LENGTH, WIDTH, HEIGHT = 10.0, 4.0, 1.0
DECK = box((LENGTH, WIDTH, HEIGHT), (3.0, 1.0, 5.0))


def areas(shards, member):
    found = finishes(shards, [member], np.zeros(len(shards), int))
    sizes = np.concatenate([triangle_areas_and_normals(shard.corners)[0] for shard in shards])
    kinds = np.concatenate(found)
    return {finish: float(sizes[kinds == finish].sum()) for finish in Finish}


def test_a_deck_is_paved_on_top_cast_around_and_broken_where_it_was_cut():
    cut = fracture(DECK, 40, seed=3)
    found = areas(cut.shards, Member("deck", "deck", DECK))
    assert found[Finish.ROAD] == pytest.approx(LENGTH * WIDTH)
    assert found[Finish.CAST] == pytest.approx(LENGTH * WIDTH + 2.0 * HEIGHT * (LENGTH + WIDTH))
    assert found[Finish.BROKEN] == pytest.approx(2.0 * cut.faces.areas.sum())  # every cut has two sides


def test_gaps_between_shards_take_nothing_of_the_road_but_their_own_width():
    cut = fracture(DECK, 12, seed=3)
    gap = 0.002
    found = areas(with_gaps(cut.shards, DECK, gap), Member("deck", "deck", DECK))
    lost = LENGTH * WIDTH - found[Finish.ROAD]
    on_top = [shard.corners[(shard.corners[:, :, 2] > 5.4999).sum(axis=1) == 2] for shard in cut.shards]
    assert 0.0 < lost < gap * sum(len(cuts) for cuts in on_top) * WIDTH  # no cut is longer than some widths
    assert found[Finish.BROKEN] > 0.0


def test_only_what_carries_a_road_is_paved():
    pier = areas(fracture(DECK, 5, seed=1).shards, Member("pier", "pier", DECK))
    assert pier[Finish.ROAD] == 0.0
    assert pier[Finish.CAST] == pytest.approx(2.0 * (LENGTH * WIDTH + HEIGHT * (LENGTH + WIDTH)))


def test_the_floor_of_a_box_girder_is_no_road():
    outer, cell = box((10.0, 4.0, 2.0), (0.0, 0.0, 0.0)), box((12.0, 3.0, 1.6), (0.0, 0.0, 0.0))
    solid = difference(outer, [cell])
    found = areas([solid], Member("girder", "deck", solid))
    assert found[Finish.ROAD] == pytest.approx(10.0 * 4.0)
    assert found[Finish.BROKEN] == 0.0
