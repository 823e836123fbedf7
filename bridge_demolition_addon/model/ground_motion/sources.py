"""The record of ground motion of a scenario, from a file, a sweep or a response spectrum.

D. A. Gasparini and E. H. Vanmarcke (1976), Simulated earthquake motions compatible with prescribed response spectra,
MIT Research Report R76-4: sines under an envelope, whose amplitudes are corrected until the spectrum is that which is
asked for. Envelope: P. C. Jennings, G. W. Housner and N. C. Tsai (1968), Simulated earthquake motions, Caltech: a
parabola, a plateau, an exponential.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...engineering.arithmetic import cosine, exponential, sine
from ...engineering.ground_motion import LARGEST_ACCELERATION_M_S2, GroundRecord, corrected
from ...engineering.units import STANDARD_GRAVITY_M_S2
from ...errors import ScenarioError
from ..schema import given
from .record_files import accelerogram_from_file
from .settings import DIRECTIONS, DesignSpectrum, GroundMotion, Sweep

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


_IN_M_S2 = {"g": STANDARD_GRAVITY_M_S2, "m/s2": 1.0, "cm/s2": 0.01}

_SAMPLES_PER_CYCLE = 100
"""Straight lines between so many samples are off a sine by less than 0.1 %."""


def ground_record(motion: GroundMotion, seed: int) -> GroundRecord:
    """Return how the ground moves; the seed draws the phases of a record that is made from a spectrum."""
    times, accelerations = _accelerations(motion, seed)
    along = np.zeros((len(times), len(DIRECTIONS)))
    along[:, [DIRECTIONS.index(direction) for direction in motion.directions]] = motion.factor * accelerations
    return corrected(times, along, motion.baseline)


def _accelerations(motion: GroundMotion, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Return times (k,) in s and the accelerations in each of its directions (k, d), m/s²."""
    count = len(motion.directions)
    if motion.sweep:
        times, values = _swept(motion.sweep)
        return times, np.repeat(values[:, None], count, axis=1)
    if motion.spectrum:
        random = np.random.Generator(np.random.PCG64(seed))
        made = [spectral_record(motion.spectrum, random) for _ in range(count)]
        return made[0][0], np.column_stack([values for _, values in made])
    times, values = accelerogram_from_file(Path(given(motion.file)), count)
    values = _IN_M_S2[given(motion.unit)] * values
    largest = float(abs(values).max())
    if largest == 0.0:
        raise ScenarioError(f"{motion.file}: all accelerations are 0: expected an accelerogram")
    if largest > LARGEST_ACCELERATION_M_S2:
        raise ScenarioError(
            f'ground_motion.unit is "{motion.unit}", by which {motion.file} has up to '
            f"{largest / STANDARD_GRAVITY_M_S2:.1f} g: expected at most "
            f"{LARGEST_ACCELERATION_M_S2 / STANDARD_GRAVITY_M_S2:g} g; see in which unit the file is"
        )
    return times, values


def _swept(sweep: Sweep) -> tuple[np.ndarray, np.ndarray]:
    """Return a sine whose frequency changes evenly: times (k,) in s and accelerations (k,) in m/s².

    The first and the last cycle fade in and out.
    """
    highest = max(sweep.from_hz, sweep.to_hz)
    count = int(np.ceil(sweep.duration_s * highest * _SAMPLES_PER_CYCLE)) + 1
    times = np.linspace(0.0, sweep.duration_s, count)
    rise = (sweep.to_hz - sweep.from_hz) / sweep.duration_s
    cycles = times * (sweep.from_hz + 0.5 * rise * times)
    in_fade = np.minimum(np.minimum(cycles, cycles[-1] - cycles), 1.0)
    faded = 0.5 * (1.0 - cosine(np.pi * in_fade))
    return times, sweep.acceleration_m_s2 * faded * sine(2.0 * np.pi * cycles)
