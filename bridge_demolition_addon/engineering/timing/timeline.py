"""The frames of a run, each with its length: some of them shortened, so that milliseconds can be seen.

Sub-steps of frames convert between forces and impulses for the whole program.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..arithmetic import logarithm
from ..arrays import FloatArray

FRAME_NOISE = 1e-6
"""Part of a frame that rounding may add to a duration without a frame being added for it."""

MOST_SUBSTEPS = 1000
"""Blender's limit of sub-steps in a frame."""


@dataclass(frozen=True, slots=True)
class TimeStep:
    """Division of time by Blender: frames into sub-steps, each one step of Bullet."""

    frames_per_second: int  # Blender's frame rate is this by the next: 29.97 Hz is 30 / 1.001
    frames_per_second_base: float
    substeps_per_frame: int
    time_scale: float  # simulated seconds per second of animation

    @property
    def frame_s(self) -> float:
        """Simulated time of one frame, s."""
        return self.time_scale * self.frames_per_second_base / self.frames_per_second

    @property
    def substep_s(self) -> float:
        """Simulated time of one sub-step, s."""
        return self.frame_s / self.substeps_per_frame

    def substeps_within(self, farthest_m: float, speed_m_s: float, acceleration_m_s2: float) -> int:
        """Return the sub-steps of a frame so that a body goes no farther in one, at most `MOST_SUBSTEPS`.

        Speed as the frame begins; it may grow by the acceleration.
        """
        return int(substeps_within(self.frame_s, self.substeps_per_frame, farthest_m, speed_m_s, acceleration_m_s2))

    def impulse(self, force_newton: float) -> float:
        """Impulse of a steady force over one sub-step, N·s: the unit of Blender's breaking threshold."""
        return force_newton * self.substep_s

    def frames(self, duration_s: float) -> int:
        """Whole frames that cover a simulated duration."""
        return frames_over(self.frame_s, duration_s)


def substeps_within(
    frame_s: ArrayLike, fewest: ArrayLike, farthest_m: float, speed_m_s: float | FloatArray, acceleration_m_s2: float
) -> FloatArray:
    """Return sub-steps as `TimeStep.substeps_within`, of frames of these lengths that have at least the fewest."""
    lengths_s = np.asarray(frame_s, float)
    way_m = (speed_m_s + acceleration_m_s2 * lengths_s) * lengths_s
    substeps: FloatArray = np.maximum(fewest, np.ceil(np.minimum(way_m / farthest_m, MOST_SUBSTEPS)))
    return substeps


def frames_over(frame_s: float, duration_s: float) -> int:
    """Whole frames of a length that cover a duration."""
    return math.ceil(duration_s / frame_s - FRAME_NOISE)


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
