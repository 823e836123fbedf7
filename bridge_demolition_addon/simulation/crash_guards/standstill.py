"""Worlds that stand still: something was taken out of them, and Blender would crash if it went on simulating.

Time stops in such a scene until its start frame, where Blender makes a new world. Everything else of the scene can be
played and edited meanwhile.
"""

from __future__ import annotations

import atexit

import bpy
from bpy.app.handlers import persistent

from ...bullet.time_control import stop_time
from ...bullet.world import BulletWorld
from ...core.errors import LayoutError
from .callbacks import Callbacks

_standing_still: set[int] = set()
"""Scenes, by the numbers that stay theirs while Blender runs."""


def stand_still(scene: bpy.types.Scene, world: BulletWorld) -> None:
    """Let a scene's world stand still up to the start frame; to be called before Blender frees what was removed.

    Where memory is not as expected, Blender is left to itself.
    """
    try:
        world.retire()
        stop_time(scene)
    except LayoutError:
        return
    _standing_still.add(scene.session_uid)
    _callbacks.attach()


def stands_still(scene: bpy.types.Scene) -> bool:
    """Whether a scene is not simulated until its start frame."""
    return scene.session_uid in _standing_still


def forget() -> None:
    """Leave all scenes to Blender, and take our handler away."""
    _standing_still.clear()
    _callbacks.detach()


@persistent
def _before_frame(scene: bpy.types.Scene, _depsgraph: bpy.types.Depsgraph | None = None) -> None:
    if not stands_still(scene):
        return
    world = scene.rigidbody_world
    if world and scene.frame_current > world.point_cache.frame_start:
        try:
            stop_time(scene)  # Blender takes frames out of its cache, and counts on from there
            return
        except LayoutError:
            pass  # a new world, and none of ours
    _standing_still.discard(scene.session_uid)
    if not _standing_still:
        forget()


_callbacks = Callbacks(frame_change_pre=_before_frame)

atexit.register(forget)
