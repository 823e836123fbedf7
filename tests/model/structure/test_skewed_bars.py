# SPDX-License-Identifier: GPL-3.0-or-later
"""Bars of skewed members: layers are skewed with them, and no section loses any of its steel."""

from dataclasses import replace

import numpy as np
import pytest
from support.bridges_by_rule import CAPS, bridge, scenario

from bridge_demolition_addon.engineering.geometry.vectors import transformed
from bridge_demolition_addon.engineering.mechanics.section_cuts import section_axes
from bridge_demolition_addon.model.scenario import BarLayer, Deck, FractureSettings, Piers
from bridge_demolition_addon.model.structure.member_layers import layers_of_members
from bridge_demolition_addon.model.structure.model import build_model

pytestmark = pytest.mark.slow

WALL = Piers(kind="wall", column_length_m=0.9, column_width_m=3.7, height_m=6.0)
COLUMN = Piers(column_length_m=0.7, column_width_m=1.2, height_m=6.0)
UPRIGHT = BarLayer(members=("pier",), along="z", side="start", depth_m=0.06, area_mm2=6_000.0)
IN_CAP = BarLayer(members=("pier cap",), along="y", side="top", depth_m=0.06, area_mm2=5_000.0)


def model(layer, skew_deg, piers):
    of_bridge = bridge(None, deck=Deck(width_m=3.7, thickness_m=0.6), piers=piers, pier_caps=CAPS, skew_deg=skew_deg)
    return build_model(scenario(of_bridge, reinforcement=(layer,), fracture=FractureSettings(shards=120)))


def pull(built, member, axis, at_m):
    """Force of bars between the shards of a member on both sides of a plane."""
    (index,) = [number for number, known in enumerate(built.members) if known.name == member]
    own = np.append(built.member_of_shard == index, False)
    before = np.append(built.centres_m[:, axis] < at_m, False)
    pairs = built.connections.pairs
    rows = own[pairs].all(axis=1)
    signs = np.sign(built.connections.normals[:, axis]) * (before[pairs[:, 0]].astype(int) - before[pairs[:, 1]])
    return float((signs * built.bars.yield_n)[rows].sum())


@pytest.mark.parametrize("piers", [WALL, COLUMN])
@pytest.mark.parametrize("skew_deg", [0.0, 15.0, 40.0])
def test_upright_bars_of_skewed_piers(skew_deg, piers):
    """The whole layer crosses each level section, wherever its pier is turned or sheared to."""
    built = model(UPRIGHT, skew_deg, piers)
    groups = [group for group in layers_of_members((UPRIGHT,), built.members)]
    (force,) = groups[0].section(35e6).across_cracks_n()
    assert groups[0].widths_m == pytest.approx((piers.column_width_m,))
    assert pull(built, "pier 1", 2, 3.0) == pytest.approx(force, rel=1e-6)


@pytest.mark.parametrize("skew_deg", [0.0, 30.0])
def test_bars_along_a_skewed_cap(skew_deg):
    built = model(IN_CAP, skew_deg, replace(WALL, column_length_m=0.7))
    (group, _) = layers_of_members((IN_CAP,), built.members)
    assert group.widths_m == pytest.approx((1.2,))
    (force,) = group.section(35e6).across_cracks_n()
    assert pull(built, "pier 1 cap", 1, 0.1) == pytest.approx(force, rel=1e-6)


def test_bars_pull_at_the_face_of_a_skewed_wall():
    """60 mm behind the face at its start, which goes through x = y tan 40° - 0.45 m."""
    built = model(UPRIGHT, 40.0, WALL)
    across = section_axes(built.connections.normals)[:, :, 1:]
    positions = built.connections.points + transformed(across, built.bars.offsets_m)
    wall = [member.name for member in built.members].index("pier 1")
    rows = (built.bars.yield_n > 0.0) & (built.member_of_shard[built.connections.pairs[:, 0]] == wall)
    rows &= built.connections.pairs[:, 1] >= 0  # not those into the ground
    x, y = positions[rows, 0], positions[rows, 1]
    assert rows.any()
    np.testing.assert_allclose(x, y * np.tan(np.radians(40.0)) - 0.45 + 0.06, atol=1e-6)
