# SPDX-License-Identifier: GPL-3.0-or-later
"""Bars that hang on bolts: what `bda check` says of them, and the load at which they come down, by hand."""

import numpy as np
import pytest
from support.steelwork import bar, node, steel_scenario

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.stages.standing import StandingBridge
from bridge_demolition_addon.model.structure.equilibrium import model_at_rest
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.model.structure.steel_bars import bar_uses, steel_facts

BOLTS_N = 2 * 0.6 * 800e6 * 245e-6
"""Two M20 8.8 with threads in the plane of shear: EN 1993-1-8:2005, table 3.4, without partial factor: 235.2 kN."""


def hanging(load_kg, **keys):
    nodes = [node("top", 0.0, 9.0, support="fixed"), node("hook", 0.0, 4.0, mass_kg=load_kg)]
    return steel_scenario(nodes, [bar("tie", "top", "hook", "FLAT 150x10", **keys)], grade="S235", pieces=4)


def weight_n(model):
    return float(model.masses_kg.sum()) * STANDARD_GRAVITY_M_S2


def test_a_tie_is_used_by_what_its_bolts_resist():
    scenario = hanging(10_000.0, end_bolts=["2 M20 8.8", "welded"])
    model = build_model(scenario)
    rest = model_at_rest(model, scenario.joints)
    (use,) = bar_uses(scenario, model, rest)
    # The joint to the upper node carries all but what of the bar goes with that node, less than 0.1 %.
    assert use.section_used == pytest.approx(weight_n(model) / BOLTS_N, rel=2e-3)
    facts = [text for _, text in steel_facts(scenario, model, rest)]
    assert "2 M20 8.8 at top: resist 235.2 kN in shear, the section between holes 343.4 kN, 67% of the bar" in facts


@pytest.mark.parametrize(("bolts", "resists_n"), [("2 M20 8.8", BOLTS_N), ("4 M20 8.8", 0.9 * 1060e-6 * 360e6)])
def test_it_comes_down_at_the_load_of_its_bolts_or_of_the_section_between_their_holes(bolts, resists_n):
    scenario = hanging(10_000.0, end_bolts=[bolts, "welded"])
    bridge = StandingBridge(build_model(scenario), scenario.joints)
    assert bridge.collapse_factor(*_whole(bridge)) == pytest.approx(
        resists_n / weight_n(bridge.model), rel=0.015
    )  # found within 1 %


def _whole(bridge):
    whole = np.ones(len(bridge.model.connections))
    return whole > 0.0, whole, np.zeros((6, len(bridge.model.shards)))


def test_bolts_are_a_part_of_the_bar_as_end_strengths_are():
    by_bolts, by_share = (
        hanging(10_000.0, **keys)
        for keys in ({"end_bolts": ["2 M20 8.8", "welded"]}, {"end_strengths": [BOLTS_N / (235e6 * 1500e-6), 1.0]})
    )
    assert by_bolts.steelwork.end_share(by_bolts.steelwork.members[0], 0) == pytest.approx(
        by_share.steelwork.members[0].end_strengths[0], rel=1e-12
    )


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"end_bolts": ["2 M20 8.8", "welded"], "end_strengths": [0.5, 1.0]}, "together with end_strengths"),
        ({"end_bolts": ["1 M20 8.8", "welded"]}, 'one bolt, which the bar turns about: expected "pinned"'),
        ({"end_bolts": ["16 M20 8.8 in 8 lines", "welded"]}, "whose holes leave nothing of FLAT 150x10"),
        ({"end_bolts": ["2 M20 9.9", "welded"]}, "'tie'|\"tie\": end_bolts.1: bolts"),
    ],
)
def test_what_cannot_be_bolted_is_refused(keys, message):
    with pytest.raises(ScenarioError, match=message):
        hanging(10_000.0, **keys)
