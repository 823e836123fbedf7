# SPDX-License-Identifier: GPL-3.0-or-later
"""Slings of a crane against the lever rule, equilibrium of three, and the angle of a part that hangs askew."""

import math

import numpy as np
import pytest

from bridge_demolition_addon.engineering.geometry.vectors import unit
from bridge_demolition_addon.engineering.mechanics.slings import hanging, sling_forces_n

WEIGHT_N, EA_N = 1200.0, 1e6


def upright(points, hook, forces):
    return forces * unit(np.subtract(hook, points))[:, 2]


def test_two_slings_carry_what_the_lever_rule_says():
    """2 m and 4 m beside the hook: 4 / 6 and 2 / 6 of the weight upright."""
    points, hook = np.array([[0.0, 0.0, 0.0], [6.0, 0.0, 0.0]]), np.array([2.0, 0.0, 5.0])
    hangs = hanging(points, hook, np.array([2.0, 0.0, -1.0]), WEIGHT_N, EA_N)
    np.testing.assert_allclose(upright(points, hook, hangs.forces_n), (800.0, 400.0), rtol=1e-6)
    assert hangs.tilt_rad == pytest.approx(0.0, abs=1e-9)


def test_a_part_turns_until_its_centre_of_gravity_is_below_the_hook():
    """1 m beside the hook and 6 m below it: atan(1 / 6), and forces that are in equilibrium in that position."""
    points, hook, centre = (
        np.array([[0.0, 0.0, 0.0], [6.0, 0.0, 0.0]]),
        np.array([3.0, 0.0, 5.0]),
        np.array([2, 0, -1.0]),
    )
    hangs = hanging(points, hook, centre, WEIGHT_N, EA_N)
    assert hangs.tilt_rad == pytest.approx(math.atan(1.0 / 6.0), rel=1e-9)
    total = (hangs.forces_n[:, None] * unit(hook - points)).sum(axis=0)
    np.testing.assert_allclose(total, WEIGHT_N * unit(hook - centre), atol=1e-3)


def test_two_slings_beside_the_middle_let_a_part_swing_about_their_line():
    """0.1 m beside the line and 1 m below it."""
    points, hook = np.array([[0.0, 0.0, 0.0], [6.0, 0.0, 0.0]]), np.array([3.0, 0.0, 5.0])
    hangs = hanging(points, hook, np.array([3.0, 0.1, -1.0]), WEIGHT_N, EA_N)
    assert hangs.tilt_rad == pytest.approx(math.atan(0.1), rel=1e-9)
    np.testing.assert_allclose(upright(points, hook, hangs.forces_n), 600.0, rtol=1e-6)


def test_three_slings_are_determinate_and_four_share_by_their_stiffness():
    """Corners of a triangle about the middle: by lever rule; of a square: a quarter each."""
    hook, centre = np.array([0.0, 0.0, 4.0]), np.array([0.0, 0.0, -1.0])
    three = np.array([[-1.0, -2.0, 0.0], [-1.0, 2.0, 0.0], [3.0, 0.0, 0.0]])
    shares = upright(three, hook, hanging(three, hook, centre, WEIGHT_N, EA_N).forces_n)
    np.testing.assert_allclose(shares, (450.0, 450.0, 300.0), rtol=1e-6)
    four = np.array([[x, y, 0.0] for x in (-2.0, 2.0) for y in (-1.0, 1.0)])
    np.testing.assert_allclose(
        upright(four, hook, hanging(four, hook, centre, WEIGHT_N, EA_N).forces_n), 300.0, rtol=1e-6
    )


def test_slings_do_not_press():
    """The hook stands over the second of three slings along a line: the one beyond is slack."""
    points = np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 0.0, -1.0]])
    forces = sling_forces_n(points, np.array([3.0, 0.0, 4.0]), np.array([0.0, 0.0, WEIGHT_N]), EA_N)
    assert (forces >= 0.0).all()


def test_one_sling_carries_all_and_the_part_hangs_below_it():
    hangs = hanging(np.zeros((1, 3)), np.array([0.0, 0.0, 5.0]), np.array([1.0, 0.0, -1.0]), WEIGHT_N, EA_N)
    assert hangs.forces_n == pytest.approx([WEIGHT_N])
    assert hangs.tilt_rad == pytest.approx(math.pi / 4.0)
