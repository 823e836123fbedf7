# SPDX-License-Identifier: GPL-3.0-or-later
"""Bars as lines: their number, length and position by hand, also in skewed members and hollow ones."""

from dataclasses import replace

import numpy as np
import pytest
from support.bridges_by_rule import PIERS, bridge, scenario

from bridge_demolition_addon.display.bridge_preview import bar_lines
from bridge_demolition_addon.model.bridge.preparation import prepared_members
from bridge_demolition_addon.model.scenario import BarLayer, Deck

BOTTOM = BarLayer(members=("deck",), depth_m=0.05, area_mm2=6_280.0)


def lines_of(layer, **parts):
    members = prepared_members(scenario(bridge(None, **parts))).members
    return bar_lines((layer,), members).reshape(-1, 2, 3)


def test_bars_along_a_slab():
    """6280 mm² are 20 bars of 20 mm, each as long as the deck of 13 m, 5 cm above its underside at 5.5 m."""
    lines = lines_of(BOTTOM)
    assert len(lines) == 20
    np.testing.assert_allclose(lines[:, 1, 0] - lines[:, 0, 0], 13.0)
    np.testing.assert_allclose(lines[..., 2], 5.55)
    np.testing.assert_allclose(np.diff(lines[:, 0, 1]), 3.7 / 20)
    assert lines[..., 1].mean() == pytest.approx(0.0, abs=1e-9)


def test_bars_of_some_length():
    lines = lines_of(replace(BOTTOM, from_m=2.0, to_m=5.5))
    np.testing.assert_allclose(lines[..., 0], np.broadcast_to((2.0, 5.5), (20, 2)))


def test_no_layer_has_more_lines_than_can_be_told_apart():
    assert len(lines_of(replace(BOTTOM, area_mm2=60_000.0))) == 40
    assert len(lines_of(replace(BOTTOM, area_mm2=10.0))) == 2


def test_upright_bars_stand_in_a_rotated_column():
    """Columns are 4.9 m high; bars at the start are 6 cm behind that side, however the column is rotated."""
    upright = BarLayer(members=("pier 1",), along="z", side="start", depth_m=0.06, area_mm2=1_256.0)
    lines = lines_of(upright, piers=replace(PIERS, columns=1), skew_deg=30.0)
    assert len(lines) == 4
    np.testing.assert_allclose(lines[:, 1, 2] - lines[:, 0, 2], 4.9)
    along = np.array([np.cos(np.radians(30.0)), -np.sin(np.radians(30.0))])  # the column's axis along the road
    np.testing.assert_allclose(lines[:, 0, :2] @ along, -0.35 + 0.06, atol=1e-9)


def test_bars_across_a_skewed_deck_follow_its_ends():
    across = replace(BOTTOM, along="y")
    lines = lines_of(across, deck=Deck(width_m=3.7, thickness_m=0.6), skew_deg=20.0)
    rise = lines[:, 1, 0] - lines[:, 0, 0]
    np.testing.assert_allclose(lines[:, 1, 1] - lines[:, 0, 1], 3.7)
    np.testing.assert_allclose(rise, 3.7 * np.tan(np.radians(20.0)))
