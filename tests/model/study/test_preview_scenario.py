# SPDX-License-Identifier: GPL-3.0-or-later
"""The scenario of a preview is coarser, and else the one that it is made from."""

from dataclasses import replace

import numpy as np
import pytest
from support.checkout import EXAMPLES, PRESETS, REPORT_2019
from support.scenarios import I235

from bridge_demolition_addon.model.bridge.preparation import prepared_members
from bridge_demolition_addon.model.scenario import FractureSettings
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.scenario.fracture import FracturePoint, MemberFracture
from bridge_demolition_addon.model.structure.kept_models import KeptModels
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.model.study.preview_scenario import (
    ELASTIC_SHARDS,
    SHARDS,
    WAVES_MS,
    preview_model,
    preview_scenario,
)

ELASTIC = read_scenario(EXAMPLES / "drilled" / "two_spans.toml")
CHARGES = read_scenario(REPORT_2019 / "single_span_explosives.toml")
TRUSS = read_scenario(PRESETS / "steel" / "deck_truss_severed.toml")


def coarse(scenario):
    return preview_scenario(scenario, prepared_members(scenario).members)


def with_fracture(**values):
    return replace(I235, fracture=FractureSettings(**values))


@pytest.mark.parametrize("scenario, shards", [(I235, SHARDS), (ELASTIC, ELASTIC_SHARDS)])
def test_it_has_so_few_shards_and_is_else_the_same(scenario, shards):
    fine = replace(scenario, fracture=replace(scenario.fracture, shards=400))
    found = coarse(fine)
    assert found.fracture.shards == shards
    assert replace(found, fracture=fine.fracture, time=fine.time) == fine
    assert found.connections.stiffness == fine.connections.stiffness


def test_rigid_connections_keep_their_steps():
    assert coarse(replace(I235, fracture=replace(I235.fracture, shards=400))).time == I235.time


def test_elastic_connections_take_36_steps_a_second_and_no_more_where_something_is_fast():
    step = coarse(ELASTIC).time.step
    assert step.frame_s == pytest.approx(1.0 / 12.0) and step.substep_s == pytest.approx(1.0 / 36.0)
    assert step.substeps_within(coarse(ELASTIC).time.farthest_per_substep_m, 50.0, 9.81) == 3
    assert coarse(ELASTIC).time.duration_s == ELASTIC.time.duration_s


def test_slow_motion_is_left_out_and_time_goes_on_as_in_the_run():
    slow = replace(ELASTIC, time=replace(ELASTIC.time, time_scale=0.1))
    assert coarse(slow).time.step == coarse(ELASTIC).time.step


def test_steps_that_are_longer_already_stay():
    long = replace(ELASTIC.time, frames_per_second=5, substeps_per_frame=2)
    step = coarse(replace(ELASTIC, time=long)).time.step
    assert step.frame_s == pytest.approx(0.2) and step.substep_s == pytest.approx(0.1)


def test_it_ends_at_a_rest_that_is_no_stricter_than_the_scenarios():
    own, found = ELASTIC.time, coarse(ELASTIC).time
    assert (
        found.rest_speed_m_s >= own.rest_speed_m_s
        and found.rest_angular_velocity_rad_s >= own.rest_angular_velocity_rad_s
    )
    assert found.rest_hold_s <= own.rest_hold_s
    loose = replace(own, rest_speed_m_s=0.7, rest_angular_velocity_rad_s=2.0, rest_hold_s=0.1)
    kept = coarse(replace(ELASTIC, time=loose)).time
    assert (kept.rest_speed_m_s, kept.rest_angular_velocity_rad_s, kept.rest_hold_s) == (0.7, 2.0, 0.1)


def test_sub_steps_are_those_of_the_run_while_waves_of_charges_pass():
    found, own = coarse(CHARGES), CHARGES.time.step.substep_s
    lengths_s = found.timeline.frame_lengths_s / found.time.substeps_per_frame
    begins_s = found.timeline.ends_s - found.timeline.frame_lengths_s
    detonations_s = {CHARGES.blast.start_s + charge.delay_s for charge in CHARGES.charges}
    for time_s in detonations_s:
        passing = (begins_s > time_s - 1e-9) & (begins_s < time_s + WAVES_MS / 1000.0 - 1e-9)
        assert passing.any()
        np.testing.assert_allclose(lengths_s[passing], own)
    assert lengths_s.max() == pytest.approx(1.0 / 36.0)


@pytest.mark.long
def test_bars_of_steel_are_not_cut_across_but_where_they_have_to_buckle():
    assert TRUSS.steelwork.pieces > 1
    found = coarse(TRUSS)
    assert found.steelwork == replace(TRUSS.steelwork, pieces=1)
    scenario, model = preview_model(TRUSS)
    assert scenario == found
    assert np.bincount(model.member_of_shard).tolist() == [1] * len(model.members)
    bowed = replace(TRUSS, steelwork=replace(TRUSS.steelwork, bowed=True))
    assert coarse(bowed).steelwork == bowed.steelwork


def test_one_with_few_shards_is_taken_as_it_is():
    scenario = with_fracture(shards=30, members=(MemberFracture(member="deck", shards=20),))
    assert coarse(scenario) is scenario


def test_shards_of_the_users_own_numbers_and_points_are_left_out_and_it_can_be_built():
    (member, *_) = prepared_members(I235).members
    position = tuple(member.solid.vertices.mean(axis=0).tolist())
    rules = (MemberFracture(member="deck", shards=300), MemberFracture(member="pier", stretch=(1.0, 1.0, 2.0)))
    scenario = with_fracture(
        shards=500, members=rules, recursion_share=0.5, points=(FracturePoint(position_m=position),)
    )
    found = coarse(scenario).fracture
    assert found == FractureSettings(shards=SHARDS, members=rules[1:])
    assert len(build_model(coarse(scenario)).shards) == SHARDS


def test_shards_are_not_cut_again():
    assert coarse(with_fracture(shards=60, recursion_share=0.5)).fracture == FractureSettings(shards=60)


def test_each_member_has_a_shard_at_least():
    members = prepared_members(I235).members
    found = preview_scenario(with_fracture(shards=5000), members * SHARDS)
    assert found.fracture.shards == SHARDS * len(members)


def test_previews_of_one_bridge_share_its_model():
    models = KeptModels()
    first, model = preview_model(I235, models)
    second, shared = preview_model(replace(I235, ball=replace(I235.ball, drop_height_m=2.0)), models)
    assert shared is model and first != second
    assert preview_model(replace(I235, seed=2), models)[1] is not model
