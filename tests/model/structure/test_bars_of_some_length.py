# SPDX-License-Identifier: GPL-3.0-or-later
"""Layers that run along a part of their member."""

from dataclasses import replace

import numpy as np
import pytest
from support.bridges_by_rule import bridge, scenario

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario import BarLayer, FractureSettings
from bridge_demolition_addon.model.structure.member_layers import layers_of_members
from bridge_demolition_addon.model.structure.model import build_model

pytestmark = pytest.mark.slow

WHOLE = BarLayer(members=("deck",), side="bottom", depth_m=0.05, area_mm2=8_000.0)
TOP = BarLayer(members=("deck",), side="top", depth_m=0.05, area_mm2=4_000.0, from_m=8.0, to_m=11.0)


def model(*layers, skew_deg=0.0):
    of_bridge = bridge(None, skew_deg=skew_deg)
    return build_model(scenario(of_bridge, reinforcement=layers, fracture=FractureSettings(shards=150)))


def pull(built, at_m):
    """Force of all bars of the deck between the shards on both sides of a plane across the road."""
    own = np.append(built.member_of_shard == 0, False)
    before = np.append(built.centres_m[:, 0] < at_m, False)
    pairs = built.connections.pairs
    signs = np.sign(built.connections.normals[:, 0]) * (before[pairs[:, 0]].astype(int) - before[pairs[:, 1]])
    return float((signs * built.bars.yield_n)[own[pairs].all(axis=1)].sum())


def test_a_layer_alone_is_where_it_runs():
    """No shard is longer than some 1.5 m: faces between those beside a plane are within that of it."""
    built = model(TOP)
    (group,) = layers_of_members((TOP,), built.members)
    (force,) = group.section(35e6).across_cracks_n()
    assert group.between_m == (8.0, 11.0)
    assert pull(built, 9.5) == pytest.approx(force, rel=1e-6)
    assert pull(built, 4.0) == 0.0


def test_sections_are_those_of_the_layers_that_are_there():
    built = model(WHOLE, TOP)
    before, within, after = layers_of_members((WHOLE, TOP), built.members)
    assert [len(group.layers) for group in (before, within, after)] == [1, 2, 1]
    assert (before.between_m[1], within.between_m, after.between_m[0]) == (8.0, (8.0, 11.0), 11.0)
    assert pull(built, 4.0) == pytest.approx(sum(before.section(35e6).across_cracks_n()), rel=1e-6)
    assert pull(built, 9.5) == pytest.approx(sum(within.section(35e6).across_cracks_n()), rel=1e-6)


def test_ends_beyond_the_member_are_its_ends():
    far = replace(TOP, from_m=-5.0, to_m=50.0)
    whole = replace(TOP, from_m=None, to_m=None)
    np.testing.assert_allclose(model(far).bars.yield_n, model(whole).bars.yield_n)


def test_faces_along_the_bars_are_parted_at_their_ends():
    """All bars across faces between x = 8 and 11 m have the length 3 m: of a layer along y, so much of its width."""
    across = BarLayer(members=("deck",), along="y", side="bottom", depth_m=0.05, area_mm2=13_000.0)
    half = replace(across, from_m=-1.0, to_m=1.0)
    built, other = model(across), model(half)
    share = other.bars.yield_n.sum() / built.bars.yield_n.sum()
    assert share == pytest.approx(2.0 / 3.7, rel=0.15)  # shards are cut at random


@pytest.mark.parametrize(
    ("ends", "text"),
    [
        (
            {"from_m": 14.0, "to_m": 15.0},
            r"reinforcement.from_m is 14.0: expected less than 13 \(m\), where 'deck' ends",
        ),
        (
            {"from_m": -3.0, "to_m": -1.0},
            r"reinforcement.to_m is -1.0: expected more than 0 \(m\), where 'deck' ends",
        ),
    ],
)
def test_bars_beside_their_member_are_refused(ends, text):
    with pytest.raises(ScenarioError, match=text):
        model(replace(TOP, **ends))


def test_bars_have_a_length():
    with pytest.raises(ScenarioError, match=r"reinforcement.to_m is 8.0: expected more than reinforcement.from_m, 8"):
        replace(TOP, to_m=8.0)
