"""Blender's handlers that drive a recording. They are there while one runs, and never raise."""

from __future__ import annotations

import atexit
from collections.abc import Callable

import bpy
from bpy.app.handlers import persistent

from ...core.errors import SimulationError
from ..crash_guards.callbacks import Callbacks
from .recorder import Recording

_current: Recording | None = None
_latest: Recording | None = None
_rendering = False


def start(recording: Recording) -> None:
    """Let a recording follow its scene's timeline, in place of one that may still run."""
    global _current, _latest, _rendering
    stop()
    _rendering = False
    _current = _latest = recording
    _callbacks.attach(first=True)  # before those that look at what is recorded


def stop() -> Recording | None:
    """End the running recording, take our handlers away, and give the recording back."""
    global _current
    _callbacks.detach()
    recording, _current = _current, None
    if recording and not recording.error:
        recording.close()
    return recording


def current() -> Recording | None:
    """The recording that runs now."""
    return _current


def latest() -> Recording | None:
    """The recording that runs now, or else ran last; its scene may be gone by now."""
    return _latest


def forget(scene: bpy.types.Scene) -> None:
    """Let go of the recording that ran last, if it is of a scene that holds something else from now on."""
    global _latest
    if _latest and _latest is not _current and _latest.scene_uid == scene.session_uid:
        _latest = None


@persistent
def _before_frame(scene: bpy.types.Scene, _depsgraph: bpy.types.Depsgraph | None = None) -> None:
    _follow(scene, _refuse_to_record_a_render)
    _follow(scene, lambda recording: recording.before_frame())


@persistent
def _after_frame(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    _follow(scene, lambda recording: recording.after_frame(depsgraph))


@persistent
def _before_update(scene: bpy.types.Scene, _depsgraph: bpy.types.Depsgraph | None = None) -> None:
    _follow(scene, lambda recording: recording.before_update())


@persistent
def _before_upheaval(*_: object) -> None:
    """Undo, redo and loading a file free what a recording looks at: it ends while that is still there."""
    if _current and not _current.error:
        _current.fail(SimulationError("undo, redo or loading a file took away what was recorded"))


@persistent
def _before_render(*_: object) -> None:
    global _rendering
    _rendering = True


@persistent
def _after_render(*_: object) -> None:
    global _rendering
    _rendering = False


def _refuse_to_record_a_render(recording: Recording) -> None:
    """A render simulates in copies and a thread of its own; what was played before it plays back."""
    if _rendering and not recording.has_frame(recording.scene.frame_current):
        raise SimulationError("a render went beyond the frames that were recorded: play the timeline, then render it")


def _follow(scene: bpy.types.Scene, action: Callable[[Recording], None]) -> None:
    if _current is None or _current.error or scene != _current.scene:
        return
    try:
        action(_current)
    except Exception as error:  # an exception in a handler would be lost in the console: the recording keeps it
        _current.fail(error)


_callbacks = Callbacks(
    frame_change_pre=_before_frame,
    frame_change_post=_after_frame,
    depsgraph_update_pre=_before_update,
    load_pre=_before_upheaval,
    undo_pre=_before_upheaval,
    redo_pre=_before_upheaval,
    render_init=_before_render,
    render_complete=_after_render,
    render_cancel=_after_render,
)

atexit.register(stop)
