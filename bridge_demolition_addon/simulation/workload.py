"""How much of a run is still to come, in sub-steps: they take alike long each, frames do not."""

from __future__ import annotations

import bpy
import numpy as np

from ..core.geometry.vectors import length
from ..core.results.frames import Frame
from ..core.timing.time_left import speeds_to_come
from ..scene.time_scale import time_step_at
from ..scene.world import farthest_per_substep_of


class Workload:
    """The sub-steps of the frames to come, as the bodies move now.

    Parameters
    ----------
    scene : bpy.types.Scene
        Scene that is played.
    first, last : int
        Its frames, without the start frame.
    """

    def __init__(self, scene: bpy.types.Scene, first: int, last: int) -> None:
        self._first = first
        self._steps = [time_step_at(scene, frame) for frame in range(first, last + 1)]
        self._ends_s = np.cumsum([step.frame_s for step in self._steps])
        self._farthest_m = farthest_per_substep_of(scene)
        gravity = np.array(scene.gravity, float) if scene.use_gravity else np.zeros(3)
        self._gravity_m_s2 = float(length(gravity))

    def to_come(self, frame: Frame) -> float:
        """Return how many sub-steps follow on a frame."""
        rows = slice(frame.number + 1 - self._first, None)
        steps = self._steps[rows]
        if self._farthest_m is None or not steps or not self._gravity_m_s2:
            return float(sum(step.substeps_per_frame for step in steps))
        after_s = self._ends_s[rows] - self._ends_s[rows][0]
        heights_m, velocities_m_s = frame.positions_m[:, 2], frame.velocities_m_s
        speeds = speeds_to_come(heights_m, velocities_m_s, self._gravity_m_s2, after_s).tolist()
        pairs = zip(steps, speeds, strict=True)
        return float(sum(step.substeps_within(self._farthest_m, speed, self._gravity_m_s2) for step, speed in pairs))
