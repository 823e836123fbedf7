"""The panels Results, with the results of the last recording, and Report."""

from pathlib import Path

import bpy

from ...errors import OutputError
from ...model.scenario import ReportSettings
from ...simulation.kept_run import has_run
from .. import key_figures as figures_in_view
from ..key_figures import peak_of_selected
from ..languages.words import translated
from ..recording.session import last_recording
from ..scenario.ui import draw_keys
from ..sidebar import SidebarPanel, draw_of_one_cut, draw_sentence
from .operator import can_report, report_of
from .shown_run import LargestValue, shown_run, why_no_run


class BDA_PT_results(SidebarPanel, bpy.types.Panel):
    """Results of the last recording."""

    bl_label = "Results"
    bl_options = set()  # open: it is there only once something was recorded

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return last_recording() is not None or has_run(context.scene)

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        try:
            run, why_not = shown_run(context.scene), why_no_run(context.scene)
        except OutputError as error:
            draw_sentence(layout, context, str(error))
            return
        if run is None:
            draw_sentence(layout, context, why_not)
            return
        draw_sentence(layout, context, run.title, icon="NONE")
        if run.stands:
            draw_sentence(layout, context, run.stands, icon="CHECKMARK")
        for doubt in run.doubts:
            draw_sentence(layout, context, doubt)
        column = layout.column(align=True)
        for line in run.lines:
            column.label(text=line, translate=False)
        self._draw_largest(translated("Peak force"), run.peak_force)
        if run.peak_force:
            draw_sentence(layout, context, run.explained_peak, icon="INFO")
        self._draw_largest(translated("Largest throw"), run.largest_throw)
        if run.bearings:
            _draw_bearings(layout.column(align=True), context, run.bearings)
            draw_of_one_cut(layout, context)
        self._draw_in_view(context)
        layout.operator("bda.look_at_bridge", icon="LOOP_BACK")
        row = layout.row(align=True)
        row.operator("bda.open_results")
        row.operator("bda.draw_charts")
        row = layout.row(align=True)
        row.operator("bda.go_to_peak", icon="EYEDROPPER")
        row.operator_menu_enum("bda.show_picture", "picture", icon="IMAGE_DATA")
        layout.operator_menu_enum("bda.export_run", "form", icon="EXPORT")

    def _draw_in_view(self, context: bpy.types.Context) -> None:
        """Draw what switches the key figures over the view, and a button to the peak of what is selected there."""
        self.layout.prop(context.scene.bda, "figures_in_view")
        if error := figures_in_view.drawing.error:
            draw_sentence(self.layout, context, error)
        if peak := peak_of_selected(context):
            self._draw_largest(*peak)

    def _draw_largest(self, label: str, largest: LargestValue | None) -> None:
        """Draw a largest value, with a button that leads to where and when it was."""
        if largest is None:
            return
        column = self.layout.column(align=True)
        column.label(text=f"{label}: {largest.text}", translate=False)
        where = translated("{}, frame {}").format(largest.body, largest.frame)
        go = column.operator("bda.go_to_body", text=where, icon="VIEWZOOM", translate=False)
        go.body, go.frame = largest.body, largest.frame


def _draw_bearings(layout: bpy.types.UILayout, context: bpy.types.Context, rows: tuple[tuple[str, ...], ...]) -> None:
    """Draw the table of bearings; names, and what happened, have lines of their own: six columns are too narrow."""
    for name, *forces, happened in rows:
        draw_sentence(layout, context, ", ".join(filter(None, (name, happened))), icon="NONE")
        line = layout.row(align=True)
        for text in forces:
            line.label(text=text, translate=False)


class BDA_PT_report(SidebarPanel, bpy.types.Panel):
    """The report of a run."""

    bl_label = "Report"
    bl_options = set()  # open: it is there only once there may be something to report

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return can_report(context.scene)

    def draw(self, context: bpy.types.Context) -> None:
        self.layout.prop(context.scene.bda, "report_language")
        self.layout.prop(context.scene.bda, "report_units")
        column = self.layout.column(align=True)
        column.operator("bda.make_report")
        column.operator("bda.make_word_report")
        column.operator("bda.open_report")
        column.operator("bda.show_survey", icon="POINTCLOUD_DATA")
        if path := report_of(context.scene):
            text = translated("Made: {}").format(Path(path.parent.name, path.name))
            draw_sentence(self.layout, context, text, icon="CHECKMARK")


class BDA_PT_document(SidebarPanel, bpy.types.Panel):
    """What identifies the report: project, people, revision."""

    bl_label = "Document Control"

    def draw(self, context: bpy.types.Context) -> None:
        group = context.scene.bda.scenario.report
        draw_keys(self.layout, context, group, ReportSettings, without=("units", "language"))
