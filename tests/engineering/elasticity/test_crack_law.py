# SPDX-License-Identifier: GPL-3.0-or-later
"""Forces across cracks: bars along themselves, sides that press and rub, and how they change."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.elasticity.crack_law import FRICTION, CrackLaw
from bridge_demolition_addon.engineering.elasticity.steel_bars import Bars, Steel

YIELD_N, PRESSED_N_M, OPENING_M = 1e5, 1e9, 0.05
ALONG_X = np.array([1.0, 0.0, 0.0])


def law(normal, direction, grip_n=0.0, yield_n=YIELD_N):
    columns = [np.asarray(vector, float)[:, None] for vector in (normal, direction)]
    bars = Bars.of(np.array([yield_n]), Steel(hardening=1.0), OPENING_M)
    none = np.zeros((3, 1))
    return CrackLaw(bars, none, np.zeros(1), *columns, np.array([PRESSED_N_M]), none, np.array([grip_n]))


def force(crack, gap):
    return crack.forces(np.asarray(gap, float)[:, None])[:, 0]


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
    found = crack.linear(np.asarray(gap, float)[:, None])[1][..., 0]
    np.testing.assert_allclose(found, np.transpose(slopes), atol=1e-4 * PRESSED_N_M)
