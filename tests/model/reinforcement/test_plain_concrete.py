# SPDX-License-Identifier: GPL-3.0-or-later
"""What is said of concrete without bars."""

from dataclasses import replace

from support.bridges_by_rule import LM1, bridge, scenario
from support.scenarios import I235

from bridge_demolition_addon.model.reinforcement.concrete_members import plain_concrete, plain_concrete_text
from bridge_demolition_addon.model.scenario import BarLayer, BridgeReinforcement, ConnectionBetween, Geometry
from bridge_demolition_addon.model.scenario import RatiosOfMember as Ratios

BY_HAND = BarLayer(members=("deck",), depth_m=0.05, area_mm2=9_000.0)


def named(plan):
    """Members that are named as having no bars."""
    text = plain_concrete_text(plan)
    return text.removeprefix("no reinforcing bars in ").partition(":")[0].split(", ") if text else []


def test_without_a_rule_all_concrete_is_named():
    assert named(scenario(bridge(None))) == ["deck", "pier cap", "pier"]
    assert named(I235) == ["deck", "pier cap", "pier"]


def test_members_with_bars_are_not_named():
    assert named(scenario(bridge(LM1))) == []
    assert named(scenario(bridge(None), reinforcement=(BY_HAND,))) == ["pier cap", "pier"]
    only_piers = BridgeReinforcement(ratios=(Ratios(member="pier", upright_percent=1.0),))
    assert named(scenario(bridge(only_piers))) == ["deck", "pier cap"]


def test_one_of_a_kind_is_named_by_itself():
    one = replace(BY_HAND, members=("pier 1 cap", "deck", "pier"), along="y")
    assert named(scenario(bridge(None), reinforcement=(one,))) == ["pier 2 cap"]


def test_no_bars_on_purpose_are_not_a_warning():
    assert named(scenario(bridge(BridgeReinforcement(designed_for="none")))) == []


def test_the_list_for_the_summary_has_those_without_bars_on_purpose_too():
    assert plain_concrete(scenario(bridge(BridgeReinforcement(designed_for="none")))) == ["deck", "pier cap", "pier"]
    assert plain_concrete(scenario(bridge(LM1))) == []
    assert plain_concrete(scenario(bridge(None), reinforcement=(BY_HAND,))) == ["pier cap", "pier"]


def test_bars_that_are_spread_evenly_are_bars():
    plan = scenario(bridge(None))
    even = replace(plan.connections, ductile_share=0.5, ductile_elongation_m=0.05)
    assert named(replace(plan, connections=even)) == []


def test_other_materials_are_not_named():
    rule = ConnectionBetween(members=("pier", "pier"), material="steel")
    plan = scenario(bridge(None))
    assert named(replace(plan, connections=replace(plan.connections, between=(rule,)))) == ["deck", "pier cap"]


def test_members_from_files_are_named():
    wall = Geometry(name="wall", file="wall.stl", density_kg_m3=2400.0)
    assert named(scenario(bridge(LM1), geometry=(wall,))) == ["member"]
