# SPDX-License-Identifier: GPL-3.0-or-later
"""Blast the other way round: every answer is put back into the wave it came from."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.blast.charge_sizing import (
    smallest_charge_for_impulse,
    smallest_charge_for_overpressure,
    stand_off_for_overpressure,
)
from bridge_demolition_addon.engineering.blast.pulses import BlastModel, blast_wave
from bridge_demolition_addon.engineering.blast.wave import Burst
from bridge_demolition_addon.errors import BlastError
from bridge_demolition_addon.model.blast.charges import Charge
from bridge_demolition_addon.model.blast.receptors import THRESHOLDS, Threshold, ring_radii

MODELS = [(model, burst) for model in BlastModel for burst in Burst]


@pytest.mark.parametrize(
    "kpa, z", [(2.07, "40.97"), (6.895, "13.45"), (20.7, "6.10"), (34.5, "4.575"), (68.9, "3.255")]
)
def test_stand_offs_of_kinney_graham(kpa, z):
    found = stand_off_for_overpressure(1e3 * kpa, 1.0, model="kinney-graham")
    # As printed; the second is 13.4487 and was rounded up.
    assert found == pytest.approx(float(z), abs=0.6 * 10.0 ** -len(z.partition(".")[2]) * 2.5)


@pytest.mark.parametrize("model, burst", MODELS)
@pytest.mark.parametrize("kpa", [0.5, 1.03, 4.9, 34.5, 300.0, 1e4])
def test_the_overpressure_is_reached_at_its_stand_off_and_not_beyond(model, burst, kpa):
    stand_off = stand_off_for_overpressure(1e3 * kpa, 200.0, burst, model)
    wave = blast_wave(np.array([1.0, 1.0 + 1e-9, 2.0, 50.0]) * stand_off, 200.0, burst, model)
    assert wave.peak_overpressure_pa[0] >= 1e3 * kpa * (1 - 1e-12)
    assert (wave.peak_overpressure_pa[1:] < 1e3 * kpa).all()


@pytest.mark.parametrize("model, burst", MODELS)
@pytest.mark.parametrize("kpa", [0.5, 4.9, 34.5, 1e4])
@pytest.mark.parametrize("stand_off", [0.5, 30.0])
def test_the_smallest_charge_gives_the_overpressure_and_less_does_not(model, burst, kpa, stand_off):
    charge = smallest_charge_for_overpressure(1e3 * kpa, stand_off, burst, model)
    less = np.array([1.0 - 1e-8, 0.9, 0.5, 0.01])
    assert blast_wave(stand_off, charge * (1 + 1e-12), burst, model).peak_overpressure_pa >= 1e3 * kpa * (1 - 1e-11)
    assert (blast_wave(stand_off, charge * less, burst, model).peak_overpressure_pa < 1e3 * kpa).all()


@pytest.mark.parametrize("model, burst", MODELS)
@pytest.mark.parametrize("impulse", [1.0, 50.0, 400.0, 1200.0, 1400.0, 2e4])
def test_the_smallest_charge_gives_the_impulse_and_less_does_not(model, burst, impulse):
    charge = smallest_charge_for_impulse(impulse, 6.0, burst, model)
    less = np.concatenate(([1.0 - 1e-8], np.linspace(0.999, 0.01, 500)))
    assert blast_wave(6.0, charge * (1 + 1e-12), burst, model).incident_impulse_pa_s >= impulse * (1 - 1e-11)
    # A grid of 4001 distances may step over a bump as small as the steps of the tables, 2.4 % here.
    impulses = blast_wave(6.0, charge * less, burst, model).incident_impulse_pa_s
    assert (impulses < impulse * 1.0001).all()


def test_what_no_charge_gives_is_refused():
    with pytest.raises(BlastError, match=r"overpressure is 1e\+06 kPa: expected up to 4.895e\+04, "):
        stand_off_for_overpressure(1e9, 1.0)
    with pytest.raises(BlastError, match=r"overpressure is 1e\+06 kPa: expected up to"):
        smallest_charge_for_overpressure(1e9, 1.0)
    with pytest.raises(BlastError, match=r"impulse is 1e\+09: expected up to 4.902e\+05 \(Pa·s\) at 10 m"):
        smallest_charge_for_impulse(1e9, 10.0)
    with pytest.raises(BlastError, match="that beyond any distance"):
        stand_off_for_overpressure(1e-6, 1.0)


@pytest.mark.parametrize("wrong", [0.0, -1.0, np.nan, np.inf])
def test_impossible_numbers_are_refused(wrong):
    for function, name in (
        (stand_off_for_overpressure, "overpressure"),
        (smallest_charge_for_overpressure, "overpressure"),
        (smallest_charge_for_impulse, "impulse"),
    ):
        with pytest.raises(BlastError, match=f"{name} is .*: expected a finite number above 0"):
            function(wrong, 1.0)
    for function in (smallest_charge_for_overpressure, smallest_charge_for_impulse):
        with pytest.raises(BlastError, match=r"stand-off is .*: expected a finite number above 0"):
            function(1000.0, wrong)
    if wrong != 0.0:
        with pytest.raises(BlastError, match="charge is"):
            stand_off_for_overpressure(1000.0, wrong)


def test_no_charge_reaches_nowhere():
    assert stand_off_for_overpressure(1000.0, 0.0) == 0.0


def test_thresholds_are_those_published():
    kpa = [threshold.overpressure_pa / 1e3 for threshold in THRESHOLDS]
    assert kpa == [1.03, 2.07, 3.4, 6.9, 15.8, 34.5, 34.5, 68.9, 103.0]
    assert all(threshold.damage and threshold.source for threshold in THRESHOLDS)


def test_rings_on_plan_of_several_charges():
    charges = [
        Charge(name="ground", position_m=(0.0, 0.0, 0.0), mass_kg=8.0),
        Charge(name="deck", position_m=(20.0, 0.0, 30.0), mass_kg=8.0),
        Charge(name="C-4", position_m=(20.0, 5.0, 0.0), mass_kg=8.0, explosive="C-4", burst=Burst.SURFACE),
        Charge(name="none", position_m=(40.0, 0.0, 0.0), mass_kg=0.0),
    ]
    wanted = (Threshold("glass", 1.03e3, ""), Threshold("houses", 34.5e3, ""))
    radii = ring_radii(charges, 0.0, wanted)
    glass, houses = (stand_off_for_overpressure(threshold.overpressure_pa, 8.0) for threshold in wanted)
    assert radii[:, 0].tolist() == [glass, houses]
    # 30 m up: less of the far ring on the ground, nothing of the one of 9.4 m.
    assert radii[0, 1] == pytest.approx(np.sqrt(glass**2 - 900.0))
    assert radii[1, 1] == 0.0
    assert radii[1, 2] == pytest.approx(stand_off_for_overpressure(34.5e3, 8.0 * 1.37, "surface"))
    assert radii[:, 3].tolist() == [0.0, 0.0]
    assert ring_radii(charges, 30.0, wanted)[:, 1].tolist() == [glass, houses]
    assert ring_radii([], 0.0).shape == (9, 0)
    twice = ring_radii(charges, 0.0, wanted, pressure_factor=2.0)
    assert twice[0, 0] == stand_off_for_overpressure(0.5 * 1.03e3, 8.0)
