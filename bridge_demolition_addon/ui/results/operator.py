"""Operators of results: looking at a body, opening the folder, drawing charts and making the report."""

import shutil
import sys
from typing import Any

import bpy
from bpy.props import IntProperty, StringProperty

from ...core.blast.models import BlastModel
from ...core.errors import OutputError, SimulationError, writing
from ...core.results.files import FORCE_CHART
from ...core.results.summary import first_hit_s
from ...simulation.kept_run import is_run_of
from ...simulation.results_folder import keep_site
from ..operators import Action, absolute, recording_runs
from ..recording.session import last_recording
from ..scenario.built import shown_site
from ..viewport import look_at_selected, select_only

_CHARTS = "charts"
_OPENER = "xdg-open"
"""Opens folders on Linux. Blender, where it is missing, only writes to the console."""
_SURROUNDINGS = 3.0
"""How many times as far away as needed the view stays from a body that is shown."""


class BDA_OT_go_to_body(Action, bpy.types.Operator):
    """Go to that frame, select the body and look at it"""

    bl_idname = "bda.go_to_body"
    bl_label = "Go to Body and Frame"
    bl_options = {"REGISTER", "UNDO"}
    changes_scene = False
    changes_objects = True

    body: StringProperty(name="Body", description="Name of the body")
    frame: IntProperty(name="Frame", description="Frame to go to", min=0)

    @classmethod
    def why_not(cls, context: bpy.types.Context) -> str | None:
        return recording_runs(context)

    def act(self, context: bpy.types.Context) -> str | None:
        body = context.view_layer.objects.get(self.body)
        if body is None:
            raise SimulationError(f"{self.body!r} is not in this scene any more")
        context.scene.frame_set(self.frame)
        select_only(context, [body])
        context.view_layer.objects.active = body
        look_at_selected(context, _SURROUNDINGS)


class _OfLastRecording(Action):
    """Base of the buttons that work on the last recording."""

    changes_scene = False

    @classmethod
    def why_not(cls, _context: bpy.types.Context) -> str | None:
        return None if last_recording() else "Nothing was recorded yet: register the handler and play"


class BDA_OT_open_results(_OfLastRecording, bpy.types.Operator):
    """Open the folder of the last recording in the system's file manager"""

    bl_idname = "bda.open_results"
    bl_label = "Open Folder"

    def act(self, _context: bpy.types.Context) -> str | None:
        folder = last_recording().folder
        if not folder.is_dir():
            raise OutputError(f"{folder}: is not there any more")
        if sys.platform.startswith("linux") and not shutil.which(_OPENER):
            raise OutputError(f"{folder}: this system has no {_OPENER}, which opens folders")
        bpy.ops.wm.path_open(filepath=str(folder))


class BDA_OT_draw_charts(_OfLastRecording, bpy.types.Operator):
    """Draw forces over time into the folder of the last recording, and charts to choose charges by if it had any"""

    bl_idname = "bda.draw_charts"
    bl_label = "Draw Charts"

    def act(self, context: bpy.types.Context) -> str | None:
        # Loading matplotlib takes a second, which switching the extension on need not wait for.
        from ...charts.blast_design import ChartSettings, write_charts
        from ...charts.force_chart import plot_forces

        last = last_recording()
        folder = last.folder / _CHARTS
        model = BlastModel(context.scene.bda.scenario.blast.model)
        with writing(folder):
            folder.mkdir(exist_ok=True)
            paths = write_charts(folder, ChartSettings(model=model)) if had_charges(last.summary) else []
            plot_forces(
                last.recording.results(), folder / FORCE_CHART, last.summary["title"], first_hit_s(last.summary)
            )
        return f"{len(paths) + 1} charts are in {folder}" if paths else f"{folder / FORCE_CHART}"


class BDA_OT_make_report(Action, bpy.types.Operator):
    """Make a report, as a page and as a PDF, from the results in the folder, with zones and neighbours as shown here"""

    bl_idname = "bda.make_report"
    bl_label = "Make Report"
    changes_scene = False

    @classmethod
    def why_not(cls, context: bpy.types.Context) -> str | None:
        if not context.scene.bda.output_directory:
            return "Choose the folder with the results first"
        return recording_runs(context)

    def act(self, context: bpy.types.Context) -> str | None:
        # Loading matplotlib takes a second, which nobody should wait for when the add-on is switched on.
        from ...report.write import write_report

        scene, folder = context.scene, absolute(context.scene.bda.output_directory)
        if is_run_of(scene, folder):
            keep_site(folder, shown_site(scene.bda))
        progress = _CursorProgress(context.window_manager)
        try:
            written = write_report([folder], None, progress=progress)
        finally:
            progress.finish()
        return f"Report: {written[0]} and {written[1].name}"


class _CursorProgress:
    """Shows how far a report is, at the mouse."""

    def __init__(self, manager: bpy.types.WindowManager):
        self._manager = manager
        manager.progress_begin(0.0, 1.0)

    def stage(self, text: str) -> None:
        """Blender's cursor shows numbers only."""

    def part(self, done: int, total: int, text: str) -> None:
        """Show how many parts of a stage are done."""
        self._manager.progress_update(done / total)

    def finish(self) -> None:
        """Show the usual mouse again."""
        self._manager.progress_end()


def had_charges(summary: dict[str, Any]) -> bool:
    """Return whether anything exploded in a run, or was meant to."""
    return bool(summary.get("charges") or summary["blast"])


CLASSES = (BDA_OT_go_to_body, BDA_OT_open_results, BDA_OT_draw_charts, BDA_OT_make_report)
