# SPDX-License-Identifier: GPL-3.0-or-later
"""Continuous beams and moving loads, against closed forms and AASHTO's table of the HS20 truck."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.reinforced_concrete.influence_lines import (
    MovingLoad,
    extreme_effects,
    influence_lines,
    permanent_effects,
)

FT = 0.3048

# Areas under influence lines are trapezoids between 64 points a span: 0.1 % too small or large at most where the line
# is a cubic, exact where it is straight.
EVEN = 1.5e-3


def test_simple_span():
    lines = influence_lines([0.0, 10.0], 0.0, 10.0)
    moments = permanent_effects(lines.points_m, lines.moments, 3e3)
    assert moments.max() == pytest.approx(3e3 * 100 / 8, rel=1e-6)
    assert permanent_effects(lines.points_m, lines.reactions, 3e3) == pytest.approx([15e3, 15e3])
    shears = permanent_effects(lines.points_m, lines.shears, 3e3)
    assert shears == pytest.approx(3e3 * (5.0 - lines.between_m), abs=1e-3)


def test_two_equal_spans():
    """-w L²/8 over the support, 9/128 w L² in the spans, reactions of 3/8, 10/8 and 3/8."""
    lines = influence_lines([0.0, 8.0, 16.0], 0.0, 16.0)
    moments = permanent_effects(lines.points_m, lines.moments, 1.0)
    assert moments.min() == pytest.approx(-8.0, rel=EVEN)
    assert moments.max() == pytest.approx(4.5, rel=EVEN)
    assert permanent_effects(lines.points_m, lines.reactions, 1.0) == pytest.approx([3.0, 10.0, 3.0], rel=EVEN)


def test_the_worse_span_is_loaded_alone():
    """w on one span of two: 0.0957 w L² there, -w L²/16 over the support; on both -w L²/8 (Young and Budynas)."""
    lines = influence_lines([0.0, 10.0, 20.0], 0.0, 20.0)
    least, largest = extreme_effects(lines.points_m, lines.moments, [MovingLoad(uniform_n_m=1.0)])
    assert least.min() == pytest.approx(-12.5, rel=EVEN)
    assert largest.max() == pytest.approx(9.57, rel=3e-3)  # the maximum is between two points, and has three digits


def test_three_spans():
    """-w L²/10 over inner supports of equal spans, 0.08 and 0.025 w L² in the spans; reactions 0.4 and 1.1 w L."""
    lines = influence_lines([0.0, 10.0, 20.0, 30.0], 0.0, 30.0)
    moments = permanent_effects(lines.points_m, lines.moments, 1.0)
    assert moments.min() == pytest.approx(-10.0, rel=EVEN)
    assert moments.max() == pytest.approx(8.0, rel=EVEN)
    assert np.interp(15.0, lines.points_m, moments) == pytest.approx(2.5, abs=0.01)
    assert permanent_effects(lines.points_m, lines.reactions, 1.0) == pytest.approx([4.0, 11.0, 11.0, 4.0], rel=EVEN)


def test_ends_that_rounding_parts_from_a_support_are_there():
    end = 26.9 + 19.2 + 12.9
    lines = influence_lines([0.0, end], 0.0, end * (1.0 + 1e-15))
    assert permanent_effects(lines.points_m, lines.reactions, 1.0) == pytest.approx([end / 2, end / 2])


def test_overhang_and_single_support():
    lines = influence_lines([0.0, 10.0], -2.0, 10.0)
    moments = permanent_effects(lines.points_m, lines.moments, 1.0)
    assert moments.min() == pytest.approx(-2.0, rel=0.01)  # a²/2, with 8 points in the overhang
    clamped = influence_lines([0.0], -2.0, 3.0)
    least, _ = extreme_effects(clamped.points_m, clamped.moments, [MovingLoad((100.0,), (0.0,))])
    assert least.min() == pytest.approx(-300.0, rel=1e-6)  # P a of the longer arm


@pytest.mark.parametrize(("span_ft", "moment_kip_ft"), [(40, 449.8), (60, 806.5), (80, 1164.9), (100, 1524.0)])
def test_hs20_truck(span_ft, moment_kip_ft):
    """AASHTO, Standard Specifications for Highway Bridges, appendix A: 8, 32 and 32 kip 14 ft apart, no impact."""
    lines = influence_lines([0.0, span_ft], 0.0, span_ft)
    truck = MovingLoad((8.0, 32.0, 32.0), (0.0, 14.0, 28.0))
    _, largest = extreme_effects(lines.points_m, lines.moments, [truck])
    assert largest.max() == pytest.approx(moment_kip_ft, rel=2e-3)  # the worst axle is between two points


def test_two_axles_by_hand():
    """Absolute maximum under one of two equal axles a apart on a simple span: P (L - a/2)² / (2 L)."""
    lines = influence_lines([0.0, 13.0], 0.0, 13.0)
    _, largest = extreme_effects(lines.points_m, lines.moments, [MovingLoad((300.0, 300.0), (0.0, 1.2))])
    assert largest.max() == pytest.approx(300.0 * 12.4**2 / 26.0, rel=2e-3)
    _, shears = extreme_effects(lines.points_m, lines.shears, [MovingLoad((300.0, 300.0), (0.0, 1.2))])
    # Beside the support, with one axle a 64th of the span on and the other 1.2 m farther.
    assert shears.max() == pytest.approx(300.0 * (2.0 - 2.0 / 64.0 - 1.2 / 13.0), rel=1e-6)


def test_axles_keep_off_the_edges_and_relieving_ones_do_not_count():
    lines = influence_lines([-1.0, 1.0], -3.0, 3.0)
    wheels = MovingLoad((100.0, 100.0), (0.0, 2.0), clear_m=0.5)
    least, _ = extreme_effects(lines.points_m, lines.moments, [wheels])
    assert least.min() == pytest.approx(-150.0, rel=1e-6)  # one wheel 1.5 m out; the other relieves by its own
    whole = MovingLoad((100.0,) * 4, (0.0, 2.0, 4.0, 6.0), clear_m=0.5)
    least, largest = extreme_effects(lines.points_m, lines.moments, [whole])
    assert (least == 0.0).all() and (largest == 0.0).all()  # it has no room
