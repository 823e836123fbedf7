"""One handler for each of Blender's events: it passes the event on to the owner of the scene, a `RecordedScene`.

The handlers are there while the add-on is on, or a scene is recorded, coloured or guarded without it.
"""

from __future__ import annotations

import atexit
from collections.abc import Callable

import bpy
from bpy.app.handlers import persistent

from .crash_guards import safe_undo
from .display.contours import ContourDisplay
from .display.shown_results import ShownResults
from .recorded_scene import RecordedScene
from .recording.recorder import Recording

_scenes: dict[int, RecordedScene] = {}
"""Owners by the numbers that scenes have as long as Blender runs."""

_is_registered = False


def register() -> None:
    """Follow all scenes from now on."""
    global _is_registered
    _is_registered = True
    _attach()
    _look_at_all()


def unregister() -> None:
    """End the work in all scenes, and remove the handlers."""
    global _is_registered
    _is_registered = False
    stop_recording()
    _after_render()
    _let_go()
    _scenes.clear()
    safe_undo.restore_preferences()
    _detach()


def recorded_scene(scene: bpy.types.Scene) -> RecordedScene:
    """Return the owner of a scene, which events of the scene reach from now on."""
    _attach()
    owner = _scenes.get(scene.session_uid)
    if owner is None:
        owner = _scenes[scene.session_uid] = RecordedScene(scene)
    owner.scene = owner.results.scene = scene  # after undo Blender holds it elsewhere
    return owner


def contours_of(scene: bpy.types.Scene) -> ContourDisplay:
    """Return the contours of a scene."""
    return recorded_scene(scene).contours


def shown_results(scene: bpy.types.Scene) -> ShownResults:
    """Return the results that are shown in a scene."""
    return recorded_scene(scene).results


def start_recording(recording: Recording, *, alone: bool = False) -> None:
    """Let a recording follow its scene's timeline, in place of one that may still run.

    Alone, in a process in which the scene cannot be edited, it is not guarded.
    """
    stop_recording()
    recorded_scene(recording.scene).start(recording, alone=alone)


def stop_recording() -> Recording | None:
    """End the recording that runs, and return it."""
    owner = next((scene for scene in list(_scenes.values()) if scene.recording), None)
    recording = owner.stop() if owner else None
    if not _is_registered and not any(scene.is_at_work for scene in list(_scenes.values())):
        _let_go()
        _detach()
    return recording


def running_recording() -> Recording | None:
    """Return the recording that runs, or ended early and was not stopped yet."""
    return next((scene.recording for scene in list(_scenes.values()) if scene.recording), None)


def _let_go() -> None:
    """Release every scene's world before Blender frees them, or while events still show that it does."""
    for owner in list(_scenes.values()):
        owner.before_undo_or_load()


def _look_at_all() -> None:
    """Take over every scene's world; while Blender switches the add-on on, it names only those that are shown."""
    shown = [window.scene for window in bpy.context.window_manager.windows]
    for scene in getattr(bpy.data, "scenes", shown):
        recorded_scene(scene).look()


def _of_scene(act: Callable[..., None], *, with_depsgraph: bool = False) -> Callable[..., None]:
    """Return the handler of an event that concerns one scene: a method of its owner."""

    @persistent
    def handler(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph | None = None) -> None:
        act(recorded_scene(scene), *([depsgraph] if with_depsgraph else ()))

    return handler


@persistent
def _after_render(*_: object) -> None:
    for owner in list(_scenes.values()):
        owner.after_render()


@persistent
def _before_undo(*_: object) -> None:
    worlds_stay = not safe_undo.needs_older_way()
    for owner in list(_scenes.values()):
        owner.before_undo_or_load(world_stays=worlds_stay)
    safe_undo.before_undo()


@persistent
def _after_undo(*_: object) -> None:
    safe_undo.after_undo()
    for scene in bpy.data.scenes:
        recorded_scene(scene).after_undo()


@persistent
def _before_load(*_: object) -> None:
    for uid, owner in list(_scenes.items()):
        owner.before_undo_or_load()
        owner.contours.settings = None
        if not owner.recording:  # which waits to be stopped, and its results to be written
            del _scenes[uid]


@persistent
def _after_load(*_: object) -> None:
    for scene in bpy.data.scenes:
        recorded_scene(scene).after_load()


@persistent
def _after_failed_load(*_: object) -> None:
    _look_at_all()


_HANDLERS = {
    "frame_change_pre": _of_scene(RecordedScene.before_frame),
    "frame_change_post": _of_scene(RecordedScene.after_frame, with_depsgraph=True),
    "depsgraph_update_pre": _of_scene(RecordedScene.before_update),
    "depsgraph_update_post": _of_scene(RecordedScene.after_update, with_depsgraph=True),
    "render_init": _of_scene(RecordedScene.before_render),
    "render_complete": _after_render,
    "render_cancel": _after_render,
    "undo_pre": _before_undo,
    "redo_pre": _before_undo,
    "undo_post": _after_undo,
    "redo_post": _after_undo,
    "load_pre": _before_load,
    "load_post": _after_load,
    "load_post_fail": _after_failed_load,
}


def _attach() -> None:
    for name, handler in _HANDLERS.items():
        handlers = getattr(bpy.app.handlers, name)
        if handler not in handlers:
            handlers.append(handler)


def _detach() -> None:
    for name, handler in _HANDLERS.items():
        handlers = getattr(bpy.app.handlers, name)
        if handler in handlers:
            handlers.remove(handler)


atexit.register(unregister)  # Blender's own end may hang or crash where handlers are left
