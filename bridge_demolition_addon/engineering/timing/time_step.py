"""Conversion between frames, sub-steps, forces and impulses, for the whole program."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

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

        Speed is that of the body as the frame begins, which may grow by the acceleration.
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
