# SPDX-License-Identifier: GPL-3.0-or-later
"""Mean strains of bars between cracks, against stresses along them that are added up step by step."""

import pytest

from bridge_demolition_addon.engineering.elasticity.steel_bars import (
    MODULUS_PA,
    Steel,
    crack_spacing_m,
    mean_strain_at_rupture,
    rupture_opening_m,
    tensile_strength_pa,
)

CLASS_B = Steel(500e6, 1.08, 0.05)


def strain_along(steel, diameter_m, spacing_m, tensile_pa, steps=200_000):
    """Mean strain from a crack to half-way to the next, where bond takes stress off the bar step by step."""
    step = 0.5 * spacing_m / steps
    stress, total = steel.hardening * steel.yield_pa, 0.0
    slope = (steel.hardening - 1.0) * steel.yield_pa / (steel.rupture_strain - steel.yield_strain)
    for _ in range(steps):
        yields = stress > steel.yield_pa
        total += steel.yield_strain + (stress - steel.yield_pa) / slope if yields else max(stress, 0.0) / MODULUS_PA
        stress -= 4.0 * (1.0 if yields else 2.0) * tensile_pa / diameter_m * step
    return total / steps


@pytest.mark.parametrize("spacing_m", [0.05, 0.2, 0.4, 2.0])
@pytest.mark.parametrize("steel", [CLASS_B, Steel(500e6, 1.15, 0.075), Steel(420e6, 1.05, 0.025)])
def test_strain_is_that_of_stresses_along_the_bar(steel, spacing_m):
    found = mean_strain_at_rupture(steel, 0.02, spacing_m, 3.2e6)
    # A step of the sum is at most 1e-5 of the length.
    assert found == pytest.approx(strain_along(steel, 0.02, spacing_m, 3.2e6), rel=1e-3)


def test_without_bond_all_of_a_bar_strains_as_in_the_crack():
    assert mean_strain_at_rupture(CLASS_B, 0.02, 0.2, 1.0) == pytest.approx(0.05, rel=1e-6)


def test_strength_and_spacing_by_hand():
    # EN 1992-1-1:2004, table 3.1: f_ctm of C30/37 is 2.9 N/mm², of C40/50 3.5 N/mm².
    assert tensile_strength_pa(30e6) == pytest.approx(2.9e6, rel=0.01)
    assert tensile_strength_pa(40e6) == pytest.approx(3.5e6, rel=0.01)
    # 2000 mm² in 1 m x 125 mm: ρ = 0.016, d (1 - ρ) / (4 ρ) = 307.5 mm, of which three quarters.
    assert crack_spacing_m(0.02, 2000e-6, 1.0, 0.05, 0.6) == pytest.approx(0.75 * 0.3075)
    assert rupture_opening_m(0.02, 0.5) == pytest.approx(0.012)
