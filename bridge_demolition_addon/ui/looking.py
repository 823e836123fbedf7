"""What is selected, and where the 3D view looks."""

from collections.abc import Iterable

import bpy


def select_only(context: bpy.types.Context, objects: Iterable[bpy.types.Object]) -> None:
    """Select these objects and nothing else."""
    for each in context.selected_objects:
        each.select_set(False)
    for each in objects:
        each.select_set(True)


def look_at_selected(context: bpy.types.Context) -> None:
    """Let the 3D view that the mouse is in show what is selected, where the mouse is in one."""
    if context.area and context.area.type == "VIEW_3D":
        region = next(each for each in context.area.regions if each.type == "WINDOW")
        with context.temp_override(region=region):
            bpy.ops.view3d.view_selected()
