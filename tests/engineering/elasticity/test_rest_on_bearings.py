# SPDX-License-Identifier: GPL-3.0-or-later
"""Blocks at rest on a bearing, far from the origin, tied to each other far more stiffly than the bearing is."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.elasticity.bearings import Bearings, PadSprings
from bridge_demolition_addon.engineering.elasticity.equations import RigidBodies
from bridge_demolition_addon.engineering.elasticity.equilibrium import equilibrium
from bridge_demolition_addon.engineering.elasticity.joint_rows import JointFrames

GRAVITY_M_S2, VERTICAL_N_M, MASS_KG = 9.81, 4e8, 1000.0
PLACE_M = np.array([65.3, 4.1, 5.4])


@pytest.mark.parametrize("tie_n_m", [1e10, 1e13, 1e15])
def test_what_a_stiff_tie_rounds_does_not_keep_blocks_from_resting(tie_n_m):
    above, below = np.array([0, 1]), np.array([1, 2])
    pads = PadSprings(
        rows=np.ones(1, int),
        parts=np.zeros(4, int),
        places_m=PLACE_M + np.array([[x, y, 1.0] for x in (-0.5, 0.5) for y in (-0.5, 0.5)]),
        vertical_n_m=np.full(4, VERTICAL_N_M / 4),
        sideways_n_m=np.full((4, 2), VERTICAL_N_M / 16),
        friction=np.array([np.inf]),
        pulls=np.zeros(1, bool),
        travel_m=np.ones(1),
        bearings=np.zeros(1, int),
        breaking_n=np.array([np.inf]),
    )
    axes = np.repeat(np.eye(3)[:, :, None], 2, axis=2)
    levers = [np.array([[0.0, 0.0, height]] * 2).T for height in (-0.5, 0.5)]
    positions = (PLACE_M + np.array([[0.0, 0.0, height] for height in (2.5, 1.5, 0.5)])).T
    rotations = np.repeat(np.eye(3)[:, :, None], 3, axis=2)
    masses = np.array([MASS_KG, MASS_KG, 0.0])
    bodies = RigidBodies(masses, np.eye(3)[:, :, None] * masses / 6.0, positions, rotations)
    stiffness = np.zeros((6, 6, 2))
    stiffness[range(6), range(6), 0] = tie_n_m
    bearings = Bearings(pads, above, below, above[pads.rows], positions, rotations)
    rest = equilibrium(
        JointFrames(above, below, axes, axes, *levers),
        stiffness,
        bodies,
        np.array([0.0, 0.0, -GRAVITY_M_S2]),
        bearings=bearings,
    )
    sag_m = 2.0 * MASS_KG * GRAVITY_M_S2 / VERTICAL_N_M
    assert rest.held[:2].all()
    assert (positions - rest.positions_m)[2, 1] == pytest.approx(sag_m, rel=1e-6)
