# SPDX-License-Identifier: GPL-3.0-or-later
"""What pictures show: the bridge, what works on it, and where pieces fall."""

from dataclasses import replace

import pytest
from support.example_runs import example

from bridge_demolition_addon.display.camera_targets import points_to_see
from bridge_demolition_addon.model.structure.model import build_model


def seen(scenario):
    few = replace(scenario, fracture=replace(scenario.fracture, shards=20, finer=(), members=()))
    points = points_to_see(scenario, build_model(few).members)
    return points.min(axis=0), points.max(axis=0)


def test_a_ball_is_seen_where_it_hangs():
    lowest, highest = seen(example("i235_one_span"))
    # Deck at 4.9 + 0.4 + 0.25 m, 5 m above it a ball of 1.34 m; around the bridge half of its height.
    top = 5.55
    assert lowest == pytest.approx([-0.5 - top / 2.0, -4.25 - top / 2.0, 0.0])
    assert highest == pytest.approx([13.5 + top / 2.0, 4.25 + top / 2.0, top + 5.0 + 1.34])


def test_a_jackhammer_is_seen_above_the_deck():
    scenario = example("jackhammer_dismantling")
    (hammer,) = scenario.jackhammers
    # The chisel's tip begins at the top of its stroke, and goes down to its depth.
    surface_m = scenario.bridge.abutments.height_m + scenario.bridge.deck.thickness_m
    surface_m += scenario.bridge.girders.depth_m
    _, highest = seen(scenario)
    assert highest[2] == pytest.approx(surface_m + hammer.stroke_m - hammer.depth_m + hammer.length_m)
