"""The panels of runs and of recording by hand, with the files of the logs."""

from __future__ import annotations

import bpy

from ...simulation.blender_events import running_recording
from ...simulation.recording.recorder import Recording
from ..connection_counts import counts_line
from ..languages.words import translated
from ..scenario.built import changed_in_blender, changes
from ..scenario.ui import draw_changes, draw_run
from ..sidebar import SidebarPanel, draw_sentence
from .beside import draw_run_beside
from .paths import BDA_OT_set_debris_log, BDA_OT_set_force_log


class BDA_PT_run(SidebarPanel, bpy.types.Panel):
    """Run the demolition, and choose the folder of its results."""

    bl_label = "Run"
    bl_options = set()

    def draw(self, context: bpy.types.Context) -> None:
        settings, recording = context.scene.bda, running_recording()
        changed = [] if recording else changes(settings)
        draw_run(self.layout.column(align=True), settings, has_changed=bool(changed))
        draw_run_beside(self.layout.column(align=True), context, has_changed=bool(changed))
        column = _draw_folder(self.layout, settings)
        column.prop(settings, "pictures_of_run")
        if recording:
            _draw_state(self.layout, context, recording)
        if changed:
            draw_changes(self.layout, context, changed)
        for change in changed_in_blender(context.scene):
            text = f"{change.key} is {change.shown} in Blender, and runs so; built {change.built}"
            draw_sentence(self.layout, context, text, icon="INFO")


class BDA_PT_handler(SidebarPanel, bpy.types.Panel):
    """Recording while the timeline plays; called Frame Change Event Handler in 2019."""

    bl_label = "Record by Hand"

    def draw(self, context: bpy.types.Context) -> None:
        _draw_folder(self.layout, context.scene.bda)
        column = self.layout.column(align=True)
        column.operator("bda.register_handler")
        column.operator("bda.unregister_handler")
        row = self.layout.row(align=True)
        row.operator("bda.bake")
        row.operator("bda.delete_bake")


class BDA_PT_post_processing(SidebarPanel, bpy.types.Panel):
    """Other files for the logs of debris and forces; called Post Processing in 2019."""

    bl_label = "Log Files"

    def draw(self, context: bpy.types.Context) -> None:
        settings = context.scene.bda
        for operator in (BDA_OT_set_debris_log, BDA_OT_set_force_log):
            column = self.layout.column(align=True)
            column.enabled = running_recording() is None
            column.operator(operator.bl_idname)
            column.prop(settings, operator.setting, text="", placeholder=translated("In the folder of the results"))


def _draw_folder(layout: bpy.types.UILayout, settings: bpy.types.PropertyGroup) -> bpy.types.UILayout:
    """Draw where results go, greyed while something is recorded, and return the column of it."""
    column = layout.column()
    column.enabled = running_recording() is None
    column.prop(settings, "output_directory", text="", placeholder=translated("A new folder for each run"))
    column.prop(settings, "overwrite")
    return column


def _draw_state(layout: bpy.types.UILayout, context: bpy.types.Context, recording: Recording) -> None:
    if recording.error:
        draw_sentence(layout, context, translated("Recording ended early: {}").format(recording.error))
        return
    layout.label(text=translated("{} frames").format(recording.recorded_frames), translate=False)
    draw_sentence(layout, context, counts_line(recording.counts), icon="NONE")
    if recording.layout_error:
        text = translated("Forces are estimated from motion: {}").format(recording.layout_error)
        draw_sentence(layout, context, text)
    elif recording.rigid_because:
        text = translated("Connections are rigid, not elastic: {}").format(recording.rigid_because)
        draw_sentence(layout, context, text)
