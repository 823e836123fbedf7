"""How much of a run is still to come, in sub-steps: they take alike long each, frames do not."""

from __future__ import annotations

import bpy
import numpy as np

from ..engineering.geometry.vectors import length
from ..engineering.timing.time_left import speeds_to_come
from ..engineering.timing.time_step import substeps_within
from ..model.results.frames import Frame
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
        steps = [time_step_at(scene, frame) for frame in range(first, last + 1)]
        self._frames_s = np.array([step.frame_s for step in steps])
        self._fewest = np.array([step.substeps_per_frame for step in steps])
        self._ends_s = np.cumsum(self._frames_s)
        self._farthest_m = farthest_per_substep_of(scene)
        gravity = np.array(scene.gravity, float) if scene.use_gravity else np.zeros(3)
        self._gravity_m_s2 = float(length(gravity))

    def to_come(self, frame: Frame) -> float:
        """Return how many sub-steps follow on a frame."""
        rows = slice(frame.number + 1 - self._first, None)
        frames_s, fewest, ends_s = self._frames_s[rows], self._fewest[rows], self._ends_s[rows]
        if self._farthest_m is None or not len(fewest) or not self._gravity_m_s2:
            return float(fewest.sum())
        after_s = ends_s - ends_s[0]
        speeds = speeds_to_come(frame.positions_m[:, 2], frame.velocities_m_s, self._gravity_m_s2, after_s)
        return float(substeps_within(frames_s, fewest, self._farthest_m, speeds, self._gravity_m_s2).sum())
