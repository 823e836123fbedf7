# SPDX-License-Identifier: GPL-3.0-or-later
"""Traffic, lane by lane, against EN 1991-2 and AASHTO worked by hand."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.reinforced_concrete.influence_lines import extreme_effects, influence_lines
from bridge_demolition_addon.engineering.reinforced_concrete.traffic import (
    hl_93,
    lever_rule,
    load_model_1,
    own_traffic,
    strip_widths_m,
)


@pytest.mark.parametrize(
    ("width_m", "lanes", "axle_kn", "uniform_kn_m"),
    [
        (2.5, 1, 300.0, 9 * 2.5),
        (3.7, 1, 300.0, 9 * 3 + 2.5 * 0.7),
        (5.6, 2, 500.0, 9 * 2.8 + 2.5 * 2.8),
        (8.5, 2, 500.0, 9 * 3 + 2.5 * 5.5),
        (9.0, 3, 600.0, 9 * 3 + 2.5 * 6),
        (12.0, 4, 600.0, 9 * 3 + 2.5 * 9),
    ],
)
def test_load_model_1_on_carriageways(width_m, lanes, axle_kn, uniform_kn_m):
    """EN 1991-2, tables 4.1 and 4.2: lanes by width; axles and uniform loads of all of them."""
    traffic = load_model_1(width_m)
    (load,) = traffic.on_whole_width()
    assert traffic.lanes == lanes
    assert load.axles_n == pytest.approx([1e3 * axle_kn] * 2)
    assert load.offsets_m == (0.0, 1.2)
    assert load.uniform_n_m == pytest.approx(1e3 * uniform_kn_m)


def test_moment_of_load_model_1_by_hand():
    """One lane on 20 m: 600 kN near mid-span, P (L - a/2)² / (2 L) = 2822.7 kN·m, and 27 × 400 / 8 = 1350 kN·m."""
    lines = influence_lines([0.0, 20.0], 0.0, 20.0)
    _, largest = extreme_effects(lines.points_m, lines.moments, load_model_1(3.0).on_whole_width())
    assert largest.max() / 1e3 == pytest.approx(300.0 * 19.4**2 / 40.0 + 1350.0, rel=2e-3)


def test_hl_93_on_a_simple_span():
    """One lane of 3.6 m on 18.288 m (60 ft): 1.2 × (1.33 × 806.5 kip·ft + 9.34 × L²/8). The truck in SI is 0.4 to 2 %
    heavier than that in kips and closer by 0.8 %."""
    span = 60 * 0.3048
    lines = influence_lines([0.0, span], 0.0, span)
    _, largest = extreme_effects(lines.points_m, lines.moments, hl_93(3.6).on_whole_width())
    by_hand = 1.2 * (1.33 * 806.5 * 1.35582 + 9.34 * span**2 / 8)
    assert largest.max() / 1e3 == pytest.approx(by_hand, rel=0.025)


def test_lanes_of_hl_93_and_their_presence():
    assert [hl_93(width).lanes for width in (3.0, 3.7, 6.5, 7.2, 12.0, 14.4)] == [1, 1, 2, 2, 3, 4]
    tandems = [hl_93(width).on_whole_width()[0].axles_n[0] for width in (3.6, 7.2, 10.8, 14.4)]
    assert tandems == pytest.approx([1330 * 110 * factor for factor in (1.2, 2.0, 2.55, 2.6)])


def test_two_trucks_count_over_supports_alone():
    lines = influence_lines([0.0, 30.0, 60.0], 0.0, 60.0)
    loads = hl_93(3.6).on_whole_width()
    all_least, all_largest = extreme_effects(lines.points_m, lines.moments, loads)
    least, largest = extreme_effects(lines.points_m, lines.moments, loads[:-1])
    assert all_largest == pytest.approx(largest)
    assert all_least.min() < 1.05 * least.min()


def test_lever_rule():
    supports = np.array([-2.0, 0.0, 2.0])
    outer, inner = lever_rule(supports, 0), lever_rule(supports, 1)
    assert outer(np.array([-3.0, -2.0, -1.0, 0.0, 1.0])) == pytest.approx([1.5, 1.0, 0.5, 0.0, 0.0])
    assert inner(np.array([-1.0, 0.0, 1.5])) == pytest.approx([0.5, 1.0, 0.25])
    everywhere = np.linspace(-3, 3, 61)
    shares = sum(lever_rule(supports, number)(everywhere) for number in range(3))
    assert shares == pytest.approx(np.ones(61))  # nothing of a load is lost


def test_axles_on_an_outer_girder():
    """Girders 2 m apart under 7 m, the lane at the edge: wheels at -3 and -1 m, 1 and 0 of half an axle of 300 kN."""
    (load,) = load_model_1(7.0).on_part(lever_rule(np.array([-3.0, -1.0, 1.0, 3.0]), 0))
    assert load.axles_n[0] == pytest.approx(150e3)
    inner = lever_rule(np.array([-3.0, -1.0, 1.0, 3.0]), 1)
    (load,) = load_model_1(6.0).on_part(inner)  # lanes at -1.5 and 1.5: wheels at -2.5, -0.5, 0.5 and 2.5
    assert load.axles_n[0] == pytest.approx(300e3 * (0.25 + 0.75) / 2 + 200e3 * 0.25 / 2)


def test_own_traffic():
    (load,) = own_traffic(7.5, 5e3, (100e3, 150e3, 150e3), (4.0, 1.5)).on_whole_width()
    assert load.axles_n == (100e3, 150e3, 150e3)
    assert load.offsets_m == (0.0, 4.0, 5.5)
    assert load.uniform_n_m == pytest.approx(5e3 * 7.5)


def test_wheels_on_a_strip():
    """LM1, E = 2 m: axles 1.2 m apart share 2 + 1.2 m, 600 / 3.2 = 187.5 kN/m, half for each wheel; E = 1 m: 300."""
    one, two = load_model_1(6.0).wheels_across(2.0, 6.0)
    assert one.axles_n == pytest.approx([93.75e3] * 2) and one.offsets_m == pytest.approx((0.0, 2.0))
    assert two.axles_n == pytest.approx([93.75e3] * 2 + [62.5e3] * 2)
    assert two.offsets_m == pytest.approx((0.0, 2.0, 3.0, 5.0))
    assert load_model_1(3.0).wheels_across(1.0, 3.0)[0].axles_n == pytest.approx([150e3] * 2)
    assert one.clear_m == pytest.approx(0.5) and load_model_1(6.0).clear_m(8.0) == pytest.approx(1.5)


def test_strips_of_aashto():
    assert strip_widths_m(2.4, -0.1) == pytest.approx((0.66 + 0.55 * 2.4, 1.22 + 0.25 * 2.4))
    assert strip_widths_m(2.4, 0.5)[1] == pytest.approx(1.14 + 0.833 * 0.5)
