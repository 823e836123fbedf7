# SPDX-License-Identifier: GPL-3.0-or-later
"""Headed studs against tables of their design resistance, and by hand."""

import math

import pytest

from bridge_demolition_addon.engineering.steelwork.studs import stud_shear_n, stud_uplift_n

SAFETY = 1.25
"""γ_V of EN 1994-1-1, 6.6.3.1, in tables."""


@pytest.mark.parametrize(
    ("diameter_mm", "concrete_n_mm2", "young_n_mm2", "design_kn"),
    # P_Rd of studs of 450 N/mm² with h / d > 4, by hand from equations 6.18 and 6.19 with E_cm of EN 1992-1-1.
    [(19.0, 25.0, 31e3, 73.7), (19.0, 30.0, 33e3, 81.7), (22.0, 25.0, 31e3, 98.9), (22.0, 35.0, 34e3, 109.5)],
)
def test_shear_is_that_of_tables(diameter_mm, concrete_n_mm2, young_n_mm2, design_kn):
    found = stud_shear_n(1e-3 * diameter_mm, 0.125, 450e6, 1e6 * concrete_n_mm2, 1e6 * young_n_mm2)
    assert found / SAFETY / 1e3 == pytest.approx(design_kn, rel=0.002)


def test_short_studs_press_on_less_concrete():
    """h = 3 d: α = 0.2 · 4 = 0.8."""
    long, short = (stud_shear_n(0.019, height, 450e6, 25e6, 31e9) for height in (0.1, 0.057))
    assert short == pytest.approx(0.8 * long)


def test_uplift_is_that_of_a_cone_or_of_the_shank():
    """By hand: h = 100 - 9.5 mm, 12.7 √25 90.5^1.5 = 54.67 kN, at 0.1 m 0.368 of it; 450 π 19² / 4 = 127.6 kN."""
    assert stud_uplift_n(0.019, 0.1, 450e6, 25e6, 1.0) == pytest.approx(54.67e3, rel=1e-3)
    assert stud_uplift_n(0.019, 0.1, 450e6, 25e6, 0.1) == pytest.approx(54.67e3 * 0.1 / 0.2715, rel=1e-3)
    assert stud_uplift_n(0.019, 0.3, 450e6, 25e6, 1.0) == pytest.approx(450e6 * math.pi * 0.019**2 / 4.0)
