# SPDX-License-Identifier: GPL-3.0-or-later
"""A bearing without tension is left once it has opened, or both sides have turned, farther than it is made for."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.elasticity.bearings import Bearings, PadSprings

ABOVE, BELOW = (0.0, 0.0, 0.5), (0.0, 0.0, -0.5)


def bearing(*, pulls):
    """Two pads in a line across the road, at the origin, and the positions and rotations of both bodies."""
    springs = PadSprings(
        rows=np.array([0]),
        parts=np.array([0, 0]),
        places_m=np.array([[0.0, -1.0, 0.0], [0.0, 1.0, 0.0]]),
        vertical_n_m=np.full(2, 1e8),
        sideways_n_m=np.full((2, 2), 1e7),
        friction=np.array([np.inf]),
        pulls=np.array([pulls]),
        travel_m=np.array([0.2]),
        bearings=np.array([0]),
        breaking_n=np.array([np.inf]),
    )
    positions, rotations = np.array([ABOVE, BELOW]).T, np.repeat(np.eye(3)[:, :, None], 2, axis=2)
    return Bearings(springs, *np.array([[0], [1]]), np.array([0]), positions, rotations), positions, rotations


def is_left(found, positions, rotations):
    found.update_plastic_state(positions, rotations)
    return len(found.failed(np.ones(1, bool), np.ones(1))) == 1


def about_the_pads(angle_rad, positions, rotations):
    """The body above, turned about the line through the pads."""
    cos, sin = np.cos(angle_rad), np.sin(angle_rad)
    turn = np.array([[cos, 0.0, sin], [0.0, 1.0, 0.0], [-sin, 0.0, cos]])
    positions, rotations = positions.copy(), rotations.copy()
    positions[:, 0] = turn @ positions[:, 0]
    rotations[..., 0] = turn
    return positions, rotations


@pytest.mark.parametrize("angle_rad, left", [(0.0, False), (0.04, False), (-0.04, False), (0.06, True), (-0.06, True)])
def test_a_deck_that_turns_lies_on_its_edge_and_no_longer_on_pads(angle_rad, left):
    found, *built = bearing(pulls=False)
    assert is_left(found, *about_the_pads(angle_rad, *built)) == left


@pytest.mark.parametrize("lifted_m, left", [(-0.001, False), (0.015, False), (0.025, True)])
def test_a_deck_that_is_lifted_off_its_pins_is_free(lifted_m, left):
    found, positions, rotations = bearing(pulls=False)
    positions = positions + np.array([[0.0, 0.0], [0.0, 0.0], [lifted_m, 0.0]])
    assert is_left(found, positions, rotations) == left


def test_a_bearing_with_tension_holds_on():
    found, positions, rotations = bearing(pulls=True)
    assert not is_left(found, *about_the_pads(0.06, positions, rotations))
    assert not is_left(found, positions + np.array([[0.0, 0.0], [0.0, 0.0], [0.05, 0.0]]), rotations)
