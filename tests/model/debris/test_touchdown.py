# SPDX-License-Identifier: GPL-3.0-or-later
"""Touchdown: what lands together and how it shakes the ground, against free fall and tabulated values."""

import numpy as np
import pytest
from support.moving_boxes import moving_boxes

from bridge_demolition_addon.engineering.blast.site_law import SiteLaw
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2 as G
from bridge_demolition_addon.model.debris.touchdown import landings, shaking_at, touchdown_velocity


@pytest.mark.parametrize(
    "mass_t, at_10_m, at_20_m, at_50_m, at_100_m",
    [(50, 15.5, 4.9, 1.1, 0.3), (107, 23.6, 7.5, 1.6, 0.5), (285, 40.6, 12.8, 2.8, 0.9)],
)
def test_the_formula_gives_what_is_tabulated_for_a_fall_of_5_m(mass_t, at_10_m, at_20_m, at_50_m, at_100_m):
    """In mm/s, worked out apart from this code, with M in t and σ in MPa; given to a tenth."""
    energy_j = mass_t * 1e3 * 9.8 * 5.0
    found = 1e3 * touchdown_velocity(np.array([10.0, 20.0, 50.0, 100.0]), energy_j)
    assert found == pytest.approx([at_10_m, at_20_m, at_50_m, at_100_m], abs=0.06)


def falling(heights_m, delays_s, places_m, *, frames_per_second=240, end_s=2.0):
    """Boxes of 1 m³ that fall from heights after delays and stay where they land."""
    times = np.arange(0.0, end_s, 1.0 / frames_per_second)
    fallen_s = np.clip(times[:, None] - delays_s, 0.0, None)
    heights = np.array(heights_m, float)
    lands_s = np.sqrt(2.0 * heights / G)
    flying = fallen_s < lands_s
    speeds = np.where(flying, G * fallen_s, 0.0)
    drops = np.where(flying, 0.5 * G * fallen_s**2, heights)
    positions = np.broadcast_to(np.array(places_m, float), (len(times), len(heights), 3)).copy()
    positions[..., 2] = heights + 0.5 - drops
    velocities = np.zeros_like(positions)
    velocities[..., 2] = -speeds
    return moving_boxes(times, np.ones((len(heights), 3)), positions, velocities_m_s=velocities)


def test_a_body_lands_with_the_energy_of_its_fall():
    """m g h; at 240 frames a second the speed is known to one frame of gravity, 0.4 % of 10 m/s, on the safe side."""
    landed = landings(falling([5.0], [0.0], [[3.0, 4.0, 0.0]]))
    assert landed.masses_kg.tolist() == [1000.0]
    assert landed.energies_j[0] == pytest.approx(1000.0 * G * 5.0, rel=0.01)
    assert landed.energies_j[0] >= 1000.0 * G * 5.0
    assert landed.times_s[0] == pytest.approx(np.sqrt(10.0 / G), abs=1 / 240)


def test_what_lands_together_counts_as_one_and_what_lands_later_does_not():
    at_once = shaking_at(np.zeros(3), landings(falling([5.0, 5.0], [0.0, 0.1], [[20.0, 0, 0], [20.0, 0, 0]])))
    apart = shaking_at(np.zeros(3), landings(falling([5.0, 5.0], [0.0, 0.5], [[20.0, 0, 0], [20.0, 0, 0]])))
    assert at_once.mass_kg == pytest.approx(2.0 * apart.mass_kg)
    # v goes with the energy to the power of 1.66 / 3.
    assert at_once.velocity_m_s / apart.velocity_m_s == pytest.approx(2.0 ** (1.66 / 3.0), rel=1e-9)
    assert at_once.distance_m == pytest.approx(20.0)


def test_a_law_of_the_site_takes_the_place_of_the_formula():
    """1 t over 5 m is 49 kJ, 20 m from it a scaled distance of 2.86; by the law 10 mm/s · 2.86^-1.5 = 2.07 mm/s."""
    law = SiteLaw(0.010, 1.5, 0.2, 6, nearest=1.0, farthest=5.0, middle=20.0 / 49.03**0.5, spread=0.7)
    landed = landings(falling([5.0], [0.0], [[20.0, 0, 0]]))
    shaking = shaking_at(np.zeros(3), landed, law)
    assert 1e3 * shaking.velocity_m_s == pytest.approx(2.07, rel=0.01)
    # t of four degrees of freedom is 2.776.
    width = 2.776 * 0.2 * np.sqrt(1.0 + 1.0 / 6.0)
    assert shaking.at_most_m_s / shaking.velocity_m_s == pytest.approx(np.exp(width), rel=1e-3)
    assert not shaking.is_extrapolated
    assert shaking_at(np.array([-60.0, 0.0, 0.0]), landed, law).is_extrapolated
    without = shaking_at(np.zeros(3), landed)
    assert without.at_most_m_s == without.velocity_m_s and not without.is_extrapolated


def test_the_nearer_of_two_equal_landings_shakes_most():
    landed = landings(falling([5.0, 5.0], [0.0, 0.5], [[40.0, 0, 0], [10.0, 0, 0]]))
    assert shaking_at(np.zeros(3), landed).time_s > 0.5
    assert shaking_at(np.array([50.0, 0.0, 0.0]), landed).time_s < 1.1


def test_nearer_than_the_formula_holds_nothing_is_given():
    """1600 t that fall 3 m are 47.1 MJ: by the formula 95 mm/s 9 m from them, where a bridge was unharmed."""
    assert 1e3 * touchdown_velocity(9.0, 1600e3 * G * 3.0) == pytest.approx(95.0, rel=0.01)
    landed = landings(falling([5.0], [0.0], [[0.0, 0, 0]]))
    near, far = (shaking_at(np.array([x, 0.0, 0.0]), landed) for x in (19.9, 20.1))
    assert near.velocity_m_s is None and near.at_most_m_s is None
    assert near.energy_j == far.energy_j and far.velocity_m_s > 0.0
    law = SiteLaw(0.010, 1.5, 0.2, 6, nearest=1.0, farthest=5.0, middle=2.9, spread=0.7)
    assert shaking_at(np.array([9.0, 0.0, 0.0]), landed, law).velocity_m_s > 0.0


def test_what_still_falls_or_only_settles_does_not_land():
    assert len(landings(falling([50.0], [0.0], [[0.0, 0, 0]]))) == 0  # in the air for 3.2 s
    assert len(landings(falling([0.03], [0.0], [[0.0, 0, 0]]))) == 0
    assert shaking_at(np.zeros(3), landings(falling([0.03], [0.0], [[0.0, 0, 0]]))) is None
