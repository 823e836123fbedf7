# SPDX-License-Identifier: GPL-3.0-or-later
"""Webs that buckle in shear, by hand with EN 1993-1-5, and against the critical stress of a plate."""

import math

import pytest

from bridge_demolition_addon.engineering.steelwork.catalogue import section_named
from bridge_demolition_addon.engineering.steelwork.resistance import shear_reduction, web_shear

GIRDER = section_named("PG 1000x12x300x20x400x30")
"""A web of 950 mm × 12 mm."""


def test_a_web_without_stiffeners_by_hand():
    """λ = 950 / (86.4 · 12 · 0.8136) = 1.126 (equation 5.5), χ = 0.83 / 1.126 = 0.737, 0.737 · 355 · 950 · 12 / √3."""
    found = web_shear(GIRDER, 355e6, 1e6, rigid_end_posts=False)
    assert found.buckling_factor == pytest.approx(5.34, rel=1e-3)
    assert found.slenderness == pytest.approx(1.126, rel=1e-3)
    assert found.resistance_n == pytest.approx(1722e3, rel=2e-3)


@pytest.mark.parametrize(("stiffeners_m", "factor"), [(2.5, 5.918), (0.95, 9.34), (0.5, 23.28)])
def test_slenderness_is_that_of_the_critical_stress_of_a_plate(stiffeners_m, factor):
    """0.76 √(f_y / τ_cr), equation 5.3, with τ_cr = k π² E / 12 (1 - ν²) · (t / h)² (Timoshenko), within 0.5 %.

    k by hand: 5.34 + 4 (h / a)², and 4 + 5.34 (h / a)² of short panels, which are alike at a = h.
    """
    found = web_shear(GIRDER, 355e6, stiffeners_m, rigid_end_posts=False)
    assert found.buckling_factor == pytest.approx(factor, rel=1e-3)
    critical_pa = factor * math.pi**2 * 210e9 / 12.0 / (1.0 - 0.3**2) * (0.012 / 0.95) ** 2
    assert found.slenderness == pytest.approx(0.76 * math.sqrt(355e6 / critical_pa), rel=5e-3)


def test_rigid_end_posts_help_slender_webs_alone():
    """Table 5.1: 1.2, 0.83 / λ, and 1.37 / (0.7 + λ) from 1.08 on, where both are alike; at 2.0 0.507 and 0.415."""
    for slenderness in (0.3, 0.69, 0.8, 1.07):
        assert shear_reduction(slenderness, rigid_end_posts=True) == shear_reduction(slenderness, rigid_end_posts=False)
    assert shear_reduction(0.69, rigid_end_posts=False) == 1.2
    assert shear_reduction(0.7, rigid_end_posts=False) == pytest.approx(1.186, abs=1e-3)
    assert shear_reduction(1.08, rigid_end_posts=True) == pytest.approx(0.83 / 1.08, rel=0.002)
    assert shear_reduction(2.0, rigid_end_posts=True) == pytest.approx(0.507, abs=1e-3)
    assert shear_reduction(2.0, rigid_end_posts=False) == pytest.approx(0.415)


def test_a_box_has_two_webs_and_a_tube_is_not_judged():
    box = web_shear(section_named("BOX 1000x600x12x25"), 355e6, 1e6, rigid_end_posts=False)
    assert box.resistance_n == pytest.approx(2.0 * 0.737 * 355e6 * 0.95 * 0.012 / math.sqrt(3.0), rel=2e-3)
    assert web_shear(section_named("SHS 100x5"), 355e6, 1.0, rigid_end_posts=False) is None


def test_webs_of_rolled_sections_do_not_buckle():
    """h_w / t of IPE 300 is 278.6 / 7.1 = 39, less than 72 ε / η = 60 of S235 (5.1 (2))."""
    assert not web_shear(section_named("IPE 300"), 235e6, 1e6, rigid_end_posts=False).buckles
