# SPDX-License-Identifier: GPL-3.0-or-later
"""The Friedlander pulse against numerical integration and against its own limits."""

from itertools import pairwise

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss

from bridge_demolition_addon.engineering.blast.pulses import (
    LARGEST_SHARE,
    Pulses,
    decay_of,
    fitted,
    impulse_between,
    pulse_pressure,
    whole_impulse,
)

DECAYS = (0.0, 1e-12, 1e-6, 1e-3, 0.1, 0.49999, 0.5, 0.50001, 1.0, 8.48, 60.0)
INTERVALS = ((-1.0, 9.0), (-1.0, 0.3), (0.2, 0.9), (1.7, 9.0), (0.0, 2.0), (0.5, 0.5), (-2.0, -1.0), (2.0, 3.0))
PEAK, DURATION = 3.0e5, 2.0


def pulse_impulse(peak, duration, decay, start, end):
    return impulse_between(Pulses(*(np.array([value]) for value in (0.0, peak, duration, decay))), start, end).item()


def integrated(decay, start, end):
    """Gauss-Legendre in 64 parts of the positive phase, exact to rounding for these smooth pulses."""
    start, end = np.clip([start, end], 0.0, DURATION)
    edges = np.linspace(start, end, 65)
    nodes, weights = leggauss(12)
    half = np.diff(edges)[:, None] / 2.0
    times = edges[:-1, None] + half * (nodes + 1.0)
    return (half * weights * PEAK * (1 - times / DURATION) * np.exp(-decay * times / DURATION)).sum()


@pytest.mark.parametrize("decay", DECAYS)
@pytest.mark.parametrize("start, end", INTERVALS)
def test_closed_form_against_numerical_integration(decay, start, end):
    # Both are exact but for rounding; the smallest part of a pulse here is 1e-4 of the whole, hence 1e-12.
    exact = pulse_impulse(PEAK, DURATION, decay, start, end)
    assert exact == pytest.approx(integrated(decay, start, end), rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("decay", DECAYS)
def test_a_short_step_loses_no_digits(decay):
    # In a millionth of the phase the pressure changes by a millionth of (1 + b).
    middle = pulse_impulse(PEAK, DURATION, decay, 0.6, 0.6 + 2e-6) / 2e-6
    assert middle == pytest.approx(pulse_pressure(PEAK, DURATION, decay, 0.6 + 1e-6), rel=1e-9)


@pytest.mark.parametrize("decay", DECAYS)
def test_the_whole_impulse_has_its_closed_form(decay):
    whole = whole_impulse(PEAK, DURATION, decay)
    assert pulse_impulse(PEAK, DURATION, decay, -1.0, 9.0) == pytest.approx(whole, rel=1e-14)
    if decay >= 0.1:  # for less the plain formula loses digits
        assert whole == pytest.approx(PEAK * DURATION * (decay - 1 + np.exp(-decay)) / decay**2, rel=1e-13)


def test_no_decay_is_a_triangle():
    assert whole_impulse(PEAK, DURATION, 0.0) == PEAK * DURATION / 2.0
    assert pulse_impulse(PEAK, DURATION, 0.0, 1.0, 2.0) == PEAK * DURATION / 8.0


def test_any_cut_into_steps_adds_up():
    edges = np.concatenate(([-3.0], np.sort(np.random.default_rng(4).uniform(-1.0, 3.0, 500)), [5.0]))
    for decay in DECAYS:
        parts = np.array([pulse_impulse(PEAK, DURATION, decay, *step) for step in pairwise(edges.tolist())])
        # Rounding in a sum of 500 positive numbers.
        assert parts.sum() == pytest.approx(whole_impulse(PEAK, DURATION, decay), rel=1e-12)
        assert (parts >= 0.0).all()


def test_pressure_begins_with_the_peak_and_ends_with_the_phase():
    times = np.array([-1e-9, 0.0, DURATION / 2, DURATION * (1 - 1e-9), DURATION, 10.0])
    pressures = pulse_pressure(PEAK, DURATION, 1.0, times)
    assert pressures[[0, 4, 5]].tolist() == [0.0, 0.0, 0.0]
    assert pressures[1] == PEAK
    assert pressures[2] == pytest.approx(PEAK * 0.5 * np.exp(-0.5))
    assert 0.0 < pressures[3] < 1e-8 * PEAK


def test_decay_is_found_for_any_share():
    shares = np.geomspace(1e-9, LARGEST_SHARE, 10_001)
    decays = decay_of(shares)
    # Newton's last step is below 1e-13 of the decay; the share is about its inverse.
    np.testing.assert_allclose(whole_impulse(1.0, 1.0, decays), shares, rtol=1e-12)
    assert (np.diff(decays) < 0.0).all()
    assert decays[-1] == 0.0


def test_decays_of_kingery_and_bulmash():
    # Peak, duration and impulse in free air at Z = 1, 5 and 20, in kPa and ms as printed.
    decays = decay_of(np.array([174.5, 40.62, 10.75]) / np.array([934.9 * 1.795, 31.30 * 3.333, 4.451 * 5.142]))
    assert decays == pytest.approx([8.48, 0.80, 0.19], abs=0.01)


def test_a_fitted_pulse_has_its_impulse():
    random = np.random.default_rng(5)
    peak, duration = random.uniform(1e3, 1e7, 1000), random.uniform(1e-4, 0.1, 1000)
    impulse = peak * duration * random.uniform(0.01, 0.49, 1000)
    kept, decay = fitted(peak, duration, impulse)
    assert kept.tolist() == duration.tolist()
    np.testing.assert_allclose(whole_impulse(peak, kept, decay), impulse, rtol=1e-12)


def test_too_large_an_impulse_makes_a_longer_triangle():
    random = np.random.default_rng(6)
    peak, duration = random.uniform(1e3, 1e7, 1000), random.uniform(1e-4, 0.1, 1000)
    share = random.uniform(0.5 + 1e-9, 2.0, 1000)
    longer, decay = fitted(peak, duration, share * peak * duration)
    assert (decay == 0.0).all()
    np.testing.assert_allclose(longer, 2.0 * share * duration, rtol=1e-14)
    np.testing.assert_allclose(whole_impulse(peak, longer, decay), share * peak * duration, rtol=1e-14)


def test_no_pulse_stays_none():
    nothing = np.zeros(3)
    duration, decay = fitted(nothing, nothing, nothing)
    assert duration.tolist() == decay.tolist() == [0.0, 0.0, 0.0]
    for start, end in INTERVALS:
        assert pulse_impulse(0.0, 0.0, 0.0, start, end) == 0.0
        assert pulse_pressure(0.0, 0.0, 0.0, start) == 0.0
