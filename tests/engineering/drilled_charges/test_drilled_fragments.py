# SPDX-License-Identifier: GPL-3.0-or-later
"""Flyrock and fragments against published examples, closed forms, an integration by scipy, and their distributions."""

import numpy as np
import pytest
from scipy import stats
from scipy.integrate import solve_ivp

from bridge_demolition_addon.engineering.drilled_charges.drill_holes import charge_length_m
from bridge_demolition_addon.engineering.drilled_charges.fragments import (
    Fragments,
    landings_m,
    lundborg_range_m,
    mckenzie_range_m,
    mean_size_m,
    mean_speed_m_s,
    passing_share,
    ranges_m,
    sampled_directions,
    sampled_speeds_m_s,
    scaled_depth_of_burial,
    size_of_share_m,
    speed_for_range_m_s,
)

pytestmark = pytest.mark.slow

G = 9.80665
DIAGONAL = np.array([1.0, 0.0, 1.0]) / np.sqrt(2.0)


def thrown(sizes_m, velocities_m_s, height_m=1.0):
    sizes, velocities = np.atleast_1d(np.asarray(sizes_m, float)), np.atleast_2d(velocities_m_s)
    return Fragments(sizes, np.tile((0.0, 0.0, height_m), (len(sizes), 1)), velocities.astype(float), 2400.0)


def test_lundborg():
    # 38 mm are 1.496 inches, to the power of 2/3: 1.308. 260 × 1.308 = 340 m.
    assert lundborg_range_m(0.038) == pytest.approx(340.1, abs=0.5)


def test_mckenzies_worked_example():
    """Holes of 115 mm with 2 m of stemming and 1.2 kg/l: 14.33 kg in 10 diameters, 1.060 m/kg^(1/3), 211.7 m."""
    assert np.pi / 4 * 0.115**2 * 1.15 * 1200 == pytest.approx(14.33, abs=0.01)
    buried = scaled_depth_of_burial(8.0, 2.0, 0.115, 1200.0)
    assert buried == pytest.approx(1.060, abs=1e-3)
    assert mckenzie_range_m(0.115, buried) == pytest.approx(211.7, rel=2e-3)  # by three digits of the depth


@pytest.mark.parametrize(
    ("diameter_m", "charge_kg", "stemming_m", "density_kg_m3", "expected", "range_m"),
    [(0.038, 0.082, 0.25, 1450.0, 0.632, 213.0), (0.032, 0.058, 0.15, 1200.0, 0.465, 297.0)],
)
def test_mckenzie_of_demolition_holes(diameter_m, charge_kg, stemming_m, density_kg_m3, expected, range_m):
    """By hand, gelatine in the first and emulsion in the second: (0.25 + 0.050 / 2) / 0.082^(1/3) = 0.633."""
    length = charge_length_m(charge_kg, diameter_m, density_kg_m3)
    buried = scaled_depth_of_burial(length, stemming_m, diameter_m, density_kg_m3)
    assert buried == pytest.approx(expected, rel=2e-3)
    assert mckenzie_range_m(diameter_m, buried) == pytest.approx(range_m, rel=4e-3)  # ditto


def test_speeds_by_the_explosives_energy():
    # √(2 η 4e6 q / 2400): 8.2, 14.1 and 25.8 m/s at 1 kg/m³.
    for share, expected in ((0.02, 8.2), (0.06, 14.1), (0.2, 25.8)):
        assert mean_speed_m_s(1.0, share=share) == pytest.approx(expected, abs=0.05)


@pytest.mark.parametrize("speed", [20.0, 50.0, 100.0])
@pytest.mark.parametrize("size", [0.02, 0.05, 0.10, 0.20])
def test_ranges_with_drag(speed, size):
    """From 1 m, by 45°, cubes of 2400 kg/m³: the table's values, which an independent integration gave to 0.1 m."""
    expected = {
        20.0: {0.02: 26.9, 0.05: 33.9, 0.10: 37.3, 0.20: 39.4},
        50.0: {0.02: 66.6, 0.05: 112.5, 0.10: 152.2, 0.20: 188.5},
        100.0: {0.02: 99.0, 0.05: 194.1, 0.10: 305.1, 0.20: 448.5},
    }
    (landing,) = landings_m(thrown(size, speed * DIAGONAL))
    assert landing[0] == pytest.approx(expected[speed][size], rel=0.005)
    assert landing[2] == pytest.approx(0.0, abs=1e-3)


@pytest.mark.parametrize(("speed", "elevation"), [(14.0, 20.0), (50.0, 38.0), (90.0, 60.0)])
def test_drag_against_scipy(speed, elevation):
    """The equation of motion again, by an adaptive method of eighth order that stops at the ground."""
    size, slowing = 0.06, 0.5 * 1.225 * 1.0 * 1.5 / (2400.0 * 0.06)
    angle = np.radians(elevation)

    def motion(_, state):
        velocity = state[2:]
        return [*velocity, *(-slowing * np.hypot(*velocity) * velocity - (0.0, G))]

    def height(_, state):
        return state[1]

    height.terminal, height.direction = True, -1.0
    start = [0.0, 1.0, speed * np.cos(angle), speed * np.sin(angle)]
    solved = solve_ivp(motion, (0.0, 60.0), start, method="DOP853", events=height, rtol=1e-10, atol=1e-10)
    (landing,) = landings_m(thrown(size, (start[2], 0.0, start[3])))
    assert landing[0] == pytest.approx(solved.y_events[0][0][0], rel=1e-4)


