# SPDX-License-Identifier: GPL-3.0-or-later
"""Shards that leave a blast zone come out of the section in time, and no closer to each other."""

import numpy as np
import pytest

from bridge_demolition_addon.model.changes.departures import FALLING_M_S, LEAVING_M_S, departure_of
from bridge_demolition_addon.model.changes.zone_firings import ZoneFiring

SECTION = np.array([(-0.35, -0.35, 0.75), (0.35, 0.35, 2.25)])
generator = np.random.default_rng(5)
CENTRES_M = generator.uniform(SECTION[0] + 0.1, SECTION[1] - 0.1, (30, 3))
BOXES_M = CENTRES_M[:, None] + np.array([(-0.1, -0.1, -0.1), (0.1, 0.1, 0.1)])


def firing(speed_m_s=0.0, along="z"):
    return ZoneFiring(
        time_s=0.5,
        members=("column",),
        lowest_corner_m=tuple(SECTION[0]),
        highest_corner_m=tuple(SECTION[1]),
        name="zone",
        along=along,
        effect="thrown out",
        left=0.0,
        speed_m_s=speed_m_s,
        cage_tension_n=0.0,
        cage_compression_n=0.0,
    )


@pytest.mark.parametrize("speed_m_s", [0.0, 3.0, 14.0])
def test_all_are_out_of_the_section_when_they_touch_again(speed_m_s):
    departure = departure_of(firing(speed_m_s), CENTRES_M, BOXES_M)
    moved = BOXES_M + departure.duration_s * departure.leaving_m_s[:, None]
    beside = (moved[:, 0, :2] >= SECTION[1, :2] - 1e-9) | (moved[:, 1, :2] <= SECTION[0, :2] + 1e-9)
    assert beside.any(axis=1).all()
    # No sooner than the last one needs.
    earlier = BOXES_M + 0.99 * departure.duration_s * departure.leaving_m_s[:, None]
    beside = (earlier[:, 0, :2] >= SECTION[1, :2]) | (earlier[:, 1, :2] <= SECTION[0, :2])
    assert not beside.any(axis=1).all()
    assert not departure.leaving_m_s[:, 2].any()  # level


@pytest.mark.parametrize("speed_m_s", [0.0, 14.0])
def test_no_two_of_them_come_closer(speed_m_s):
    departure = departure_of(firing(speed_m_s), CENTRES_M, BOXES_M)
    for share in (0.25, 0.5, 1.0):
        moved = CENTRES_M + share * departure.duration_s * departure.leaving_m_s
        before, after = (np.linalg.norm(at[:, None] - at, axis=2) for at in (CENTRES_M, moved))
        assert (after >= before - 1e-9).all()


def test_rubble_slows_down_once_it_is_out():
    departure = departure_of(firing(), CENTRES_M, BOXES_M)
    assert np.linalg.norm(departure.leaving_m_s, axis=1) == pytest.approx(np.full(30, LEAVING_M_S))
    assert np.linalg.norm(departure.after_m_s, axis=1) == pytest.approx(np.full(30, FALLING_M_S))
    assert departure.duration_s < 0.35  # across 0.7 m and twice its own half at 5 m/s, askew


def test_what_is_thrown_has_the_mean_speed():
    departure = departure_of(firing(14.0), CENTRES_M, BOXES_M)
    speeds = np.linalg.norm(departure.after_m_s, axis=1)
    assert speeds.mean() == pytest.approx(14.0)
    assert (speeds.min() > 7.0) and (speeds.max() < 21.0)
    np.testing.assert_allclose(departure.leaving_m_s, departure.after_m_s)


def test_rubble_of_a_level_member_falls_straight_down():
    departure = departure_of(firing(along="x"), CENTRES_M, BOXES_M)
    np.testing.assert_allclose(departure.leaving_m_s, np.tile((0.0, 0.0, -LEAVING_M_S), (30, 1)))


def test_a_shard_on_the_axis_leaves_as_well():
    middle = SECTION.mean(axis=0)[None]
    departure = departure_of(firing(), middle, SECTION[None])
    assert departure.duration_s == pytest.approx(0.7 / LEAVING_M_S)
    assert np.linalg.norm(departure.leaving_m_s) == pytest.approx(LEAVING_M_S)


@pytest.mark.parametrize("side", [(0.0, 1.8), (0.0, -1.8), (1.8, 0.0)])
@pytest.mark.parametrize("whole", [True, False])
def test_none_goes_where_a_column_stands_beside_or_its_concrete_comes_from(side, whole):
    """Columns of 0.7 m, 1.8 m apart, which fire together: what leaves them does not meet."""
    centres, boxes = (SECTION.mean(axis=0)[None], SECTION[None]) if whole else (CENTRES_M, BOXES_M)
    beside = np.array((*side, 0.0))
    departures = [departure_of(firing(), centres, boxes, (SECTION + shift)[None]) for shift in (beside, -beside)]
    ends = [boxes + departure.duration_s * departure.leaving_m_s[:, None] for departure in departures]
    ends[1] = ends[1] + beside  # the other column
    lowest = np.maximum(ends[0][:, None, 0], ends[1][None, :, 0])
    highest = np.minimum(ends[0][:, None, 1], ends[1][None, :, 1])
    assert not (highest > lowest + 1e-9).all(axis=2).any()
    alone = departure_of(firing(), centres, boxes)
    assert np.linalg.norm(departures[0].leaving_m_s, axis=1) == pytest.approx(np.linalg.norm(alone.leaving_m_s, axis=1))


def test_between_two_columns_they_leave_along_the_road():
    others = np.stack([np.add(SECTION, (0.0, 1.8, 0.0)), np.subtract(SECTION, (0.0, 1.8, 0.0))])
    departure = departure_of(firing(), CENTRES_M, BOXES_M, others)
    assert not departure.leaving_m_s[:, 1:].any()
    np.testing.assert_array_equal(np.sign(departure.leaving_m_s[:, 0]), np.sign(CENTRES_M[:, 0]))


def test_what_stands_farther_away_or_lies_below_does_not_matter():
    others = np.stack([np.add(SECTION, (0.0, 4.0, 0.0)), np.subtract(SECTION, (0.0, 0.0, 1.6))])
    found, alone = (departure_of(firing(), CENTRES_M, BOXES_M, *beside) for beside in ((others,), ()))
    np.testing.assert_array_equal(found.leaving_m_s, alone.leaving_m_s)
