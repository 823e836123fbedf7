# SPDX-License-Identifier: GPL-3.0-or-later
"""Bars in bending, against a textbook, against formulas by hand, and against the moments of the sections they make."""

import math

import pytest

from bridge_demolition_addon.engineering.reinforced_concrete.materials import GRADES, Concrete, design_yield_pa
from bridge_demolition_addon.engineering.reinforced_concrete.resistance import (
    PressedShape,
    flange_width_m,
    tension_steel,
)
from bridge_demolition_addon.model.materials import ReinforcedSection

C35 = Concrete(35e6)
YIELD = 500e6 / 1.15


def test_textbook_rectangle():
    """W. H. Mosley, J. H. Bungey, R. Hulse, Reinforced Concrete Design to Eurocode 2, example 4.1: 185 kN·m on 260 mm ×
    440 mm of C25/30 needs 1140 mm². It has α_cc = 0.85, which is in the strength here."""
    found = tension_steel(185e3, PressedShape.rectangle(0.5, 0.26), 0.44, Concrete(0.85 * 25e6), YIELD)
    assert 1e6 * found.area_m2 == pytest.approx(1140.0, rel=3e-3)  # the book rounds the lever arm to 373 mm
    assert found.neutral_axis == pytest.approx(2.5 * (1.0 - 373.0 / 440.0), abs=2.5 * 0.5 / 440.0)


@pytest.mark.parametrize("moment_nm", [50e3, 150e3, 250e3])
def test_a_rectangle_resists_the_moment_that_its_bars_are_for(moment_nm):
    found = tension_steel(moment_nm, PressedShape.rectangle(0.6, 0.3), 0.55, C35, YIELD)
    section = ReinforcedSection(0.6, 0.3, C35.design_pa, [0.55], [found.area_m2], [YIELD])
    assert section.moments_nm()[0] == pytest.approx(moment_nm, rel=1e-6)


def test_a_flange_that_holds_the_whole_block_makes_the_section_as_wide():
    wide = tension_steel(800e3, PressedShape.rectangle(1.0, 2.0), 0.92, C35, YIELD)
    flanged = tension_steel(800e3, PressedShape(1.0, 0.4, 2.0, 0.25), 0.92, C35, YIELD)
    assert flanged == wide


def test_a_block_below_the_flange():
    """By hand, C30: f_cd = 20 N/mm². Flange 1.0 × 0.1 m beside a web of 0.3 m: 0.7 × 0.1 × 20 = 1.4 MN at 0.55 m. A
    block of 0.2 m in the web: 0.3 × 0.2 × 20 = 1.2 MN at 0.5 m. So M = 0.77 + 0.6 MN·m and A_s = 2.6 MN / f_yd."""
    found = tension_steel(1.37e6, PressedShape(0.65, 0.3, 1.0, 0.1), 0.6, Concrete(30e6), YIELD)
    assert found.area_m2 == pytest.approx(2.6e6 / YIELD, rel=1e-9)
    assert found.neutral_axis == pytest.approx(0.2 / 0.8 / 0.6, rel=1e-9)


def test_what_no_bars_carry_has_no_finite_area():
    """Even pressed throughout, 0.3 × 0.5 m of C35 resist b d² f_cd / 2 = 0.875 MN·m."""
    shape = PressedShape.rectangle(0.55, 0.3)
    assert math.isinf(tension_steel(0.876e6, shape, 0.5, C35, YIELD).area_m2)
    assert math.isfinite(tension_steel(0.874e6, shape, 0.5, C35, YIELD).area_m2)


def test_concrete_as_table_3_1_of_en_1992_1_1_has_it():
    for f_ck, f_ctm in (
        (20, 2.2),
        (25, 2.6),
        (30, 2.9),
        (35, 3.2),
        (40, 3.5),
        (50, 4.1),
        (60, 4.4),
        (80, 4.8),
        (90, 5.0),
    ):
        assert Concrete(f_ck * 1e6).tension_pa / 1e6 == pytest.approx(f_ctm, abs=0.05)
    assert [round(1e3 * Concrete(f * 1e6).crushing_strain, 1) for f in (50, 55, 60, 70, 80, 90)] == [
        3.5, 3.1, 2.9, 2.7, 2.6, 2.6,
    ]  # fmt: skip
    assert (Concrete(90e6).block_depth, Concrete(90e6).block_pa) == pytest.approx((0.7, 0.8 * 60e6))
    assert (Concrete(50e6).deepest_neutral_axis, Concrete(55e6).deepest_neutral_axis) == (0.45, 0.35)


def test_grades_as_table_c_1_of_en_1992_1_1_has_them():
    assert design_yield_pa(GRADES["B500B"]) == pytest.approx(434.78e6, rel=1e-4)
    for name, hardening, strain in (("B500A", 1.05, 0.025), ("B500B", 1.08, 0.05), ("B500C", 1.15, 0.075)):
        assert (GRADES[name].hardening, GRADES[name].rupture_strain) == (hardening, strain)
    assert GRADES["Grade 60"].yield_pa * GRADES["Grade 60"].hardening == pytest.approx(620e6)  # ASTM A615M-04a


def test_effective_flange():
    """EN 1992-1-1, 5.7a: 0.2 × 1.5 + 0.1 × 10 = 1.3 of 1.5 m at the left; at the right the whole 0.4 m."""
    assert flange_width_m(0.3, (1.5, 0.4), 10.0) == pytest.approx(0.3 + 1.3 + 0.4)
    assert flange_width_m(0.3, (5.0, 5.0), 6.0) == pytest.approx(0.3 + 2 * 1.2)  # 0.2 l_0
