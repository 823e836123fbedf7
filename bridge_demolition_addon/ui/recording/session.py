"""What goes on between the operators: a run that is at work, the sidebar's redrawing, and the last recording."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import bpy

from ...model.run_folder.summary import RunSummary
from ...simulation.blender_events import running_recording, stop_recording
from ...simulation.recording.recorder import Recording
from .. import task_progress
from ..sidebar import redraw_sidebars

_REDRAWN_EVERY_S = 0.25

_timers: list[bpy.types.Timer] = []
"""That of Run, if it is at work: switching the extension off takes its operator away without a word to it."""

_recordings: list[LastRecording] = []
"""The last one, if any was made since Blender started."""


class LastRecording(NamedTuple):
    """A recording with its folder and summary, for the panel of its results and the charts of them."""

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


def begin_run(context: bpy.types.Context, tick_s: float, frames: int) -> task_progress.TaskProgress:
    """Have Blender call the operator Run again and again, and show its progress."""
    _timers.append(context.window_manager.event_timer_add(tick_s, window=context.window))
    return task_progress.begin(context, "Running", "frames", frames)


def end_run(context: bpy.types.Context) -> None:
    """Take back what Run shows, if it is at work."""
    if not _timers:
        return
    context.window_manager.event_timer_remove(_timers.pop())
    task_progress.end(context)


def run_goes_on() -> bool:
    """Return whether Run is at work, which plays the timeline itself and is stopped by Esc alone."""
    return bool(_timers)


def redraw_while_recording() -> None:
    """Redraw the sidebars for as long as a recording runs: Blender leaves them alone while the timeline plays."""
    if not bpy.app.timers.is_registered(_redraw):
        bpy.app.timers.register(_redraw, persistent=True)


def unregister() -> None:
    """End a run or recording that goes on, and forget the last one."""
    end_run(bpy.context)
    stop_recording()
    if bpy.app.timers.is_registered(_redraw):
        bpy.app.timers.unregister(_redraw)
    _recordings.clear()


def _redraw() -> float | None:
    redraw_sidebars(bpy.context)
    return _REDRAWN_EVERY_S if running_recording() else None
