# SPDX-License-Identifier: GPL-3.0-or-later
"""Values and ranges of contours, on the chain whose forces are known by hand; arrows and films."""

from dataclasses import replace

import numpy as np
import pytest
from support.sample_results import FRAME_S, POINTS, G, hanging_chain

from bridge_demolition_addon.display.colour_scale import ColourMap, colours
from bridge_demolition_addon.display.contour_quantities import ContourQuantity
from bridge_demolition_addon.display.contours import (
    ContourScale,
    ContourSeries,
    ContourSettings,
    RangeKind,
    StageContours,
    colour_bar,
)
from bridge_demolition_addon.display.force_arrows import arrows, connection_forces, contact_forces
from bridge_demolition_addon.display.frames import film_rows
from bridge_demolition_addon.engineering.unit_systems import UnitSystem
from bridge_demolition_addon.errors import ContourError, OutputError

UPPER, LOWER, BALL = 1, 2, 3


@pytest.fixture
def series():
    return ContourSeries.of_results(hanging_chain())


def test_forces_of_the_chain(series):
    # The ledge pulls upper up by the weight of both, lower pulls it down by its own.
    assert series.values(1, ContourQuantity.RESULTANT)[UPPER] == pytest.approx(300 * G)
    assert series.values(1, ContourQuantity.SUM)[UPPER] == pytest.approx(700 * G)
    assert series.values(1, ContourQuantity.RESULTANT)[LOWER] == pytest.approx(200 * G)
    # Half a frame at 6000 g is 3000 g on average; the peak is the whole.
    assert series.values(4, ContourQuantity.RESULTANT)[BALL] == pytest.approx(3000 * G)
    assert series.values(4, ContourQuantity.RESULTANT, peak=True)[BALL] == pytest.approx(6000 * G)


def test_stresses_of_the_chain(series):
    # A hanging bar under tension at one end: mean stress is half the end's. Lower: 200 g over 0.5 m² at its top.
    assert series.values(1, ContourQuantity.PRINCIPAL)[LOWER] == pytest.approx(200 * G / 0.5 / 2.0)
    assert series.values(1, ContourQuantity.VON_MISES)[LOWER] == pytest.approx(200 * G / 0.5 / 2.0)


def test_displacement_is_from_where_a_body_stood_at_first(series):
    # Lower has moved by (3, 4, -12) m: Pythagoras gives 13 m.
    assert series.values(4, ContourQuantity.DISPLACEMENT)[[UPPER, LOWER]] == pytest.approx([0.0, 13.0])
    assert ContourQuantity.DISPLACEMENT.units.of(13.0).name == "m"
    assert ContourQuantity.DISPLACEMENT.units.of(0.013).name == "mm"


def test_in_us_units_the_bar_has_round_ticks_and_the_units_of_nist(series):
    """NIST SP 811, B.8: 1 kip is 4448.222 N, 1 ft 0.3048 m."""
    settings = ContourSettings(range_kind=RangeKind.FIXED, low=0.0, high=99 * 4448.222, logarithmic=False)
    bar = colour_bar(settings, series.show(3, settings), UnitSystem.IMPERIAL)
    assert (bar.unit, bar.tick_texts) == ("(kip)", ("0", "20", "40", "60", "80"))
    np.testing.assert_allclose(bar.tick_shares, np.arange(5) * 20.0 / 99.0, atol=1e-6)
    moved = replace(settings, quantity=ContourQuantity.DISPLACEMENT, high=4 * 0.3048)
    bar = colour_bar(moved, series.show(3, moved), UnitSystem.IMPERIAL)
    assert (bar.unit, bar.tick_texts) == ("(ft)", ("0", "1", "2", "3", "4"))


