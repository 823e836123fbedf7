"""Settings of the sidebar, kept in the scene as ``scene.bda``."""

import bpy
from bpy.props import BoolProperty, PointerProperty, StringProperty

from .contour_properties import ContourProperties


class BDA_PG_settings(ContourProperties, bpy.types.PropertyGroup):
    """What the panels ask for."""

    scenario_path: StringProperty(
        name="Scenario",
        description="Scenario file (TOML) that the bridge, its connections and the ball are built from",
        subtype="FILE_PATH",
    )
    title: StringProperty(name="Title", description="Title of the scenario that the scene was built from")
    output_directory: StringProperty(
        name="Results",
        description="Folder for the logs and results of the recording; it is made when the handler is registered",
        subtype="DIR_PATH",
    )
    overwrite: BoolProperty(
        name="Overwrite",
        description="Replace the results of an earlier recording in that folder",
        default=False,
    )


def register() -> None:
    """Give every scene its settings."""
    bpy.utils.register_class(BDA_PG_settings)
    bpy.types.Scene.bda = PointerProperty(type=BDA_PG_settings)


def unregister() -> None:
    """Take the settings away again."""
    del bpy.types.Scene.bda
    bpy.utils.unregister_class(BDA_PG_settings)