def test_ranges_in_vacuum():
    """Without air the parabola: from a height as by the quadratic equation, and over level ground v² / g at most."""
    for speed in (20.0, 50.0, 100.0):
        assert speed_for_range_m_s(speed**2 / G) == pytest.approx(speed)
    (landing,) = landings_m(thrown(0.05, 30.0 * DIAGONAL, height_m=12.0), drag_coefficient=0.0)
    level = upwards = 30.0 / np.sqrt(2.0)
    seconds = np.roots([-G / 2.0, upwards, 12.0]).max()
    assert landing[0] == pytest.approx(level * seconds, rel=1e-5)


def test_drag_alone_slows_by_its_closed_form():
    """Without weight a fragment goes ln(1 + k v t) / k: it meets a wall of ground there, 12 m ahead, at t."""
    speed, size = 40.0, 0.04
    k = 0.5 * 1.225 * 1.5 / (2400.0 * size)
    (landing,) = landings_m(
        thrown(size, (speed, 0.0, -speed), height_m=12.0), gravity_m_s2=0.0
    )  # downwards by 45°: as far as it is high
    assert landing[0] == pytest.approx(12.0, rel=1e-6)
    # Its path after 0.5 s by the closed form, as that of a fragment that comes down there.
    along = np.log(1.0 + k * speed * 0.5) / k
    (landing,) = landings_m(thrown(size, (0.0, 0.0, -speed), height_m=along), gravity_m_s2=0.0)
    assert landing[2] == pytest.approx(0.0, abs=1e-6)


def test_best_angle_falls_with_speed():
    """Of 0.05 m: 42, 38 and 34 degrees at 20, 50 and 100 m/s (from the same independent integration)."""
    angles = np.arange(25, 50)
    for speed, best in ((20.0, 42), (50.0, 38), (100.0, 34)):
        directions = np.column_stack((np.cos(np.radians(angles)), 0.0 * angles, np.sin(np.radians(angles))))
        flown = landings_m(thrown(np.full(len(angles), 0.05), speed * directions))[:, 0]
        assert abs(angles[flown.argmax()] - best) <= 1  # the maximum is flat


def test_fragments_land_on_the_ground_below_them():
    slope = landings_m(thrown(0.05, 25.0 * DIAGONAL), lambda at: 0.5 * at[:, 0])
    assert slope[0, 2] == pytest.approx(0.5 * slope[0, 0], abs=1e-3)
    assert slope[0, 0] < landings_m(thrown(0.05, 25.0 * DIAGONAL))[0, 0]
    beyond = landings_m(thrown(0.05, 25.0 * DIAGONAL), lambda at: np.full(len(at), np.nan))
    assert beyond[0, 2] == pytest.approx(0.0, abs=1e-3)


def test_sizes_of_kuz_ram():
    # A 7, 74 g a hole, RWS 100: 8.6 cm with 0.5 kg/m³, 5.0 cm with 1.
    assert mean_size_m(0.5, 0.074) == pytest.approx(0.086, abs=5e-4)
    assert mean_size_m(1.0, 0.074) == pytest.approx(0.050, abs=5e-4)


def test_sizes_are_rosins_and_rammlers():
    """Half of the mass is smaller than X50; scipy's Weibull distribution is the same law."""
    law = stats.weibull_min(1.1, scale=0.05 / np.log(2.0) ** (1 / 1.1))
    shares = np.array([0.1, 0.5, 0.9, 0.999])
    assert passing_share(0.05, 0.05) == pytest.approx(0.5)
    assert size_of_share_m(shares, 0.05) == pytest.approx(law.ppf(shares))
    assert passing_share(law.ppf(shares), 0.05) == pytest.approx(shares)


def test_speeds_are_log_normal_with_their_mean():
    speeds = sampled_speeds_m_s(40_000, 14.0, np.inf, np.random.default_rng(1))
    # Standard error of the mean: 14 √(e^0.25 - 1) / 200 = 0.037 m/s; four of them.
    assert speeds.mean() == pytest.approx(14.0, abs=0.15)
    law = stats.lognorm(0.5, scale=14.0 * np.exp(-0.125))
    assert stats.kstest(speeds, law.cdf).pvalue > 0.01
    assert sampled_speeds_m_s(1000, 14.0, 20.0, np.random.default_rng(1)).max() == 20.0


def test_directions_go_by_a_power_of_the_cosine():
    normal = np.array([0.6, 0.0, 0.8])
    directions = sampled_directions(40_000, normal, np.random.default_rng(2))
    assert np.linalg.norm(directions, axis=1) == pytest.approx(np.ones(len(directions)))
    cosines = directions @ normal
    # Density cos⁴ over the half sphere: the cosine's distribution function is c⁵, its mean 5/6.
    assert stats.kstest(cosines, lambda c: c**5).pvalue > 0.01
    across = directions @ np.array([0.0, 1.0, 0.0])
    assert across.mean() == pytest.approx(0.0, abs=0.01)  # standard error √(1/7 / 40000) = 0.002


def test_ranges_leave_out_what_is_light():
    landings = np.array([[3.0, 4.0, 0.0], [30.0, 40.0, 0.0], [300.0, 0.0, 0.0]])
    ranges = ranges_m((0.0, 0.0, 2.0), landings, np.array([1.0, 0.1, 0.05]))
    assert (ranges.half_m, ranges.largest_m) == (5.0, 50.0)
    none = ranges_m((0.0, 0.0, 0.0), landings, np.full(3, 0.01))
    assert none.largest_m == 0.0
