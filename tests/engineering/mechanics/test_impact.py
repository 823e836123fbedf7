# SPDX-License-Identifier: GPL-3.0-or-later
"""Hits against known impulses, and Hertz's contact against published results and its own equation of motion."""

import math

import numpy as np
import pytest

from bridge_demolition_addon.engineering.mechanics.impact import (
    CONCRETE,
    STEEL,
    Contact,
    Elasticity,
    estimate,
    half_sine_peak_force,
    hertz_compression,
    hertz_contact_time,
    hertz_peak_force,
    hits,
)

GRAVITY = 9.80665
STEEL_DENSITY = 7850.0


def ball_mass(radius_m):
    return STEEL_DENSITY * 4.0 / 3.0 * math.pi * radius_m**3


def ball_on(ground, radius_m):
    return Contact.between(STEEL, ground, ball_mass(radius_m), radius_m)


def upward(*impulses):
    return np.column_stack((np.zeros(len(impulses)), np.zeros(len(impulses)), impulses))


def test_hits_are_runs_of_steps_with_an_impulse():
    found = hits(upward(0, 3, 4, 0, 0, 5, 0), np.full(7, 0.01), start_s=1.0)
    assert [(hit.first_step, hit.last_step) for hit in found] == [(1, 2), (5, 5)]
    assert [hit.impulse_ns.tolist() for hit in found] == [[0, 0, 7], [0, 0, 5]]
    assert [hit.raw_peak_force_n for hit in found] == pytest.approx([400, 500])
    # Rounding in sums of hundredths.
    assert [time for hit in found for time in (hit.start_s, hit.end_s)] == pytest.approx([1.01, 1.03, 1.05, 1.06])


def test_impulses_add_up_as_vectors():
    (hit,) = hits(np.array([[3.0, 0, 0], [0, 4.0, 0]]), np.full(2, 0.5))
    assert hit.impulse_ns.tolist() == [3, 4, 0]
    assert hit.impulse_magnitude_ns == 5
    assert (hit.start_s, hit.end_s, hit.raw_peak_force_n, hit.raw_step_s) == (0, 1, 8, 0.5)


def test_steps_may_differ():
    (hit,) = hits(upward(6, 5), np.array([0.2, 0.1]))
    assert (hit.raw_peak_force_n, hit.raw_step_s) == (50, 0.1)
    assert hit.end_s == pytest.approx(0.3)


def test_resting_on_the_ground_is_no_hit():
    weight, step = 1000.0 * GRAVITY, 1 / 240
    resting = weight * step
    impulses = upward(0, 9000 + resting, resting, resting)
    (hit,) = hits(impulses, np.full(4, step), resting_force_n=2 * weight)
    assert (hit.first_step, hit.last_step) == (1, 1)
    # Without a threshold the body is hit until the end.
    assert hits(impulses, np.full(4, step))[0].last_step == 3


@pytest.mark.parametrize("impulses", [np.zeros((0, 3)), np.zeros((4, 3))])
def test_no_impulse_no_hit(impulses):
    assert hits(impulses, np.full(len(impulses), 0.01)) == []


def test_steps_without_time_and_unknown_impulses_are_no_hits():
    assert hits(upward(5, np.nan), np.array([0.0, 0.01])) == []


def test_a_hit_that_lasts_to_the_end_and_one_from_the_start():
    found = hits(upward(1, 0, 1), np.ones(3))
    assert [(hit.first_step, hit.last_step) for hit in found] == [(0, 0), (2, 2)]


def test_reduced_mass_radius_and_modulus():
    same = Contact.between(STEEL, STEEL, 2.0, 0.1, 2.0, 0.1)
    assert (same.mass_kg, same.radius_m) == pytest.approx((1.0, 0.05))
    assert same.modulus_pa == pytest.approx(210e9 / (2 * 0.91))
    ground = Contact.between(STEEL, CONCRETE, 2.0, 0.1)
    assert (ground.mass_kg, ground.radius_m) == (2.0, 0.1)
    assert ground.modulus_pa == pytest.approx(1 / (0.91 / 210e9 + 0.96 / 30e9))


@pytest.mark.parametrize("ball_diameter_m, drop_m", [(0.005, 0.2), (0.0125, 1.0), (0.05, 0.1)])
def test_contact_time_of_the_impact_echo_method(ball_diameter_m, drop_m):
    """Its formula for steel balls that drop on concrete, 5.97 [density (δ₁ + δ₂)]^0.4 R / h^0.1, δ = (1 - ν²)/(π E).

    M. Sansalone, N. Carino (1986), Impact-echo: a method for flaw detection in concrete using transient stress waves,
    NBSIR 86-3452, after Goldsmith (1960); its three digits are good for 0.1 %. For usual concrete it becomes
    0.0043 D / h^0.1 (M. Sansalone, W. Streett, 1997, Impact-Echo), two digits and a stiffer concrete than the one here:
    6 % less.
    """
    radius = ball_diameter_m / 2
    time = hertz_contact_time(ball_on(CONCRETE, radius), math.sqrt(2 * GRAVITY * drop_m))
    softness = (1 - 0.3**2) / (math.pi * 210e9) + (1 - 0.2**2) / (math.pi * 30e9)
    assert time == pytest.approx(5.97 * (STEEL_DENSITY * softness) ** 0.4 * radius / drop_m**0.1, rel=1e-3)
    assert time == pytest.approx(0.0043 * ball_diameter_m / drop_m**0.1, rel=0.07)


