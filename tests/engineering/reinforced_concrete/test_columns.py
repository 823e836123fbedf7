# SPDX-License-Identifier: GPL-3.0-or-later
"""Columns, against sections worked by hand from a given neutral axis."""

import math

import pytest

from bridge_demolition_addon.engineering.reinforced_concrete.least_areas import (
    BarChoice,
    bars_in_rows,
    row_depth_m,
)
from bridge_demolition_addon.engineering.reinforced_concrete.materials import Concrete
from bridge_demolition_addon.engineering.reinforced_concrete.resistance import ColumnSection, design_moment_nm
from bridge_demolition_addon.model.materials import ReinforcedSection

YIELD = 500e6 / 1.15
SECTION = ColumnSection(0.5, 0.4, 0.05, Concrete(30e6), YIELD)


def test_moment_at_a_given_neutral_axis():
    """x = 0.3 m: block of 0.24 m, 0.4 × 0.24 × 20 MPa = 1.92 MN at 0.13 m. Strains 0.0035 × 0.25/0.3 and -0.0035 ×
    0.15/0.3 = -0.00175: the bars in tension have 350 N/mm². With 2000 mm² at each face 869.6 and -700 kN at 0.2 m."""
    axial = 1.92e6 + 2000e-6 * (YIELD - 350e6)
    moment = 1.92e6 * 0.13 + 2000e-6 * (YIELD + 350e6) * 0.2
    assert SECTION.moment_nm(4000e-6, axial) == pytest.approx(moment, rel=1e-6)
    assert SECTION.bars_m2(axial, moment) == pytest.approx(4000e-6, rel=1e-6)


def test_without_axial_force_it_is_a_beam():
    beam = ReinforcedSection(0.5, 0.4, 20e6, [0.05, 0.45], [1000e-6] * 2, [YIELD] * 2)
    assert SECTION.moment_nm(2000e-6, 0.0) == pytest.approx(beam.moments_nm()[0], rel=1e-6)


def test_plain_concrete():
    """0.5 × 0.4 m of 20 N/mm² under 2 MN: block of 0.25 m, 2 MN × 0.125 m. More than 4 MN crush it."""
    assert SECTION.moment_nm(0.0, 2e6) == pytest.approx(0.25e6, rel=1e-6)
    assert SECTION.bars_m2(2e6, 0.249e6) == 0.0
    assert SECTION.moment_nm(0.0, 4.01e6) < 0.0
    assert math.isinf(SECTION.bars_m2(20e6, 0.0))


def test_eccentricities():
    """Stocky: the larger of h/30, 20 mm and l_0/400. Slender: f_yd / E / (0.45 d) l_0² / 10 more, by hand."""
    assert design_moment_nm(0.1e6, SECTION, 3.0) == pytest.approx(0.1e6 * 0.02)
    # λ = 12 / 0.1443 = 83 > 10.78 / √(1 / 4) = 21.6; e = 12 / 400 + 434.78 / 200 000 / (0.45 × 0.45) × 144 / 10 m.
    assert design_moment_nm(1e6, SECTION, 12.0) == pytest.approx(1e6 * (0.03 + 0.15459), rel=1e-4)


def test_bars_in_rows():
    """2000 mm² of 20 mm (314 mm²) are 7; over 0.3 m between axes 50 mm apart, which is 45 mm at least."""
    choice = bars_in_rows(2000e-6, 0.32, 0.02, 1, least_spacing_m=0.0, most_spacing_m=0.25)
    assert choice == BarChoice(7, 0.02, 1, pytest.approx(0.05))
    assert choice.area_m2 == pytest.approx(7 * math.pi * 0.02**2 / 4)
    assert bars_in_rows(2400e-6, 0.32, 0.02, 1, least_spacing_m=0.0, most_spacing_m=0.25) is None  # 8 need 0.335 m
    in_two = bars_in_rows(2400e-6, 0.32, 0.02, 2, least_spacing_m=0.0, most_spacing_m=0.25)
    assert (in_two.number, in_two.rows) == (8, 2)
    assert row_depth_m(0.02, 2) == pytest.approx(0.01 + 0.0225)  # two rows 45 mm apart
    few = bars_in_rows(10e-6, 1.0, 0.012, 1, least_spacing_m=0.0, most_spacing_m=0.25)
    assert few.number == 5 and few.spacing_m <= 0.25
