"""Where tools are built: a rigid-body world, the frames of a run, the heights of the bridge, and surfaces of bodies."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import bpy
import numpy as np

from ...engineering.timing.timeline import Timeline
from ...model.actions import HeightAt
from ...model.scenario import SurfaceValues
from ...model.scenario.contacts import BodyInContact
from ..world import FIRST_STEP_FRAME


@dataclass(frozen=True, eq=False, slots=True)
class BuildSite:
    """What the maker of a tool works with; the timeline begins at `FIRST_STEP_FRAME`."""

    world: bpy.types.RigidBodyWorld
    timeline: Timeline
    height_at: HeightAt
    surface_of: Callable[[BodyInContact], SurfaceValues]

    def frame_after(self, time_s: float) -> int:
        """Return the first frame that begins at a simulated time or later."""
        return FIRST_STEP_FRAME + self.timeline.frames_until(time_s)

    def frames_and_times(self) -> tuple[np.ndarray, np.ndarray]:
        """Return all frames (k,) from time 0 on, and their times (k,), s."""
        times = np.concatenate(([0.0], self.timeline.ends_s))
        return FIRST_STEP_FRAME - 1 + np.arange(len(times)), times
