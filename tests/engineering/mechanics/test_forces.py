# SPDX-License-Identifier: GPL-3.0-or-later
"""Forces on bodies against statics and Newton's third law."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.geometry.vectors import carried_points
from bridge_demolition_addon.engineering.mechanics.carried_sections import CarriedSections
from bridge_demolition_addon.engineering.mechanics.stress import PairSums

NO_PAIRS, NO_VECTORS = np.zeros((0, 2), int), np.zeros((0, 3))

# Body 0 is the ceiling; 1 weighs 100 N and hangs on it, 2 weighs 40 N and hangs on 1.
CHAIN = np.array([[1, 0], [1, 2]])
CHAIN_FORCES = np.array([[0.0, 0.0, 140.0], [0.0, 0.0, -40.0]])


def resultants(pairs, forces, bodies):
    return PairSums(pairs, None, (1, bodies)).resultants(forces[None])[0]


def magnitude_sums(pairs, magnitudes, bodies):
    return PairSums(pairs, None, (1, bodies)).sums(magnitudes[None])[0]


def test_resultants_in_a_hanging_chain_are_the_weights():
    expected = [[0, 0, -140], [0, 0, 100], [0, 0, 40]]
    assert resultants(CHAIN, CHAIN_FORCES, 3).tolist() == expected


def test_order_of_a_pair_turns_its_force():
    turned = CHAIN[:, ::-1]
    assert resultants(turned, -CHAIN_FORCES, 3).tolist() == resultants(CHAIN, CHAIN_FORCES, 3).tolist()


def test_sums_of_magnitudes_in_a_hanging_chain():
    assert magnitude_sums(CHAIN, np.linalg.norm(CHAIN_FORCES, axis=1), 3).tolist() == [140, 180, 40]


def test_a_squeezed_body_has_no_resultant_but_a_sum():
    pairs, squeeze = np.array([[0, 1], [0, 2]]), np.array([[3.0, 0.0, 4.0], [-3.0, 0.0, -4.0]])
    assert resultants(pairs, squeeze, 3)[0].tolist() == [0, 0, 0]
    assert magnitude_sums(pairs, np.linalg.norm(squeeze, axis=1), 3).tolist() == [10, 5, 5]


def test_forces_of_all_bodies_cancel():
    random = np.random.default_rng(1)
    first = random.integers(0, 50, 400)
    pairs = np.column_stack((first, (first + random.integers(1, 50, 400)) % 50))
    forces = random.normal(size=(400, 3))
    # Third law; the remainder is rounding in sums of some hundred numbers around 1.
    np.testing.assert_allclose(resultants(pairs, forces, 50).sum(axis=0), 0.0, atol=1e-12)
    # Each magnitude is counted on both of its bodies.
    magnitudes = np.linalg.norm(forces, axis=1)
    assert magnitude_sums(pairs, magnitudes, 50).sum() == pytest.approx(2 * magnitudes.sum())


def test_sub_steps_are_added_up_each_for_itself():
    both = PairSums(CHAIN, None, (2, 3)).resultants(np.stack((CHAIN_FORCES, 2.0 * CHAIN_FORCES)))
    assert both.tolist() == [[[0, 0, -140], [0, 0, 100], [0, 0, 40]], [[0, 0, -280], [0, 0, 200], [0, 0, 80]]]
    # Of pairs that are in one sub-step each, here none in the first, and the two in the third and second.
    single = PairSums(CHAIN[::-1], np.array([1, 2]), (3, 3)).differences(np.array([5.0, 7.0]))
    assert single.tolist() == [[0, 0, 0], [0, 5, -5], [-7, 7, 0]]


def test_bodies_without_connections_feel_nothing():
    assert resultants(NO_PAIRS, NO_VECTORS, 3).tolist() == np.zeros((3, 3)).tolist()
    assert magnitude_sums(NO_PAIRS, np.linalg.norm(NO_VECTORS, axis=1), 3).tolist() == [0, 0, 0]
    assert resultants(CHAIN, CHAIN_FORCES, 5)[3:].tolist() == np.zeros((2, 3)).tolist()


def moments_at(points, forces, torques, centres):
    """Moments about points of bodies that are not turned, each loaded about its own centre."""
    count = len(points)
    sections = CarriedSections(np.arange(count), np.ones(count), points - centres, np.tile(np.eye(3), (count, 1, 1)))
    turns = np.repeat(np.eye(3)[..., None], count, axis=-1)
    return sections.loads_at_once(np.concatenate((forces.T, torques.T)), centres.T, turns).moments_nm


def test_moment_that_clamps_a_cantilever():
    # A beam of 4 m along x weighs 10 N and is clamped at its left end. At rest there is no torque about its centre;
    # the clamp lifts with 10 N and turns the free end up, about -y, with weight times half the length.
    clamp, centre = np.array([[1.0, 5.0, 3.0]]), np.array([[3.0, 5.0, 3.0]])
    moment = moments_at(clamp, np.array([[0.0, 0.0, 10.0]]), np.zeros((1, 3)), centre)
    assert moment.tolist() == [[0, -20, 0]]


def test_a_hinge_carries_no_moment_whatever_its_lever_arm():
    points, centres = np.array([[0.5, 1.0, -2.0]]), np.array([[1.0, -1.0, 0.5]])
    force = np.array([[7.0, -3.0, 2.0]])
    # Torque of a force at the point, written out by components: r = (-0.5, 2, -2.5).
    torque = np.array([[2 * 2 - -2.5 * -3, -2.5 * 7 - -0.5 * 2, -0.5 * -3 - 2 * 7]])
    assert moments_at(points, force, torque, centres).tolist() == [[0, 0, 0]]


def test_points_turn_and_move_with_their_bodies():
    quarter_turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])  # x becomes y
    rotations = np.array([np.eye(3), quarter_turn])
    centres = np.array([[0.0, 0.0, 0.0], [10.0, 0.0, 5.0]])
    local = np.array([[1.0, 0.0, 2.0], [1.0, 2.0, 3.0], [0.0, 1.0, 0.0]])
    carried = carried_points(local, centres[[1, 0, 1]], rotations[[1, 0, 1]])
    assert carried.tolist() == [[10, 1, 7], [1, 2, 3], [9, 0, 5]]


def test_no_connections_have_no_moments_and_no_points():
    assert moments_at(NO_VECTORS, NO_VECTORS, NO_VECTORS, NO_VECTORS).shape == (0, 3)
    assert carried_points(NO_VECTORS, NO_VECTORS, np.zeros((0, 3, 3))).shape == (0, 3)
