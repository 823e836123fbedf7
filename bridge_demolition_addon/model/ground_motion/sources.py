"""The record of ground motion of a scenario, from a file, a sweep or a spectrum."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...engineering.arithmetic import cosine, sine
from ...engineering.ground_motion.record import LARGEST_ACCELERATION_M_S2, GroundRecord, corrected
from ...engineering.units import STANDARD_GRAVITY_M_S2
from ...errors import ScenarioError
from ..schema import given
from .record_files import accelerogram_from_file
from .settings import DIRECTIONS, GroundMotion, Sweep
from .spectral_record import spectral_record

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
