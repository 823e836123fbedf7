"""Panels in the sidebar of the 3D view, tab BDA."""

import bpy

from ..simulation import handlers


class _SidebarPanel:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "BDA"


class BDA_PT_scenario(_SidebarPanel, bpy.types.Panel):
    """Scenario file to build the scene from."""

    bl_label = "Scenario"

    def draw(self, context: bpy.types.Context) -> None:
        self.layout.use_property_split = True
        self.layout.prop(context.scene.bda, "scenario_path")
        self.layout.operator("bda.build_scenario")


class BDA_PT_handler(_SidebarPanel, bpy.types.Panel):
    """Recording while the timeline plays."""

    bl_label = "Frame Change Event Handler"

    def draw(self, context: bpy.types.Context) -> None:
        settings, recording = context.scene.bda, handlers.current()
        self.layout.use_property_split = True
        column = self.layout.column()
        column.enabled = recording is None
        column.prop(settings, "output_directory")
        column.prop(settings, "overwrite")
        row = self.layout.row(align=True)
        row.operator("bda.register_handler")
        row.operator("bda.unregister_handler")
        if recording and recording.error:
            self.layout.label(text=str(recording.error), icon="ERROR")
        elif recording:
            self.layout.label(text=f"{recording.recorded_frames} frames, {recording.broken} connections broken")


CLASSES = (BDA_PT_scenario, BDA_PT_handler)


def register() -> None:
    """Show the panels."""
    for each in CLASSES:
        bpy.utils.register_class(each)


def unregister() -> None:
    """Take the panels away."""
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
