"""A moving ground: kept with the scene until a recording moves it, and animated so that it is seen to move."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import bpy
import numpy as np

from ...engineering.ground_motion import GroundRecord, integrated
from ...engineering.timing.timeline import Timeline
from ...errors import SimulationError
from ..bodies import Kind, bodies_of, kind_of
from ..custom_properties import edited, keep, kept_number, kept_series
from .keyframes import key_values

_TIMES = "bda_ground_motion_times_s"
_ACCELERATIONS = "bda_ground_motion_m_s2"
_START = "bda_ground_motion_start_s"


@dataclass(frozen=True, slots=True, eq=False)
class GroundMotionOfScene:
    """A record that moves the ground of a scene from a simulated time on."""

    record: GroundRecord
    start_s: float

    @property
    def end_s(self) -> float:
        """Simulated time from which on the ground rests."""
        return self.start_s + self.record.duration_s


def keep_ground_motion(scene: bpy.types.Scene, record: GroundRecord | None, start_s: float = 0.0) -> None:
    """Keep a record in the scene, and so in its file; with None its ground rests."""
    keep(scene, _TIMES, record and record.times_s.tolist())
    keep(scene, _ACCELERATIONS, record and record.accelerations_m_s2.ravel().tolist())
    keep(scene, _START, record and start_s)


def ground_motion_of(scene: bpy.types.Scene) -> GroundMotionOfScene | None:
    """Return how the ground of a scene moves, None where it rests."""
    if _TIMES not in scene:
        return None
    of_times, of_accelerations = "two or more times that ascend", "three finite numbers for each time of the record"
    times, accelerations = kept_series(scene, _TIMES, of_times), kept_series(scene, _ACCELERATIONS, of_accelerations)
    if len(times) < 2 or not (np.isfinite(times).all() and (np.diff(times) > 0.0).all()):
        raise edited(scene, _TIMES, of_times)
    if len(accelerations) != 3 * len(times) or not np.isfinite(accelerations).all():
        raise edited(scene, _ACCELERATIONS, of_accelerations)
    return GroundMotionOfScene(integrated(times, accelerations.reshape(-1, 3)), kept_number(scene, _START, 0.0))


def move_with_ground(
    scene: bpy.types.Scene, record: GroundRecord, start_s: float, frame: int, timeline: Timeline
) -> None:
    """Animate the ground and all bodies that are fixed to it, from the frame of the time 0 on.

    Blender moves them in straight lines between two frames; a recording moves them in every sub-step.
    """
    times = np.concatenate(([0.0], timeline.ends_s))
    shifts = np.array([record.displacement_at(time_s - start_s) for time_s in times.tolist()])
    first = None
    for body in filter(_is_fixed, bodies_of(scene)):
        body.rigid_body.kinematic = True
        if first is None:
            key_values(body, "delta_location", frame + np.arange(len(times)), shifts)
            first = body.animation_data
        else:  # one action moves them all
            animation = body.animation_data_create()
            animation.action = first.action
            if hasattr(animation, "action_slot"):
                animation.action_slot = first.action_slot


def rows_on_moving_ground(bodies: Sequence[bpy.types.Object]) -> np.ndarray:
    """Return which of the bodies (r,) move with the ground."""
    rows = [row for row, body in enumerate(bodies) if _is_fixed(body) and body.rigid_body.kinematic]
    if not rows:
        raise SimulationError("the ground is to move, and no body of it is left: build the scenario again")
    return np.array(rows)


def _is_fixed(body: bpy.types.Object) -> bool:
    """Return whether a body is the ground or a support."""
    return body.rigid_body.type == "PASSIVE" and kind_of(body) in (Kind.GROUND, Kind.SHARD)
