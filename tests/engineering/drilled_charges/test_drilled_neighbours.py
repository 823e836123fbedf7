# SPDX-License-Identifier: GPL-3.0-or-later
"""Air pressure and vibration of confined charges, against AS 2187.2 and sums by hand."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.blast.vibration import peak_particle_velocity
from bridge_demolition_addon.engineering.drilled_charges.neighbours import (
    BARE_KPA,
    air_pressure_pa,
    decibels,
    largest_mass_together_kg,
)


@pytest.mark.parametrize(
    ("site_kpa", "pressure_kpa", "level_db"),
    [(20.0, 0.0548, 128.8), (BARE_KPA, 1.414, 157.0)],  # 5 kg at 100 m: R / Q^(1/3) = 58.48, to the power of -1.45
)
def test_air_pressure_of_5_kg_at_100_m(site_kpa, pressure_kpa, level_db):
    pressure = air_pressure_pa(100.0, 5.0, site_kpa)
    assert pressure / 1e3 == pytest.approx(pressure_kpa, rel=1e-3)  # the digits given
    assert decibels(pressure) == pytest.approx(level_db, abs=0.05)


def test_levels_of_known_pressures():
    # 94 dB are 1 Pa, as calibrators of sound-level meters have it; 20 µPa are 0 dB.
    assert decibels(1.0) == pytest.approx(93.979, abs=1e-3)
    assert decibels(20e-6) == pytest.approx(0.0, abs=1e-9)


def test_stemmed_holes_make_a_twenty_fifth_of_a_bare_charge():
    assert air_pressure_pa(50.0, 3.0, BARE_KPA) / air_pressure_pa(50.0, 3.0) == pytest.approx(25.8)


def test_vibration_of_5_kg_at_30_m():
    # AS 2187.2 with 1140: a sum by hand, three digits.
    assert 1e3 * peak_particle_velocity(30.0, 5.0) == pytest.approx(17.9, abs=0.05)


def test_mass_within_8_ms_by_hand():
    times = [0.0, 0.005, 0.008, 0.100, 0.107, 0.114]
    # 0 and 5 ms: 3 kg; 5 and 8: 6; 100 and 107: 9; 107 and 114: 11.
    assert largest_mass_together_kg(times, [1.0, 2.0, 4.0, 4.0, 5.0, 6.0]) == pytest.approx(11.0)
    assert largest_mass_together_kg([0.0, 0.008], [1.0, 1.0]) == pytest.approx(1.0)
    assert largest_mass_together_kg([], []) == 0.0


def test_scatter_brings_delays_together():
    # 25 ms apart: 9 ms of scatter each leave 7 ms between the latest of one and the earliest of the other.
    assert largest_mass_together_kg([0.0, 0.025], [1.0, 1.0], [0.0085, 0.0085]) == pytest.approx(1.0)
    assert largest_mass_together_kg([0.0, 0.025], [1.0, 1.0], [0.009, 0.009]) == pytest.approx(2.0)


def test_mass_within_8_ms_is_that_of_the_fullest_window_tried():
    """Windows of 8 ms moved in steps of 0.1 ms, as one would do it with a ruler."""
    generator = np.random.default_rng(3)
    times, masses = generator.integers(0, 60, 25) / 1e3 + 5e-5, generator.random(25)
    starts = np.arange(-100, 700) / 1e4
    tried = [masses[(times >= start) & (times < start + 0.008)].sum() for start in starts]
    assert largest_mass_together_kg(times, masses) == pytest.approx(max(tried))
