# SPDX-License-Identifier: GPL-3.0-or-later
"""A cable against Hooke's law, its energy, and the exact swing of a mass that hangs on it."""

import math

import pytest

from bridge_demolition_addon.engineering.mechanics.slings import (
    cable_force_n,
    force_of_step_n,
    free_length_m,
    rope_stiffness_n,
    stored_j,
)


def test_it_pulls_by_hooke_and_never_pushes():
    """EA / L · Δ: 40 m of cable, 20 MN, stretched by 0.1 m pull with 50 kN, and hold 2.5 kJ."""
    assert cable_force_n(20e6, 40.0, 40.1) == pytest.approx(50e3, rel=1e-9)
    assert cable_force_n(20e6, 40.0, 39.9) == 0.0
    assert free_length_m(20e6, 50e3, 40.1) == pytest.approx(40.0, rel=1e-9)
    assert stored_j(20e6, 50e3, 40.0) == pytest.approx(0.5 * 50e3 * 0.1, rel=1e-9)


def test_a_rope_is_as_stiff_as_its_steel_by_hand():
    """30 mm: 0.58 · π / 4 · 30² = 410 mm² of steel; makers give 0.46 d² = 414 mm² for such ropes."""
    assert rope_stiffness_n(0.030) / 100e9 == pytest.approx(414e-6, rel=0.02)


@pytest.mark.parametrize("mass_kg", [10_000.0, 1.0])
def test_a_mass_on_a_cable_comes_to_rest_at_its_weight(mass_kg):
    """m g = EA / L · Δ, however light the mass is beside the stiffness and the step: with 1 kg ω h = 3.7, by explicit
    steps unstable from 2 on."""
    stiffness_n, free_m, step_s = 20e6, 40.0, 1.0 / 192.0
    down_m, speed_m_s, force_n = 0.0, 0.0, 0.0
    weight_n = 9.80665 * mass_kg
    damping_kg_s = 2.0 * math.sqrt(stiffness_n / free_m * mass_kg)
    for _ in range(2000):
        force_n = force_of_step_n(stiffness_n, free_m, free_m + down_m, speed_m_s, force_n, step_s, mass_kg)
        speed_m_s += step_s * (weight_n - force_n) / mass_kg
        speed_m_s /= 1.0 + step_s * damping_kg_s / mass_kg
        down_m += step_s * speed_m_s
    assert force_n == pytest.approx(weight_n, rel=1e-6)
    assert down_m == pytest.approx(weight_n * free_m / stiffness_n, rel=1e-6)
