# SPDX-License-Identifier: GPL-3.0-or-later
"""Sides of a crack that turn on each other about one corner: they press where they still lie on each other alone."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.elasticity.cracks import Cracks, corner_positions
from bridge_demolition_addon.engineering.elasticity.steel_bars import Steel

PRESSED_N_M, CLOSED_M = 2e9, 1e-4
WIDTH_M, HEIGHT_M = 0.6, 1.2


def crack():
    """Two bodies that touch in a plane across x, and the corners there; bars hold in the first corner."""
    positions, rotations = np.zeros((3, 2)), np.repeat(np.eye(3)[..., None], 2, axis=-1)
    axes = np.eye(3)[:, 1:, None]
    corners = corner_positions(np.zeros((3, 1)), axes, np.array([[WIDTH_M], [HEIGHT_M]]))
    yields = np.array([[1e3], [0.0], [0.0], [0.0]])
    cracks = Cracks(Steel(), np.full(1, 0.02), yields, np.ones(1), np.full(1, PRESSED_N_M))
    one, along = np.zeros(1, int), np.eye(3)[:, :1]
    cracks.add(one, one, one + 1, corners, along, along, positions, rotations)
    return cracks, corners[:, 0, 0]


def placed(hinge, degrees):
    """Places of the bodies once the second has turned in the plane about a point, and is pressed a little."""
    cosine, sine = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    turned = np.array([[1.0, 0.0, 0.0], [0.0, cosine, -sine], [0.0, sine, cosine]])
    positions = np.stack((np.zeros(3), hinge - turned @ hinge - (CLOSED_M, 0.0, 0.0)), axis=1)
    return positions, np.stack((np.eye(3), turned), axis=-1)


def pressing(cracks, places):
    """Corners that press, by the energy of all."""
    cracks.update_plastic_state(*places)
    of_one = 0.5 * PRESSED_N_M / 4.0 * CLOSED_M * CLOSED_M
    return cracks.state(*places).stored_j[0] / of_one


def test_a_side_presses_where_it_lies_on_the_other():
    # By 20° corners move by at most 0.35 times the diagonal, and lie on the other side; by 90° all but the hinge move
    # by 1.4 times a side of the face or more, and lie beside it.
    cracks, hinge = crack()
    assert pressing(cracks, placed(hinge, 20.0)) == pytest.approx(4.0, abs=0.01)  # bars in the hinge add a little
    assert pressing(cracks, placed(hinge, 90.0)) == pytest.approx(1.0, abs=0.01)


def test_a_side_that_has_slid_off_does_not_press_again():
    cracks, hinge = crack()
    pressing(cracks, placed(hinge, 90.0))
    assert pressing(cracks, placed(hinge, 5.0)) == pytest.approx(1.0, abs=0.01)
