# SPDX-License-Identifier: GPL-3.0-or-later
"""Bars that are stretched: the bilinear law of EN 1992-1-1:2004, figure 3.8, by hand, and what they are refused."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.elasticity.cracks import corner_positions
from bridge_demolition_addon.engineering.elasticity.steel_bars import Bars, Steel, bar_response
from bridge_demolition_addon.errors import ScenarioError

YIELD_N, ELONGATION_M = 100e3, 0.1
STEEL = Steel()
# 500 N/mm² by 200 000 N/mm² is a strain of 0.0025, a twentieth of the 5 % at which it ruptures.
AT_YIELD_M = ELONGATION_M / 20.0


def pulled(*stretches_m):
    """Forces of a bar along x, one stretch after another, and along y and z."""
    bars, slips, flows, forces = Bars.of(np.array([YIELD_N]), STEEL, ELONGATION_M), np.zeros((3, 1)), np.zeros(1), []
    for stretch_m in stretches_m:
        answer = bar_response(bars, np.array([[stretch_m], [0.0], [0.0]]), slips, flows)
        slips, flows = answer.slips_m, answer.flows_m
        assert answer.forces_n[1:].tolist() == [[0.0], [0.0]]
        forces.append(float(answer.forces_n[0, 0]))
    return forces


def test_a_bar_is_elastic_until_it_yields():
    assert pulled(0.5 * AT_YIELD_M, -0.5 * AT_YIELD_M, AT_YIELD_M) == pytest.approx([50e3, -50e3, YIELD_N])


def test_a_bar_hardens_in_proportion_until_it_ruptures():
    middle = AT_YIELD_M + 0.5 * (ELONGATION_M - AT_YIELD_M)
    assert pulled(middle) == pytest.approx([1.04 * YIELD_N])
    assert pulled(0.5 * middle, middle, ELONGATION_M)[1:] == pytest.approx([1.04 * YIELD_N, 1.08 * YIELD_N])


def test_a_bar_that_is_let_go_is_as_stiff_as_before_it_yielded():
    middle = AT_YIELD_M + 0.5 * (ELONGATION_M - AT_YIELD_M)
    less = pulled(middle, middle - 0.3 * AT_YIELD_M, middle)
    assert less == pytest.approx([1.04 * YIELD_N, 0.74 * YIELD_N, 1.04 * YIELD_N])


def test_tangents_are_how_forces_change():
    """Against differences, for a bar that yields along one way and is then pushed along others."""
    bars = Bars.of(np.full(3, YIELD_N), STEEL, ELONGATION_M)
    slips, flows = np.tile([[0.01], [0.002], [0.0]], 3), np.full(3, 0.0102)
    stretch, step = np.array([0.02, 0.015, -0.01]), 1e-9
    around = np.stack([stretch + sign * step * np.eye(3) for sign in (1.0, -1.0)])
    forces = [bar_response(bars, strains.T, slips, flows).forces_n for strains in around]
    differences = (forces[0] - forces[1]) / (2.0 * step)
    found = bar_response(bars, np.tile(stretch[:, None], 3), slips, flows).tangents_n_m[..., 0]
    np.testing.assert_allclose(found, differences, rtol=1e-4, atol=1e-5 * bars.stiffness_n_m[0])


def test_what_cracks_leave_is_at_the_corners_of_the_rectangle():
    axes = np.array([[[0.0], [0.0]], [[1.0], [0.0]], [[0.0], [1.0]]])
    positions = corner_positions(np.array([[5.0], [0.0], [2.0]]), axes, np.array([[0.4], [1.2]]))[..., 0]
    assert positions.T.tolist() == [[5.0, y, z] for y in (-0.2, 0.2) for z in (1.4, 2.6)]


@pytest.mark.parametrize(
    ("numbers", "message"),
    [((500e6, 1.08, 0.0025), "rupture_strain"), ((500e6, 0.99, 0.05), "hardening"), ((0.0, 1.08, 0.05), "yield_pa")],
)
def test_there_is_no_such_steel(numbers, message):
    with pytest.raises(ScenarioError, match=message):
        Steel(*numbers)
