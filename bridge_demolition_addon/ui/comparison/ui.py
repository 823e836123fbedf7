"""Panel of another run beside this one, with the key figures of both."""

from pathlib import Path

import bpy

from ...errors import DemolitionError
from ..languages.words import translated
from ..results.shown_run import shown_run
from ..sidebar import SidebarPanel, draw_sentence
from .decorator import drawing
from .figures import FigureRow, figure_rows

_NAME_SHARE = 0.46


class BDA_PT_compare(SidebarPanel, bpy.types.Panel):
    """Another run beside this one in the 3D view, with the key figures of both."""

    bl_label = "Compare"

    def draw(self, context: bpy.types.Context) -> None:
        settings, layout = context.scene.bda, self.layout
        layout.prop(settings, "compared_directory", text="", placeholder=translated("Folder of another run"))
        row = layout.row(align=True)
        row.operator("bda.compare_run")
        row.operator("bda.forget_compared", text="", icon="X")
        if not settings.compared_folder:
            return
        layout.prop(settings, "show_compared")
        row = layout.row(align=True)
        row.prop(settings, "compared_shift_m")
        row.operator("bda.lay_over", text="", icon="ARROW_LEFTRIGHT")
        if drawing.error:
            draw_sentence(layout, context, drawing.error)
        self._draw_figures(context)

    def _draw_figures(self, context: bpy.types.Context) -> None:
        other = Path(context.scene.bda.compared_folder)
        try:
            run = shown_run(context.scene)
            rows = figure_rows(run.folder if run else None, other)
        except (DemolitionError, OSError) as error:
            draw_sentence(self.layout, context, str(error))
            return
        column = self.layout.box().column(align=True)
        self._draw_row(column, FigureRow("", translated("This run"), other.name))
        for row in rows:
            self._draw_row(column, row)

    @staticmethod
    def _draw_row(column: bpy.types.UILayout, row: FigureRow) -> None:
        line = column.split(factor=_NAME_SHARE)
        line.label(text=row.name, translate=False)
        values = line.split(factor=0.5)
        values.label(text=row.this, translate=False)
        values.label(text=row.other, translate=False)
