# SPDX-License-Identifier: GPL-3.0-or-later
"""Inertia of boxes against the formula of textbooks, and what an impulse at an arm does to two bodies."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.elasticity.joint_rows import (
    JointRows,
    effective_inverse_masses,
    inertia_tensors,
)

MASS_KG, SIDES_M = 12.0, np.array([3.0, 2.0, 1.0])
OF_A_BOX = MASS_KG / 12.0 * (np.sum(SIDES_M**2) - SIDES_M**2)
"""m (b² + c²) / 12 about each axis."""

ROUNDED = 1e-14


def turned_about_z(angle):
    cosine, sine = np.cos(angle), np.sin(angle)
    return np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])


def test_a_turned_box_has_the_inertia_of_a_box_in_its_own_axes():
    rotation = turned_about_z(0.7)
    inverse = rotation @ np.diag(1.0 / OF_A_BOX) @ rotation.T
    found = inertia_tensors(inverse[..., None], rotation[..., None], np.array([MASS_KG]))
    assert found[..., 0] == pytest.approx(np.diag(OF_A_BOX), rel=ROUNDED, abs=ROUNDED * MASS_KG)


def test_bodies_that_do_not_move_have_none():
    assert not inertia_tensors(np.zeros((3, 3, 1)), np.eye(3)[..., None], np.zeros(1)).any()


def test_an_impulse_at_an_arm_shifts_and_turns_both_bodies():
    """Along y at x = arm: 1/m + arm²/I_z of the first body, whose second one is held; about z it is 1/I_z."""
    arm_m, rows = 1.5, JointRows.empty(1)
    rows.along[1, 1, 0], rows.turning[2, 2, 0] = 1.0, 1.0
    rows.first_turning[1, 2, 0] = arm_m
    inverse_inertias = np.zeros((3, 3, 2))
    inverse_inertias[..., 0] = np.diag(1.0 / OF_A_BOX)
    ends = np.array([0]), np.array([1])
    found = effective_inverse_masses(rows, ends, np.array([1.0 / MASS_KG, 0.0]), inverse_inertias)
    assert found[1, 0] == pytest.approx(1.0 / MASS_KG + arm_m**2 / OF_A_BOX[2], rel=ROUNDED)
    assert found[5, 0] == pytest.approx(1.0 / OF_A_BOX[2], rel=ROUNDED)
