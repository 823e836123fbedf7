# SPDX-License-Identifier: GPL-3.0-or-later
"""Response spectra against oscillators that are known, and records made from the spectrum of EN 1998-1."""

import numpy as np
import pytest
from scipy.signal import step

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.ground_motion.settings import DesignSpectrum, GroundMotion
from bridge_demolition_addon.model.ground_motion.sources import design_spectrum, ground_record, response_spectrum

pytestmark = pytest.mark.slow

STIFF = DesignSpectrum(acceleration_m_s2=2.0, ground_type="C")


def test_an_oscillator_on_a_sine_swings_up_as_its_transmissibility():
    """√(1 + (2 ζ r)²) / √((1 - r²)² + (2 ζ r)²), with r = frequency over own frequency; after many cycles."""
    step_s, hertz, damping = 0.002, 2.0, 0.05
    times = np.arange(0.0, 40.0, step_s)
    periods = np.array([0.1, 0.5, 1.0, 2.0])
    found = response_spectrum(np.sin(2.0 * np.pi * hertz * times), step_s, periods, damping)
    ratio = hertz * periods
    doubled = 2.0 * damping * ratio
    expected = np.sqrt((1.0 + doubled**2) / ((1.0 - ratio**2) ** 2 + doubled**2))
    # At resonance it is what remains; elsewhere the start adds some for a while. 0.5 %: the samples of the sine.
    assert found[1] == pytest.approx(expected[1], rel=0.005)
    assert (found > 0.995 * expected).all()


def test_a_step_of_acceleration_swings_over_by_the_overshoot():
    """By scipy: the absolute acceleration has the transfer function (2 ζ ω s + ω²) / (s² + 2 ζ ω s + ω²)."""
    own, damping = 2.0 * np.pi, 0.1
    found = response_spectrum(np.ones(4000), 0.001, np.array([1.0]), damping)
    system = [2.0 * damping * own, own**2], [1.0, 2.0 * damping * own, own**2]
    _, swings = step(system, T=np.arange(0.0, 4.0, 0.001))
    assert found[0] == pytest.approx(swings.max(), rel=2e-3)  # the first sample rises from 0


def test_the_design_spectrum_has_the_values_of_the_standard():
    """EN 1998-1, table 3.2, ground C: S 1.15, T_B 0.2, T_C 0.6, T_D 2.0; (3.2) to (3.5) by hand."""
    found = design_spectrum(STIFF, np.array([0.0, 0.1, 0.2, 0.6, 1.2, 2.0, 4.0]))
    rock = 2.0 * 1.15
    expected = [rock, rock * 1.75, rock * 2.5, rock * 2.5, rock * 1.25, rock * 0.75, rock * 0.1875]
    assert found == pytest.approx(expected)


def test_records_of_a_spectrum_keep_to_what_the_standard_asks_of_them():
    """EN 1998-1, 3.2.3.1.2 (4): the mean spectrum of three or more is nowhere below 90 % of the elastic one.

    In four draws with ground C: from 0.91 to 1.15 of it, at periods from 0.1 to 2 s.
    """
    periods = 0.1 * 20.0 ** np.linspace(0.0, 1.0, 25)
    found = []
    for seed in range(3):
        record = ground_record(GroundMotion(directions=("across",), spectrum=STIFF), seed)
        assert abs(record.velocities_m_s[-1]).max() < 1e-9
        step_s = float(record.times_s[1])
        found.append(response_spectrum(record.accelerations_m_s2[:, 1], step_s, periods))
    assert not np.array_equal(found[0], found[1])
    ratio = np.mean(found, axis=0) / design_spectrum(STIFF, periods)
    assert ratio.min() > 0.9 and ratio.max() < 1.25


def test_a_seed_makes_the_same_record_again_and_each_direction_has_its_own():
    motion = GroundMotion(directions=("along", "across"), spectrum=STIFF, factor=0.5)
    one, again = (ground_record(motion, 7).accelerations_m_s2 for _ in range(2))
    assert (one == again).all()
    assert abs(np.corrcoef(one[:, 0], one[:, 1])[0, 1]) < 0.3
    with pytest.raises(ScenarioError, match="has up: expected along or across with a spectrum"):
        GroundMotion(directions=("up",), spectrum=STIFF)
