"""Setting how much time passes in the coming frame.

Blender makes its Bullet world and takes the first step at once, before anything can be read from that world. With a
time scale of 0 it makes the world and takes no step. And where the time scale is animated, Blender may simulate a frame
before it has animated it: its order of work does not forbid that.

So the time scale is written before each such frame, into the evaluated copy of the scene only: setting it through
Python would change the user's scene, and mark the point cache as outdated, so that nothing could be played back.
"""

from __future__ import annotations

import bpy

from ..errors import LayoutError
from ..scene.world import evaluated_scenes
from . import checks
from .layout import platform_layout
from .memory import FLOATS, SHORTS, read_value

_NEVER = -2_000_000.0
"""No frame comes after this one: Blender's first is -1 048 574."""


def set_time_scale(scene: bpy.types.Scene, time_scale: float) -> None:
    """Let the coming frame have a time scale; with 0 no simulated time passes in it.

    Raises a `LayoutError` if memory is not as expected; then nothing has been written.
    """
    for world in _evaluated_worlds(scene):
        _write_time_scale(world, time_scale)


def set_substeps(scene: bpy.types.Scene, substeps: int) -> None:
    """Let the coming frame have so many sub-steps."""
    for world in _evaluated_worlds(scene):
        SHORTS.write(_field(world, "world_substeps"), substeps)


def time_stands_still(depsgraph: bpy.types.Depsgraph) -> bool:
    """Whether no simulated time passed in the frame that a dependency graph was evaluated for."""
    return depsgraph.scene_eval.rigidbody_world.time_scale == 0.0


def release_time(scene: bpy.types.Scene) -> None:
    """Let time pass again as the scene says."""
    for world in _evaluated_worlds(scene):
        if world.time_scale == 0.0:
            _write_time_scale(world, scene.rigidbody_world.time_scale)


def stop_time(scene: bpy.types.Scene) -> None:
    """Let Blender take no step until the start frame: it simulates only the frame that follows on its last one.

    Unlike a time scale of 0 this outlasts animation, and an update of the scene's evaluated copy. Raises a
    `LayoutError` if memory is not as expected; then nothing has been written.
    """
    for world in _evaluated_worlds(scene):
        field = _field(world, "world_last_frame")
        last = read_value(field, "f")
        if last != _NEVER and not (abs(last) < -_NEVER and last == int(last)):
            raise LayoutError(f"last frame of the world is {last:g}")
        FLOATS.write(field, _NEVER)


def _evaluated_worlds(scene: bpy.types.Scene) -> list[bpy.types.RigidBodyWorld]:
    return [evaluated.rigidbody_world for evaluated in evaluated_scenes(scene)]


def _write_time_scale(world: bpy.types.RigidBodyWorld, time_scale: float) -> None:
    FLOATS.write(_field(world, "world_time_scale"), time_scale)


def _field(world: bpy.types.RigidBodyWorld, name: str) -> int:
    """Address of a field of Blender's world, which is checked."""
    layout = platform_layout()
    checks.check_settings(layout, world)
    return int(world.as_pointer() + getattr(layout.blender, name))
