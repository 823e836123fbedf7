# SPDX-License-Identifier: GPL-3.0-or-later
"""Forces across cracks: bars along themselves, sides that press and rub, and how they change."""

import numpy as np
import pytest
from support.core_terms import forces_and_tangents, term_of_law

from bridge_demolition_addon.engineering.elasticity.crack_state import DOWEL_SHARE, FRICTION, SHEARED
from bridge_demolition_addon.engineering.elasticity.steel_bars import Bars, Steel
from bridge_demolition_addon.engineering.elasticity.substep import CRACKS

YIELD_N, PRESSED_N_M, OPENING_M = 1e5, 1e9, 0.05
ALONG_X = np.array([1.0, 0.0, 0.0])


def law(normal, direction, grip_n=0.0, yield_n=YIELD_N):
    """A crack with the same law at its four corners."""
    normals, directions = (np.tile(np.asarray(vector, float)[:, None], 4) for vector in (normal, direction))
    bars, none = Bars.of(np.full(4, yield_n), Steel(hardening=1.0), OPENING_M), np.zeros((3, 4))
    arrays = {"yields": bars.yield_n, "stiffness": bars.stiffness_n_m, "modulus": bars.modulus_n_m}
    arrays |= {"slips": none, "flows": np.zeros(4), "normals": normals, "directions": directions, "rests": none}
    arrays |= {"pressed": np.full(4, PRESSED_N_M), "grips": np.full(4, grip_n)}
    arrays |= {"dowel": DOWEL_SHARE, "sheared": SHEARED}
    return term_of_law(CRACKS, arrays, none, np.zeros(4, int))


def opened(crack, gap):
    forces, tangents = forces_and_tangents(crack, np.tile(np.asarray(gap, float)[:, None], 4))
    return forces[:, 0], tangents[..., 0].copy()


def force(crack, gap):
    return opened(crack, gap)[0]


@pytest.mark.parametrize("angle", [0.0, 0.5, 1.0])
def test_bars_pull_with_their_yield_force_along_themselves_across_cracks_of_any_direction(angle):
    crack = law((np.cos(angle), np.sin(angle), 0.0), ALONG_X)
    np.testing.assert_allclose(force(crack, 0.01 * ALONG_X), YIELD_N * ALONG_X, atol=1e-6 * YIELD_N)


def test_bars_resist_as_dowels_across_themselves():
    slid = force(law(ALONG_X, ALONG_X), (0.0, 0.02, 0.0))
    # fib Model Code 2010: 0.9 A √(f_c f_y), with f_c / f_y = 35 / 500.
    np.testing.assert_allclose(slid, [0.0, 0.9 * np.sqrt(0.07) * YIELD_N, 0.0], atol=1e-6 * YIELD_N)


def test_pressed_sides_press_and_rub_up_to_their_friction():
    crack = law(ALONG_X, ALONG_X, grip_n=FRICTION * 2e5, yield_n=0.0)
    pressed, _, along = force(crack, (-2e-4, 0.0, 0.01))
    assert pressed == pytest.approx(-2e5)
    assert along == pytest.approx(0.7 * 2e5)
    assert force(crack, (0.01, 0.0, 0.0)) == pytest.approx([0.0, 0.0, 0.0])


@pytest.mark.parametrize("gap", [(1e-4, 2e-4, 0.0), (0.01, 0.003, -0.002), (-1e-4, 1e-5, 2e-5), (-1e-4, 0.01, 0.0)])
def test_tangents_are_the_slope_of_the_forces(gap):
    crack = law((0.8, 0.6, 0.0), ALONG_X, grip_n=5e4)
    step = 1e-9
    slopes = [
        (force(crack, np.asarray(gap) + step * axis) - force(crack, np.asarray(gap) - step * axis)) / (2.0 * step)
        for axis in np.eye(3)
    ]
    found = opened(crack, gap)[1]
    np.testing.assert_allclose(found, np.transpose(slopes), atol=1e-4 * PRESSED_N_M)
