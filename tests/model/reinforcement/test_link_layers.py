# SPDX-License-Identifier: GPL-3.0-or-later
"""Links of a schedule become bars that are spread over their members: A_sw / (s b), by hand."""

import pytest
from support.scenarios import I235

from bridge_demolition_addon.model.bridge.preparation import prepared_members
from bridge_demolition_addon.model.reinforcement.schedule import Schedule, ScheduledLinks, link_layers


def links_of(name, kind, width_m, diameter_m):
    """Two legs of 10 mm every 200 mm: 2 × 78.5 / 0.2 = 785 mm²/m."""
    legs = {"legs": 2, "diameter_m": diameter_m, "spacing_m": 0.2, "loop_m": 2.0, "length_m": 5.0}
    return ScheduledLinks((name,), kind, 785.0, 700.0, "shear", width_m=width_m, **legs)


def test_upright_legs_of_what_lies_and_legs_both_ways_of_columns():
    members = prepared_members(I235).members
    pier = next(member for member in members if member.kind == "pier")
    schedule = Schedule(links=(links_of("deck", "deck", 0.5, 0.01), links_of(pier.name, "pier", 0.7, 0.0)))
    deck, *of_pier = link_layers(schedule, members)
    assert (deck.members, deck.along, deck.diameter_mm) == (("deck",), "z", pytest.approx(10.0))
    assert deck.spread_mm2_m2 == pytest.approx(785.0 / 0.5)
    assert [layer.along for layer in of_pier] == ["x", "y"]
    assert [layer.spread_mm2_m2 for layer in of_pier] == pytest.approx([785.0 / 0.7] * 2)
    assert {layer.diameter_mm for layer in of_pier} == {10.0}
