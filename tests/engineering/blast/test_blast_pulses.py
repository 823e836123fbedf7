# SPDX-License-Identifier: GPL-3.0-or-later
"""Pulses of several charges on several bodies: who is loaded when, and by how much."""

from itertools import pairwise

import numpy as np
import pytest
from reference import blast as reference

from bridge_demolition_addon.engineering.blast.pulses import (
    REPORT_DECAY,
    BlastModel,
    Loading,
    Pulses,
    blast_pulses,
    blast_wave,
    impulse_between,
    pressure_at,
    whole_impulse,
)
from bridge_demolition_addon.engineering.blast.wave import Burst
from bridge_demolition_addon.errors import BlastError

STAND_OFFS = np.array([[3.0, 40.0, 12.0], [20.0, 9.0, 0.0]])
CHARGES, DELAYS, BURSTS = np.array([10.0, 50.0, 2.0]), np.array([0.0, 0.025, 0.5]), ("air", "surface", "air")


def pulses(**options):
    return blast_pulses(STAND_OFFS, CHARGES, DELAYS, BURSTS, **options)


@pytest.mark.parametrize("model", BlastModel)
@pytest.mark.parametrize("loading", Loading)
def test_every_pulse_is_that_of_its_charge_at_its_stand_off(model, loading):
    found = pulses(model=model, loading=loading)
    for body in range(2):
        for charge in range(3):
            wave = blast_wave(STAND_OFFS[body, charge], CHARGES[charge], BURSTS[charge], model)
            reflected = loading is Loading.REFLECTED
            peak = wave.reflected_overpressure_pa if reflected else wave.peak_overpressure_pa
            impulse = wave.reflected_impulse_pa_s if reflected else wave.incident_impulse_pa_s
            assert found.peaks_pa[body, charge] == peak
            assert found.arrivals_s[body, charge] == DELAYS[charge] + wave.arrival_time_s
            # The decay is solved to 1e-13.
            assert found.impulses_pa_s[body, charge] == pytest.approx(impulse, rel=1e-11)


def test_impulse_over_steps_of_any_length_adds_up_to_the_whole():
    found = pulses()
    for step in (1.0 / 24.0, 1.001 / 30.0, 1.0 / 2400.0):
        edges = np.arange(0.0, 1.0, step)
        total = sum(impulse_between(found, start, end) for start, end in pairwise(edges))
        np.testing.assert_allclose(total, found.impulses_pa_s, rtol=1e-11)  # sums of up to 2400 numbers


def test_impulse_is_the_integral_of_the_pressure():
    found = pulses()
    start, end = found.arrivals_s.min() + 0.001, found.arrivals_s.max() + 0.0005
    edges = np.unique(np.concatenate((found.arrivals_s.ravel(), found.ends_s.ravel(), [start, end])))
    edges = edges[(edges >= start) & (edges <= end)]
    nodes, weights = np.polynomial.legendre.leggauss(40)
    total = np.zeros(STAND_OFFS.shape)
    # Between two beginnings or ends all pulses are smooth, so that 40 nodes give every digit but the last few.
    for low, high in pairwise(edges):
        half = (high - low) / 2.0
        total += sum(half * w * pressure_at(found, low + half * (x + 1.0)) for x, w in zip(nodes, weights, strict=True))
    np.testing.assert_allclose(impulse_between(found, start, end), total, rtol=1e-10)


def test_delays_shift_pulses_and_change_nothing_else():
    at_once, later = pulses(), blast_pulses(STAND_OFFS, CHARGES, DELAYS + 2.0, BURSTS)
    # 2 s more cost one digit of the times within a pulse of milliseconds: 2 s · 2e-16 / 1 ms.
    np.testing.assert_allclose(impulse_between(later, 2.01, 2.06), impulse_between(at_once, 0.01, 0.06), rtol=1e-10)
    assert later.peaks_pa.tolist() == at_once.peaks_pa.tolist()


def test_nothing_before_the_arrival_and_after_the_phase():
    found = pulses()
    first, last = found.arrivals_s.min(), found.ends_s.max()
    for start, end in ((-10.0, 0.0), (0.0, first), (last, last + 1.0), (1e3, 2e3)):
        assert impulse_between(found, start, end).tolist() == np.zeros((2, 3)).tolist()
        assert not found.load_between(start, end).any()
    assert pressure_at(found, first - 1e-9).sum() == pressure_at(found, last).sum() == 0.0


def test_bodies_are_loaded_while_a_pulse_passes():
    found = pulses()
    for body in range(2):
        for charge in range(3):
            middle = found.arrivals_s[body, charge] + found.durations_s[body, charge] / 2.0
            assert found.load_between(middle, middle + 1e-9)[body, charge]
            assert impulse_between(found, middle, middle + 1e-9)[body, charge] > 0.0
    assert found.load_between(0.0, 1.0).tolist() == np.ones((2, 3), bool).tolist()


def test_the_times_may_be_an_array():
    found = pulses()
    at_arrivals = pressure_at(found, found.arrivals_s)
    assert at_arrivals.tolist() == found.peaks_pa.tolist()


def test_a_charge_of_nothing_does_nothing():
    found = blast_pulses(STAND_OFFS, [0.0, 50.0, 0.0], DELAYS, BURSTS)
    assert found.peaks_pa[:, [0, 2]].tolist() == np.zeros((2, 2)).tolist()
    assert impulse_between(found, -1.0, 10.0)[:, [0, 2]].tolist() == np.zeros((2, 2)).tolist()
    for name in ("arrivals_s", "durations_s", "decays"):
        assert np.isfinite(getattr(found, name)).all()
    assert not blast_pulses(STAND_OFFS, np.zeros(3), DELAYS, BURSTS).load_between(-1.0, 10.0).any()


