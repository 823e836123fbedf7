"""A sentence where undo has put the timeline to its start frame.

Undo makes another world of rigid bodies, which knows no frame but its first: going on from the middle would crash
Blender, so `simulation.crash_guards.safe_undo` goes back.
"""

from __future__ import annotations

import bpy
from bpy.app.handlers import persistent

from ...simulation.blender_events import shown_results
from ..languages.words import translated
from ..stages.shown import show_checked

_frames_before: dict[int, int] = {}
"""The frame of each scene as an undo or redo begins, by the scene's number of this session."""

_put_back: dict[int, int] = {}
"""The start frame of scenes whose timeline was put there."""


def undo_note(scene: bpy.types.Scene) -> str:
    """Return the sentence as long as the timeline stays where undo has put it; empty otherwise."""
    if scene.rigidbody_world and _put_back.get(scene.session_uid) == scene.frame_current:
        if shown_results(scene).are_loaded:
            return translated("Undo put the timeline to its start: it plays what was recorded")
        return translated("Undo began the simulation again: the timeline is at its start, and plays as before")
    _put_back.pop(scene.session_uid, None)
    return ""


@persistent
def _before(*_: object) -> None:
    _frames_before.clear()
    _frames_before.update((scene.session_uid, scene.frame_current) for scene in bpy.data.scenes)


@persistent
def _after(*_: object) -> None:
    for scene in bpy.data.scenes:
        show_checked(scene)
        world, before = scene.rigidbody_world, _frames_before.get(scene.session_uid)
        if world and before is not None and before > scene.frame_current == world.point_cache.frame_start:
            _put_back[scene.session_uid] = scene.frame_current


_HANDLERS = {"undo_pre": _before, "redo_pre": _before, "undo_post": _after, "redo_post": _after}


def register() -> None:
    """Follow undo; to be called after the guards of the simulation, which put the timeline back."""
    for name, handler in _HANDLERS.items():
        getattr(bpy.app.handlers, name).append(handler)


def unregister() -> None:
    """Follow it no longer."""
    for name, handler in _HANDLERS.items():
        getattr(bpy.app.handlers, name).remove(handler)
    _frames_before.clear()
    _put_back.clear()
