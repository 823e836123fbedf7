"""A sine whose frequency goes evenly from one to another."""

from __future__ import annotations

import numpy as np

from ...engineering.arithmetic import cosine, sine
from .settings import Sweep

_SAMPLES_PER_CYCLE = 100
"""Straight lines between so many samples are off a sine by less than 0.1 %."""


def swept(sweep: Sweep) -> tuple[np.ndarray, np.ndarray]:
    """Return times (k,) in s and accelerations (k,) in m/s²; the first and the last cycle fade in and out."""
    highest = max(sweep.from_hz, sweep.to_hz)
    count = int(np.ceil(sweep.duration_s * highest * _SAMPLES_PER_CYCLE)) + 1
    times = np.linspace(0.0, sweep.duration_s, count)
    rise = (sweep.to_hz - sweep.from_hz) / sweep.duration_s
    cycles = times * (sweep.from_hz + 0.5 * rise * times)
    in_fade = np.minimum(np.minimum(cycles, cycles[-1] - cycles), 1.0)
    faded = 0.5 * (1.0 - cosine(np.pi * in_fade))
    return times, sweep.acceleration_m_s2 * faded * sine(2.0 * np.pi * cycles)
