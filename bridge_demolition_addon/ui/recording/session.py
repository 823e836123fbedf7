"""The last recording, and where a recording is written to: files of its logs, folder of its results."""

import os
import re
from pathlib import Path
from typing import NamedTuple

import bpy
from bpy.props import StringProperty

from ...errors import OutputError
from ...model.run_folder.files import DEBRIS_LOG, FORCE_LOG
from ...model.run_folder.folder import numbered_folder
from ...model.run_folder.summary import RunSummary
from ...scene.as_built import build_of
from ...simulation.blender_events import running_recording, stop_recording
from ...simulation.recording.recorder import Recording
from ..operators import FileWriter, UndoableAction, absolute, recording_runs
from ..sidebar import redraw_sidebars

_REDRAWN_EVERY_S = 0.25

_recordings: "list[LastRecording]" = []
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


_SUFFIX = ".csv"

_OF_ALL_RUNS = "Bridge Demolition"
"""Folder in the user's documents, for files that were not saved yet."""


class _LogPathOperator(UndoableAction, FileWriter):
    """Base of the operators that ask for a log's file; each names the setting and the file's usual name."""

    filename_ext = _SUFFIX
    filter_glob: StringProperty(default="*" + _SUFFIX, options={"HIDDEN"})
    setting: str
    usual_name: str
    blocked_by = (recording_runs,)

    def usual_path(self, context: bpy.types.Context) -> str:
        return getattr(context.scene.bda, self.setting) or self.usual_name

    def act(self, context: bpy.types.Context) -> str | None:
        path = bpy.path.ensure_ext(self.filepath, _SUFFIX) if self.filepath else ""
        if path and absolute(path).is_dir():
            raise OutputError(f"{path}: expected a file for the log, found a folder")
        setattr(context.scene.bda, self.setting, path)


class BDA_OT_set_debris_log(_LogPathOperator, bpy.types.Operator):
    """Choose the file of the debris log; none for the folder of the results; called Set Debris Log Filepath in 2019"""

    bl_label = "Choose Debris Log"
    setting, usual_name = "debris_log_path", DEBRIS_LOG


class BDA_OT_set_force_log(_LogPathOperator, bpy.types.Operator):
    """Choose the file of the force log; none for the folder of the results; called Set Force Log Filepath in 2019"""

    bl_label = "Choose Force Log"
    setting, usual_name = "force_log_path", FORCE_LOG


def new_folder(title: str) -> Path:
    """Return a folder for a run that is not there yet: named after its scenario, with the next free number.

    It is next to the saved file, or in the user's documents where the file has not been saved.
    """
    saved = bpy.data.filepath
    parent = Path(saved).parent if saved else documents_folder() / _OF_ALL_RUNS
    return numbered_folder(parent, title)


def documents_folder() -> Path:
    """Return the user's folder for documents, as the desktop names it; their home where there is none."""
    home = Path.home()
    desktop = Path(os.environ.get("XDG_CONFIG_HOME") or home / ".config") / "user-dirs.dirs"
    text = desktop.read_text(encoding="utf-8") if desktop.is_file() else ""
    named = re.search(r'^XDG_DOCUMENTS_DIR="(.+)"', text, re.MULTILINE)
    documents = Path(named[1].replace("$HOME", str(home))) if named else home / "Documents"
    return documents if documents.is_dir() else home
