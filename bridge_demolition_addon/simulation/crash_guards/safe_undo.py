"""Undo and redo in the middle of a simulation, without a crash.

Blender's undo reads what has changed anew and keeps everything else. It frees the Bullet bodies of changed objects,
while the world that it keeps still holds them, and crashes at the next step. Its older undo (a preference for
developers, "Undo Legacy") reads the whole file anew, world included. So wherever there is a rigid-body world, undo and
redo go the older way, and the preferences are as before when they are done.

No body has a place in Bullet after that, and a simulation cannot go on from the middle: undo ends at the start frame.
"""

from __future__ import annotations

import atexit

import bpy
from bpy.app.handlers import persistent

from .callbacks import Callbacks

_LEGACY, _DEVELOPER, _CHANGED = "use_undo_legacy", "show_developer_ui", "is_dirty"

_before: dict[str, bool] = {}
"""The person's preferences, while they are not as the person left them."""


def register() -> None:
    """Make undo and redo safe from now on."""
    _callbacks.attach()


def unregister() -> None:
    """Leave undo to Blender."""
    _callbacks.detach()
    if bpy.app.timers.is_registered(_restore_preferences):
        bpy.app.timers.unregister(_restore_preferences)
    _restore_preferences()


@persistent
def _before_undo(*_: object) -> None:
    if _before or not any(scene.rigidbody_world for scene in bpy.data.scenes):
        return
    preferences = bpy.context.preferences
    _before[_DEVELOPER] = preferences.view.show_developer_ui
    _before[_LEGACY] = preferences.experimental.use_undo_legacy
    _before[_CHANGED] = preferences.is_dirty
    preferences.view.show_developer_ui = True  # without it Blender ignores the other
    preferences.experimental.use_undo_legacy = True
    # If undo fails half way, nobody tells.
    bpy.app.timers.register(_restore_preferences, persistent=True)


@persistent
def _after_undo(*_: object) -> None:
    if not _before:
        return
    _restore_preferences()
    for scene in bpy.data.scenes:
        world = scene.rigidbody_world
        if world and not world.point_cache.is_baked and scene.frame_current > world.point_cache.frame_start:
            scene.frame_set(world.point_cache.frame_start)


def _restore_preferences() -> None:
    if not _before:
        return
    preferences = bpy.context.preferences
    preferences.view.show_developer_ui = _before[_DEVELOPER]
    preferences.experimental.use_undo_legacy = _before[_LEGACY]
    preferences.is_dirty = _before[_CHANGED]
    _before.clear()


_callbacks = Callbacks(undo_pre=_before_undo, redo_pre=_before_undo, undo_post=_after_undo, redo_post=_after_undo)

atexit.register(_restore_preferences)
