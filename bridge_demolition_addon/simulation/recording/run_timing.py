"""How much time passes in the coming frame, and in how many sub-steps."""

from __future__ import annotations

import bpy
import numpy as np

from ...bullet.time_control import release_time, set_substeps, set_time_scale
from ...engineering.geometry.vectors import dot
from ...errors import LayoutError, SimulationError
from ...model.results.frames import Frame
from ...scene.world import farthest_per_substep_of, time_is_animated, time_step_at


class RunTiming:
    """Time of one scene while it is recorded."""

    def __init__(self, scene: bpy.types.Scene):
        self._scene = scene
        self._has_set_substeps = False

    def set_time(self, *, holds_first: bool) -> None:
        """Hold time in the frame in which Blender makes its world, if asked to, and have it pass as it is animated.

        Raises a `LayoutError` if time cannot be held.
        """
        scene = self._scene
        coming, animated = scene.frame_current, time_is_animated(scene)
        is_held = holds_first and coming == scene.rigidbody_world.point_cache.frame_start + 1
        if not is_held and not animated:
            return
        try:
            set_time_scale(scene, 0.0 if is_held else time_step_at(scene, coming).time_scale)
        except LayoutError as error:
            if animated:
                raise SimulationError(f"an animated time scale cannot be followed, as {error}: remove it") from error
            raise

    def set_substeps(self, last: Frame | None) -> int:
        """Set the sub-steps of the coming frame by the speed of its bodies, if the scene says so; return how many.

        `last` is the frame before it, None where the number is not to change.
        """
        scene = self._scene
        step, farthest_m = time_step_at(scene, scene.frame_current), farthest_per_substep_of(scene)
        if farthest_m is None or last is None:
            return step.substeps_per_frame
        speed_m_s = float(np.sqrt(dot(last.velocities_m_s, last.velocities_m_s).max()))
        gravity = np.array(scene.gravity, float) if scene.use_gravity else np.zeros(3)
        substeps = step.substeps_within(farthest_m, speed_m_s, float(np.sqrt(dot(gravity, gravity))))
        set_substeps(scene, substeps)
        self._has_set_substeps = True
        return substeps

    def release(self) -> None:
        """Leave time and sub-steps to Blender again."""
        release_time(self._scene)
        if self._has_set_substeps:
            set_substeps(self._scene, self._scene.rigidbody_world.substeps_per_frame)
            self._has_set_substeps = False
