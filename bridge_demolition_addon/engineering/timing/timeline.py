"""The frames of a run, each with its length: some of them shortened, so that milliseconds can be seen."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arithmetic import logarithm
from ..arrays import FloatArray
from .time_step import FRAME_NOISE, frames_over

SLOWING = 0.8
"""Length of a frame over the one before it on the way into slow motion: forces rise to 1.6 times for some sub-steps."""

_FEWEST_BETWEEN = 8
"""Frames between two slow motions: enough to slow down again, and to be divided evenly."""


@dataclass(frozen=True, slots=True)
class SlowMotion:
    """A span of simulated time in which frames are shorter than elsewhere."""

    start_s: float
    duration_s: float
    frame_s: float  # simulated time of one of its frames

    @property
    def end_s(self) -> float:
        """When it is over, s."""
        return self.start_s + self.duration_s


@dataclass(frozen=True, eq=False, slots=True)
class Timeline:
    """Frames in their order, (k,) simulated time that each adds."""

    frame_lengths_s: FloatArray

    @classmethod
    def of(cls, frame_s: float, duration_s: float, slow_motions: Sequence[SlowMotion] = ()) -> Timeline:
        """Frames that cover a duration, with slow motions in it.

        A slow motion begins exactly at its time, and frames shorten towards it by `SLOWING` each. Bullet pulls
        connections that have stretched together again with a force that goes with 1 / step², so that a bridge that has
        settled in long steps would be torn apart by short ones that began at once. For the same reason the time before
        is divided evenly, and slow motions with less than `_FEWEST_BETWEEN` frames in between are one.
        """
        lengths: list[FloatArray] = []
        time = 0.0
        for slow in _merged(slow_motions, _FEWEST_BETWEEN * frame_s):
            if slow.start_s >= duration_s:
                break
            lengths.append(_frames_slowing_down(frame_s, slow.frame_s, slow.start_s - time))
            count = max(1, frames_over(slow.frame_s, slow.duration_s))
            lengths.append(np.full(count, slow.frame_s))
            time = slow.start_s + count * slow.frame_s
        lengths.append(np.full(max(0, frames_over(frame_s, duration_s - time)), frame_s))
        return cls(np.concatenate(lengths))

    def __len__(self) -> int:
        return len(self.frame_lengths_s)

    @property
    def ends_s(self) -> FloatArray:
        """(k,) simulated time at the end of each frame."""
        return np.cumsum(self.frame_lengths_s)

    def frames_until(self, time_s: float) -> int:
        """Whole frames that it takes from the beginning to a simulated time."""
        noise = FRAME_NOISE * self.frame_lengths_s
        return int(np.searchsorted(self.ends_s + noise, time_s)) + (1 if time_s > 0.0 else 0)


def _frames_slowing_down(frame_s: float, slow_frame_s: float, duration_s: float) -> FloatArray:
    """Frames that together are exactly a duration, at first of one length, at last shorter and shorter."""
    steps = max(0, math.ceil(logarithm(slow_frame_s / frame_s) / logarithm(SLOWING)) - 1)
    slowing = frame_s * np.cumprod(np.full(steps, SLOWING))
    slowing = slowing[np.cumsum(slowing[::-1])[::-1] <= duration_s]  # as many as there is time for
    room_s = duration_s - slowing.sum()
    count = max(0, frames_over(frame_s, room_s))
    return np.concatenate((np.full(count, room_s / max(1, count)), slowing))


def _merged(slow_motions: Sequence[SlowMotion], least_gap_s: float) -> list[SlowMotion]:
    """In the order of time, those with too small a gap in between as one, in the shorter frames of the two."""
    merged: list[SlowMotion] = []
    for slow_motion in sorted(slow_motions, key=lambda motion: motion.start_s):
        if merged and slow_motion.start_s < merged[-1].end_s + least_gap_s:
            last = merged.pop()
            end = max(last.end_s, slow_motion.end_s)
            slow_motion = SlowMotion(last.start_s, end - last.start_s, min(last.frame_s, slow_motion.frame_s))
        merged.append(slow_motion)
    return merged
