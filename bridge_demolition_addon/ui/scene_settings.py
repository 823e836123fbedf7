"""Settings of the sidebar, kept in the scene as ``scene.bda``."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, IntProperty, PointerProperty, StringProperty

from .blast import prop as charge_properties
from .contours.prop import ContourProperties
from .scenario import prop as scenario_properties
from .sidebar import path_property


def _settings_class(scenario_group: type[bpy.types.PropertyGroup]) -> type[bpy.types.PropertyGroup]:
    properties: dict[str, Any] = {
        "scenario_path": path_property(
            "Scenario", "Scenario file (TOML) to load or to save; Build Scenario loads one that was not loaded yet"
        ),
        "loaded_path": StringProperty(options={"HIDDEN"}, description="Scenario file that was loaded or saved last"),
        "scenario": PointerProperty(type=scenario_group),
        "title": StringProperty(name="Title", description="Title of the scenario that the scene was built from"),
        "built_scenario": StringProperty(options={"HIDDEN"}, description="The scenario that the scene was built from"),
        "charge_index": IntProperty(
            name="Charge",
            description="The charge whose properties are shown below the list",
            min=0,
            update=charge_properties.select_shown,
        ),
        "charge_explosive": EnumProperty(
            name="Explosive",
            description="What the charge is made of",
            items=charge_properties.EXPLOSIVE_ITEMS,
            get=charge_properties.shown_explosive,
            set=charge_properties.set_explosive,
        ),
        "charge_burst": EnumProperty(
            name="Burst",
            description="Whether the charge detonates in the air, or on the ground, which throws the wave back",
            items=charge_properties.BURST_ITEMS,
            get=charge_properties.shown_burst,
            set=charge_properties.set_burst,
        ),
        "charges_given": StringProperty(options={"HIDDEN"}, description="Charges as they were loaded, in JSON"),
        "total_mass": StringProperty(options={"HIDDEN"}, description="Mass of all active bodies but the ball"),
        "output_directory": path_property(
            "Results",
            "Folder for the logs and results of the recording; it is made when the handler is registered",
            "DIR_PATH",
        ),
        "overwrite": BoolProperty(
            name="Overwrite",
            description="Replace the results of an earlier recording in that folder, and log files that are there",
            default=False,
        ),
        "debris_log_path": path_property("Debris Log", "File for the debris log; none for the folder of the results"),
        "force_log_path": path_property("Force Log", "File for the force log; none for the folder of the results"),
    }
    contents = {"__doc__": "Settings that the panels show.", "__annotations__": properties}
    return type("BDA_PG_settings", (ContourProperties, bpy.types.PropertyGroup), contents)


def register() -> None:
    """Give every scene its settings."""
    settings_class = _settings_class(scenario_properties.register())
    bpy.utils.register_class(settings_class)
    bpy.types.Scene.bda = PointerProperty(type=settings_class)


def unregister() -> None:
    """Take the settings from all scenes."""
    del bpy.types.Scene.bda
    bpy.utils.unregister_class(scenario_properties.registered_group("BDA_PG_settings"))
    scenario_properties.unregister()
