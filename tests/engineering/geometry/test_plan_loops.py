# SPDX-License-Identifier: GPL-3.0-or-later
"""Compiled loops over points and paths in plan give the bits of numpy."""

import numpy as np
import pytest
from manifold3d import CrossSection

from bridge_demolition_addon.engineering.geometry import plan_areas, plan_paths
from bridge_demolition_addon.engineering.geometry.plan_areas import distances_outside, plan_loops
from bridge_demolition_addon.engineering.geometry.plan_paths import (
    bends_and_moves,
    ends_of_straight_parts,
    path_of_corners,
)

pytest.importorskip("numba")


@pytest.fixture
def without_numba(monkeypatch):
    def leave_out():
        monkeypatch.setattr(plan_areas, "plan_loops", lambda: None)
        monkeypatch.setattr(plan_paths, "plan_loops", lambda: None)

    return leave_out


def with_a_hole():
    outer, inner = CrossSection.circle(3.0, 40), CrossSection.square([1.0, 2.0])
    return (outer - inner) + CrossSection.square([1.0, 1.0]).translate([5.0, 0.0])


def test_distances_are_those_of_numpy(without_numba):
    area = with_a_hole()
    corners = np.concatenate([np.asarray(ring) for ring in area.to_polygons()])
    points = np.concatenate([np.random.default_rng(1).uniform(-6.0, 6.0, (3000, 2)), corners, np.zeros((1, 2))])
    compiled = distances_outside(area, points)
    assert plan_loops() is not None
    without_numba()
    np.testing.assert_array_equal(compiled, distances_outside(area, points))
    assert (compiled == 0.0).any() and (compiled > 0.0).any()


@pytest.mark.parametrize("lost", [(np.nan, 1.0), (1.0, np.nan), (np.inf, 0.0), (9.0, -np.inf)])
def test_points_that_are_lost_have_the_distance_of_numpy(without_numba, lost):
    area, points = with_a_hole(), np.array([lost, (9.0, 0.0)])
    with np.errstate(invalid="ignore"):
        compiled = distances_outside(area, points)
        without_numba()
        np.testing.assert_array_equal(compiled, distances_outside(area, points))


@pytest.mark.parametrize("steps", [1, 2, 3, 80])
def test_bends_and_moves_are_those_of_numpy(without_numba, steps):
    fall = np.cumsum(np.random.default_rng(2).normal(size=(steps, 1, 2)), axis=0)
    plans = np.ascontiguousarray(fall + np.random.default_rng(3).normal(scale=1e-3, size=(steps, 9, 2)))
    plans[steps // 2 :] = plans[steps // 2]
    compiled, ends = bends_and_moves(plans), ends_of_straight_parts(plans, 0.01)
    without_numba()
    for found, expected in zip(compiled, bends_and_moves(plans), strict=True):
        np.testing.assert_array_equal(found, expected)
    assert ends == ends_of_straight_parts(plans, 0.01)
    assert ends[0] == 0 and ends[-1] == steps - 1


def test_corners_in_plan_are_those_of_numpy(without_numba):
    rng = np.random.default_rng(4)
    rotations, positions = rng.normal(size=(60, 3, 3)), rng.normal(scale=50.0, size=(60, 3))
    corners = rng.normal(size=(14, 3))
    compiled = path_of_corners(rotations, positions, corners)
    without_numba()
    np.testing.assert_array_equal(compiled, path_of_corners(rotations, positions, corners))
    assert compiled.shape == (60, 14, 2)
