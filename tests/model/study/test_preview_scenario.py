# SPDX-License-Identifier: GPL-3.0-or-later
"""The scenario of a preview is coarser, and else the one that it is made from."""

from dataclasses import replace

import pytest
from support.checkout import EXAMPLES
from support.scenarios import I235

from bridge_demolition_addon.model.bridge.preparation import prepared_members
from bridge_demolition_addon.model.scenario import FractureSettings
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.scenario.fracture import FracturePoint, MemberFracture
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.model.study.preview_scenario import ELASTIC_SHARDS, SHARDS, preview_scenario

ELASTIC = read_scenario(EXAMPLES / "drilled" / "two_spans.toml")


def coarse(scenario):
    return preview_scenario(scenario, prepared_members(scenario).members)


def with_fracture(**values):
    return replace(I235, fracture=FractureSettings(**values))


@pytest.mark.parametrize("scenario, shards", [(I235, SHARDS), (ELASTIC, ELASTIC_SHARDS)])
def test_it_has_so_few_shards_and_is_else_the_same(scenario, shards):
    fine = replace(scenario, fracture=replace(scenario.fracture, shards=400))
    found = coarse(fine)
    assert found.fracture.shards == shards
    assert replace(found, fracture=fine.fracture) == fine
    assert found.connections.stiffness == fine.connections.stiffness


def test_one_with_few_shards_is_taken_as_it_is():
    scenario = with_fracture(shards=30, members=(MemberFracture(member="deck", shards=20),))
    assert coarse(scenario) is scenario


def test_shards_of_the_users_own_numbers_and_points_are_left_out_and_it_can_be_built():
    (member, *_) = prepared_members(I235).members
    position = tuple(member.solid.vertices.mean(axis=0).tolist())
    rules = (MemberFracture(member="deck", shards=300), MemberFracture(member="pier", stretch=(1.0, 1.0, 2.0)))
    scenario = with_fracture(shards=500, members=rules, recursion_share=0.5, points=(FracturePoint(place_m=position),))
    found = coarse(scenario).fracture
    assert found == FractureSettings(shards=SHARDS, members=rules[1:])
    assert len(build_model(coarse(scenario)).shards) == SHARDS


def test_shards_are_not_cut_again():
    assert coarse(with_fracture(shards=60, recursion_share=0.5)).fracture == FractureSettings(shards=60)


def test_each_member_has_a_shard_at_least():
    members = prepared_members(I235).members
    found = preview_scenario(with_fracture(shards=5000), members * SHARDS)
    assert found.fracture.shards == SHARDS * len(members)
