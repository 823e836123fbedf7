# SPDX-License-Identifier: GPL-3.0-or-later
"""Shear, against tables of The Concrete Centre and the equations of EN 1992-1-1 worked by hand."""

import pytest

from bridge_demolition_addon.engineering.reinforced_concrete import least_areas
from bridge_demolition_addon.engineering.reinforced_concrete.materials import Concrete
from bridge_demolition_addon.engineering.reinforced_concrete.resistance import (
    links,
    struts_n,
    without_links_n,
)

YIELD = 500e6 / 1.15


@pytest.mark.parametrize(
    ("depth_m", "ratio", "stress_n_mm2"),
    [
        (0.2, 0.0025, 0.54),
        (0.2, 0.005, 0.59),
        (0.2, 0.01, 0.75),
        (0.2, 0.02, 0.94),
        (0.3, 0.0025, 0.47),
        (0.3, 0.01, 0.68),
    ],
)
def test_without_links(depth_m, ratio, stress_n_mm2):
    """The Concrete Centre, How to design concrete structures using Eurocode 2: slabs, table of v_Rd,c for C30/37."""
    force = without_links_n(1.0, depth_m, ratio * depth_m, Concrete(30e6))
    assert force / depth_m / 1e6 == pytest.approx(stress_n_mm2, abs=0.0051)  # the table has two decimals


@pytest.mark.parametrize(
    ("f_ck", "flat", "steep"), [(20, 2.54, 3.68), (30, 3.64, 5.28), (35, 4.15, 6.02), (50, 5.51, 8.0)]
)
def test_struts(f_ck, flat, steep):
    """The Concrete Centre, How to design concrete structures using Eurocode 2: beams, v_Rd,max by 0.9 b d."""
    for cot, stress in ((2.5, flat), (1.0, steep)):
        force = struts_n(0.3, 0.5, Concrete(f_ck * 1e6), cot)
        assert force / (0.9 * 0.3 * 0.5) / 1e6 == pytest.approx(stress, abs=0.0101)  # rounded down


def test_links_between_flat_struts():
    """A_sw/s = V / (z f_ywd cot θ): 200 kN on d = 0.5 m are 200 000 / (450 × 434.8 × 2.5) = 0.409 mm²/mm."""
    found = links(200e3, 0.3, 0.5, Concrete(30e6), YIELD)
    assert found.cot_strut == 2.5
    assert 1e6 * found.area_m2_m == pytest.approx(409.0, rel=1e-3)


def test_struts_are_steeper_where_flat_ones_would_be_crushed():
    concrete = Concrete(30e6)
    shear = 0.5 * (struts_n(0.3, 0.5, concrete, 2.5) + struts_n(0.3, 0.5, concrete, 1.0))
    found = links(shear, 0.3, 0.5, concrete, YIELD)
    assert 1.0 < found.cot_strut < 2.5
    assert struts_n(0.3, 0.5, concrete, found.cot_strut) == pytest.approx(shear)  # just not crushed
    assert found.area_m2_m * 0.9 * 0.5 * YIELD * found.cot_strut == pytest.approx(shear)


def test_no_links_help_crushed_struts():
    concrete = Concrete(30e6)
    assert links(1.001 * struts_n(0.3, 0.5, concrete, 1.0), 0.3, 0.5, concrete, YIELD) is None


def test_least_areas_by_hand():
    c30 = Concrete(30e6)  # f_ctm = 2.896 N/mm²
    assert 1e6 * least_areas.of_beam_m2(1.0, 0.2, c30, 500e6) == pytest.approx(0.26 * 2.896 / 500 * 200e3, rel=1e-3)
    assert 1e6 * least_areas.of_beam_m2(1.0, 0.2, Concrete(20e6), 500e6) == pytest.approx(260.0)  # 0.13 %
    assert 1e6 * least_areas.of_links_m2_m(0.3, c30, 500e6) == pytest.approx(0.08 * 30**0.5 / 500 * 300e3, rel=1e-9)
    assert 1e6 * least_areas.of_column_m2(2e6, 0.16, YIELD) == pytest.approx(460.0)  # 0.1 N / f_yd
    assert 1e6 * least_areas.of_column_m2(1e6, 0.16, YIELD) == pytest.approx(320.0)  # 0.2 %
    assert 1e6 * least_areas.upright_of_wall_m2(0.5 * 4.0) == pytest.approx(4000.0)
    assert 1e6 * least_areas.level_of_wall_m2(1000e-6, 0.5) == pytest.approx(500.0)  # 0.1 % of 0.5 m²/m
    assert least_areas.column_link_spacing_m(0.016, 0.3) == 0.3
    assert least_areas.column_link_spacing_m(0.012, 0.3) == pytest.approx(0.24)
    assert least_areas.column_link_bar_m(0.032) == 0.008