def test_no_charges_and_no_bodies():
    without = blast_pulses(np.zeros((4, 0)), [], [], [])
    assert impulse_between(without, 0.0, 1.0).shape == (4, 0)
    assert without.load_between(0.0, 1.0).shape == (4, 0)
    assert blast_pulses(np.zeros((0, 1)), [1.0], [0.0], ["air"]).peaks_pa.shape == (0, 1)


def test_the_decay_of_the_report_gives_0_368_of_peak_and_duration():
    found = blast_pulses([[5.0]], [1.0], [0.0], ["air"], model="kinney-graham", constant_decay=REPORT_DECAY)
    assert found.decays.tolist() == [[1.0]]
    # e^(-1), as printed in three digits; and the impulse that tests with TNT give is 1.5 times that.
    assert found.impulses_pa_s == pytest.approx(0.368 * found.peaks_pa * found.durations_s, rel=5e-4)
    assert found.impulses_pa_s == pytest.approx(0.65 * blast_wave(5.0, 1.0).incident_impulse_pa_s, rel=0.01)


def test_pulses_of_kinney_graham_keep_their_impulse_beyond_z_5():
    distances = np.array([[5.0], [20.0], [100.0]])
    found = blast_pulses(distances, [1.0], [0.0], ["air"], model="kinney-graham")
    wave = blast_wave(distances, 1.0, model="kinney-graham")
    assert (found.durations_s > wave.positive_phase_duration_s).all()
    assert (found.decays == 0.0).all()
    np.testing.assert_allclose(found.impulses_pa_s, wave.incident_impulse_pa_s, rtol=1e-12)


@pytest.mark.parametrize("model", BlastModel)
@pytest.mark.parametrize("burst", Burst)
@pytest.mark.parametrize("loading", Loading)
def test_every_pulse_keeps_its_impulse_at_any_stand_off(model, burst, loading):
    distances = np.geomspace(0.01, 1000.0, 500)[:, None]
    found = blast_pulses(distances, [1.0], [0.0], [burst], model=model, loading=loading)
    wave = blast_wave(distances, 1.0, burst, model)
    impulse = wave.reflected_impulse_pa_s if loading is Loading.REFLECTED else wave.incident_impulse_pa_s
    np.testing.assert_allclose(found.impulses_pa_s, impulse, rtol=1e-11)
    assert (found.decays >= 0.0).all()
    assert (found.durations_s >= wave.positive_phase_duration_s).all()


def test_impossible_input_is_refused():
    with pytest.raises(BlastError, match="charge is -1"):
        blast_pulses([[1.0]], [-1.0], [0.0], ["air"])
    with pytest.raises(BlastError, match="delay is nan"):
        blast_pulses([[1.0]], [1.0], [np.nan], ["air"])
    with pytest.raises(BlastError, match="decay is -1"):
        blast_pulses([[1.0]], [1.0], [0.0], ["air"], constant_decay=-1.0)
    with pytest.raises(BlastError, match="Burst is 'space'"):
        blast_pulses([[1.0]], [1.0], [0.0], ["space"])
    with pytest.raises(BlastError, match="do not fit"):
        blast_pulses([[1.0, 2.0]], [1.0], [0.0], ["air"])
    with pytest.raises(BlastError, match="do not fit"):
        blast_pulses([1.0], [1.0], [0.0], ["air"])
    with pytest.raises(BlastError, match="end of the step is 1: expected at least its start, 2"):
        impulse_between(pulses(), 2.0, 1.0)


def test_the_smallest_stand_off_is_what_a_body_around_the_charge_gets():
    around, touching = (blast_pulses([[r]], [27.0], [0.0], ["air"]) for r in (0.0, 3.0 * 0.0531))
    assert around.impulses_pa_s == pytest.approx(touching.impulses_pa_s, rel=1e-12)
    assert whole_impulse(around.peaks_pa, around.durations_s, around.decays).item() > 0.0


@pytest.mark.parametrize("seed", range(3))
def test_impulses_are_those_of_the_reference(seed):
    random = np.random.default_rng(seed)
    arrivals, peaks, durations = random.uniform(0.0, 0.02, 4000), random.uniform(1e2, 1e7, 4000), random.random(4000)
    durations *= random.choice([0.0, 1e-4, 1e-2, 1.0, np.nan], 4000)
    decays = random.uniform(0.0, 40.0, 4000) * random.choice([0.0, 1e-3, 1.0, 20.0, 1e3], 4000)
    all_of_them = Pulses(arrivals, peaks, durations, decays)
    for between in [(0.0, 0.03), (0.01, 0.01), (0.012, 0.0121), (0.05, 4.0)]:
        found = impulse_between(all_of_them, *between)
        np.testing.assert_array_equal(found, reference.impulse_between(all_of_them, *between))
        assert (between[0] == between[1]) is not bool((found > 0.0).any())


def test_pulses_that_do_not_fit_are_not_read():
    short = Pulses(np.zeros(4), np.ones(4), np.ones(3), np.ones(4))
    with pytest.raises(ValueError, match="durations has 3 numbers: expected 4"):
        impulse_between(short, 0.0, 1.0)
    with pytest.raises(ValueError, match="decays has numbers of type int64: expected float64"):
        impulse_between(Pulses(np.zeros(4), np.ones(4), np.ones(4), np.ones(4, int)), 0.0, 1.0)
