# SPDX-License-Identifier: GPL-3.0-or-later
"""What charges do to places near them, against the waves of single charges."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.blast.pulses import blast_wave
from bridge_demolition_addon.model.blast.charges import Charge
from bridge_demolition_addon.model.blast.receptors import charges_per_delay, loads_at, peak_overpressures


def charge(x, mass_kg, delay_s=0.0, explosive="TNT"):
    return Charge(
        name=f"at {x} m", position_m=(x, 0.0, 0.0), mass_kg=mass_kg, delay_ms=1e3 * delay_s, explosive=explosive
    )


def test_one_charge_gives_its_own_wave():
    """Z = 5 for 8 kg at 10 m, free air, Kingery and Bulmash: 31.30 kPa, 40.62 kPa·ms/kg^(1/3), 8.995 ms/kg^(1/3)."""
    load = loads_at((10.0, 0.0, 0.0), [charge(0.0, 8.0, 0.1)])
    assert load.distance_m == 10.0
    assert load.peak_pa == pytest.approx(31.30e3, rel=1e-3)
    assert load.impulse_pa_s == pytest.approx(2 * 40.62, rel=1e-3)
    assert load.arrival_s == pytest.approx(0.1 + 2 * 8.995e-3, rel=1e-3)


def test_waves_that_arrive_together_add_up_and_apart_they_do_not():
    position = (0.0, 0.0, 0.0)
    alone = loads_at(position, [charge(10.0, 8.0)])
    together = loads_at(position, [charge(10.0, 8.0), charge(-10.0, 8.0)])
    apart = loads_at(position, [charge(10.0, 8.0), charge(-10.0, 8.0, 1.0)])
    assert together.peak_pa == pytest.approx(2.0 * alone.peak_pa)
    assert apart.peak_pa == pytest.approx(alone.peak_pa)
    assert together.impulse_pa_s == apart.impulse_pa_s == pytest.approx(2.0 * alone.impulse_pa_s)


def test_charges_that_touch_and_go_off_together_are_one_at_a_neighbour():
    position, whole, halves = (10.0, 0.0, 0.0), [charge(0.0, 8.0)], [charge(0.0, 3.0), charge(0.0, 5.0)]
    one, other = loads_at(position, whole), loads_at(position, halves)
    assert (other.peak_pa, other.impulse_pa_s) == pytest.approx((one.peak_pa, one.impulse_pa_s))
    points = np.array([position])
    assert peak_overpressures(points, halves) == pytest.approx(peak_overpressures(points, whole))


def test_the_pressure_over_time_has_the_impulse_of_the_pulse():
    load = loads_at((10.0, 0.0, 0.0), [charge(0.0, 8.0)])
    # Straight lines between 24 times of a decaying pulse.
    means = (load.pressures_pa[1:] + load.pressures_pa[:-1]) / 2.0
    assert np.sum(means * np.diff(load.times_s)) == pytest.approx(load.impulse_pa_s, rel=0.01)


def test_explosives_count_by_pressure_for_pressure_and_by_impulse_for_impulse():
    position = (10.0, 0.0, 0.0)
    load = loads_at(position, [charge(0.0, 8.0, explosive="C-4")])
    assert load.peak_pa == pytest.approx(float(blast_wave(10.0, 8.0 * 1.37).peak_overpressure_pa))
    assert load.impulse_pa_s == pytest.approx(float(blast_wave(10.0, 8.0 * 1.19).incident_impulse_pa_s), rel=1e-6)


def test_charges_within_eight_milliseconds_shake_as_one():
    charges = [
        charge(0.0, 1.0, 0.025),
        charge(1.0, 2.0),
        charge(2.0, 4.0, 0.0079),
        charge(3.0, 8.0, 0.008),
        charge(4.0, 0.0),
    ]
    groups = [[charge.mass_kg for charge in group] for group in charges_per_delay(charges)]
    assert groups == [[2.0, 4.0], [8.0], [1.0]]


def test_vibration_is_of_the_worst_delay():
    """v = 1140 mm/s (R/√Q)^-1.6: 20 m from 4 kg is a scaled distance of 10, so 1140 / 39.81 = 28.64 mm/s."""
    together = loads_at((20.0, 0.0, 0.0), [charge(0.0, 2.0), charge(0.0, 2.0)])
    assert 1e3 * together.peak_velocity_m_s == pytest.approx(28.64, rel=1e-3)
    apart = loads_at((20.0, 0.0, 0.0), [charge(0.0, 4.0), charge(0.0, 2.0, 0.5)])
    assert apart.peak_velocity_m_s == pytest.approx(together.peak_velocity_m_s)


def test_peaks_on_the_ground_are_those_of_the_charge_that_gives_most():
    points = np.array([[10.0, 0.0, 0.0], [90.0, 0.0, 0.0]])
    peaks = peak_overpressures(points, [charge(0.0, 8.0), charge(100.0, 8.0)])
    assert peaks == pytest.approx([31.30e3, 31.30e3], rel=1e-3)


def test_a_factor_on_pressures_leaves_times_and_the_ground_alone():
    charges, position = [charge(10.0, 8.0), charge(-10.0, 8.0, 0.05)], (30.0, 5.0, 0.0)
    one, twice = loads_at(position, charges), loads_at(position, charges, pressure_factor=2.0)
    assert (twice.peak_pa, twice.impulse_pa_s) == (2.0 * one.peak_pa, 2.0 * one.impulse_pa_s)
    assert (twice.arrival_s, twice.peak_velocity_m_s) == (one.arrival_s, one.peak_velocity_m_s)
    points = np.array([position, (50.0, 0.0, 0.0)])
    np.testing.assert_array_equal(
        peak_overpressures(points, charges, pressure_factor=2.0), 2.0 * peak_overpressures(points, charges)
    )
