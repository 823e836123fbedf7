# SPDX-License-Identifier: GPL-3.0-or-later
"""Specific charge, holes and bared bars against blasting manuals, statics and Euler."""

import numpy as np
import pytest
from scipy.integrate import solve_bvp

from bridge_demolition_addon.engineering.drilled_charges.bare_bars import (
    buckling_force_n,
    compression_n,
    slender_from_m,
    straight_compression_n,
    yield_force_n,
)
from bridge_demolition_addon.engineering.drilled_charges.drill_holes import (
    charge_length_m,
    hole_capacity_kg,
    hole_positions_m,
    holes_by_rule,
    zone_height_m,
)
from bridge_demolition_addon.engineering.drilled_charges.specific_charge import (
    DrilledElement,
    Effect,
    Thresholds,
    breaking_range_kg_m3,
    charge_a_hole_kg,
    effect_of,
    left_of_concrete,
    specific_charge_kg_m3,
)
from bridge_demolition_addon.errors import BlastError


@pytest.mark.parametrize(
    ("diameter_m", "bared_m", "expected_n"),
    [(0.025, 0.9, 186.9e3), (0.016, 0.5, 101.6e3)],  # π² E I / (0.5 l)² by hand, E = 200 GPa
)
def test_buckling_of_a_bar_by_hand(diameter_m, bared_m, expected_n):
    assert buckling_force_n(diameter_m, bared_m) == pytest.approx(expected_n, rel=5e-4)  # four digits


def test_yield_force_by_hand():
    assert yield_force_n(0.025) == pytest.approx(245.4e3, rel=5e-4)
    assert yield_force_n(0.016) == pytest.approx(100.5e3, rel=5e-4)


def test_straight_bars_resist_by_yield_and_by_buckling():
    # 8 bars of 25 mm: 8 × 245.4 kN where they are short, 8 × 186.9 kN over 0.9 m.
    assert 8 * straight_compression_n(0.025, 0.4) == pytest.approx(1.963e6, rel=5e-4)
    assert 8 * straight_compression_n(0.025, 0.9) == pytest.approx(1.495e6, rel=5e-4)


@pytest.mark.parametrize(("diameters", "part"), [(20.0, 0.763), (10.0 * np.pi, 0.540), (40.0, 0.400), (50.0, 0.286)])
def test_bars_are_counted_on_by_curve_c(diameters, part):
    """By hand: λ = l / (10 π d) with 500 N/mm² and 200 GPa; for 20 d λ 0.637, φ 0.810, χ 1 / (0.810 + 0.500)."""
    for diameter_m in (0.012, 0.02, 0.032):
        resisted = compression_n(diameter_m, diameters * diameter_m) / yield_force_n(diameter_m)
        assert resisted == pytest.approx(part, abs=1e-3)


def test_ten_bars_of_16_mm_over_1_2_m():
    # λ 2.387, φ 3.885, χ 0.1439 of 10 × 100.5 kN; Euler's load is 0.176 MN.
    assert 10 * compression_n(0.016, 1.2) == pytest.approx(0.1446e6, rel=2e-3)
    assert 10 * straight_compression_n(0.016, 1.2) == pytest.approx(0.1764e6, rel=2e-3)


@pytest.mark.parametrize("yield_pa", [220e6, 420e6, 500e6, 600e6])
def test_a_bar_may_be_counted_on_for_less_the_longer_it_is_and_never_for_more_than_a_straight_one(yield_pa):
    heights_m = np.linspace(0.05, 4.0, 80)
    counted = compression_n(0.02, heights_m, yield_pa)
    assert counted[0] == pytest.approx(float(yield_force_n(0.02, yield_pa)))  # 2.5 diameters
    assert (np.diff(counted[heights_m > 0.2]) < 0.0).all()
    assert (counted <= straight_compression_n(0.02, heights_m, yield_pa)).all()
    # Far beyond 31 diameters it is Euler's load, but for its bow.
    assert counted[-1] == pytest.approx(buckling_force_n(0.02, 4.0), rel=0.12)


def test_bars_are_slender_from_31_diameters_on():
    # (π/2) √(200 000 / 500) = 31.4: the blasters' "30 to 50 bar diameters". There λ is 1, and curve c 0.540.
    assert slender_from_m(0.02) == pytest.approx(31.416 * 0.02, rel=1e-4)
    limit = float(slender_from_m(0.028))
    assert buckling_force_n(0.028, limit) == pytest.approx(float(yield_force_n(0.028)), rel=1e-12)


def test_a_bar_fixed_at_both_ends_deflects_without_bound_at_the_buckling_force():
    """The fourth-order equation E I w'''' + P w'' = q, solved by scipy: at 99 % of P the deflection is large."""
    diameter, length = 0.02, 0.8
    inertia = np.pi / 64 * diameter**4

    def deflection(force_n):
        def slope(_, w):
            return np.vstack((w[1], w[2], w[3], (1.0 - force_n * w[2]) / (200e9 * inertia)))

        def ends(start, end):
            return np.array([start[0], start[1], end[0], end[1]])

        grid = np.linspace(0.0, length, 41)
        return np.abs(solve_bvp(slope, ends, grid, np.zeros((4, 41)), tol=1e-8).y[0]).max()

    at = float(buckling_force_n(diameter, length))
    without = deflection(0.0)
    assert without == pytest.approx(length**4 / (384 * 200e9 * inertia), rel=1e-3)  # beam theory, q = 1 N/m
    # A fixed bar's first mode grows as 1 / (1 - P / P_cr) within a few per cent (S. Timoshenko, 1936).
    assert deflection(0.9 * at) / without == pytest.approx(10.0, rel=0.05)


