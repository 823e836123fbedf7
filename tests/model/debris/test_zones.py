# SPDX-License-Identifier: GPL-3.0-or-later
"""A zone is entered exactly when a hull reaches into it, between frames too."""

import numpy as np
import pytest
from support.moving_boxes import moving_boxes, turned_about_z

from bridge_demolition_addon.model.debris.zones import TIME_TOLERANCE_S, watch_zone
from bridge_demolition_addon.model.scenario import Zone

SQUARE = ((5, -5), (15, -5), (15, 5), (5, 5))


def zone(corners=SQUARE, **heights):
    return Zone(name="Road", kind="road", corners_m=corners, **heights)


def slide(speed_m_s, duration_s=2.0, frame_s=0.25, height_m=0.0, size=(1, 1, 1)):
    """A box that slides along x from 0."""
    times = np.arange(0.0, duration_s + frame_s / 2, frame_s)
    positions = np.zeros((len(times), 1, 3))
    positions[:, 0, 0], positions[:, 0, 2] = speed_m_s * times, height_m
    return moving_boxes(times, [size], positions)


@pytest.mark.parametrize("speed", [3.0, 4.7, 20.0])
def test_entry_is_when_the_front_face_crosses_the_edge(speed):
    watch = watch_zone(slide(speed), zone(), [0])
    (entry,) = watch.entries
    # The front face is half a metre ahead, and the edge at 5 m.
    assert entry.time_s == pytest.approx(4.5 / speed, abs=TIME_TOLERANCE_S)
    assert entry.stays == (speed * 2.0 - 0.5 < 15.0)
    assert watch.mass_within_kg == (1000.0 if entry.stays else 0.0)


def test_what_stops_short_does_not_enter():
    assert watch_zone(slide(4.49 / 2), zone(), [0]).entries == ()


def test_what_touches_does_not_enter():
    # It ends with its face at 5 m exactly.
    assert watch_zone(slide(2.25), zone(), [0]).entries == ()


def test_a_wire_is_met_between_frames():
    """At 20 m/s a box is 5 m apart in two frames; the wire is a centimetre thick."""
    wire = zone(((7.0, -5), (7.01, -5), (7.01, 5), (7.0, 5)), bottom_m=0.2, top_m=0.21)
    (entry,) = watch_zone(slide(20.0), wire, [0]).entries
    assert entry.time_s == pytest.approx(6.5 / 20.0, abs=TIME_TOLERANCE_S)
    assert not entry.stays


@pytest.mark.parametrize("bottom, top, enters", [(0.51, None, False), (0.49, None, True), (None, -0.51, False)])
def test_heights_of_a_zone_count(bottom, top, enters):
    assert bool(watch_zone(slide(5.0), zone(bottom_m=bottom, top_m=top), [0]).entries) is enters


def test_free_fall_onto_a_zone():
    """Falling 20 m into a zone that is 2 m high, frames of 1/24 s: the parabola is followed within a frame's sag."""
    times = np.arange(49) / 24.0
    positions = np.zeros((49, 1, 3))
    positions[:, 0, 2] = 20.0 - 9.80665 * times**2 / 2
    results = moving_boxes(times, [(1, 1, 1)], positions)
    (entry,) = watch_zone(results, zone(((-3, -3), (3, -3), (3, 3), (-3, 3)), top_m=2.0), [0]).entries
    # The straight line between two frames lies at most g Δt²/8 = 2 mm beside the parabola, and it falls at 18.5 m/s.
    assert entry.time_s == pytest.approx(np.sqrt(2 * 17.5 / 9.80665), abs=TIME_TOLERANCE_S + 0.0025 / 18.5)


def test_a_bar_that_swings_into_a_zone_with_its_end():
    """Turning by 90° in one frame about its middle: the end comes 5 m out, and in between only an angle counts."""
    angles = np.radians([0.0, 90.0])
    results = moving_boxes([0.0, 1.0], [(10, 0.02, 1)], np.zeros((2, 1, 3)), rotations=turned_about_z(angles)[:, None])
    (entry,) = watch_zone(results, zone(((-10, 4), (10, 4), (10, 20), (-10, 20))), [0]).entries
    # Its corner is at 5 m and 0.01 m off the axis: reaching y = 4 takes an angle of asin(4 / r) - atan(0.01 / 5).
    angle = np.degrees(np.arcsin(4.0 / np.hypot(5.0, 0.01)) - np.arctan(0.01 / 5.0))
    assert entry.time_s == pytest.approx(angle / 90.0, abs=2 * TIME_TOLERANCE_S)


def test_the_notch_of_a_zone_is_not_the_zone():
    notched = zone(((-5, 3), (-5, -3), (-3, -3), (-3, 2), (3, 2), (3, -3), (5, -3), (5, 3)))
    drop = np.zeros((3, 1, 3))
    drop[:, 0, 1] = [-20.0, -1.0, 1.0]
    assert watch_zone(moving_boxes([0, 1, 2], [(1, 1, 1)], drop), notched, [0]).entries == ()
    drop[2, 0, 1] = 1.6
    (entry,) = watch_zone(moving_boxes([0, 1, 2], [(1, 1, 1)], drop), notched, [0]).entries
    # From -1 to 1.6 in a second; the face is half a metre ahead of the middle, the edge at 2.
    assert entry.time_s == pytest.approx(1.0 + 2.5 / 2.6, abs=TIME_TOLERANCE_S)


def test_what_was_there_before_does_not_enter():
    positions = np.zeros((2, 2, 3))
    positions[:, 0, 0], positions[:, 1, 0] = 10.0, [0.0, 10.0]
    watch = watch_zone(moving_boxes([0.0, 1.0], [(1, 1, 1)] * 2, positions), zone(), [0, 1])
    assert watch.there_before == (0,)
    assert [entry.body for entry in watch.entries] == [1]
    assert watch.mass_within_kg == 1000.0


def test_the_first_comes_first():
    times, positions = [0.0, 1.0], np.zeros((2, 2, 3))
    positions[1, :, 0] = [6.0, 12.0]
    watch = watch_zone(moving_boxes(times, [(1, 1, 1)] * 2, positions), zone(), [0, 1])
    assert [entry.body for entry in watch.entries] == [1, 0]


def test_corners_may_run_either_way_round():
    forth, back = (watch_zone(slide(4.0), zone(corners), [0]).entries for corners in (SQUARE, SQUARE[::-1]))
    assert forth == back and len(forth) == 1
