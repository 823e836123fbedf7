"""Panel of another run next to this one: settings, buttons, and the key figures of both."""

from pathlib import Path

import bpy
import numpy as np
from bpy.props import BoolProperty, FloatProperty, StringProperty

from ...errors import DemolitionError
from ..ground.decorator import plan_of
from ..languages.words import translated
from ..operators import UndoableAction, absolute, unset
from ..results.shown_run import shown_run
from ..sidebar import SidebarPanel, draw_sentence, path_property
from ..viewport import look_at_box, redraw_views
from . import shown
from .shown import FigureRow, drawing, figure_rows, findings_of

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


class BDA_OT_compare_run(UndoableAction, bpy.types.Operator):
    """Show the other run beside this one, at the same simulated time, with the key figures of both; it is only drawn"""

    bl_label = "Show Beside"
    blocked_by = (unset("compared_directory", "Choose the folder of another run first"),)

    def act(self, context: bpy.types.Context) -> str:
        scene = context.scene
        folder = absolute(scene.bda.compared_directory).resolve()
        run = shown.OtherRun.read(folder)
        findings_of(folder)
        scene.bda.compared_folder, scene.bda.show_compared = str(folder), True
        scene.bda.compared_shift_m = shown.shift_beside(scene, run)
        look_at_box(context, _box_of_both(scene, run))
        redraw_views()
        return f"{run.title}: {len(run.series)} frames, {scene.bda.compared_shift_m:g} m beside this run"


def _box_of_both(scene: bpy.types.Scene, run: shown.OtherRun) -> np.ndarray:
    """Return the box around both bridges as they were built, (2, 3) m."""
    left, bottom, right, top = run.plan_m
    shift = scene.bda.compared_shift_m
    heights = run.surfaces.at(0)[0][:, :, 2]
    box = np.array([(left, bottom + shift, 0.0), (right, top + shift, heights.max(initial=1.0))])
    plan = plan_of(scene)
    if plan is None or plan.is_empty():
        return box
    own = np.array(plan.bounds()).reshape(2, 2)
    box[0, :2], box[1, :2] = np.minimum(box[0, :2], own[0]), np.maximum(box[1, :2], own[1])
    return box


def _nothing_beside(context: bpy.types.Context) -> str | None:
    return None if context.scene.bda.compared_folder else "No other run is shown"


class BDA_OT_lay_over(UndoableAction, bpy.types.Operator):
    """Draw the other run over this one, seen through; again, beside it"""

    bl_label = "Over or Beside"
    blocked_by = (_nothing_beside,)

    def act(self, context: bpy.types.Context) -> None:
        settings = context.scene.bda
        run = shown.other_run(context.scene)
        settings.compared_shift_m = 0.0 if settings.compared_shift_m else shown.shift_beside(context.scene, run)


class BDA_OT_forget_compared(UndoableAction, bpy.types.Operator):
    """Show the other run no more; its files stay"""

    bl_label = "Remove Other Run"
    blocked_by = (_nothing_beside,)

    def act(self, context: bpy.types.Context) -> None:
        context.scene.bda.compared_folder = ""
        redraw_views()


class ComparisonProperties:
    """Part of the settings of a scene."""

    compared_directory: path_property(
        "Other Run", "Folder of another run, of this scenario or of another one, to show beside this one", "DIR_PATH"
    )
    compared_folder: StringProperty(options={"HIDDEN"}, description="Folder of the run that is shown beside this one")
    show_compared: BoolProperty(
        name="Show Other Run",
        description="Draw the bodies of the other run at the simulated time of the frame that is shown. They are only "
        "drawn: nothing is simulated with them",
        default=True,
        update=redraw_views,
    )
    compared_shift_m: FloatProperty(
        name="Beside By",
        description="How far beside this run the other one is drawn, along y: 0 m lays it over this one, and it is "
        "seen through then",
        default=0.0,
        soft_min=-1000.0,
        soft_max=1000.0,
        step=100,
        unit="LENGTH",
        update=redraw_views,
    )
