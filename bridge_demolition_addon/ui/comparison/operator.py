"""Operators that show another run beside this one, and remove it."""

from __future__ import annotations

import bpy
import numpy as np

from ..ground.areas import plan_of
from ..operators import UndoableAction, absolute, unset
from ..viewport import look_at_box, redraw_views
from . import shown
from .figures import findings_of


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
