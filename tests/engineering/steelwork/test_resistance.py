# SPDX-License-Identifier: GPL-3.0-or-later
"""What bars resist against numbers by hand and of EN 1993-1-1."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.mechanics.section_cuts import SectionForces
from bridge_demolition_addon.engineering.mechanics.strength import rectangular_sections, utilisation
from bridge_demolition_addon.engineering.steelwork.catalogue import section_named
from bridge_demolition_addon.engineering.steelwork.resistance import (
    buckling,
    plastic_second_moments,
    plastic_strength,
)


def test_a_strut_buckles_about_its_weak_axis():
    """HEB 200, S235, 5 m: Euler π² · 210 000 · 2003e4 / 5000² = 1661 kN, λ = √(1835 / 1661) = 1.051, curve c: 0.508."""
    strut = buckling(section_named("HEB 200"), 235e6, (5.0, 5.0))
    assert (strut.axis, strut.curve) == ("z", "c")
    assert strut.euler_n == pytest.approx(1661e3, rel=2e-3)
    assert strut.slenderness == pytest.approx(1.051, rel=2e-3)
    assert strut.resistance_n == pytest.approx(0.512 * 1835e3, rel=0.01)


def test_an_angle_buckles_about_neither_of_its_legs():
    """L 100x100x10: i_v = 1.95 cm in tables, with fillets; about its legs 3.04 cm."""
    strut = buckling(section_named("L 100x100x10"), 235e6, (2.0, 2.0))
    assert strut.axis == "v"
    assert strut.slenderness == pytest.approx(200.0 / 1.95 / 93.9, rel=0.02)


@pytest.mark.parametrize("name", ["IPE 300", "HEB 200", "RHS 200x100x8", "CHS 168.3x8", "I 900x300x12x25"])
def test_axial_force_and_bending_add_up_as_shares_of_plastic_resistances(name):
    """N / N_pl + M_y / M_pl,y + M_z / M_pl,z: EN 1993-1-1, 6.2.1 (7); V_pl and T by areas and moduli."""
    section, yield_pa = section_named(name), 235e6
    plastic_n = section.area_m2 * yield_pa
    about_y, about_z = section.shape.plastic_moduli_m3 * yield_pa
    shear_n = section.plastic_shear_areas_m2.min() * yield_pa / np.sqrt(3.0)
    torsion_nm = section.torsion_modulus_m3 * yield_pa / np.sqrt(3.0)
    forces = SectionForces(
        axial_n=np.array([0.5, -0.5, 0.3, 0.0, 0.0, 0.0]) * plastic_n,
        shear_n=np.array([0, 0, 0, 0, 0.7, 0.0])[:, None] * (0.0, shear_n),
        torsion_nm=np.array([0, 0, 0, 0, 0, 0.6]) * torsion_nm,
        bending_nm=np.array([(0.2, 0.1), (0.2, -0.1), (0.0, 0.4), (0.9, 0.0), (0, 0), (0, 0)]) * (about_y, about_z),
    )
    sections = rectangular_sections(np.full(6, section.area_m2), np.tile(plastic_second_moments(section), (6, 1, 1)))
    used = utilisation(forces, sections, plastic_strength(section, yield_pa))
    np.testing.assert_allclose(used, [0.8, 0.8, 0.7, 0.9, 0.7, 0.6], rtol=1e-6)
