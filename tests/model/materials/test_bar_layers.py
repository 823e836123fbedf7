# SPDX-License-Identifier: GPL-3.0-or-later
"""Plastic moments of sections with bars, held against the design formulas of EN 1992-1-1 worked by hand."""

import numpy as np
import pytest

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.materials import BarLayer, ReinforcedSection

LAYER = {"members": ("deck",), "depth_m": 0.05, "area_mm2": 1000.0}


def test_one_layer_that_yields():
    """M = A f_y (d - a / 2), a = A f_y / (b f_c): a stress block of EN 1992-1-1:2004, 3.1.7 (3)."""
    section = ReinforcedSection(0.5, 0.3, 30e6, [0.45], [1500e-6], [500e6])
    # 750 kN, and a block of 750e3 / (0.3 × 30e6) = 83.3 mm: 750 × (0.45 - 0.04167) kN·m.
    assert section.moments_nm()[0] == pytest.approx(306.25e3, rel=1e-6)


def test_a_layer_that_does_not_yield():
    """Its stress follows from plane sections with 0.0035 at the edge: a quadratic for the neutral axis, by hand."""
    section = ReinforcedSection(0.5, 0.2, 20e6, [0.40], [4000e-6], [500e6])
    # 0.8 x b f_c = A E 0.0035 (d - x) / x: 3.2e6 x² + 2.8e6 x - 1.12e6 = 0, so x = 0.29809 m.
    neutral = (-2.8 + (2.8**2 + 4 * 3.2 * 1.12) ** 0.5) / 6.4
    moment = 3.2e6 * neutral * (0.40 - 0.4 * neutral)
    assert section.moments_nm()[0] == pytest.approx(moment, rel=1e-6)
    assert moment == pytest.approx(267.8e3, rel=1e-3)


def test_two_layers_that_both_yield_in_tension():
    """Near the pressed edge, but below a shallow block: M = A f_y (d + d' - a), a = 2 A f_y / (b f_c)."""
    section = ReinforcedSection(0.5, 0.4, 40e6, [0.05, 0.45], [200e-6] * 2, [500e6] * 2)
    # 100 kN each, a = 200e3 / 16e6 = 12.5 mm, x = 15.6 mm: strains from 0.0077.
    assert section.moments_nm() == pytest.approx((100e3 * 0.4875,) * 2, rel=1e-6)


@pytest.mark.parametrize(
    ("depths", "areas"), [([0.05, 0.45], [1000e-6, 1500e-6]), ([0.04, 0.09, 0.46], [900e-6, 300e-6, 1200e-6])]
)
def test_ties_bear_both_moments_of_the_section_about_its_edges(depths, areas):
    section = ReinforcedSection(0.5, 0.3, 30e6, depths, areas, [500e6] * len(depths))
    forces = section.across_cracks_n()
    first = sum(force * depth for force, depth in zip(forces, depths, strict=True))
    other = sum(force * (0.5 - depth) for force, depth in zip(forces, depths, strict=True))
    assert (first, other) == pytest.approx(section.moments_nm(), rel=1e-9)
    for force, area in zip(forces, areas, strict=True):
        assert 0.0 < force <= 500e6 * area


def test_ties_of_one_side_bear_the_moment_that_pulls_them():
    section = ReinforcedSection(0.5, 0.3, 30e6, [0.45], [1500e-6], [500e6])
    assert section.across_cracks_n()[0] * 0.45 == pytest.approx(section.moments_nm()[0])
    upside_down = ReinforcedSection(0.5, 0.3, 30e6, [0.05], [1500e-6], [500e6])
    assert upside_down.across_cracks_n() == pytest.approx(section.across_cracks_n())


def test_few_bars_on_one_side_never_push():
    section = ReinforcedSection(0.5, 0.3, 30e6, [0.05, 0.45], [20e-6, 1500e-6], [500e6] * 2)
    forces = section.across_cracks_n()
    assert forces[0] == 0.0
    assert forces[1] * 0.45 == pytest.approx(section.moments_nm()[0])


def test_bars_run_beside_their_side():
    with pytest.raises(ScenarioError, match=r"reinforcement.side .* expected a side that bars along z run beside"):
        BarLayer(**LAYER, along="z", side="top")
    layer = BarLayer(**LAYER, along="z", side="start")
    assert layer.axes == (2, 0, 1)
    assert layer.level_m(-1.0, 1.0) == pytest.approx(-0.95)
    assert BarLayer(**LAYER, side="top").level_m(3.0, 4.0) == pytest.approx(3.95)


def test_resistance_under_axial_force_and_moment():
    # 0.4 m × 0.5 m, 30 N/mm², 1000 mm² at 0.05 and at 0.45 m, 500 N/mm².
    section = ReinforcedSection(0.5, 0.4, 30e6, [0.05, 0.45], [1e-3, 1e-3], [500e6, 500e6])
    first, other = section.moments_nm()
    pulled_n, pressed_n = 2e-3 * 500e6, -(0.4 * 0.5 * 30e6 + 2e-3 * 500e6)
    # With the neutral axis 0.2 m deep the bars near the edge are at 525 N/mm², so they yield, as do the others.
    at_n = -0.8 * 0.2 * 0.4 * 30e6
    at_nm = 0.8 * 0.2 * 0.4 * 30e6 * (0.25 - 0.08) + 2 * 1e-3 * 500e6 * 0.2
    loads = [(0.0, first), (0.0, -other), (pulled_n, 0.0), (pressed_n, 0.0), (at_n, at_nm), (at_n / 2, -at_nm / 2)]
    axial_n, moments_nm = np.array(loads).T
    np.testing.assert_allclose(section.utilisations(axial_n, moments_nm), [1, 1, 1, 1, 1, 0.5], rtol=1e-2)


def test_bars_on_one_side_resist_on_that_side_alone():
    section = ReinforcedSection(0.5, 0.4, 30e6, [0.45], [1e-3], [500e6])
    assert section.utilisations(np.zeros(1), np.array([section.moments_nm()[0]]))[0] == pytest.approx(1.0, abs=2e-3)
    assert section.utilisations(np.zeros(1), -np.array([section.moments_nm()[0]]))[0] > 5.0
