"""The blast pressure of several charges on several bodies: waves, the pulses that they bring, and the impulse of each.

A pulse is Friedlander's, the report's equation 1 (1946): p(τ) = p₀ (1 - τ/t_d) e^(-b τ/t_d). τ is the time since the
front arrived; the pulse is over at τ = t_d. The suction that follows, the negative phase, is not modelled.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import ArrayLike

from ...errors import BlastError
from ..arithmetic import cube_root, exponential
from ..arrays import BoolArray, FloatArray, IntArray
from ..core.calls import call
from ..core.structs import Count, Doubles, Struct, WrittenDoubles
from ..geometry.vectors import distance
from . import kingery_bulmash, kinney_graham
from .wave import SMALLEST_SCALED_DISTANCE, Burst, NamedChoice, Wave, checked, scaled_distance

REPORT_DECAY = 1.0
"""The one decay of the report of 2019, for any charge and stand-off."""

LARGEST_SHARE = 0.5
"""Share of p₀ t_d that the impulse of a pulse without decay has, a triangle; no decay gives more."""

_SERIES_BELOW = 0.5
_SERIES_TERMS = 15
"""Enough for the last term to be below rounding where the series is used: 0.5^15 / 15! is 2e-17."""

_SERIES = [
    [1.0 / (math.factorial(term) * (term + order + 1)) for order in range(3)] for term in reversed(range(_SERIES_TERMS))
]
"""Coefficients of the series of three moments, the last term first."""

_MOST_STEPS = 50


class BlastModel(NamedChoice):
    """Source of peak, impulse, arrival and duration."""

    KINGERY_BULMASH = "kingery-bulmash"
    """Fits to tests, for either burst: what the field uses."""

    KINNEY_GRAHAM = "kinney-graham"
    """The formulas of the report of 2019."""


_UNIT_WAVES = {
    BlastModel.KINGERY_BULMASH: kingery_bulmash.unit_wave,
    BlastModel.KINNEY_GRAHAM: kinney_graham.unit_wave,
}


def blast_wave(
    stand_off_m: ArrayLike,
    tnt_kg: ArrayLike,
    burst: Burst | str = Burst.AIR,
    model: BlastModel | str = BlastModel.KINGERY_BULMASH,
) -> Wave:
    """Return the waves of charges (kg of TNT) at stand-offs (m), of the shape to which both broadcast.

    Stand-offs nearer than a charge's surface (`wave.SMALLEST_SCALED_DISTANCE`) count as that; a charge of 0 has a wave
    of zeros.

    Examples
    --------
    >>> wave = blast_wave([10.0, 20.0], 8.0)
    >>> (wave.peak_overpressure_pa / 1e3).round(2)
    array([31.3 , 11.09])
    """
    distance = scaled_distance(stand_off_m, tnt_kg)
    unit_wave = _UNIT_WAVES[BlastModel(model)]
    anywhere = np.where(np.isinf(distance), 1.0, distance)
    return unit_wave(anywhere, Burst(burst)).scaled(cube_root(tnt_kg))


class Loading(NamedChoice):
    """Pressure that loads a body."""

    INCIDENT = "incident"
    """The pressure beside the wave's path, as in the report."""

    REFLECTED = "reflected"
    """The pressure on a wall that the wave meets head-on: more than any real face gets."""


@dataclass(frozen=True, eq=False, slots=True)
class Pulses:
    """Friedlander pulses of c charges on n bodies, arrays (n, c), or of k pairs of them as arrays (k,)."""

    arrivals_s: FloatArray  # of the front, delay of its charge included
    peaks_pa: FloatArray  # peak overpressures; 0 for a charge of 0 kg
    durations_s: FloatArray  # of the positive phase
    decays: FloatArray  # decay b

    @property
    def ends_s(self) -> FloatArray:
        """Return when each positive phase ends, (n, c) s."""
        return self.arrivals_s + self.durations_s

    @property
    def impulses_pa_s(self) -> FloatArray:
        """Return the impulse per area of each whole pulse, (n, c) Pa·s."""
        return whole_impulse(self.peaks_pa, self.durations_s, self.decays)

    def take(self, pairs: IntArray) -> "Pulses":
        """Return the pulses (k,) of pairs (k,): c i + j belongs to body i and charge j."""
        return Pulses(*(getattr(self, item.name).take(pairs) for item in fields(self)))

    def put(self, columns: IntArray, other: "Pulses") -> None:
        """Replace the pulses of some charges (k,) by others (n, k)."""
        for item in fields(self):
            getattr(self, item.name)[:, columns] = getattr(other, item.name)

    def load_between(self, start_s: float, end_s: float) -> BoolArray:
        """Return whether each pulse (n, c) loads its body at some time between two."""
        return (self.peaks_pa > 0.0) & (self.arrivals_s < end_s) & (start_s < self.ends_s)


