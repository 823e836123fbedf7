"""Records that have a given response spectrum, made of sines with random phases.

D. A. Gasparini and E. H. Vanmarcke (1976), Simulated earthquake motions compatible with prescribed response spectra,
MIT Research Report R76-4: sines under an envelope, whose amplitudes are corrected until the spectrum is that which is
asked for. The envelope is that of P. C. Jennings, G. W. Housner and N. C. Tsai (1968), Simulated earthquake motions,
Caltech: a parabola, a plateau, an exponential.
"""

from __future__ import annotations

import numpy as np

from ...engineering.arithmetic import exponential, sine
from ...engineering.ground_motion.record import corrected
from .response_spectrum import design_spectrum, response_spectrum
from .settings import DesignSpectrum

STEP_S = 0.01

RISE_S, DECAY_S = 2.0, 5.0

SHORTEST_S, LONGEST_S = 0.05, 4.0
"""Periods at which the spectrum is matched."""

_LOWEST_HZ, _HIGHEST_HZ = 0.2, 25.0
_DECAY_BY_S = 1.5
"""In this time of the decay the envelope falls to 1/e."""

_PERIODS = 60
_CORRECTIONS = 12
_MOST_AT_ONCE = 3.0
"""Largest factor of a correction of an amplitude."""


def spectral_record(spectrum: DesignSpectrum, random: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Return times (k,) in s and accelerations (k,) in m/s² of a record with a spectrum; the generator draws phases."""
    duration = RISE_S + spectrum.strong_s + DECAY_S
    times = STEP_S * np.arange(round(duration / STEP_S) + 1)
    frequencies = np.arange(_LOWEST_HZ, _HIGHEST_HZ, 1.0 / duration)
    phases = 2.0 * np.pi * random.random(len(frequencies))
    waves = sine(2.0 * np.pi * frequencies[:, None] * times + phases[:, None]) * _envelope(times, spectrum.strong_s)
    periods = SHORTEST_S * exponential(np.linspace(0.0, np.log(LONGEST_S / SHORTEST_S), _PERIODS))
    wanted = design_spectrum(spectrum, periods)
    amplitudes = design_spectrum(spectrum, 1.0 / frequencies) / np.sqrt(len(frequencies))
    made = _record(times, waves, amplitudes)
    best, least = made, np.inf
    for _ in range(_CORRECTIONS):
        actual = response_spectrum(made, STEP_S, periods)
        off = float(abs(actual / wanted - 1.0).max())
        if off < least:
            best, least = made, off
        factors = np.clip(wanted / actual, 1.0 / _MOST_AT_ONCE, _MOST_AT_ONCE)
        amplitudes = amplitudes * np.interp(1.0 / frequencies, periods, factors)
        made = _record(times, waves, amplitudes)
    return times, best


def _record(times: np.ndarray, waves: np.ndarray, amplitudes: np.ndarray) -> np.ndarray:
    """Sum of waves (f, k) by amplitudes (f,), that ends at rest where it began."""
    total = (amplitudes[:, None] * waves).sum(axis=0)
    return corrected(times, total[:, None], "linear").accelerations_m_s2[:, 0]


def _envelope(times: np.ndarray, strong_s: float) -> np.ndarray:
    rising = np.minimum(times / RISE_S, 1.0)
    after = np.maximum(times - RISE_S - strong_s, 0.0)
    return rising * rising * exponential(-after / _DECAY_BY_S)
