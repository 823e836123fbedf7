"""The panel Results: what the last recording came to."""

import shutil
import sys
from typing import Any

import bpy
from bpy.props import IntProperty, StringProperty

from ...core.blast.models import BlastModel
from ...core.errors import DemolitionError, OutputError
from ...core.results.files import FORCE_CHART
from ...core.results.summary import first_hit_s
from ..operators import Refusing, recording_runs, refused
from ..recording import last_recording
from ..sidebar import SidebarPanel, draw_sentence
from ..viewport import look_at_selected, select_only

_CHARTS = "charts"
_OPENER = "xdg-open"
"""Opens folders on Linux. Blender, where it is missing, only writes to the console."""
_N_PER_KN = 1000.0
_SURROUNDINGS = 3.0


class BDA_OT_go_to_body(Refusing, bpy.types.Operator):
    """Go to that frame, select the body and look at it"""

    bl_idname = "bda.go_to_body"
    bl_label = "Go to Body and Frame"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012  Blender wants a plain set

    body: StringProperty(name="Body", description="Name of the body")
    frame: IntProperty(name="Frame", description="Frame to go to", min=0)

    @classmethod
    def why_not(cls, context: bpy.types.Context) -> str | None:
        return recording_runs() or (None if context.mode == "OBJECT" else "Go to object mode first")

    def execute(self, context: bpy.types.Context) -> set[str]:
        body = context.view_layer.objects.get(self.body)
        if body is None:
            self.report({"ERROR"}, f"{self.body!r} is not in this scene any more")
            return {"CANCELLED"}
        context.scene.frame_set(self.frame)
        select_only(context, [body])
        context.view_layer.objects.active = body
        look_at_selected(context, _SURROUNDINGS)
        return {"FINISHED"}


class BDA_OT_open_results(Refusing, bpy.types.Operator):
    """Open the folder of the last recording in the system's file manager"""

    bl_idname = "bda.open_results"
    bl_label = "Open Folder"

    @classmethod
    def why_not(cls, _context: bpy.types.Context) -> str | None:
        return _nothing_recorded()

    def execute(self, _context: bpy.types.Context) -> set[str]:
        folder = last_recording.last().folder
        if not folder.is_dir():
            return refused(self, OutputError(f"{folder}: is not there any more"))
        if sys.platform.startswith("linux") and not shutil.which(_OPENER):
            return refused(self, OutputError(f"{folder}: this system has no {_OPENER}, which opens folders"))
        bpy.ops.wm.path_open(filepath=str(folder))
        return {"FINISHED"}


class BDA_OT_draw_charts(Refusing, bpy.types.Operator):
    """Draw the forces over time, and the charts to choose charges by, into the folder of the last recording"""

    bl_idname = "bda.draw_charts"
    bl_label = "Draw Charts"

    @classmethod
    def why_not(cls, _context: bpy.types.Context) -> str | None:
        return _nothing_recorded()

    def execute(self, context: bpy.types.Context) -> set[str]:
        # Loading matplotlib takes a second, which switching the extension on need not wait for.
        from ...charts.blast_design import ChartSettings, write_charts
        from ...charts.force_chart import plot_forces

        last = last_recording.last()
        folder = last.folder / _CHARTS
        model = BlastModel(context.scene.bda.scenario.blast.model)
        try:
            paths = write_charts(folder, ChartSettings(model=model))
            plot_forces(last.results, folder / FORCE_CHART, last.summary["title"], first_hit_s(last.summary))
        except DemolitionError as error:
            return refused(self, error)
        except OSError as error:
            return refused(self, OutputError(f"{folder}: cannot be written ({error.strerror})"))
        self.report({"INFO"}, f"{len(paths) + 1} charts are in {folder}")
        return {"FINISHED"}


class BDA_PT_results(SidebarPanel, bpy.types.Panel):
    """What the last recording came to."""

    bl_label = "Results"
    bl_options = {"DEFAULT_CLOSED"}  # noqa: RUF012

    def draw(self, context: bpy.types.Context) -> None:
        layout, last = self.layout, last_recording.last()
        if last is None:
            draw_sentence(layout, context, "Nothing was recorded yet: register the handler and play.", icon="INFO")
            return
        summary = last.summary
        draw_sentence(layout, context, summary["title"], icon="NONE")
        column = layout.column(align=True)
        for line in lines_of(summary):
            column.label(text=line)
        self._draw_place("Largest peak force", summary["largest_resultant"], last_frame=None)
        self._draw_place("Largest throw", summary["largest_throw"], last_frame=int(last.results.frames[-1]))
        row = layout.row(align=True)
        row.operator("bda.open_results")
        row.operator("bda.draw_charts")

    def _draw_place(self, label: str, found: dict[str, Any] | None, last_frame: int | None) -> None:
        """A largest value, with a button that leads to where and when it was."""
        if found is None:
            return
        value = f"{found['force_N'] / _N_PER_KN:,.0f} kN" if "force_N" in found else f"{found['throw_m']:.2f} m"
        frame = found.get("frame", last_frame)
        column = self.layout.column(align=True)
        column.label(text=f"{label}: {value}".replace(",", " "))
        go = column.operator("bda.go_to_body", text=f"{found['body']}, frame {frame}", icon="VIEWZOOM")
        go.body, go.frame = found["body"], frame


CLASSES = (BDA_OT_go_to_body, BDA_OT_open_results, BDA_OT_draw_charts, BDA_PT_results)


def lines_of(summary: dict[str, Any]) -> list[str]:
    """The totals of a summary, each in a few words."""
    connections = summary["connections"]
    return [
        f"Total mass: {summary['mass_kg']['shard']:,.0f} kg".replace(",", " "),
        f"Broken: {connections['broken']} of {connections['count']} connections",
        f"{summary['frames']} frames, {summary['simulated_s']:.2f} s",
    ]


def _nothing_recorded() -> str | None:
    return None if last_recording.last() else "Nothing was recorded yet: register the handler and play"
