"""The panel Report: what is handed over of a run."""

import bpy

from ...core.errors import DemolitionError
from ..operators import Refusing, absolute, recording_runs, refused
from ..sidebar import SidebarPanel


class BDA_OT_make_report(Refusing, bpy.types.Operator):
    """Make a report, as a page and as a PDF, from the results in the folder"""

    bl_idname = "bda.make_report"
    bl_label = "Make Report"

    @classmethod
    def why_not(cls, context: bpy.types.Context) -> str | None:
        if not context.scene.bda.output_directory:
            return "Choose the folder with the results first"
        return recording_runs()

    def execute(self, context: bpy.types.Context) -> set[str]:
        # Loading matplotlib takes a second, which nobody should wait for when the add-on is switched on.
        from ...report.write import write_report

        progress = _CursorProgress(context.window_manager)
        try:
            written = write_report([absolute(context.scene.bda.output_directory)], None, progress=progress)
        except DemolitionError as error:
            return refused(self, error)
        finally:
            progress.finish()
        self.report({"INFO"}, f"Report: {written[0]} and {written[1].name}")
        return {"FINISHED"}


class _CursorProgress:
    """How far a report is, at the mouse."""

    def __init__(self, manager: bpy.types.WindowManager):
        self._manager = manager
        manager.progress_begin(0.0, 1.0)

    def stage(self, text: str) -> None:
        """Blender's cursor shows numbers only."""

    def part(self, done: int, total: int, text: str) -> None:
        """Show how many parts of a stage are done."""
        self._manager.progress_update(done / total)

    def finish(self) -> None:
        """Give the mouse back."""
        self._manager.progress_end()


class BDA_PT_report(SidebarPanel, bpy.types.Panel):
    """What is handed over of a run."""

    bl_label = "Report"
    bl_options = {"DEFAULT_CLOSED"}  # noqa: RUF012  Blender wants a plain set

    def draw(self, context: bpy.types.Context) -> None:
        self.layout.operator("bda.make_report")


CLASSES = (BDA_OT_make_report, BDA_PT_report)
