"""The operator that renders the pictures of a run that was just played."""

from collections.abc import Iterator
from pathlib import Path

import bpy

from ...model.run_folder.files import PICTURES
from ...simulation.crash_guards.safe_render import frames_are_known
from ...simulation.display.pictures import rendered_pictures
from .. import messages
from ..modal_task import RenderingTask
from ..operators import no_world, recording_runs
from . import session
from .operator import view_of


class BDA_OT_render_run(RenderingTask, bpy.types.Operator):
    """Render the bridge before, at the frame of the largest force and after the last run, into its folder; Esc stops"""

    bl_idname = "bda.render_run"
    bl_label = "Pictures of the Run"

    _folder: Path

    @classmethod
    def disabled_reason(cls, context: bpy.types.Context) -> str | None:
        if reason := no_world(context) or recording_runs(context):
            return reason
        last = session.last_recording()
        if last is None or last.recording.scene_uid != context.scene.session_uid:
            return "Nothing was run in this scene since Blender started: run it first"
        if not frames_are_known(context.scene):
            return "Something has changed since the run: run it again first"
        return None

    def begin(self, context: bpy.types.Context) -> tuple[Iterator[Path], int]:
        messages.clear(self)
        last = session.last_recording()
        self._folder = last.folder
        key_frame, last_frame = last.summary.key_frame, last.recording.last_frame
        view = view_of(last.recording)
        return rendered_pictures(context.scene, last.folder, view, key_frame, last_frame), len(PICTURES)

    def finish(self) -> set[str]:
        messages.tell(self, "INFO", f"Pictures of the run are in {self._folder}")
        return {"FINISHED"}


CLASSES = (BDA_OT_render_run,)
