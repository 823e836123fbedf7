# SPDX-License-Identifier: GPL-3.0-or-later
"""Punching resistance, held against the table of the Concrete Centre for C30/37, of which γ_c = 1.5 is taken out."""

import math

import pytest

from bridge_demolition_addon.engineering.reinforced_concrete.resistance import punching_n, punching_stress_pa

V_RD_C = {
    (0.20, 0.0025): 0.54,
    (0.20, 0.0050): 0.59,
    (0.20, 0.0100): 0.75,
    (0.20, 0.0200): 0.94,
    (0.30, 0.0100): 0.68,
}
"""N/mm², by depth and ratio: How to design concrete structures using Eurocode 2, table of v_Rd,c."""


@pytest.mark.parametrize(("depth_m", "ratio"), V_RD_C)
def test_stresses_of_the_table(depth_m, ratio):
    # The table has two decimals.
    assert punching_stress_pa(depth_m, ratio, 30e6) / 1.5e6 == pytest.approx(V_RD_C[depth_m, ratio], abs=0.006)


def test_force_on_the_perimeter_at_two_depths():
    """d = 0.2 m under a circle of 0.5 m: u = π (0.5 + 0.8) m = 4.084 m."""
    assert punching_n(0.2, 0.5, 0.005, 30e6) == pytest.approx(1.5 * 0.592e6 * 4.084 * 0.2, rel=1e-3)
    assert punching_n(0.2, 0.0, 0.005, 30e6) == pytest.approx(1.5 * 0.592e6 * math.pi * 0.8 * 0.2, rel=1e-3)