def test_a_magnified_shape_is_displaced_and_turned_so_many_times_as_much():
    results = hanging_chain()
    angle = 0.1
    turned = results.frames.rotations.copy()
    turned[4, LOWER, :2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    series = ContourSeries.of_results(replace(results, frames=replace(results.frames, rotations=turned)))
    first, shown = series.frame(0), series.magnified(4, 3.0)
    assert shown.positions_m[LOWER] - first.positions_m[LOWER] == pytest.approx([9.0, 12.0, -36.0])
    expected = [[np.cos(0.3), -np.sin(0.3)], [np.sin(0.3), np.cos(0.3)]]
    np.testing.assert_allclose(shown.rotations[LOWER, :2, :2], expected, atol=1e-6)  # kept in single precision
    assert series.magnified(4, 1.0).positions_m[LOWER].tolist() == series.frame(4).positions_m[LOWER].tolist()
    magnified = colour_bar(ContourSettings(magnification=3.0), series.show(4, ContourSettings()))
    assert magnified.subtitle == "frame mean, shape × 3"


@pytest.mark.parametrize(
    "quantity, peak, subtitle, ball_n",
    [
        # Half a frame at 6000 g: see above.
        (ContourQuantity.RESULTANT, False, "frame mean", 3000 * G),
        (ContourQuantity.RESULTANT, True, "sub-step peak so far", 6000 * G),
        (ContourQuantity.SUM, True, "sub-step peak so far", 6000 * G),
        (ContourQuantity.VON_MISES, False, "frame mean", None),
        (ContourQuantity.VON_MISES, True, "frame mean, peak so far", None),
        (ContourQuantity.DISPLACEMENT, False, "", None),
        (ContourQuantity.DISPLACEMENT, True, "peak so far", None),
    ],
)
def test_the_colour_bar_says_whether_it_is_a_mean_or_a_peak(series, quantity, peak, subtitle, ball_n):
    settings = ContourSettings(quantity=quantity, peak=peak)
    shown = series.show(4, settings)
    assert colour_bar(settings, shown).subtitle == subtitle
    if ball_n:
        assert shown.values[BALL] == pytest.approx(ball_n)


def test_what_never_moves_has_no_value(series):
    assert np.isnan(series.values(1, ContourQuantity.RESULTANT)[0])


def test_peak_so_far_never_falls_and_is_reached(series):
    peaks = np.array([series.values(row, ContourQuantity.SUM, peak=True) for row in range(5)])[:, 1:]
    assert (np.diff(peaks, axis=0) >= 0.0).all()
    assert peaks[-1, 0] == pytest.approx(500 * G + np.hypot(200 * G, 1000.0))


def test_a_growing_series_is_the_finished_one(series):
    results = hanging_chain()
    recorded = []
    growing = ContourSeries(results.inventory, recorded)
    settings = ContourSettings(peak=True)
    for row in range(5):
        recorded.append(results.frames[row])
        growing.follow()
        growing.show(row, settings)
    for row in range(5):
        assert np.array_equal(growing.show(row, settings).screen_colours, series.show(row, settings).screen_colours)


def test_range_over_the_run_and_of_each_frame(series):
    linear = {"logarithmic": False, "colour_map": ColourMap.BLUE_TO_RED}
    run, frame = ContourSettings(**linear), ContourSettings(range_kind=RangeKind.FRAME, **linear)
    # The ball's 3000 g do not count; a push of 1000 N for half a frame, across the weight of both, is the most.
    assert series.show(1, run).scale == ContourScale(0.0, pytest.approx(np.hypot(300 * G, 500.0)))
    assert series.show(1, frame).scale == ContourScale(0.0, pytest.approx(300 * G))
    assert series.show(1, frame).screen_colours[UPPER].tolist() == [1.0, 0.0, 0.0]
    # The first frame, in which no time passes, is free of load: everything is blue, as in the report's Figure 55.
    assert series.show(0, frame).screen_colours[1:].tolist() == [[0.0, 0.0, 1.0]] * 3


def test_fixed_and_logarithmic_ranges(series):
    fixed = ContourSettings(
        range_kind=RangeKind.FIXED, low=0.0, high=600 * G, logarithmic=False, colour_map=ColourMap.BLUE_TO_RED
    )
    assert series.show(1, fixed).screen_colours[UPPER] == pytest.approx([0.5, 1.0, 0.0])
    logarithmic = ContourSettings(logarithmic=True, decades=2.0)
    scale = series.show(1, logarithmic).scale
    most = np.hypot(300 * G, 500.0)
    assert (scale.low, scale.high) == pytest.approx((most / 100.0, most))
    assert scale.shares([most / 100.0, most / 10.0, -most, 0.0]) == pytest.approx([0.0, 0.5, 1.0, 0.0])


def test_the_ball_has_a_colour_and_no_say_in_the_scale(series):
    shown = series.show(4, ContourSettings(logarithmic=False))
    assert shown.values[BALL] > 5.0 * shown.scale.high
    assert shown.screen_colours[BALL].tolist() == colours(ColourMap.VIRIDIS, [1.0])[0].tolist()


def test_a_percentile_leaves_the_few_largest_out(series):
    # Of the two shards, over the run: 200, 200, 206, 300, 300, 300 and 304 g, and some zeros. The middle one is 300 g.
    half = ContourSettings(logarithmic=False, percentile=50.0)
    shown = series.show(3, half)
    assert shown.scale == ContourScale(0.0, pytest.approx(300 * G))
    assert shown.screen_colours[UPPER].tolist() == colours(ColourMap.VIRIDIS, [1.0])[0].tolist()
    assert colour_bar(half, shown).subtitle == "frame mean, up to percentile 50"
    of_frame = replace(half, range_kind=RangeKind.FRAME)
    assert series.show(1, of_frame).scale == ContourScale(0.0, pytest.approx(250 * G))  # of 200 and 300
    assert series.show(0, of_frame).scale == ContourScale(0.0, 0.0)  # in the first frame nothing bears a load


def test_a_percentile_follows_a_series_that_grows(series):
    results, recorded = hanging_chain(), []
    growing, settings = ContourSeries(results.inventory, recorded), ContourSettings(percentile=80.0)
    for row in range(5):
        recorded.append(results.frames[row])
        growing.follow()
        growing.show(row, settings)
    assert growing.show(2, settings).scale == series.show(2, settings).scale


def test_the_peak_of_the_whole_run_is_that_of_the_last_frame_in_every_frame(series):
    whole = ContourSettings(peak=True, whole_run=True)
    first = series.show(0, whole)
    assert np.array_equal(first.values, series.values(4, ContourQuantity.RESULTANT, peak=True), equal_nan=True)
    assert first.values[BALL] == pytest.approx(6000 * G) and first.frame == series.frames[0]
    assert colour_bar(whole, first).subtitle == "sub-step peak of the whole run"
    assert series.show(0, ContourSettings(peak=True)).values[BALL] == 0.0


@pytest.mark.parametrize(("low", "high", "logarithmic"), [(1.0, 1.0, False), (2.0, 1.0, False), (0.0, 1.0, True)])
def test_a_range_without_an_extent_is_refused(low, high, logarithmic):
    with pytest.raises(ContourError, match="range of contours"):
        ContourSettings(range_kind=RangeKind.FIXED, low=low, high=high, logarithmic=logarithmic)


def test_ticks_are_round_and_inside():
    assert ContourScale(0.0, 1.0).ticks() == pytest.approx([0.0, 0.2, 0.4, 0.6, 0.8, 1.0])
    assert ContourScale(-70.0, 130.0).ticks() == pytest.approx([-50.0, 0.0, 50.0, 100.0])
    assert ContourScale(0.02, 30.0, True).ticks() == pytest.approx([0.1, 1.0, 10.0])
    assert ContourScale(0.0, 0.0).ticks() == pytest.approx([0.0])


def test_units_keep_numbers_short():
    found = [
        ContourQuantity.SUM.units.of(5e6).name,
        ContourQuantity.SUM.units.of(5e3).name,
        ContourQuantity.VON_MISES.units.of(2e6).name,
    ]
    assert found == ["MN", "kN", "N/mm²"]


def test_rows_by_frames(series):
    assert [series.row_at(frame) for frame in (1, 2, 4, 6, 99)] == [0, 0, 2, 4, 4]
    assert ContourSeries(hanging_chain().inventory, ()).row_at(1) is None


def test_connections_move_with_their_first_bodies(series):
    first, last = series.frame(0), series.frame(4)
    positions, forces = connection_forces(last, first, series.pairs, series.points_m)
    assert len(positions) == len(forces) == 1  # the other is broken
    turned = replace(last, rotations=last.rotations.copy())
    turned.rotations[UPPER] = [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]
    positions, _ = connection_forces(turned, first, series.pairs, series.points_m)
    arm = POINTS[0] - first.positions_m[UPPER]  # 2 m above: a quarter turn about x takes it to -y
    assert positions[0] == pytest.approx(first.positions_m[UPPER] + [0.0, -arm[2], 0.0])


def test_contact_forces_are_impulses_over_the_frame(series):
    _, forces = contact_forces(series.frame(4), FRAME_S)
    assert forces[BALL] == pytest.approx([0.0, 0.0, 3000 * G])


def test_arrows_start_at_their_bodies_and_are_as_long_as_their_forces():
    starts = np.array([[1.0, 2.0, 3.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    forces = np.array([[0.0, 0.0, 500.0], [1.0, 0.0, 0.0], [np.nan, 0.0, 0.0]])
    lines = arrows(starts, forces, 0.004, least_m=0.1).reshape(-1, 3, 2, 3)
    assert len(lines) == 1  # one is too short, one is not known
    assert lines[0, 0].tolist() == [[1.0, 2.0, 3.0], [1.0, 2.0, 5.0]]
    assert np.allclose(lines[0, 1:, 0], [1.0, 2.0, 5.0]) and (lines[0, 1:, 1, 2] < 5.0).all()


def test_a_film_in_real_time_and_slowed_down():
    times = np.arange(11) / 10.0
    assert film_rows(times, 10.0).tolist() == list(range(11))
    assert film_rows(times, 5.0).tolist() == list(range(0, 11, 2))
    slow = film_rows(times, 10.0, slowness=3.0)
    assert len(slow) == 31 and slow[[0, 15, 30]].tolist() == [0, 5, 10]


def test_a_film_keeps_time_where_frames_are_of_different_lengths():
    times = np.array([0.0, 0.1, 0.11, 0.12, 0.13, 0.2])
    assert film_rows(times, 10.0).tolist() == [0, 1, 5]


def test_a_film_of_nothing_is_refused():
    with pytest.raises(OutputError, match="no recorded frames"):
        film_rows([], 25.0)
    with pytest.raises(OutputError, match="positive"):
        film_rows([0.0], 25.0, 0.0)


@pytest.mark.parametrize(("largest", "end"), [(0.78, 1.0), (3.0, 3.0), (7.0, 7.0)])
def test_utilisation_is_linear_from_0_to_where_connections_break_which_is_marked(largest, end):
    used = np.array([[0.0, 0.39, largest]])
    settings = ContourSettings(ContourQuantity.UTILISATION)
    frame = StageContours(np.zeros(1), used, np.zeros((3, 3))).show(1, settings)
    assert frame.scale.shares(used[0]).tolist() == pytest.approx([0.0, 0.39 / end, largest / end])
    bar = colour_bar(settings, frame)
    marked = dict(zip(bar.tick_texts, bar.tick_shares, strict=True))
    assert marked["100"] == pytest.approx(1.0 / end) and bar.unit == "(%)"
