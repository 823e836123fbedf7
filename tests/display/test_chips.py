# SPDX-License-Identifier: GPL-3.0-or-later
"""Chips fly off when their cloud appears, fall as stones do, and stay on the ground."""

import numpy as np
import pytest

from bridge_demolition_addon.display.dust import Puff, chips_of
from bridge_demolition_addon.engineering.terrain.surface import RecordedGround

FLAT = RecordedGround(None, ())
CLOUD = Puff(12, (3.0, 1.0, 6.0), 1.0)
SINCE_S = 0.5
CHIPS = chips_of([CLOUD], {12: SINCE_S}, FLAT)


def middles(time_s):
    return CHIPS.at(time_s).vertices.reshape(len(CHIPS.sizes_m), -1, 3).mean(axis=1)


def test_there_are_none_before_anything_breaks():
    assert CHIPS.at(SINCE_S - 0.01) is None
    assert chips_of([], {}, FLAT).at(9.0) is None


def test_they_fly_off_where_it_broke():
    assert np.abs(middles(SINCE_S) - CLOUD.position_m).max() < CLOUD.radius_m


def test_they_fall_with_gravity_alone():
    one, two, three = (middles(SINCE_S + time_s)[:, 2] for time_s in (0.1, 0.2, 0.3))
    # Second difference of heights at three times 0.1 s apart; turning moves the middle of a chip by some millimetres.
    assert np.mean(one - 2.0 * two + three) / 0.1**2 == pytest.approx(-9.81, rel=0.05)


def test_they_stay_on_the_ground_near_by():
    late, later = CHIPS.at(20.0).vertices, CHIPS.at(30.0).vertices
    assert np.array_equal(late, later)
    assert late[:, 2].min() > -0.05 and late[:, 2].max() < 0.2
    assert np.abs(late[:, :2] - CLOUD.position_m[:2]).max() < 8.0  # no forecast of what flies far


def test_every_call_gives_the_same():
    assert np.array_equal(chips_of([CLOUD], {12: SINCE_S}, FLAT).at(1.0).vertices, CHIPS.at(1.0).vertices)
