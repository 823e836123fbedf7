# SPDX-License-Identifier: GPL-3.0-or-later
"""Two blocks with a crack between them at rest, against the law of bars and of friction by hand."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.elasticity.crack_state import FRICTION
from bridge_demolition_addon.engineering.elasticity.cracked_equilibrium import BuiltStructure, CrackedStructure
from bridge_demolition_addon.engineering.elasticity.cracks import Cracks, corner_positions
from bridge_demolition_addon.engineering.elasticity.equations import RigidBodies
from bridge_demolition_addon.engineering.elasticity.equilibrium import equilibrium
from bridge_demolition_addon.engineering.elasticity.joint_rows import JointFrames
from bridge_demolition_addon.engineering.elasticity.steel_bars import Steel
from bridge_demolition_addon.engineering.elasticity.structure import ElasticStructure

MASS_KG, SIDE_M, THICK_M, STIFFNESS_N_M, GRAVITY_M_S2 = 2000.0, 4.0, 0.1, 1e9, 10.0
WEIGHT_N = MASS_KG * GRAVITY_M_S2


def plates(yield_n, opening_m, steel, side):
    """A plate that is above another (side 1), or hangs below it (-1), which never moves; one face connects them."""
    height_m = side * THICK_M
    inertia = MASS_KG * SIDE_M**2 / 12.0 * np.diag([1.0, 1.0, 2.0])
    unturned = np.repeat(np.eye(3)[:, :, None], 2, axis=2)
    bodies = RigidBodies(
        np.array([0.0, MASS_KG]),
        np.stack((np.zeros((3, 3)), inertia), axis=2),
        np.array([[0.0, 0.0], [0.0, 0.0], [0.0, height_m]]),
        unturned,
    )
    axes, half = np.eye(3)[:, :, None], np.array([[0.0], [0.0], [height_m / 2.0]])
    frames = JointFrames(np.array([0]), np.array([1]), axes, axes, half, -half)
    stiffness = (STIFFNESS_N_M * np.diag([1.0] * 3 + [SIDE_M**2] * 3))[:, :, None]
    left, one = np.ones(1), np.full(1, True)
    cracks = Cracks(steel, np.array([opening_m]), np.full((4, 1), yield_n / 4.0), left, np.array([STIFFNESS_N_M]))
    rest = equilibrium(frames, stiffness, bodies, np.zeros(3))
    return CrackedStructure(BuiltStructure(frames, stiffness, bodies), cracks, left, one, rest)


def carries(structure, side, acceleration_m_s2, pause=lambda: None):
    """Whether it comes to rest, once its connection has cracked, with this acceleration."""

    def tear(cracks, rows, positions_m, rotations):
        normals = np.array([[0.0], [0.0], [float(side)]])
        across = np.eye(3)[:, :2, None]
        places = corner_positions(side * THICK_M / 2.0 * abs(normals), across, np.full((2, 1), SIDE_M))
        cracks.add(rows, np.array([0]), np.array([1]), places, normals, normals, positions_m, rotations)

    accelerations = np.zeros((6, 2))
    accelerations[:3, 1] = acceleration_m_s2
    return structure.load(accelerations, lambda loads, intact: np.flatnonzero(intact), tear, pause)


@pytest.mark.slow
def test_a_plate_hangs_by_bars_as_the_bilinear_law_says():
    """Elastic below the force at which they yield, then on the slope of hardening, and down beyond its end."""
    steel, opening_m = Steel(hardening=1.5), 0.1
    yield_n = WEIGHT_N / 1.25
    at_yield_m = opening_m * steel.yield_strain / steel.rupture_strain
    hanging = plates(yield_n, opening_m, steel, -1)
    assert carries(hanging, -1, (0.0, 0.0, -0.4 * GRAVITY_M_S2))
    # Each step leaves 1e-4 of the load; the part of the mass in the equations is far less.
    assert -hanging.positions_m[2, 1] - THICK_M == pytest.approx(0.5 * at_yield_m, rel=1e-2)
    np.testing.assert_allclose(hanging.cracks.used(hanging.positions_m, hanging.rotations), 0.5 / 1.5, rtol=1e-2)
    np.testing.assert_allclose(hanging.loads[2], -0.4 * WEIGHT_N, rtol=1e-3)
    assert carries(hanging, -1, (0.0, 0.0, -GRAVITY_M_S2))
    hardened_m = at_yield_m + 0.5 * (opening_m - at_yield_m)
    assert -hanging.positions_m[2, 1] - THICK_M == pytest.approx(hardened_m, rel=1e-2)
    # Let go, bars are as stiff as before, and keep what they have yielded by.
    assert carries(hanging, -1, (0.0, 0.0, -0.4 * GRAVITY_M_S2))
    assert -hanging.positions_m[2, 1] - THICK_M == pytest.approx(hardened_m - 0.75 * at_yield_m, rel=1e-2)
    assert hanging.held[1]
    carries(hanging, -1, (0.0, 0.0, -1.25 * GRAVITY_M_S2))
    assert not hanging.held[1]


@pytest.mark.parametrize(("share", "holds"), [(0.95, True), (1.05, False)])
def test_a_plate_without_bars_is_held_by_friction(share, holds):
    """Force along the crack over that across it, by the friction of its sides."""
    lying = plates(0.0, 0.0, Steel(), 1)
    carries(lying, 1, (share * FRICTION * GRAVITY_M_S2, 0.0, -GRAVITY_M_S2))
    assert lying.held[1] == holds


def test_a_copy_goes_on_by_itself():
    hanging = plates(WEIGHT_N / 1.25, 0.1, Steel(hardening=1.5), -1)
    carries(hanging, -1, (0.0, 0.0, -0.4 * GRAVITY_M_S2))
    before_m, other = hanging.positions_m.copy(), hanging.copy()
    carries(other, -1, (0.0, 0.0, -1.25 * GRAVITY_M_S2))
    assert not other.held[1]
    assert hanging.held[1]
    np.testing.assert_array_equal(hanging.positions_m, before_m)
    assert carries(hanging, -1, (0.0, 0.0, -0.4 * GRAVITY_M_S2))


def test_others_go_on_before_each_solving(monkeypatch):
    """Also where sides of the crack rub and it is solved again with that: one after another they would take long."""
    done, solve = [], ElasticStructure.step

    def noted(structure, *arguments):
        done.append("solved")
        return solve(structure, *arguments)

    monkeypatch.setattr(ElasticStructure, "step", noted)
    lying = plates(0.0, 0.0, Steel(), 1)
    carries(lying, 1, (0.95 * FRICTION * GRAVITY_M_S2, 0.0, -GRAVITY_M_S2), lambda: done.append("paused"))
    assert len(done) > 2
    assert done == ["paused", "solved"] * (len(done) // 2)
