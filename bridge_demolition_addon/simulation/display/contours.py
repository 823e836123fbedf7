"""Contours that follow the timeline: of the recording that runs, of the one that ran last, or of loaded results.

The handlers are there while any scene shows contours, and never raise. In a render they run in the render's thread,
and write into the render's own copies of the bodies alone.
"""

from __future__ import annotations

import atexit
from dataclasses import dataclass

import bpy
import numpy as np
from bpy.app.handlers import persistent

from ...core.display.contours import ContourFrame, ContourSeries, ContourSettings
from ...core.errors import ContourError
from ...core.results.arrays import Results
from ...scene.bodies import bodies_of
from ...scene.rendering.body_colours import colours_are_shown, paint, place, show_colours, show_materials, unpaint
from ..crash_guards.callbacks import Callbacks
from ..recording import handlers
from ..recording.recorder import Recording


@dataclass(slots=True)
class _Show:
    """What is shown in a scene, and why it cannot be."""

    settings: ContourSettings
    error: Exception | None = None


_shows: dict[int, _Show] = {}
_loaded: dict[int, tuple[ContourSeries, Recording | None]] = {}
"""Series of loaded results, and the recording that was the latest when they were loaded."""
_recorded: dict[int, ContourSeries] = {}


def show(scene: bpy.types.Scene, settings: ContourSettings) -> None:
    """Colour the scene's bodies from now on, whatever frame is gone to."""
    _shows[scene.session_uid] = _Show(settings)
    if not colours_are_shown(scene):
        show_colours(scene)
    _callbacks.attach()
    refresh(scene)


def hide(scene: bpy.types.Scene) -> None:
    """Give the scene's bodies their own colours and materials back."""
    _shows.pop(scene.session_uid, None)
    show_materials(scene)
    unpaint(scene)
    if not _shows:
        stop()


def stop() -> None:
    """Take the handlers away."""
    _shows.clear()
    _callbacks.detach()


def is_shown(scene: bpy.types.Scene) -> bool:
    """Whether the scene's bodies are coloured."""
    return scene.session_uid in _shows


def settings_of(scene: bpy.types.Scene) -> ContourSettings | None:
    """What is shown, or None."""
    shown = _shows.get(scene.session_uid)
    return shown.settings if shown else None


def error_of(scene: bpy.types.Scene) -> Exception | None:
    """Why the scene's bodies could not be coloured."""
    shown = _shows.get(scene.session_uid)
    return shown.error if shown else None


def refresh(scene: bpy.types.Scene) -> None:
    """Colour the bodies of the current frame now."""
    for layer in scene.view_layers:
        if layer.depsgraph:
            _paint(scene, layer.depsgraph)


def use_results(scene: bpy.types.Scene, results: Results) -> None:
    """Show contours of results that were kept, until something new is recorded.

    Raises
    ------
    ContourError
        None of the bodies is in the scene.
    """
    world = scene.rigidbody_world
    there = {body.name for body in bodies_of(scene)} if world and world.collection else set()
    names = results.inventory.body_names.tolist()
    if there.isdisjoint(names):
        raise ContourError(
            f"results: none of their {len(names)} bodies is in scene {scene.name!r}; open the scene "
            "that they were recorded in, or build it from the same scenario"
        )
    _loaded[scene.session_uid] = (ContourSeries.of_results(results), handlers.latest())


def forget(scene: bpy.types.Scene) -> None:
    """Let go of what was recorded or loaded of a scene."""
    handlers.forget(scene)
    _loaded.pop(scene.session_uid, None)
    _recorded.pop(scene.session_uid, None)


def forget_all() -> None:
    """Let go of everything that was recorded or loaded."""
    _loaded.clear()
    _recorded.clear()


def series_of(scene: bpy.types.Scene) -> ContourSeries | None:
    """What there is to show of a scene, up to the latest frame; None where nothing was recorded."""
    uid, latest = scene.session_uid, handlers.latest()
    series, known = _loaded.get(uid, (None, None))
    if series is not None and known is latest:
        return series
    if latest is None or latest.scene_uid != uid:
        return None
    return _followed(uid, latest)


def shown_frame(scene: bpy.types.Scene) -> tuple[ContourFrame, int] | None:
    """The current frame as it is shown, and its row in the series; None where nothing was recorded."""
    shown, series = _shows.get(scene.session_uid), series_of(scene)
    row = series.row_at(scene.frame_current) if series else None
    if shown is None or row is None:
        return None
    return series.show(row, shown.settings), row


def is_placed(scene: bpy.types.Scene) -> bool:
    """Whether bodies are shown where they were recorded, as Blender has forgotten the frames it played."""
    recording, world = handlers.current(), scene.rigidbody_world
    if recording and recording.scene_uid == scene.session_uid:
        return False
    is_of_file = scene.session_uid in _loaded and series_of(scene) is _loaded[scene.session_uid][0]
    return is_of_file or bool(world and world.point_cache.is_outdated) or not (world and world.enabled)


def _followed(uid: int, recording: Recording) -> ContourSeries | None:
    """The series of a recording, with the frames that came since the last look."""
    frames, series = recording.frames, _recorded.get(uid)
    if not frames:
        return None
    count = len(series) if series else 0
    goes_on = 0 < count <= len(frames) and series.frame(count - 1) is frames[count - 1]
    if not goes_on:
        series = ContourSeries(recording.inventory)
        _recorded[uid] = series
    for frame in frames[len(series) :]:
        series.append(frame)
    return series


def _paint(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    found = shown_frame(scene)
    if found is None:
        return
    frame, row = found
    series = series_of(scene)
    rows = {name: row for row, name in enumerate(series.body_names)}
    if is_placed(scene):
        moving = {name: body for name, body in rows.items() if series.moves[body]}
        recorded = series.frame(row)
        place(scene, depsgraph, moving, recorded.positions_m, recorded.rotations)
    paint(scene, depsgraph, rows, np.where(series.moves[:, None], frame.screen_colours, np.nan))


@persistent
def _after_frame(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    _follow(scene, depsgraph)


@persistent
def _after_update(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    _follow(scene, depsgraph)  # an edited body was evaluated anew, and has its own colour again


@persistent
def _before_load(*_: object) -> None:
    stop()
    forget_all()


def _follow(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    shown = _shows.get(scene.session_uid)
    if shown is None or shown.error:
        return
    try:
        _paint(scene, depsgraph)
    except Exception as error:  # an exception in a handler would be lost in the console: it is kept for the sidebar
        shown.error = error


_callbacks = Callbacks(frame_change_post=_after_frame, depsgraph_update_post=_after_update, load_pre=_before_load)

atexit.register(stop)
