# SPDX-License-Identifier: GPL-3.0-or-later
"""The table [bridge.reinforcement]: what goes together, and what it needs elsewhere in a scenario."""

from dataclasses import replace

import pytest
from support.bridges_by_rule import LM1, bridge, scenario
from support.scenarios import I235

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario import BridgeReinforcement, RatiosOfMember
from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_text

RATIOS = (RatiosOfMember(member="deck", bottom_percent=1.0),)


@pytest.mark.parametrize(
    ("keys", "text"),
    [
        ({}, "all missing: expected exactly one of these"),
        ({"designed_for": "LM1", "traffic_kn_m2": 5.0}, "given together"),
        ({"designed_for": "LM1", "ratios": RATIOS}, "given together"),
        ({"axles_kn": (100.0, 100.0)}, "axle_spacing_m is missing: expected 1 numbers"),
        ({"traffic_kn_m2": 5.0, "axle_spacing_m": (1.2,)}, "expected none with fewer than two axles"),
        ({"designed_for": "LM2"}, 'expected one of "LM1", "HL-93", "own weight", "none"'),
        ({"designed_for": "LM1", "steel": "S235"}, 'expected one of "B400B"'),
        ({"designed_for": "LM1", "concrete_n_mm2": 5.0}, "from 12 to 90"),
    ],
)
def test_what_is_refused(keys, text):
    with pytest.raises(ScenarioError, match=text):
        BridgeReinforcement(**keys)


def test_a_ratio_table_has_a_ratio():
    with pytest.raises(ScenarioError, match="has no ratio above 0"):
        RatiosOfMember(member="deck", bottom_percent=0.0)


def test_the_carriageway_is_on_the_deck():
    with pytest.raises(ScenarioError, match=r"carriageway_m is 4.0: expected at most bridge.deck.width_m, 3.7"):
        bridge(replace(LM1, carriageway_m=4.0))


def test_merged_bridges_have_no_members_for_bars():
    with pytest.raises(ScenarioError, match=r"bridge.reinforcement is given: expected none with bridge.merge"):
        bridge(LM1, merge=True)
    bridge(BridgeReinforcement(designed_for="none"), merge=True)


def test_it_needs_what_layers_by_hand_need():
    plan = replace(I235, bridge=replace(I235.bridge, reinforcement=None))
    with pytest.raises(
        ScenarioError, match=r"connections.material is missing: expected it with \[bridge.reinforcement"
    ):
        replace(plan, bridge=replace(plan.bridge, reinforcement=LM1))
    whole = scenario(bridge())
    with pytest.raises(ScenarioError, match=r'stiffness is "rigid": expected "elastic" with \[bridge.reinforcement\]'):
        replace(whole, connections=replace(whole.connections, stiffness="rigid"))
    none = BridgeReinforcement(designed_for="none")
    assert replace(plan, bridge=replace(plan.bridge, reinforcement=none)).bridge.reinforcement == none


def test_what_of_the_steel_is_given_counts():
    plan = scenario(bridge(replace(LM1, steel="B500C")))
    elastic = replace(plan.connections, stiffness="elastic", ductile_rupture_strain=0.1)
    steel = replace(plan, connections=elastic).steel
    assert (steel.hardening, steel.rupture_strain) == (1.15, 0.1)


@pytest.mark.parametrize(
    "rule",
    [
        LM1,
        BridgeReinforcement(traffic_kn_m2=5.0, axles_kn=(100.0, 150.0), axle_spacing_m=(4.0,), cover_m=0.03),
        BridgeReinforcement(ratios=RATIOS, steel="Grade 60"),
    ],
)
def test_it_is_written_and_read_again(tmp_path, rule):
    path = tmp_path / "bridge.toml"
    path.write_text(scenario_text(scenario(bridge(rule))), encoding="utf-8")
    assert read_scenario(path).bridge.reinforcement == rule


def test_words_for_what_it_is_by():
    assert LM1.described == "own weight and LM1"
    assert BridgeReinforcement(designed_for="own weight").described == "own weight"
    own = BridgeReinforcement(traffic_kn_m2=5.0, axles_kn=(100.0, 150.0), axle_spacing_m=(4.0,))
    assert own.described == "own weight, 5 kN/m² and axles of 100 + 150 kN"
    assert BridgeReinforcement(ratios=RATIOS).described == "ratios of steel"
