"""Impulses of pulses as a loop, which Numba compiles: import this only where it is installed.

It gives the same bits as `pulses`.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..arithmetic import EXPONENTIAL, LN2_PARTS, PER_LN2
from ..compilation import compiled
from .pulses import SERIES, SERIES_BELOW

_TERMS = tuple((whole, centre) for whole, centre, _ in SERIES)


@compiled
def impulses(peaks: Any, durations: Any, decays: Any, starts: Any, ends: Any) -> Any:
    """`pulses.pulse_impulse` of k pulses, all arrays (k,)."""
    found = np.empty(len(peaks))
    for pulse in range(len(peaks)):
        first = _passed(starts[pulse], durations[pulse])
        length = _passed(ends[pulse], durations[pulse]) - first
        whole, centre = _moments(decays[pulse] * length)
        mean = (1.0 - first) * whole - length * centre
        left = _exponential(-decays[pulse] * first)
        found[pulse] = peaks[pulse] * durations[pulse] * left * length * mean
    return found


@compiled
def _passed(time: Any, duration: Any) -> Any:
    """Part of the positive phase that has passed, from 0 to 1; a pulse without duration is over at once."""
    return min(max(time / duration, 0.0), 1.0) if duration > 0.0 else 1.0


@compiled
def _moments(exponent: Any) -> Any:
    """The first two of `pulses._moments`."""
    if exponent < SERIES_BELOW:
        whole, centre = 0.0, 0.0
        for term in range(len(_TERMS)):
            whole, centre = _TERMS[term][0] - exponent * whole, _TERMS[term][1] - exponent * centre
        return whole, centre
    left = _exponential(-exponent)
    whole = (1.0 - left) / exponent
    return whole, (1.0 * whole - left) / exponent


@compiled
def _exponential(x: Any) -> Any:
    """`arithmetic.exponential` of a number."""
    limited = min(max(x, -750.0), 710.0)
    doublings = np.rint(limited * PER_LN2)
    upper, lower = limited - doublings * LN2_PARTS[0], doublings * LN2_PARTS[1]
    short = upper - lower
    square = short * short
    value = EXPONENTIAL[4]
    for term in range(3, -1, -1):
        value = EXPONENTIAL[term] + square * value
    bend = short - square * value
    return math.ldexp(1.0 - ((lower - short * bend / (2.0 - bend)) - upper), int(doublings))
