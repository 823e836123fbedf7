# SPDX-License-Identifier: GPL-3.0-or-later
"""A deck carries a road where it is wide enough for one."""

import numpy as np
from support.sample_results import CUBE, changed, hanging_chain

from bridge_demolition_addon.display.approaches import approaches
from bridge_demolition_addon.display.dressing import Stuff
from bridge_demolition_addon.display.road_furniture import road_furniture


def deck(width_m):
    """A run whose first shard is a deck of 20 m along the road."""
    results = hanging_chain()
    vertices = np.array(results.arrays()["vertices_m"])
    vertices[8:16] = np.array((20.0, width_m, 1.0)) / 2.0 * CUBE
    return changed(results, vertices_m=vertices, body_member_kinds=np.array(["", "deck", "pier", ""]))


def test_a_beam_of_2_m_carries_no_road_and_one_of_3_m_does():
    assert road_furniture(deck(2.0)) == [] and approaches(deck(2.0)) == []
    assert {part.stuff for part in road_furniture(deck(3.0))} == {Stuff.CONCRETE, Stuff.STEEL, Stuff.WHITE}
    assert Stuff.SOIL in {part.stuff for part in approaches(deck(3.0))}