def test_specific_charge_of_the_worked_example():
    """A column of 0.7 × 0.7 m, 1.5 m of it with 1 kg/m³: 0.735 kg in 10 holes of 73.5 g; Rahmede viaduct had 74 g."""
    volume = 0.7 * 0.7 * 1.5
    assert charge_a_hole_kg(1.0, volume, 10) == pytest.approx(0.0735)
    assert specific_charge_kg_m3(10 * 0.0735, volume) == pytest.approx(1.0)
    assert 6 * 10 * charge_a_hole_kg(1.0, volume, 10) == pytest.approx(4.41)


def test_stronger_explosives_need_less():
    assert charge_a_hole_kg(1.0, 1.0, 1, 125.0) == pytest.approx(0.8)
    assert specific_charge_kg_m3(0.8, 1.0, 125.0) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("element", "burden_m", "expected"),
    [
        (DrilledElement.BEAM_OR_COLUMN, 0.15, (0.50, 0.56)),
        (DrilledElement.BEAM_OR_COLUMN, 0.20, (0.38, 0.42)),
        (DrilledElement.BEAM_OR_COLUMN, 0.30, (0.30, 0.34)),
        (DrilledElement.BEAM_OR_COLUMN, 0.35, (0.28, 0.31)),  # half way to 0.26 and 0.28
        (DrilledElement.BEAM_OR_COLUMN, 0.40, (0.26, 0.28)),
        (DrilledElement.BEAM_OR_COLUMN, 1.00, (0.26, 0.28)),
        (DrilledElement.CAP_BEAM, 0.35, (0.44, 0.50)),
        (DrilledElement.SLAB, 0.35, (0.48, 0.55)),
        (DrilledElement.MASONRY, 0.35, (0.40, 0.50)),
        (DrilledElement.PLAIN, 0.35, (0.20, 0.30)),
    ],
)
def test_specific_charges_that_break_are_those_of_the_table(element, burden_m, expected):
    assert breaking_range_kg_m3(element, burden_m) == pytest.approx(expected)


def test_effects_by_the_two_thresholds():
    limits = Thresholds(0.32)  # throws at 1
    effects = [effect_of(q, limits) for q in (0.1, 0.16, 0.31, 0.32, 0.99, 1.0)]
    assert effects == [
        Effect.NOTHING,
        Effect.LOOSENED,
        Effect.LOOSENED,
        Effect.RUBBLE,
        Effect.RUBBLE,
        Effect.THROWN,
    ]


@pytest.mark.parametrize(
    ("q", "tension", "compression"), [(0.1, 1.0, 1.0), (0.16, 1.0, 0.5), (0.24, 0.5, 0.5), (0.32, 0.0, 0.0)]
)
def test_what_concrete_has_left(q, tension, compression):
    left = left_of_concrete(q, Thresholds(0.32))
    assert (left.tension, left.compression) == pytest.approx((tension, compression))


def test_thresholds_in_the_wrong_order_are_refused():
    with pytest.raises(BlastError, match=r"thresholds are 0\.5 and 0\.4 kg/m³: expected two numbers above 0"):
        Thresholds(0.5, 0.4)


def test_holes_by_rule():
    one, two = holes_by_rule(0.6, 0.6), holes_by_rule(0.9, 1.2)
    assert (one.rows, one.burden_m, one.depth_m, one.stemming_m) == pytest.approx((1, 0.3, 0.4, 0.3))
    assert (two.rows, two.burden_m, two.depth_m, two.stemming_m) == pytest.approx((2, 0.3, 0.6, 0.3))
    assert one.spacing_m == pytest.approx((0.3, 0.54))
    assert holes_by_rule(0.2, 0.2).stemming_m == 0.15  # never below it


def test_a_hole_holds_its_cylinder_below_the_stemming():
    # 38 mm: 11.34 cm²; 0.45 m deep with 0.25 m of stemming: 227 cm³ of 1.2 kg/l.
    assert hole_capacity_kg(0.45, 0.25, 0.038, 1200.0) == pytest.approx(0.2722, rel=1e-3)
    assert hole_capacity_kg(0.45, 0.50, 0.038, 1200.0) == 0.0
    assert charge_length_m(0.2722, 0.038, 1200.0) == pytest.approx(0.2, rel=1e-3)


def test_holes_lie_evenly_about_the_middle():
    (row,) = hole_positions_m(1, 3, 0.4, 0.0)
    assert row == pytest.approx(np.array([[-0.4, 0.0], [0.0, 0.0], [0.4, 0.0]]))
    staggered = hole_positions_m(2, 2, 0.4, 0.3)
    assert staggered[0] == pytest.approx(np.array([[-0.3, -0.15], [0.1, -0.15]]))
    assert staggered[1] == pytest.approx(np.array([[-0.1, 0.15], [0.3, 0.15]]))
    assert staggered.reshape(-1, 2).mean(axis=0) == pytest.approx(np.zeros(2))


def test_height_of_a_zone_by_rule():
    # 1.5 × (0.7 m + 40 × 25 mm)
    assert zone_height_m(0.7, 0.025) == pytest.approx(2.55)
