# SPDX-License-Identifier: GPL-3.0-or-later
"""Outlines of bridge and ball: edges counted and measured by hand, heights from the sizes in the scenario."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.checkout import DEMOLITIONS

from bridge_demolition_addon.display.bridge_preview import ball_lines, bridge_edges, outline, sharp_edges
from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh
from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.model.bridge.preparation import prepared_members
from bridge_demolition_addon.model.scenario.ball import BallCable
from bridge_demolition_addon.model.scenario.file import read_scenario

BALL = read_scenario(DEMOLITIONS["two_spans_13m_ball"])
SCENARIOS = list(DEMOLITIONS.values())


def lengths(lines):
    return np.linalg.norm(lines[1::2] - lines[::2], axis=1)


def test_a_box_has_twelve_edges_and_none_across_its_faces():
    lines = sharp_edges(box((2.0, 3.0, 5.0), (1.0, 1.0, 1.0)))
    assert sorted(lengths(lines).tolist()) == pytest.approx([2.0] * 4 + [3.0] * 4 + [5.0] * 4)


def test_a_surface_with_a_hole_is_refused():
    solid = box((1.0, 1.0, 1.0))
    with pytest.raises(ValueError, match="not closed"):
        sharp_edges(TriangleMesh(solid.vertices, solid.triangles[1:]))


@pytest.mark.parametrize("path", SCENARIOS, ids=lambda path: path.stem)
def test_the_outline_reaches_just_as_far_as_what_is_built(path):
    scenario = read_scenario(path)
    if not scenario.bridge or scenario.geometry:
        return
    corners = np.concatenate([member.solid.corners.reshape(-1, 3) for member in prepared_members(scenario).members])
    lines = bridge_edges(scenario.bridge)
    np.testing.assert_allclose(lines.min(axis=0), corners.min(axis=0), atol=1e-9)
    np.testing.assert_allclose(lines.max(axis=0), corners.max(axis=0), atol=1e-9)


def test_the_ball_hangs_its_drop_height_over_the_deck_and_falls_on_its_target():
    bridge, ball = BALL.bridge, BALL.ball
    lines = outline(bridge, ball)[len(bridge_edges(bridge)) :]
    top = bridge.piers.height_m + (bridge.pier_caps.height_m if bridge.pier_caps else 0.0) + bridge.deck.thickness_m
    assert lines[:, 2].max() == pytest.approx(top + ball.drop_height_m + ball.diameter_m)
    middle = lines[np.argsort(lengths(lines))[-1] * 2 :][:2]
    assert middle[0] == pytest.approx((*ball.target_m, top + ball.drop_height_m + ball.diameter_m / 2.0))
    assert middle[1] == pytest.approx((*ball.target_m, top))


def test_a_swinging_ball_needs_nothing_under_it_and_its_way_is_an_arc_about_the_crane():
    cable = BallCable(crane_point_m=(1.0, 2.0, 20.0), length_m=8.0, angle_degrees=60.0, azimuth_degrees=90.0)
    ball = replace(BALL.ball, target_m=None, drop_height_m=None, hits=(), cable=cable)
    arc = ball_lines(ball, None)[-2 * 24 :]
    np.testing.assert_allclose(np.linalg.norm(arc - cable.crane_point_m, axis=1), 8.0)
    assert arc[0] == pytest.approx((1.0, 2.0 + 8.0 * math.sin(math.radians(60.0)), 16.0))
    assert arc[-1] == pytest.approx((1.0, 2.0, 12.0))


def test_a_drop_on_what_is_not_known_is_not_drawn():
    assert len(ball_lines(BALL.ball, None)) == 0
    assert len(outline(BALL.bridge, BALL.ball, is_all=False)) == len(bridge_edges(BALL.bridge))
