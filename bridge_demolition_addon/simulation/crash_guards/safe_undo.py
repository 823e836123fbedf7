"""Undo and redo in the middle of a simulation, without a crash.

Blender's undo reads changed objects again and keeps everything else. It frees the Bullet bodies of changed objects,
while the world that it keeps still holds them, and crashes at the next step. Its older undo (a preference for
developers, "Undo Legacy") reads the whole file again, world included. So wherever there is a rigid-body world, undo and
redo use the older way, and the preferences are restored afterwards.

After that no body has a position in Bullet, and a simulation cannot go on from the middle: undo ends at the start
frame.

The older undo replaces Blender's data, but scenes linked from other files still use copies of the former data, and
Blender crashes when it next plays them. So where such a scene has been shown, undo works in Blender's own way, and the
worlds of demolitions stand still after it.
"""

from __future__ import annotations

import bpy

_LEGACY, _DEVELOPER, _CHANGED = "use_undo_legacy", "show_developer_ui", "is_dirty"

_before: dict[str, bool] = {}
"""The user's preferences, while they are changed."""


def needs_older_way() -> bool:
    """Return whether undo and redo have to use the older way now."""
    scenes = bpy.data.scenes
    return any(scene.rigidbody_world for scene in scenes) and not any(map(_is_linked_and_shown, scenes))


def before_undo() -> None:
    """Make the coming undo or redo use the older way, if it has to."""
    if _before or not needs_older_way():
        return
    preferences = bpy.context.preferences
    _before[_DEVELOPER] = preferences.view.show_developer_ui
    _before[_LEGACY] = preferences.experimental.use_undo_legacy
    _before[_CHANGED] = preferences.is_dirty
    preferences.view.show_developer_ui = True  # without it Blender ignores the other
    preferences.experimental.use_undo_legacy = True
    # Blender calls no handler where an undo fails half way.
    bpy.app.timers.register(_restore, persistent=True)


def after_undo() -> None:
    """Restore the preferences and go to the start frame."""
    if not _before:
        return
    _restore()
    for scene in bpy.data.scenes:
        world = scene.rigidbody_world
        if world and not world.point_cache.is_baked and scene.frame_current > world.point_cache.frame_start:
            scene.frame_set(world.point_cache.frame_start)


def restore_preferences() -> None:
    """Restore the preferences, whether or not the undo has ended."""
    if bpy.app.timers.is_registered(_restore):
        bpy.app.timers.unregister(_restore)
    _restore()


def _is_linked_and_shown(scene: bpy.types.Scene) -> bool:
    return scene.library is not None and any(layer.depsgraph for layer in scene.view_layers)


def _restore() -> None:
    if not _before:
        return
    preferences = bpy.context.preferences
    preferences.view.show_developer_ui = _before[_DEVELOPER]
    preferences.experimental.use_undo_legacy = _before[_LEGACY]
    preferences.is_dirty = _before[_CHANGED]
    _before.clear()
