"""Settings of the panel Study, besides the keys of a study file."""

import os

import bpy
from bpy.props import BoolProperty, IntProperty

from ..sidebar import path_property


class StudyProperties:
    """Part of the settings of a scene."""

    study_path: path_property("Study", "Study file (TOML) to load, with the scenario that it varies")
    study_directory: path_property(
        "Folder", "Folder of the study: made if new; one that was stopped goes on where it was", "DIR_PATH"
    )
    study_jobs: IntProperty(
        name="Draws at a Time",
        description="How many draws run at a time, each in a Blender of its own; such as 1 less than processors",
        default=max((os.cpu_count() or 1) - 1, 1),
        min=1,
        max=1000,
    )
    show_study: BoolProperty(
        name="Show Map and Limit",
        description="Show on the ground how likely debris gets to a place, and the limit of the reach as a line",
        default=True,
        update=lambda _settings, context: redraw_views(context),
    )


def redraw_views(context: bpy.types.Context) -> None:
    """Have all 3D views drawn anew, with their sidebars."""
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()
