# SPDX-License-Identifier: GPL-3.0-or-later
"""Ductile bars: directions and masses by hand, and how they hold, give way and let go of a mass on a line."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.mechanics.reinforcement import bar_forces, effective_masses, parting

STEP_S = 1.0 / 240.0
WEIGHT_N = 981.0
MASS_KG = 100.0


def test_parting_along_the_gap():
    points = np.array([[0.0, 0, 0]]), np.array([[0.3, 0.4, 0.0]])
    velocities = np.array([[1.0, 0, 0]]), np.array([[4.0, 4.0, 9.0]])
    distances, rates, directions = parting(*points, *velocities)
    assert distances == pytest.approx([0.5])
    np.testing.assert_allclose(directions, [[0.6, 0.8, 0.0]])
    assert rates == pytest.approx([3 * 0.6 + 4 * 0.8])


def test_points_that_are_still_one_part_along_their_velocity():
    here = np.zeros((2, 3))
    distances, rates, directions = parting(here, here, here, np.array([[0, 0, -2.0], [0, 0, 0]]))
    assert distances.tolist() == [0.0, 0.0]
    assert rates.tolist() == [2.0, 0.0]
    assert directions.tolist() == [[0, 0, -1], [0, 0, 0]]


def test_masses_are_reduced_and_shared_out():
    masses = np.array([0.0, 30.0, 60.0])
    # Against a fixed body its own mass, between two the reduced mass 20 kg; body 1 has two bars, so half each.
    np.testing.assert_allclose(effective_masses(masses, np.array([[1, 0], [1, 2]])), [15.0, 10.0])
    np.testing.assert_allclose(effective_masses(masses, np.array([[0, 0]])), [0.0])


def hung(yield_n, steps):
    """Speeds and tensions of a mass that hangs from a bar, step by step."""
    speed, held, history = 0.0, np.zeros(1), []
    for _ in range(steps):
        tension, held = bar_forces(held, np.array([speed]), np.array([MASS_KG]), np.array([yield_n]), STEP_S)
        speed += (WEIGHT_N - tension[0]) / MASS_KG * STEP_S
        history.append((speed, tension[0]))
    return np.array(history)


def test_tie_that_is_strong_enough_comes_to_hold_the_weight():
    speeds, tensions = hung(10 * WEIGHT_N, 60).T
    # The error shrinks to 0.71 in a step: to 1e-9 in sixty.
    assert tensions[-1] == pytest.approx(WEIGHT_N, rel=1e-8)
    assert speeds[-1] == pytest.approx(0.0, abs=1e-8)


def test_tie_that_is_too_weak_gives_way_under_its_yield_force():
    speeds, tensions = hung(0.25 * WEIGHT_N, 60).T
    np.testing.assert_allclose(tensions[10:], 0.25 * WEIGHT_N)
    np.testing.assert_allclose(np.diff(speeds)[10:], 0.75 * WEIGHT_N / MASS_KG * STEP_S)


def test_tie_never_pushes():
    tension, held = bar_forces(np.array([50.0]), np.array([-1.0]), np.array([MASS_KG]), np.array([1e6]), STEP_S)
    assert tension[0] == held[0] == 0.0
