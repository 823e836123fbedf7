"""Panels in the sidebar of the 3D view, tab BDA."""

import textwrap

import bpy

from ..simulation import handlers
from ..simulation.recording import Recording

_LETTER_PX = 6.5
_EDGES_PX = 75
"""Of the sidebar, at 100 %: its tabs, the margins of a panel and an icon."""


class _SidebarPanel:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "BDA"


class BDA_PT_scenario(_SidebarPanel, bpy.types.Panel):
    """Scenario file to build the scene from."""

    bl_label = "Scenario"

    def draw(self, context: bpy.types.Context) -> None:
        self.layout.prop(context.scene.bda, "scenario_path", text="", placeholder="Scenario file")
        self.layout.operator("bda.build_scenario")


class BDA_PT_handler(_SidebarPanel, bpy.types.Panel):
    """Recording while the timeline plays."""

    bl_label = "Frame Change Event Handler"

    def draw(self, context: bpy.types.Context) -> None:
        settings, recording = context.scene.bda, handlers.current()
        column = self.layout.column()
        column.enabled = recording is None
        column.prop(settings, "output_directory", text="", placeholder="Folder for the results")
        column.prop(settings, "overwrite")
        row = self.layout.row(align=True)
        row.operator("bda.register_handler")
        row.operator("bda.unregister_handler")
        if recording:
            self._draw_state(context, recording)

    def _draw_state(self, context: bpy.types.Context, recording: Recording) -> None:
        if recording.error:
            _draw_sentence(self.layout, context, f"Recording ended early: {recording.error}")
            return
        self.layout.label(text=f"{recording.recorded_frames} frames, {recording.broken} connections broken")
        if recording.distrust:
            _draw_sentence(self.layout, context, f"Forces are estimated from motion: {recording.distrust}")


class BDA_PT_report(_SidebarPanel, bpy.types.Panel):
    """What is handed over of a run."""

    bl_label = "Report"

    def draw(self, context: bpy.types.Context) -> None:
        self.layout.operator("bda.make_report")


CLASSES = (BDA_PT_scenario, BDA_PT_handler, BDA_PT_report)


def register() -> None:
    """Show the panels."""
    for each in CLASSES:
        bpy.utils.register_class(each)


def unregister() -> None:
    """Take the panels away."""
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)


def _draw_sentence(layout: bpy.types.UILayout, context: bpy.types.Context, text: str) -> None:
    """A warning on as many lines as it needs, as Blender cuts off what is wider than the sidebar."""
    width = context.region.width / context.preferences.system.ui_scale
    column = layout.column(align=True)
    lines = textwrap.wrap(text, max(int((width - _EDGES_PX) / _LETTER_PX), 10))
    for number, line in enumerate(lines):
        column.label(text=line, icon="BLANK1" if number else "ERROR")