@pytest.mark.parametrize("ground", [STEEL, CONCRETE])
def test_contact_follows_its_equation_of_motion(ground):
    """Compression, time, force and impulse, integrated in small steps: m δ'' = -4/3 E* √R δ^(3/2)."""
    contact, speed = ball_on(ground, 0.6), 5.0
    stiffness = 4 / 3 * contact.modulus_pa * math.sqrt(contact.radius_m)
    step = hertz_contact_time(contact, speed) / 20_000
    compression, velocity, time, impulse, peak, deepest = 0.0, speed, 0.0, 0.0, 0.0, 0.0
    while True:
        compression += velocity * step / 2
        if compression < 0:
            break
        force = stiffness * compression**1.5
        velocity -= force / contact.mass_kg * step
        compression += velocity * step / 2
        time, impulse = time + step, impulse + force * step
        peak, deepest = max(peak, force), max(deepest, compression)
        if compression < 0:
            break
    # 20 000 steps of a method of second order; contact ends within a step or two of the right moment.
    assert deepest == pytest.approx(hertz_compression(contact, speed), rel=1e-6)
    assert time == pytest.approx(hertz_contact_time(contact, speed), rel=2e-4)
    assert peak == pytest.approx(hertz_peak_force(contact, speed), rel=1e-6)
    assert impulse == pytest.approx(2 * contact.mass_kg * speed, rel=1e-6)


def test_a_faster_ball_touches_for_a_shorter_time():
    contact = ball_on(CONCRETE, 0.6)
    ratio = hertz_contact_time(contact, 32.0) / hertz_contact_time(contact, 1.0)
    assert ratio == pytest.approx(32 ** (-1 / 5))  # a half
    # Force grows with v^(6/5): 2^6 for 32 = 2^5.
    assert hertz_peak_force(contact, 32.0) / hertz_peak_force(contact, 1.0) == pytest.approx(64)


def test_a_ball_twice_as_large_touches_twice_as_long():
    small, large = (hertz_contact_time(ball_on(STEEL, radius), 3.0) for radius in (0.2, 0.4))
    assert large / small == pytest.approx(2)


def test_half_sine_has_its_impulse():
    impulse, time = 70.0, 0.003
    peak = half_sine_peak_force(impulse, time)
    moments = (np.arange(10_000) + 0.5) * time / 10_000
    # The midpoint rule over 10 000 intervals is exact to 1e-8.
    assert (peak * np.sin(np.pi * moments / time)).mean() * time == pytest.approx(impulse, rel=1e-7)


def test_half_sine_against_the_pulse_of_hertz():
    contact, speed = ball_on(CONCRETE, 0.6), 9.9
    half_sine = half_sine_peak_force(2 * contact.mass_kg * speed, hertz_contact_time(contact, speed))
    # π/2.943 against 5/4, each times m v²/δ.
    assert half_sine / hertz_peak_force(contact, speed) == pytest.approx(math.pi / 2.9432752 / 1.25, rel=1e-7)


def test_estimate_of_a_wrecking_ball():
    """10 t at 9.9 m/s that does not bounce: half of the elastic impulse, so half of the half-sine's elastic peak."""
    mass, speed, radius = 10_000.0, 9.9, 0.67
    contact = Contact.between(STEEL, CONCRETE, mass, radius)
    stopped = estimate(mass * speed, speed, contact)
    bounced = estimate(2 * mass * speed, speed, contact)
    assert stopped.contact_time_s == bounced.contact_time_s == hertz_contact_time(contact, speed)
    assert stopped.half_sine_peak_force_n == pytest.approx(bounced.half_sine_peak_force_n / 2)
    assert stopped.hertz_peak_force_n > bounced.half_sine_peak_force_n
    # 2.87 (m² / (R E*² v))^(1/5), by hand: 10⁸ / (0.67 × (27.52 GPa)² × 9.9) = 1.990e-14, and its fifth root 0.001819.
    assert stopped.contact_time_s == pytest.approx(2.868 * 0.001819, rel=1e-3)


def test_a_measured_contact_time_replaces_that_of_hertz():
    contact = ball_on(CONCRETE, 0.6)
    given = estimate(1000.0, 5.0, contact, contact_time_s=0.02)
    assert given.contact_time_s == 0.02
    assert given.half_sine_peak_force_n == pytest.approx(math.pi * 1000.0 / 0.04)
    assert given.hertz_peak_force_n == hertz_peak_force(contact, 5.0)


def test_two_equal_balls_are_one_against_a_wall_in_their_middle():
    """By symmetry two like balls meet at a rigid wall in the middle, each at half of the speed."""
    rubber, rigid = Elasticity(5e6, 0.5), Elasticity(math.inf, 0.0)
    pair = Contact.between(rubber, rubber, 1.0, 0.1, 1.0, 0.1)
    wall = Contact.between(rubber, rigid, 1.0, 0.1)
    assert hertz_contact_time(pair, 4.0) == pytest.approx(hertz_contact_time(wall, 2.0))
    assert hertz_peak_force(pair, 4.0) == pytest.approx(hertz_peak_force(wall, 2.0))
