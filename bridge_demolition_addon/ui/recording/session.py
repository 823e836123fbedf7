"""The last recording, and redrawing the sidebar while one runs."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import bpy

from ...model.run_folder.summary import RunSummary
from ...scene.as_built import build_of
from ...simulation.blender_events import running_recording, stop_recording
from ...simulation.recording.recorder import Recording
from ..sidebar import redraw_sidebars

_REDRAWN_EVERY_S = 0.25

_recordings: list[LastRecording] = []
"""The last one, if any was made since Blender started."""


class LastRecording(NamedTuple):
    """A recording with its folder and summary, for the panel of its results and their charts."""

    folder: Path
    recording: Recording
    summary: RunSummary


def keep_recording(folder: Path, recording: Recording, summary: RunSummary) -> None:
    """Keep a recording in place of the one before."""
    _recordings[:] = [LastRecording(folder, recording, summary)]


def forget_recording(folder: Path) -> None:
    """Forget the last recording if its results are in a folder, which is to be cleared."""
    if _recordings and _recordings[0].folder == folder:
        _recordings.pop().recording.forget()


def last_recording() -> LastRecording | None:
    """Return the last recording, None before there was one."""
    return _recordings[0] if _recordings else None


def last_recording_of(scene: bpy.types.Scene) -> LastRecording | None:
    """Return the last recording where it is of what a scene shows: results of another bridge say nothing of this."""
    last = last_recording()
    is_of_it = last and (last.recording.scene_uid, last.recording.build) == (scene.session_uid, build_of(scene))
    return last if is_of_it else None


def redraw_while_recording() -> None:
    """Redraw the sidebars for as long as a recording runs: Blender leaves them alone while the timeline plays."""
    if not bpy.app.timers.is_registered(_redraw):
        bpy.app.timers.register(_redraw, persistent=True)


def unregister() -> None:
    """End a recording that goes on, and forget the last one."""
    stop_recording()
    if bpy.app.timers.is_registered(_redraw):
        bpy.app.timers.unregister(_redraw)
    _recordings.clear()


def _redraw() -> float | None:
    redraw_sidebars(bpy.context)
    return _REDRAWN_EVERY_S if running_recording() else None
