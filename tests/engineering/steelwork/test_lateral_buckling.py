# SPDX-License-Identifier: GPL-3.0-or-later
"""Lateral torsional buckling against tables, and a critical moment by hand."""

import math

import pytest

from bridge_demolition_addon.engineering.steelwork.catalogue import section_named
from bridge_demolition_addon.engineering.steelwork.resistance import critical_moment_nm, lateral_buckling

# Warping constants I_w, 10³ cm⁶, of the tables (ArcelorMittal, Sections and Merchant Bars).
WARPING = {"IPE 200": 12.99, "IPE 300": 125.9, "HEA 200": 108.0, "HEB 200": 171.1, "HEB 300": 1688.0, "HEM 300": 4386.0}


@pytest.mark.parametrize("name", WARPING)
def test_critical_moments_are_those_of_the_warping_constants_of_tables(name):
    """Within 0.5 %: two flanges at a distance leave out the roots."""
    section, length_m = section_named(name), 6.0
    weak = section.shape.second_moments_m4[1, 1]
    euler_n = math.pi**2 * 210e9 * weak / length_m**2
    by_table = euler_n * math.sqrt(WARPING[name] * 1e-9 / weak + 210e9 / 2.6 * section.torsion_m4 / euler_n)
    assert critical_moment_nm(section, length_m) == pytest.approx(by_table, rel=0.005)


def test_a_long_beam_resists_less_than_its_section_by_hand():
    """IPE 300, S235, 6 m: I_z = 604 cm⁴, I_w = 126 · 10³ cm⁶, I_t = 20.1 cm⁴, W_pl = 628 cm³, h / b = 2.

    N_E = 347.6 kN, M_cr = 347.6 √(0.02084 + 0.04671) = 90.3 kN·m, λ = √(147.7 / 90.3) = 1.279; curve b, φ =
    0.5 (1 + 0.34 · 0.879 + 0.75 · 1.635) = 1.263, χ = 1 / (1.263 + √(1.594 - 1.226)) = 0.535.
    """
    found = lateral_buckling(section_named("IPE 300"), 235e6, 6.0)
    assert found.critical_nm == pytest.approx(90.3e3, rel=0.005)
    assert (found.curve, found.slenderness) == ("b", pytest.approx(1.279, rel=0.005))
    assert found.reduction == pytest.approx(0.535, rel=0.01)
    assert found.resistance_nm == pytest.approx(found.reduction * 628e-6 * 235e6, rel=0.002)


def test_a_short_beam_resists_as_its_section():
    assert lateral_buckling(section_named("HEB 300"), 235e6, 1.0).reduction == 1.0


@pytest.mark.parametrize("name", ["SHS 100x5", "CHS 168.3x8", "L 100x100x10", "PG 1000x10x200x20x400x20"])
def test_what_has_no_two_flanges_alike_is_not_judged(name):
    assert lateral_buckling(section_named(name), 235e6, 6.0) is None