class CorePulses(Struct):
    """Pulses in a step: `bda_pulses`."""

    _fields_ = (
        ("count", Count),
        *((name, Doubles) for name in ("peaks", "durations", "decays", "starts", "ends")),
        ("impulses", WrittenDoubles),
    )


def blast_pulses(
    stand_offs_m: ArrayLike,
    tnt_kg: ArrayLike,
    delays_s: ArrayLike,
    bursts: Sequence[Burst | str],
    *,
    model: BlastModel | str = BlastModel.KINGERY_BULMASH,
    loading: Loading | str = Loading.INCIDENT,
    constant_decay: float | None = None,
    pressure_factor: ArrayLike = 1.0,
) -> Pulses:
    """Return the pulses of charges on bodies, from stand-offs (n, c), masses and delays (c,), and c bursts.

    Stand-offs nearer than a charge's surface count as that. `constant_decay` is one decay for all pulses, such as
    `REPORT_DECAY`; None solves each from peak, duration and impulse. Impulses grow with `pressure_factor`, one or (c,),
    as pressures do; times and decays stay.

    Examples
    --------
    >>> pulses = blast_pulses([[10.0, 20.0]], [8.0, 8.0], [0.0, 0.025], ["air", "surface"])
    >>> impulse_between(pulses, 0.0, 1.0).round(1)
    array([[81.2, 62.1]])
    """
    stand_offs = checked(stand_offs_m, "stand-off", "m")
    masses, delays = checked(tnt_kg, "charge", "kg of TNT"), checked(delays_s, "delay", "s")
    _check_shapes(stand_offs, masses, delays, bursts)
    factors = np.broadcast_to(checked(pressure_factor, "pressure factor", "no unit"), masses.shape)
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
            duration, decay = fitted(peak, duration, impulse)
        else:
            decay = np.full(peak.shape, constant_decay)
        arrivals = wave.arrival_time_s + delays[columns]
        pulses.put(columns, Pulses(arrivals, factors[columns] * peak, duration, decay))
    return pulses


def charges_as_fired(
    sources_m: FloatArray, tnt_kg: ArrayLike, delays_s: FloatArray, bursts: Sequence[Burst | str]
) -> tuple[FloatArray, FloatArray]:
    """Return the TNT (c,) that goes off as one with each of c charges, its own included, and its share of that (c,).

    Charges that touch each other as balls and detonate at one time make one wave, whose impulse is less than the sum of
    two (Hopkinson 1915, Cranz 1926): each has its share of the common pressure.
    """
    masses = checked(tnt_kg, "charge", "kg of TNT")
    radii_m = SMALLEST_SCALED_DISTANCE * cube_root(masses)
    groups: list[list[int]] = []
    for row, times in enumerate(zip(delays_s, map(Burst, bursts), strict=True)):
        for group in groups:
            first = group[0]
            is_near = distance(sources_m[row], sources_m[first]) <= radii_m[row] + radii_m[first]
            if times == (delays_s[first], Burst(bursts[first])) and is_near:
                group.append(row)
                break
        else:
            groups.append([row])
    together = masses.copy()
    for group in groups:
        together[group] = math.fsum(masses[group])
    return together, np.divide(masses, together, out=np.ones_like(masses), where=together > 0.0)


def impulse_between(pulses: Pulses, start_s: float, end_s: float) -> FloatArray:
    """Return the exact impulse per area (n, c) of every pulse from `start_s` to `end_s`, Pa·s.

    The interval may begin before the front and end after the pulse. It is integrated from its own beginning, so that
    short intervals lose nothing to the difference of two long ones.
    """
    if not end_s >= start_s:
        raise BlastError(f"end of the step is {end_s:g}: expected at least its start, {start_s:g} (s)")
    starts, ends = start_s - pulses.arrivals_s, end_s - pulses.arrivals_s
    found = np.empty_like(starts)
    core = CorePulses(count=found.size).take(
        peaks=(pulses.peaks_pa, found.size),
        durations=(pulses.durations_s, found.size),
        decays=(pulses.decays, found.size),
        starts=(starts, found.size),
        ends=(ends, found.size),
        impulses=(found, found.size),
    )
    call("bda_impulses_of_pulses", core)
    return found


def pressure_at(pulses: Pulses, time_s: float | FloatArray) -> FloatArray:
    """Return the overpressure (n, c) of every pulse at a time, or at times that broadcast with (n, c), Pa."""
    return pulse_pressure(pulses.peaks_pa, pulses.durations_s, pulses.decays, time_s - pulses.arrivals_s)


