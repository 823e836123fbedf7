# SPDX-License-Identifier: GPL-3.0-or-later
"""What is held of a bridge, and which connections lie between which members."""

from dataclasses import replace

import numpy as np
import pytest
from support.scenarios import I235

from bridge_demolition_addon.engineering.fracture.shards import fracture
from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.errors import GeometryError, ScenarioError
from bridge_demolition_addon.model.scenario import FractureSettings, Support
from bridge_demolition_addon.model.scenario.file import scenario_from_text, scenario_text
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.model.structure.supports import DIRECTIONS, on_outermost_face

pytestmark = pytest.mark.slow

CONNECTIONS = replace(I235.connections, method="face", search_radius_m=None)
SCENARIO = replace(I235, connections=CONNECTIONS, fracture=FractureSettings(shards=80))


def names_of(model, shards):
    return {model.members[member].name for member in model.member_of_shard[shards]}


def test_nothing_is_held_without_supports():
    assert not build_model(SCENARIO).fixed.any()


def test_whole_members_are_held_and_keep_no_connection_among_themselves():
    free, model = build_model(SCENARIO), build_model(replace(SCENARIO, supports=[Support(member="pier")]))
    columns = {f"pier {pier} column {column}" for pier in (1, 2) for column in (1, 2)}
    assert names_of(model, model.fixed) == columns
    assert names_of(model, ~model.fixed) == {"deck", "pier 1 cap", "pier 2 cap"}
    held = np.append(model.fixed, True)
    assert not held[model.connections.pairs].all(axis=1).any()
    # What lies between a held shard and one that moves stays: the caps on the columns.
    assert model.connections.areas[held[model.connections.pairs].any(axis=1)].sum() == pytest.approx(4 * 0.49, rel=1e-7)
    assert len(model.connections) == (~held[free.connections.pairs].all(axis=1)).sum()
    assert len(model.second_moments_m4) == len(model.connections)


def test_a_name_holds_one_member():
    model = build_model(replace(SCENARIO, supports=[Support(member="pier 2 cap")]))
    assert names_of(model, model.fixed) == {"pier 2 cap"}


@pytest.mark.parametrize(
    "face, axis, place", [("start", 0, -0.5), ("end", 0, 13.5), ("right", 1, -4.25), ("top", 2, 5.55)]
)
def test_shards_on_a_face_are_held(face, axis, place):
    model = build_model(replace(SCENARIO, supports=[Support(member="deck", face=face)]))
    reach = np.array([abs(shard.vertices[:, axis] - place).min() for shard in model.shards])
    deck = model.member_of_shard == 0
    # Shards of the deck that reach the face; all of them reach its top, and so are held by it.
    assert np.array_equal(model.fixed, deck & (reach < 1e-9))
    assert model.fixed.any()


def test_the_end_of_a_skewed_deck_is_its_skewed_face():
    bridge = replace(I235.bridge, skew_deg=60, span_lengths_m=[30])
    scenario = replace(SCENARIO, ball=None, bridge=bridge, supports=[Support(member="deck", face="end")])
    model = build_model(scenario)
    tangent = np.sqrt(3)
    reach = np.array([abs(shard.vertices @ [1, -tangent, 0] - 30.5).min() for shard in model.shards])
    assert model.fixed.any() and np.array_equal(model.fixed, (model.member_of_shard == 0) & (reach < 1e-6))


def test_faces_of_a_cube():
    cube = box([1, 1, 1])
    shards = fracture(cube, 60, seed=1).shards
    for direction in DIRECTIONS.values():
        reaches = np.array([(shard.vertices @ direction).max() for shard in shards])
        assert np.array_equal(on_outermost_face(cube, shards, np.array(direction)), reaches > 0.5 - 1e-9)


def test_a_face_further_in_is_not_the_outermost():
    steps = box([1, 1, 1])
    shards = fracture(steps, 8, seed=1).shards
    low = [shard for shard in shards if shard.vertices[:, 2].max() < 0.5 - 1e-6]
    assert not on_outermost_face(steps, low, np.array([0.0, 0.0, 1.0])).any()


def test_what_is_not_there_cannot_be_held():
    with pytest.raises(
        ScenarioError, match=r'supports.member is "abutment": expected the name or kind of a member, one'
    ):
        build_model(replace(SCENARIO, supports=[Support(member="abutment")]))
    with pytest.raises(ScenarioError, match=r"supports.face is"):
        Support(member="deck", face="inside")


def test_something_has_to_move():
    with pytest.raises(GeometryError, match="nothing is left to move"):
        build_model(replace(SCENARIO, supports=[Support(member=kind) for kind in ("deck", "pier", "pier cap")]))


def test_supports_are_written_and_read():
    scenario = replace(SCENARIO, supports=[Support(member="pier 1 cap"), Support(member="deck", face="start")])
    assert scenario_from_text(scenario_text(scenario)) == scenario
