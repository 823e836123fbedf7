# SPDX-License-Identifier: GPL-3.0-or-later
"""Limits of codes at the foundation, as they are tabulated, in mm/s."""

import math

import pytest

from bridge_demolition_addon.model.debris.vibration_limits import FALL_HZ, LIMITS, reached

BY_NAME = {str(limit.building): limit for limit in LIMITS}


def found(building, *frequencies_hz):
    return [1e3 * BY_NAME[building].at_m_s(frequency) for frequency in frequencies_hz]


@pytest.mark.parametrize(
    "building, at_1, at_10, at_50, at_100",
    [
        ("industrial buildings", 20, 20, 40, 50),
        ("dwellings", 5, 5, 15, 20),
        ("sensitive or listed buildings", 3, 3, 8, 10),
    ],
)
def test_lines_1_to_3_of_din_4150(building, at_1, at_10, at_50, at_100):
    """Table 1: 1 to 10 Hz, 10 to 50 Hz and 50 to 100 Hz, straight between."""
    assert found(building, 1, 10, 50, 100) == pytest.approx([at_1, at_10, at_50, at_100])
    assert found(building, 30, 75) == pytest.approx([(at_10 + at_50) / 2.0, (at_50 + at_100) / 2.0])


def test_lines_of_bs_7385():
    """Line 1: 50 from 4 Hz on. Line 2: 15 at 4 Hz, 20 at 15 Hz, 50 from 40 Hz; 44 at 35 Hz, as NBR 9653 has it."""
    light = "unreinforced or light framed buildings, cosmetic damage"
    assert found(light, 4, 15, 35, 40, 100) == pytest.approx([15, 20, 44, 50, 50])
    assert found("reinforced or framed buildings, cosmetic damage", 4, 100) == pytest.approx([50, 50])
    # 0.6 mm of displacement, below 4 Hz, is as fast there.
    assert 2.0 * math.pi * 4.0 * 0.6 == pytest.approx(found(light, 4)[0], rel=0.01)


def test_classes_of_sn_640_312():
    """Now and then: 15, 20 and 30 below 30 Hz, from there to 60 Hz, and above; class 4 down to half of it."""
    assert found("buildings of normal sensitivity", 8, 29.9, 30, 59, 60.1) == pytest.approx([15, 15, 20, 20, 30])
    assert found("buildings of raised sensitivity", 8, 29.9, 30, 59, 60.1) == pytest.approx([7.5, 7.5, 10, 10, 15])


@pytest.mark.parametrize(
    "velocity_mm_s, reached_mm_s",
    [
        (2.9, []),
        (3.0, [3]),
        (5.0, [3, 5]),
        (14.9, [3, 5, 7.5]),
        (19.9, [3, 5, 7.5, 15, 15]),
        (50.0, [3, 5, 7.5, 15, 15, 20, 50]),
    ],
)
def test_what_falls_is_held_against_the_lowest(velocity_mm_s, reached_mm_s):
    limits = reached(1e-3 * velocity_mm_s, FALL_HZ)
    assert [1e3 * limit.at_m_s(FALL_HZ) for limit in limits] == pytest.approx(reached_mm_s)