def _check_shapes(
    stand_offs: FloatArray, masses: FloatArray, delays: FloatArray, bursts: Sequence[Burst | str]
) -> None:
    count = stand_offs.shape[1] if stand_offs.ndim == 2 else None
    if not masses.shape == delays.shape == (len(bursts),) == (count,):
        raise BlastError(
            f"stand-offs {stand_offs.shape}, charges {masses.shape}, delays {delays.shape} and {len(bursts)} bursts "
            "do not fit: expected (n, c), (c,), (c,) and c"
        )


def pulse_pressure(peak: FloatArray, duration: FloatArray, decay: FloatArray, time: float | FloatArray) -> FloatArray:
    """Return the overpressure, Pa, at times in s since the front arrived; 0 before it and after the positive phase.

    Peak overpressure (Pa), positive-phase duration (s), decay b and time broadcast.
    """
    part = _part_of_phase(time, duration)
    passed = np.clip(part, 0.0, 1.0)
    return np.where(part >= 0.0, peak * (1.0 - passed) * exponential(-decay * passed), 0.0)


def whole_impulse(peak: FloatArray, duration: FloatArray, decay: FloatArray) -> FloatArray:
    """Return the impulse of the whole positive phase, p₀ t_d (b - 1 + e^(-b)) / b², in Pa·s."""
    return peak * duration * _share(np.asarray(decay, float))


def fitted(peak: FloatArray, duration: FloatArray, impulse: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return duration and decay of the pulses with a peak (Pa), a duration (s) and an impulse (Pa·s), of one shape.

    No decay of at least 0 gives more than half of p₀ t_d. Where more is wanted, the pulse gets no decay and a longer
    duration, 2 i / p₀: peak and impulse are what moves and breaks a body, and tests measure them better than where a
    pulse that fades out ends. A negative decay would keep the duration, with a pressure that hardly falls and then
    drops at once.

    Where the peak is 0 so are the results.
    """
    there = peak > 0.0
    triangle = np.divide(impulse, LARGEST_SHARE * peak, out=np.zeros_like(peak), where=there)
    share = np.full_like(peak, LARGEST_SHARE)
    np.divide(impulse, peak * duration, out=share, where=there & (triangle < duration))
    return np.where(there, np.maximum(duration, triangle), 0.0), decay_of(share)


def decay_of(share: FloatArray) -> FloatArray:
    """Return the decay b ≥ 0 at which the impulse is a share of p₀ t_d, from above 0 to `LARGEST_SHARE`.

    The share falls with b and is convex, and at b = 1/share - 2 it is not below the wanted one. So Newton's steps
    from there go one way, never overshoot, and are done after a handful.
    """
    share = np.asarray(share, float)
    decay = np.maximum(1.0 / share - 2.0, 0.0)
    for _ in range(_MOST_STEPS):
        whole, first, second = _moments(decay, 3)
        step = (whole - first - share) / (first - second)
        decay = np.maximum(decay + step, 0.0)
        if (abs(step) <= 1e-13 * (1.0 + decay)).all():
            break
    return decay


def _share(decay: FloatArray) -> FloatArray:
    mean, first = _moments(decay, 2)
    return mean - first


def _moments(exponent: FloatArray, count: int) -> list[FloatArray]:
    """Return ∫₀¹ uⁿ e^(-y u) du for y ≥ 0 and n from 0 on; a series where the closed form would lose its digits."""
    is_small = exponent < _SERIES_BELOW
    # Both are costly: most steps are so short, or so long, that one of them serves all pulses.
    if is_small.all():
        return list(_series_of_moments(exponent, count))
    if not is_small.any():
        return _closed_moments(exponent, count)
    series = _series_of_moments(np.minimum(exponent, _SERIES_BELOW), count)
    closed = _closed_moments(np.maximum(exponent, _SERIES_BELOW), count)
    return [np.where(is_small, *moments) for moments in zip(series, closed, strict=True)]


def _series_of_moments(exponent: FloatArray, count: int) -> FloatArray:
    """Return the moments (count, ...) by their series, for small exponents."""
    sums = np.zeros((count, *exponent.shape))
    for coefficients in np.array(_SERIES)[:, :count].reshape(-1, count, *[1] * exponent.ndim):
        np.multiply(exponent, sums, out=sums)
        np.subtract(coefficients, sums, out=sums)
    return sums


def _closed_moments(exponent: FloatArray, count: int) -> list[FloatArray]:
    left = exponential(-exponent)
    moments = [(1.0 - left) / exponent]
    for order in range(1, count):
        moments.append((order * moments[-1] - left) / exponent)
    return moments


def _part_of_phase(time: ArrayLike, duration: ArrayLike) -> FloatArray:
    """Return time as part of the positive phase; a pulse without duration is over at once."""
    times, durations = np.broadcast_arrays(np.asarray(time, float), np.asarray(duration, float))
    part: FloatArray = np.divide(times, durations, out=np.full(times.shape, np.inf), where=durations > 0.0)
    return part
