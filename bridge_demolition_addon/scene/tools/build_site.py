"""Where tools are built: a rigid-body world, the frames of a run, and what lies under each place."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import numpy as np

from ...engineering.timing.timeline import Timeline
from ...model.actions import HeightAt
from ..world import FIRST_STEP_FRAME


@dataclass(frozen=True, eq=False, slots=True)
class BuildSite:
    """What the maker of a tool is given.

    Attributes
    ----------
    world : bpy.types.RigidBodyWorld
    timeline : Timeline
        Frames from the first that time leads to.
    height_at : callable
        Height of the bridge at a place, m.
    """

    world: bpy.types.RigidBodyWorld
    timeline: Timeline
    height_at: HeightAt

    def frame_after(self, time_s: float) -> int:
        """Return the first frame that begins at a simulated time or later."""
        return FIRST_STEP_FRAME + self.timeline.frames_until(time_s)

    def frames_and_times(self) -> tuple[np.ndarray, np.ndarray]:
        """Return all frames (k,) from that of the time 0 on, and their times (k,), s."""
        times = np.concatenate(([0.0], self.timeline.ends_s))
        return FIRST_STEP_FRAME - 1 + np.arange(len(times)), times
