"""The pressure pulses of several charges on several bodies, and the impulse of each in any step of time."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...errors import BlastError
from ..arrays import BoolArray, FloatArray, IntArray
from . import friedlander
from .models import BlastModel, blast_wave
from .wave import Burst, Choice, checked

REPORT_DECAY = 1.0
"""The one decay of the report of 2019, for any charge and stand-off."""


class Loading(Choice):
    """Which pressure loads a body."""

    INCIDENT = "incident"
    """The pressure beside the wave's path, as in the report."""

    REFLECTED = "reflected"
    """The pressure on a wall that the wave meets head-on: more than any real face gets."""


@dataclass(frozen=True, eq=False, slots=True)
class Pulses:
    """Friedlander pulses of c charges on n bodies, or of k pairs of them as arrays (k,).

    Attributes
    ----------
    arrivals_s : (n, c) float
        When each front arrives, delay of its charge included, s.
    peaks_pa : (n, c) float
        Peak overpressures, Pa; 0 for a charge of 0 kg.
    durations_s : (n, c) float
        Positive-phase durations, s.
    decays : (n, c) float
        Decays b.
    """

    arrivals_s: FloatArray
    peaks_pa: FloatArray
    durations_s: FloatArray
    decays: FloatArray

    @property
    def ends_s(self) -> FloatArray:
        """Return when each positive phase ends, (n, c) s."""
        return self.arrivals_s + self.durations_s

    @property
    def impulses_pa_s(self) -> FloatArray:
        """Return the impulse per area of each whole pulse, (n, c) Pa·s."""
        return friedlander.whole_impulse(self.peaks_pa, self.durations_s, self.decays)

    def take(self, pairs: IntArray) -> "Pulses":
        """Return the pulses (k,) of pairs (k,): c i + j is that of body i and charge j."""
        every = (self.arrivals_s, self.peaks_pa, self.durations_s, self.decays)
        return Pulses(*(values.take(pairs) for values in every))

    def put(self, columns: IntArray, other: "Pulses") -> None:
        """Replace the pulses of some charges (k,) by others (n, k)."""
        self.arrivals_s[:, columns] = other.arrivals_s
        self.peaks_pa[:, columns] = other.peaks_pa
        self.durations_s[:, columns] = other.durations_s
        self.decays[:, columns] = other.decays

    def load_between(self, start_s: float, end_s: float) -> BoolArray:
        """Return whether each pulse (n, c) loads its body at some time between two."""
        return (self.peaks_pa > 0.0) & (self.arrivals_s < end_s) & (start_s < self.ends_s)


def blast_pulses(
    stand_offs_m: ArrayLike,
    tnt_kg: ArrayLike,
    delays_s: ArrayLike,
    bursts: Sequence[Burst | str],
    *,
    model: BlastModel | str = BlastModel.KINGERY_BULMASH,
    loading: Loading | str = Loading.INCIDENT,
    constant_decay: float | None = None,
    pressure_factor: float = 1.0,
) -> Pulses:
    """Return the pulses of charges on bodies.

    Parameters
    ----------
    stand_offs_m : (n, c) float
        Distances of the bodies from the charges, m; nearer than its surface counts as that.
    tnt_kg, delays_s : (c,) float
        Mass of each charge, kg of TNT, and its delay, s.
    bursts : (c,) Burst
        Where each charge detonates.
    model : BlastModel
        Where the waves come from.
    loading : Loading
        Which of their pressures loads the bodies.
    constant_decay : float or None
        One decay for all pulses, such as `REPORT_DECAY`; None solves each from peak, duration and impulse.
    pressure_factor : float
        Factor on the pressures. Impulses grow with it, times and decays stay.

    Raises
    ------
    BlastError
        A number is negative or not finite, or the arrays do not fit each other.

    Examples
    --------
    >>> pulses = blast_pulses([[10.0, 20.0]], [8.0, 8.0], [0.0, 0.025], ["air", "surface"])
    >>> impulse_between(pulses, 0.0, 1.0).round(1)
    array([[81.2, 62.1]])
    """
    stand_offs = checked(stand_offs_m, "stand-off", "m")
    masses, delays = checked(tnt_kg, "charge", "kg of TNT"), checked(delays_s, "delay", "s")
    _check_shapes(stand_offs, masses, delays, bursts)
    checked(pressure_factor, "pressure factor", "no unit")
    if constant_decay is not None:
        checked(constant_decay, "decay", "no unit")
    pulses = Pulses(*(np.zeros(stand_offs.shape) for _ in range(4)))
    for burst in {Burst(burst) for burst in bursts}:
        columns = np.flatnonzero([Burst(other) is burst for other in bursts])
        wave = blast_wave(stand_offs[:, columns], masses[columns], burst, model)
        reflected = Loading(loading) is Loading.REFLECTED
        peak = wave.reflected_overpressure_pa if reflected else wave.peak_overpressure_pa
        impulse = wave.reflected_impulse_pa_s if reflected else wave.incident_impulse_pa_s
        duration = wave.positive_phase_duration_s
        if constant_decay is None:
            duration, decay = friedlander.fitted(peak, duration, impulse)
        else:
            decay = np.full(peak.shape, constant_decay)
        pulses.put(columns, Pulses(wave.arrival_time_s + delays[columns], pressure_factor * peak, duration, decay))
    return pulses


def impulse_between(pulses: Pulses, start_s: float, end_s: float) -> FloatArray:
    """Return the exact impulse per area (n, c) of every pulse from `start_s` to `end_s`, Pa·s.

    Raises
    ------
    BlastError
        The step ends before it starts.
    """
    if not end_s >= start_s:
        raise BlastError(f"end of the step is {end_s:g}: expected at least its start, {start_s:g} (s)")
    return friedlander.impulse_between(
        pulses.peaks_pa, pulses.durations_s, pulses.decays, start_s - pulses.arrivals_s, end_s - pulses.arrivals_s
    )


def pressure_at(pulses: Pulses, time_s: float | FloatArray) -> FloatArray:
    """Return the overpressure (n, c) of every pulse at a time, Pa; ambient pressure is not part of it.

    Instead of one time there can be an array of them that broadcasts with (n, c).
    """
    return friedlander.pressure(pulses.peaks_pa, pulses.durations_s, pulses.decays, time_s - pulses.arrivals_s)


def _check_shapes(
    stand_offs: FloatArray, masses: FloatArray, delays: FloatArray, bursts: Sequence[Burst | str]
) -> None:
    count = stand_offs.shape[1] if stand_offs.ndim == 2 else None
    if not masses.shape == delays.shape == (len(bursts),) == (count,):
        raise BlastError(
            f"stand-offs {stand_offs.shape}, charges {masses.shape}, delays {delays.shape} and {len(bursts)} bursts "
            "do not fit: expected (n, c), (c,), (c,) and c"
        )
