"""Settings of stages, kept in the scene as part of ``scene.bda``."""

import bpy
from bpy.props import IntProperty

from ...simulation.blender_events import contours_of
from ..contours import view as contour_view
from ..sidebar import path_property


def _show_stage(settings: bpy.types.PropertyGroup, _context: bpy.types.Context) -> None:
    display = contours_of(settings.id_data)
    display.stage = min(settings.stage_shown, len(display.stages)) if display.stages else 1
    contour_view.follow(settings.id_data)


class StageProperties:
    """Part of the settings of a scene."""

    stages_directory: path_property(
        "Tables", "Folder for stages.csv, utilisation.csv and criticality.csv; none to write no tables", "DIR_PATH"
    )
    stage_shown: IntProperty(
        name="Stage",
        description="Which stage is told in full, and shown by the contours of utilisation at rest, such as 1",
        default=1,
        min=1,
        soft_max=20,
        update=_show_stage,
    )
