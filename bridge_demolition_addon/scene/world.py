"""The scene's rigid-body world, its time, and the collections that its bodies and connections live in."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy

from ..engineering.timing.timeline import TimeStep
from ..engineering.units import STANDARD_GRAVITY_M_S2
from ..model.scenario import TimeSettings
from ..model.scenario.time import PASSES
from .custom_properties import keep, kept_number

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
    """Remove the scene's rigid-body world, if it has one, with those of its collections that are empty."""
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
