"""The scene's rigid-body world, the collections of its bodies and connections, and how it cuts time into sub-steps."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np

from ..engineering.timing.timeline import Timeline, TimeStep
from ..engineering.units import STANDARD_GRAVITY_M_S2
from ..model.scenario import TimeSettings
from ..model.scenario.time import PASSES
from .custom_properties import keep, kept_number
from .tools.keyframes import curves_of

START_FRAME = 1

FIRST_STEP_FRAME = START_FRAME + 2
"""First frame that time leads to: in the frame before, Blender makes the world and no time passes."""

_OF_SCENE = ("gravity", "frame_start", "frame_end")
_OF_UNITS = ("system", "scale_length")
_OF_RENDERING = ("fps", "fps_base", "use_lock_interface")
"""Settings of the scene, its units and its rendering that `create_world` changes."""

_OURS = "bda_"
"""How the names of the add-on's properties of a scene begin."""

_FARTHEST_PER_SUBSTEP = "bda_farthest_per_substep_m"


def create_world(scene: bpy.types.Scene, settings: TimeSettings, last_frame: int) -> bpy.types.RigidBodyWorld:
    """Give a scene a rigid-body world, over the frames from `START_FRAME` to `last_frame`."""
    scene.unit_settings.system = "METRIC"
    scene.unit_settings.scale_length = 1.0
    scene.gravity = (0.0, 0.0, -STANDARD_GRAVITY_M_S2)
    scene.render.fps = settings.frames_per_second
    scene.render.fps_base = settings.frames_per_second_base
    scene.frame_start, scene.frame_end = START_FRAME, last_frame
    scene.render.use_lock_interface = True  # a render and the window would step one and the same Bullet world
    scene.frame_set(START_FRAME)
    with bpy.context.temp_override(scene=scene):
        bpy.ops.rigidbody.world_add()
    world = scene.rigidbody_world
    world.substeps_per_frame = settings.substeps_per_frame
    world.solver_iterations = settings.solver_iterations or PASSES
    keep(scene, _FARTHEST_PER_SUBSTEP, settings.farthest_per_substep_m)
    world.use_split_impulse = settings.split_impulse
    world.time_scale = settings.time_scale
    world.point_cache.frame_start, world.point_cache.frame_end = START_FRAME, last_frame
    world.collection = bpy.data.collections.new("Bodies")
    world.constraints = bpy.data.collections.new("Connections")
    scene.collection.children.link(world.collection)
    scene.collection.children.link(world.constraints)
    return world


@contextmanager
def settings_restored_on_failure(scene: bpy.types.Scene) -> Iterator[None]:
    """Give a scene back its gravity, units, frames and kept properties where the block fails."""
    groups = ((scene, _OF_SCENE), (scene.unit_settings, _OF_UNITS), (scene.render, _OF_RENDERING))
    settings = [(group, name, _copied(getattr(group, name))) for group, names in groups for name in names]
    kept = _kept_properties(scene)
    frame, part = scene.frame_current, scene.frame_subframe
    try:
        yield
    except BaseException:
        for group, name, value in settings:
            setattr(group, name, value)
        for name in _kept_properties(scene):
            del scene[name]
        for name, value in kept.items():
            scene[name] = value
        scene.frame_set(frame, subframe=part)
        raise


def _kept_properties(scene: bpy.types.Scene) -> dict[str, Any]:
    return {name: _copied(value) for name, value in scene.items() if name.startswith(_OURS)}


def _copied(value: Any) -> Any:
    """Return a copy of a value: Blender's arrays show what they are changed to."""
    return value if isinstance(value, str | int | float) else tuple(value)


def remove_world(scene: bpy.types.Scene) -> None:
    """Remove the scene's rigid-body world, if it has one, with its empty collections."""
    world = scene.rigidbody_world
    if world is None:
        return
    collections = (world.collection, world.constraints)
    empty = [collection for collection in collections if collection and not collection.all_objects]
    with bpy.context.temp_override(scene=scene):
        bpy.ops.rigidbody.world_remove()
    bpy.data.batch_remove(empty)


def scene_time_step(scene: bpy.types.Scene) -> TimeStep:
    """Return the length of frames and sub-steps that the scene has now."""
    world = scene.rigidbody_world
    return TimeStep(scene.render.fps, scene.render.fps_base, world.substeps_per_frame, world.time_scale)


def farthest_per_substep_of(scene: bpy.types.Scene) -> float | None:
    """Return how far a body may go in one sub-step before frames have more of them, m; None where they never do."""
    return kept_number(scene, _FARTHEST_PER_SUBSTEP, 0.0) or None


def start_over(scene: bpy.types.Scene) -> None:
    """Go to the start frame, and have Blender simulate frames again that it would play back."""
    world = scene.rigidbody_world
    world.substeps_per_frame = world.substeps_per_frame  # Blender takes any setting for a change
    scene.frame_set(world.point_cache.frame_start)


def keep_played_frames(scene: bpy.types.Scene) -> None:
    """Turn the frames played so far into a bake, which is saved with the file and played back as it was.

    Without it Blender simulates a loaded file again, and then nothing lets the bodies of broken connections collide.
    """
    scene.frame_set(START_FRAME)
    with bpy.context.temp_override(scene=scene, point_cache=scene.rigidbody_world.point_cache):
        bpy.ops.ptcache.bake_from_cache()


@contextmanager
def off_scene(scene: bpy.types.Scene) -> Iterator[tuple[bpy.types.Collection, bpy.types.Collection]]:
    """Take the collections of bodies and connections off the scene while many objects are linked to them.

    Objects linked to them become bodies or connections of the scene's world all the same. But for every link to a
    collection that a scene shows, Blender goes through all its objects: the time grows with the square of their number.
    """
    both = (scene.rigidbody_world.collection, scene.rigidbody_world.constraints)
    shown = [collection for collection in both if collection in scene.collection.children[:]]
    for collection in shown:
        scene.collection.children.unlink(collection)
    try:
        yield both
    finally:
        for collection in shown:
            scene.collection.children.link(collection)


def evaluated_scenes(scene: bpy.types.Scene) -> list[bpy.types.Scene]:
    """Return Blender's evaluated copies of a scene with a rigid-body world, one for each evaluated view layer."""
    graphs = [layer.depsgraph for layer in scene.view_layers if layer.depsgraph]
    return [graph.scene_eval for graph in graphs if graph.scene_eval and graph.scene_eval.rigidbody_world]


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
