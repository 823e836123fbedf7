"""Response spectra: how much an oscillator on the ground is accelerated, and what EN 1998-1 asks for."""

from __future__ import annotations

import numpy as np

from ...engineering.arithmetic import cosine, exponential, sine
from .settings import DesignSpectrum

DAMPING_RATIO = 0.05

_GROUND_TYPES = {
    (1, "A"): (1.0, 0.15, 0.4, 2.0),
    (1, "B"): (1.2, 0.15, 0.5, 2.0),
    (1, "C"): (1.15, 0.20, 0.6, 2.0),
    (1, "D"): (1.35, 0.20, 0.8, 2.0),
    (1, "E"): (1.4, 0.15, 0.5, 2.0),
    (2, "A"): (1.0, 0.05, 0.25, 1.2),
    (2, "B"): (1.35, 0.05, 0.25, 1.2),
    (2, "C"): (1.5, 0.10, 0.25, 1.2),
    (2, "D"): (1.8, 0.10, 0.30, 1.2),
    (2, "E"): (1.6, 0.05, 0.25, 1.2),
}
"""Soil factor S and periods T_B, T_C, T_D in s, by type of spectrum and ground: EN 1998-1:2004, tables 3.2 and 3.3."""


def design_spectrum(spectrum: DesignSpectrum, periods_s: np.ndarray) -> np.ndarray:
    """Return the elastic response spectrum S_e (p,), m/s², at periods (p,): EN 1998-1:2004, (3.2) to (3.5), 5 %."""
    soil, rising, even, falling = _GROUND_TYPES[spectrum.type, spectrum.ground_type]
    periods = np.asarray(periods_s, float)
    safe = np.maximum(periods, rising)
    shape = np.where(periods < rising, 1.0 + periods / rising * 1.5, 2.5)
    shape = np.where(periods > even, 2.5 * even / safe, shape)
    shape = np.where(periods > falling, 2.5 * even * falling / (safe * safe), shape)
    return spectrum.acceleration_m_s2 * soil * shape


def response_spectrum(
    accelerations_m_s2: np.ndarray, step_s: float, periods_s: np.ndarray, damping_ratio: float = DAMPING_RATIO
) -> np.ndarray:
    """Return the largest acceleration (p,), m/s², of oscillators with periods (p,) on ground that is accelerated so.

    The acceleration of the ground goes in straight lines between its samples (k,). Oscillators follow that exactly: the
    ramp-invariant filter of D. O. Smallwood (1981), An improved recursive formula for calculating shock response
    spectra, Shock and Vibration Bulletin 51, part 2, 211-217, for the absolute acceleration. With a damping of 5 % that
    is the pseudo-acceleration within 1 %.
    """
    angle = 2.0 * np.pi * step_s / np.asarray(periods_s, float)
    decay = exponential(-damping_ratio * angle)
    turned = angle * np.sqrt(1.0 - damping_ratio * damping_ratio)
    real, imaginary = decay * cosine(turned), decay * sine(turned) / turned
    inputs = 1.0 - imaginary, 2.0 * (imaginary - real), decay * decay - imaginary
    ground = np.concatenate((np.zeros(2), accelerations_m_s2)).tolist()
    now, before = np.zeros_like(angle), np.zeros_like(angle)
    largest = np.zeros_like(angle)
    for sample in range(2, len(ground)):
        driven = inputs[0] * ground[sample] + inputs[1] * ground[sample - 1] + inputs[2] * ground[sample - 2]
        now, before = driven + 2.0 * real * now - decay * decay * before, now
        np.maximum(largest, abs(now), out=largest)
    return largest
