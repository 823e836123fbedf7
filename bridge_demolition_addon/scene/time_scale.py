"""How a scene cuts time into frames and sub-steps, and its time scale, animated where frames differ in length."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np

from ..engineering.timing.timeline import Timeline, TimeStep
from .tools.keyframes import curves_of
from .world import FIRST_STEP_FRAME, START_FRAME, farthest_per_substep_of, scene_time_step

_PATH = "rigidbody_world.time_scale"
_SINGLE = 1e-6
"""Relative difference that only comes from Blender's single precision, in which it keeps frame rate and speed."""


@dataclass(frozen=True, slots=True, eq=False)
class TimeOfScene:
    """How a run cuts time: settings as of `time_settings`, and the step of the start frame.

    Attributes
    ----------
    farthest_per_substep_m
        How far a body may go in one sub-step before frames have more of them; None where they never do.
    is_animated
        Whether frames may differ in length.
    frame_lengths_s : (f,) float
        Simulated time of each frame that is played, from `FIRST_STEP_FRAME` on.
    """

    settings: dict[str, Any]
    step: TimeStep
    farthest_per_substep_m: float | None
    start_frame: int
    last_frame: int
    is_animated: bool
    frame_lengths_s: np.ndarray


def time_of(scene: bpy.types.Scene) -> TimeOfScene:
    """Read how a scene cuts time."""
    cache = scene.rigidbody_world.point_cache
    last_frame, is_animated = min(scene.frame_end, cache.frame_end), time_is_animated(scene)
    frames = range(FIRST_STEP_FRAME, last_frame + 1)
    if is_animated:
        lengths_s = np.array([time_step_at(scene, frame).frame_s for frame in frames], float)
    else:
        lengths_s = np.full(len(frames), scene_time_step(scene).frame_s)
    step, farthest_m = time_step_at(scene, cache.frame_start), farthest_per_substep_of(scene)
    return TimeOfScene(time_settings(scene), step, farthest_m, cache.frame_start, last_frame, is_animated, lengths_s)


def time_settings(scene: bpy.types.Scene) -> dict[str, Any]:
    """Return how a scene cuts time, by the keys of a scenario; not its speed where that is animated."""
    world = scene.rigidbody_world
    settings = {
        "frames_per_second": scene.render.fps,
        "frames_per_second_base": scene.render.fps_base,
        "substeps_per_frame": world.substeps_per_frame,
        "farthest_per_substep_m": farthest_per_substep_of(scene),
        "solver_iterations": world.solver_iterations,
        "split_impulse": world.use_split_impulse,
        "time_scale": world.time_scale,
    }
    if time_is_animated(scene):
        del settings["time_scale"]
    return settings


def animate_time_scale(scene: bpy.types.Scene, timeline: Timeline, first_frame: int) -> None:
    """Give every frame its length, from the first that time leads to; frames of one length need no animation."""
    world = scene.rigidbody_world
    normal = world.time_scale
    scales = timeline.frame_lengths_s * scene.render.fps / scene.render.fps_base
    if np.allclose(scales, normal, rtol=_SINGLE):
        return
    changes = np.flatnonzero(np.diff(scales, prepend=np.nan))
    # No time passes before the first step, in the frame in which Blender makes its world.
    keys = {START_FRAME: normal, START_FRAME + 1: 0.0} | {first_frame + row: scales[row] for row in changes.tolist()}
    for frame, scale in keys.items():
        world.time_scale = scale
        scene.keyframe_insert(_PATH, frame=frame)
    curve = _curve(scene)
    for point in curve.keyframe_points if curve else ():
        point.interpolation = "CONSTANT"
    world.time_scale = normal


def stop_animation(scene: bpy.types.Scene) -> None:
    """Give all frames the same length."""
    curve = _curve(scene)
    if curve:
        for frame in [point.co.x for point in curve.keyframe_points]:
            scene.keyframe_delete(_PATH, frame=frame)


def time_is_animated(scene: bpy.types.Scene) -> bool:
    """Return whether frames may differ in length."""
    return _curve(scene) is not None


def time_step_at(scene: bpy.types.Scene, frame: int) -> TimeStep:
    """Return the length of a frame and of its sub-steps."""
    step = scene_time_step(scene)
    curve = _curve(scene)
    if curve is None:
        return step
    scale = curve.evaluate(frame)
    return TimeStep(step.frames_per_second, step.frames_per_second_base, step.substeps_per_frame, scale)


def simulated_time_s(scene: bpy.types.Scene, first_frame: int) -> float:
    """Return the simulated time of the present frame, s; time leads to the first frame and to all after it."""
    frames = range(first_frame, scene.frame_current + 1)
    if not time_is_animated(scene):
        return len(frames) * scene_time_step(scene).frame_s
    return math.fsum(time_step_at(scene, frame).frame_s for frame in frames)


def _curve(scene: bpy.types.Scene) -> bpy.types.FCurve | None:
    """Return the curve of the scene's time scale, None where it is not animated."""
    animation = scene.animation_data
    if animation is None or animation.action is None:
        return None
    return next((curve for curve in curves_of(animation) if curve.data_path == _PATH), None)
